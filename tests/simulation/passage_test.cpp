// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/opening/orifice.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/proof.h>

#include <chrono>
#include <iostream>

#include "simulation/moving_pairs.h"
#include "simulation/passes.h"
#include "support/campaign.h"

namespace vericone::simulation::passage_test {
namespace {

using Eigen::Vector2d;
using namespace passes;

MovingOrifice facing(double radius, bool wall = true) {
  MovingOrifice orifice;
  orifice.opening = Opening::circle(radius);
  orifice.wall = wall;
  return orifice;
}

TEST(Passage, OfABallThroughARing) {
  for (const bool wall : {true, false}) {
    const Track agent = straight(ball(1), {0.5, 0, -5}, {0, 0, 1}, 10);
    const PassageProof proof = prove_passage(agent, facing(2, wall), 0, 10);
    EXPECT_EQ(proof.verdict, PassageVerdict::passed);
    EXPECT_NEAR(proof.time, 5, 1e-9);
    EXPECT_EQ(proof.direction, 1);
    EXPECT_LE((proof.place - Vector3d(0.5, 0, 0)).norm(), 1e-8);
    EXPECT_LE(proof.least_distance, 0.5);
    EXPECT_GE(proof.least_distance, 0.494);
    EXPECT_NEAR(proof.least_time, 5, 0.1);
  }
}

TEST(Passage, RoundTheRingIsNoPassage) {
  const Track agent = straight(ball(1), {3.5, 0, -5}, {0, 0, 1}, 10);
  const PassageProof round = prove_passage(agent, facing(2, false), 0, 10);
  EXPECT_EQ(round.verdict, PassageVerdict::missed);
  EXPECT_EQ(round.direction, 0);
  EXPECT_LE(round.least_distance, 0.5);
  EXPECT_GE(round.least_distance, 0.494);
  const PassageProof hit = prove_passage(agent, facing(2, true), 0, 10);
  EXPECT_EQ(hit.verdict, PassageVerdict::touched);
  EXPECT_NEAR(hit.time, 4, 1e-5);
  EXPECT_LE(hit.from, 4);
  EXPECT_LE(hit.to - hit.from, 1e-5);
  EXPECT_NEAR(hit.place.z(), 0, 1e-9);
}

/// A verdict against samples.
struct Counts {
  std::array<int, 4> verdicts{};
  int of(PassageVerdict verdict) const { return verdicts[static_cast<std::size_t>(verdict)]; }
};

void expect_common_point(const Pass& pass, const PassageProof& proof) {
  const TrueBody body(pass);
  const Motion m = pass.agent.motion(proof.to);
  const Stand s = stand(pass.orifice, proof.to);
  EXPECT_LE(body.value(m.rotation.transpose() * (proof.place - m.position)), 1e-9);
  const Vector3d own = s.frame.transpose() * (proof.place - s.center);
  EXPECT_NEAR(own.z(), 0, 1e-9);
  if (pass.orifice.wall && !within(pass.orifice.opening, own.head<2>())) return;
  double nearest = 1e9;
  if (pass.orifice.opening.polygonal()) {
    nearest = std::abs(pass.orifice.opening.depth(own.head<2>()));
  } else {
    nearest = std::abs(own.head<2>().cwiseQuotient(pass.orifice.opening.semi_axes()).norm() - 1);
  }
  EXPECT_LE(nearest, 1e-9);
}

void expect_sampled(const Pass& pass, const PassageProof& proof, Random& samples) {
  const Brute brute = brute_force(pass, samples, 400, 240);
  switch (proof.verdict) {
    case PassageVerdict::passed:
    case PassageVerdict::missed:
      EXPECT_FALSE(brute.touched) << to_string(proof.verdict) << ", sampled contact at " << brute.when;
      EXPECT_EQ(brute.passed, proof.verdict == PassageVerdict::passed);
      break;
    case PassageVerdict::touched:
      expect_common_point(pass, proof);
      if (brute.touched) {
        EXPECT_LE(proof.from, brute.when);
      }
      break;
    case PassageVerdict::undecided:
      break;
  }
}

TEST(Passage, RandomPassesAgreeWithSamples) {
  const auto seed = static_cast<unsigned>(testing::from_environment("VERICONE_SEED", 1900));
  Random random(seed), samples(seed + 1);
  SCOPED_TRACE("seed " + std::to_string(seed));
  const int cases =
      static_cast<int>(testing::from_environment("VERICONE_CASES", testing::campaign_size(300, 10'000)));
  Counts counts;
  std::uint64_t pieces = 0;
  double seconds = 0;
  for (int i = 0; i < cases; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const Pass pass = random_pass(random, random_kind(random));
    const auto start = std::chrono::steady_clock::now();
    const PassageProof proof = prove_passage(pass.agent, pass.orifice, 0, pass.end);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++counts.verdicts[static_cast<std::size_t>(proof.verdict)];
    pieces += proof.pieces;
    expect_sampled(pass, proof, samples);
  }
  std::cout << "[ passes   ] " << cases << ": passed " << counts.verdicts[0] << ", touched "
            << counts.verdicts[1] << ", missed " << counts.verdicts[2] << ", undecided " << counts.verdicts[3]
            << "; " << double(pieces) / cases << " pieces and " << 1e3 * seconds / cases << " ms a proof\n";
  EXPECT_LE(counts.of(PassageVerdict::undecided), cases / 1000);
  EXPECT_GT(counts.of(PassageVerdict::passed), cases / 8);
  EXPECT_GT(counts.of(PassageVerdict::touched), cases / 8);
  EXPECT_GT(counts.of(PassageVerdict::missed), cases / 50);
}

/// Rods that rise through a slit while they turn level, which has no bound of the second order.
TEST(Passage, LevelRodsTurningInASlit) {
  SCOPED_TRACE("seed 1914");
  Random random(1914);
  Counts counts;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Pass pass{{}, {0.9, 0.05, 0.05}, {}, Track(ball(1), {}, Orientation::fixed, 0), {}, 3};
    const double speed = 0.5, turning = random.uniform(0.5, 3), rising = random.uniform(0.2, 0.6);
    pass.agent =
        Track(ellipsoid(pass.axes), {{0, 0, -1.5 * rising}, {speed, 0, rising}, Matrix3d::Identity()},
              Orientation::level, 0);
    for (int k = 1; k <= 60; ++k) {
      const Vector3d v = pass.agent.motion(pass.agent.end()).velocity;
      pass.agent.advance(Vector3d(-v.y(), v.x(), 0) * turning, 0.05 * k);
    }
    const Vector3d there = pass.agent.motion(1.5).velocity;
    const double off = random.uniform(-0.6, 0.6);
    pass.orifice.opening = Opening::ellipse({1.1, random.uniform(0.1, 0.7)});
    pass.orifice.rotation =
        Eigen::AngleAxisd(std::atan2(there.y(), there.x()) + off, Vector3d::UnitZ()).toRotationMatrix();
    pass.orifice.position = pass.agent.motion(1.5).position;
    const PassageProof proof = prove_passage(pass.agent, pass.orifice, 0, pass.end);
    ++counts.verdicts[static_cast<std::size_t>(proof.verdict)];
    expect_sampled(pass, proof, random);
  }
  EXPECT_GT(counts.of(PassageVerdict::passed), 20);
  EXPECT_GT(counts.of(PassageVerdict::touched), 20);
}

/// The distance from the rim to an ellipsoid over all times: samples, the nearest refined. By the distance of
/// two ellipsoids, one of them as small as a point.
double sampled_distance(const Pass& pass) {
  constexpr double kPoint = 1e-9;
  const auto distance = [&](double t, const Vector2d& rim) {
    const Motion m = pass.agent.motion(t);
    const Stand s = stand(pass.orifice, t);
    const Vector3d x = s.center + s.frame.leftCols<2>() * rim;
    return separation(Ellipsoid::from_axes(m.position, pass.axes, m.rotation),
                      Ellipsoid::from_axes(x, Vector3d::Constant(kPoint)))
               .distance +
           kPoint;
  };
  const std::vector<Vector2d> rim = rim_points(pass.orifice.opening, 120);
  const auto n = static_cast<double>(rim.size());
  const auto at = [&](double place) -> Vector2d {  // between samples: the outline itself, or its edges
    const double whole = std::floor(place);
    const auto i = static_cast<std::size_t>(static_cast<long>(whole + 10 * n) % static_cast<long>(n));
    const Vector2d a = rim[i], b = rim[(i + 1) % rim.size()];
    const Vector2d x = a + (place - whole) * (b - a);
    return pass.orifice.opening.polygonal() ? x
                                            : x / x.cwiseQuotient(pass.orifice.opening.semi_axes()).norm();
  };
  double least = 1e9, when = 0, where = 0;
  for (int i = 0; i <= 150; ++i)
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const double t = pass.end * i / 150;
      if (const double d = distance(t, rim[k]); d < least) {
        least = d;
        when = t;
        where = static_cast<double>(k);
      }
    }
  for (double step = 1; step > 1e-6; step *= 0.7)
    for (const double dt : {-1.0, 0.0, 1.0})
      for (const double dk : {-1.0, 0.0, 1.0}) {
        const double t = std::clamp(when + dt * step * pass.end / 150, 0.0, pass.end), k = where + dk * step;
        if (const double d = distance(t, at(k)); d < least) {
          least = d;
          when = t;
          where = k;
        }
      }
  return least;
}

TEST(Passage, LeastDistanceIsThatOfSamples) {
  SCOPED_TRACE("seed 1910");
  Random random(1910);
  int seen = 0;
  double loosest = 1;
  for (int i = 0; seen < testing::share(120); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Kind kind = random_kind(random);
    kind.hull = false;
    if (i % 3 == 0) {  // which turn faster than a bound of their turning's rate is known
      kind.level = kind.turns = true;
      kind.straight = kind.tumbles = kind.ball = false;
    }
    const Pass pass = random_pass(random, kind);
    const PassageProof proof = prove_passage(pass.agent, pass.orifice, 0, pass.end);
    if (proof.verdict != PassageVerdict::passed && proof.verdict != PassageVerdict::missed) continue;
    ++seen;
    const double sampled = sampled_distance(pass);
    EXPECT_LE(proof.least_distance, sampled + 1e-9);
    EXPECT_GE(proof.least_distance, 0.98 * sampled - 2e-6);
    loosest = std::min(loosest, proof.least_distance / sampled);
  }
  std::cout << "[ passes   ] least distance at least " << loosest << " of what samples found\n";
}

TEST(Passage, OpeningsSmallerByLessThanTheLeastDistanceLetPass) {
  SCOPED_TRACE("seed 1911");
  Random random(1911);
  int seen = 0;
  for (int i = 0; seen < testing::share(200); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Kind kind = random_kind(random);
    kind.outline = 0;
    Pass pass = random_pass(random, kind);
    const PassageProof proof = prove_passage(pass.agent, pass.orifice, 0, pass.end);
    if (proof.verdict != PassageVerdict::passed || proof.least_distance < 1e-5) continue;
    ++seen;
    const double radius = pass.orifice.opening.semi_axes().x();
    pass.orifice.opening = Opening::circle(radius - proof.least_distance * (1 - 1e-3));
    const PassageProof narrow = prove_passage(pass.agent, pass.orifice, 0, pass.end);
    EXPECT_EQ(narrow.verdict, PassageVerdict::passed);
    EXPECT_NEAR(narrow.time, proof.time, 1e-9);
    // And of this one by 2 cm less, with which only touching or undecided is left.
    if (radius < 0.04) continue;
    pass.orifice.opening = Opening::circle(0.02);
    EXPECT_NE(prove_passage(pass.agent, pass.orifice, 0, pass.end).verdict, PassageVerdict::passed);
  }
}

/// Straight motion without spin through circles in walls: what OrificeOracle decides exactly.
TEST(Passage, StraightPassesAreThoseOfTheOrificeCone) {
  SCOPED_TRACE("seed 1912");
  Random random(1912);
  Counts counts;
  int balls = 0, facing_passes = 0, facing_touches = 0;
  const int cases = testing::campaign_size(500, 10'000);
  for (int i = 0; i < cases; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Kind kind = random_kind(random);
    kind.hull = kind.spins = kind.tumbles = false;
    kind.straight = kind.wall = true;
    kind.outline = 0;
    kind.ball = i % 2 == 0;
    Pass pass = random_pass(random, kind);
    const Motion m = pass.agent.motion(0);
    const Stand s = stand(pass.orifice, 0);
    const Vector3d w = m.velocity - pass.orifice.velocity;
    const double radius = pass.orifice.opening.semi_axes().x();
    const OrificeOracle oracle(Ellipsoid::from_axes(m.position, pass.axes, m.rotation),
                               {s.center, s.frame.col(2), radius});
    if (oracle.side() != WallSide::clear) continue;
    // Until it is through, or has hit the wall.
    const double to_wall = s.frame.col(2).dot(s.center - m.position) / s.frame.col(2).dot(w);
    const double thick = pass.axes.norm() / std::abs(s.frame.col(2).dot(w));
    const double end = to_wall > 0 ? to_wall + 1.01 * thick : 10;
    if (!(end < 1e4)) continue;
    const Track agent = straight(ellipsoid(pass.axes), m.position, m.velocity, end, m.rotation);
    const PassageProof proof = prove_passage(agent, pass.orifice, 0, end);
    ++counts.verdicts[static_cast<std::size_t>(proof.verdict)];
    const Transit transit = oracle.transit(w);
    if (transit == Transit::passes) {
      EXPECT_TRUE(proof.verdict == PassageVerdict::passed || proof.verdict == PassageVerdict::undecided);
    } else if (to_wall < 0) {
      EXPECT_EQ(proof.verdict, PassageVerdict::missed);
    } else {
      EXPECT_TRUE(proof.verdict == PassageVerdict::touched || proof.verdict == PassageVerdict::undecided);
    }
    if (!kind.ball || to_wall < 0) continue;
    ++balls;
    if (facing_orifice_transit(s.center - m.position, pass.axes.x(), radius, w) != Transit::passes) continue;
    ++facing_passes;
    if (proof.verdict == PassageVerdict::touched) ++facing_touches;
  }
  std::cout << "[ passes   ] straight: passed " << counts.verdicts[0] << ", touched " << counts.verdicts[1]
            << ", missed " << counts.verdicts[2] << ", undecided " << counts.verdicts[3] << "; of " << balls
            << " balls (2.2) calls " << facing_passes << " passing, of which " << facing_touches
            << " touched\n";
  EXPECT_LE(counts.of(PassageVerdict::undecided), cases / 1000);
  EXPECT_GT(counts.of(PassageVerdict::passed), cases / 8);
  EXPECT_GT(facing_touches, cases / 100);
}

TEST(Passage, IntoTheRingAndBackIsNoPassageAndThroughAndBackIsOne) {
  // x = 0, height 2 - 4 t + t^2 v / 4 ...: down to `deep` at t = 2 and back up, by braking and falling back.
  for (const double deep : {-0.5, -0.999999, -1.00001, -3.0}) {
    const double drop = 3 - deep;  // from z = 3
    Track agent(ball(1), {{0, 0, 3}, {0, 0, -drop}, Matrix3d::Identity()}, Orientation::fixed, 0);
    agent.advance({0, 0, drop / 2}, 4);
    EXPECT_NEAR(agent.motion(2).position.z(), deep, 1e-9);
    for (const bool wall : {true, false}) {
      const PassageProof proof = prove_passage(agent, facing(50, wall), 0, 4);
      EXPECT_EQ(proof.verdict, deep < -1 ? PassageVerdict::passed : PassageVerdict::missed) << deep;
      EXPECT_EQ(proof.direction, deep < -1 ? -1 : 0);
      EXPECT_LE(proof.least_distance, 49);
      EXPECT_GE(proof.least_distance, 0.99 * 49);
    }
  }
}

TEST(Passage, ThroughAndThenRoundBackCountsOnce) {
  // A circle of radius 4 about the rim: through the ring downwards, outside of it upwards.
  Track agent(ball(0.5), {{-4, 0, 0.001}, {0, 0, 2}, Matrix3d::Identity()}, Orientation::heading, 0);
  const double end = 2 * std::numbers::pi * 4 / 2;
  for (int i = 1; i <= 200; ++i) {
    const Vector3d v = agent.motion(agent.end()).velocity;
    agent.advance(Vector3d(v.z(), 0, -v.x()) / 2, end * i / 200);
  }
  MovingOrifice ring = facing(4, false);
  ring.position = {-4, 0, 0};
  const PassageProof inside = prove_passage(agent, ring, 1, end);
  EXPECT_EQ(inside.verdict, PassageVerdict::missed)
      << "starts beside and comes back into the ring at its end";
  ring.position = {4, 0, 0};
  const PassageProof down = prove_passage(agent, ring, 1, end);
  EXPECT_EQ(down.verdict, PassageVerdict::passed);
  EXPECT_EQ(down.direction, -1);
  EXPECT_NEAR(down.time, end / 2, 0.01);
}

TEST(Passage, DriftCoversEveryConstantCurrent) {
  SCOPED_TRACE("seed 1913");
  Random random(1913);
  int seen = 0;
  for (int i = 0; seen < testing::share(100); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Kind kind = random_kind(random);
    const Pass pass = random_pass(random, kind);
    const PassageProof proof = prove_passage(pass.agent, pass.orifice, 0, pass.end);
    if (proof.verdict != PassageVerdict::passed) continue;
    // Wholly through by more than any current carries it.
    const TrueBody body(pass);
    const Stand s = stand(pass.orifice, pass.end);
    const Motion m = pass.agent.motion(pass.end);
    const Vector3d ahead = proof.direction * s.frame.col(2);
    if (ahead.dot(m.position - s.center) - body.support(-(m.rotation.transpose() * ahead)) <
        proof.least_distance)
      continue;
    ++seen;
    ProofOptions drifting;
    drifting.drift = 0.9 * proof.least_distance / pass.end;
    const PassageProof all = prove_passage(pass.agent, pass.orifice, 0, pass.end, drifting);
    ASSERT_EQ(all.verdict, PassageVerdict::passed);
    EXPECT_LE(all.least_distance, proof.least_distance);
    EXPECT_GT(all.least_distance, 0);
    // The opening carried the other way.
    for (int k = 0; k < 4; ++k) {
      MovingOrifice carried = pass.orifice;
      carried.velocity -= drifting.drift * random.vector(1).normalized();
      const PassageProof one = prove_passage(pass.agent, carried, 0, pass.end);
      EXPECT_EQ(one.verdict, PassageVerdict::passed);
      EXPECT_LE(all.least_distance, one.least_distance * 1.0102 + 1e-6);
    }
    drifting.drift = 1e3;
    EXPECT_EQ(prove_passage(pass.agent, pass.orifice, 0, pass.end, drifting).verdict,
              PassageVerdict::undecided);
  }
}

TEST(Passage, BodiesOfOtherKinds) {
  const Matrix3d upright = Matrix3d::Identity();
  // A dented quadric within (0.4, 0.3, 0.3) sqrt(2), and a union of two balls.
  const ShapeInTime dented = DentedQuadric{{0.4, 0.3, 0.3}, {0.5, 0.5, 3, 0, false}};
  const ShapeInTime pair = RigidShape{Placed(vericone::Body::pieces(
      {CombinedEllipsoid(Ellipsoid::from_axes({0.3, 0, 0}, Vector3d::Constant(0.2))),
       CombinedEllipsoid(Ellipsoid::from_axes({-0.3, 0, 0}, Vector3d::Constant(0.2)))}))};
  const ShapeInTime box =
      RigidShape{Placed(vericone::Body(HullBody::box({-0.4, -0.2, -0.2}, {0.4, 0.2, 0.2})))};
  for (const ShapeInTime& shape : {dented, pair, box}) {
    const Track agent = straight(shape, {0.1, 0, -4}, {0, 0, 1}, 8, upright);
    EXPECT_EQ(prove_passage(agent, facing(1), 0, 8).verdict, PassageVerdict::passed);
    const Track aside = straight(shape, {3, 0, -4}, {0, 0, 1}, 8, upright);
    EXPECT_EQ(prove_passage(aside, facing(1, false), 0, 8).verdict, PassageVerdict::missed);
  }
  // Hits of the body itself are proved where it has one formula.
  EXPECT_EQ(prove_passage(straight(dented, {0, 0.9, -4}, {0, 0, 1}, 8), facing(1), 0, 8).verdict,
            PassageVerdict::touched);
  EXPECT_EQ(prove_passage(straight(box, {0.8, 0, -4}, {0, 0, 1}, 8), facing(1), 0, 8).verdict,
            PassageVerdict::touched);
  EXPECT_EQ(prove_passage(straight(pair, {0.6, 0, -4}, {0, 0, 1}, 8), facing(1), 0, 8).verdict,
            PassageVerdict::undecided);
}

/// A square frame of eight triangles about a square window, which spins and moves: the same as the polygon
/// without a wall, as long as the agent keeps to the frame's middle part.
TEST(Passage, WindowsOfMeshesLikeTheirPolygons) {
  const double in = 1, out = 6;
  const std::vector<Vector3d> points{{-out, -out, 0}, {out, -out, 0}, {out, out, 0}, {-out, out, 0},
                                     {-in, -in, 0},   {in, -in, 0},   {in, in, 0},   {-in, in, 0}};
  const std::vector<Assembly::Triangle> triangles{{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                                  {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const MeshWindow window(points, triangles, 1);
  MovingOrifice polygon;
  polygon.opening = Opening::polygon({{-in, -in}, {in, -in}, {in, in}, {-in, in}});
  SCOPED_TRACE("seed 1915");
  Random random(1915);
  Counts counts;
  for (int i = 0; i < testing::share(200); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Kind kind = random_kind(random);
    kind.hull = kind.recedes = kind.tight = false;
    Pass pass = random_pass(random, kind);
    polygon.position = pass.orifice.position;
    polygon.velocity = pass.orifice.velocity;
    polygon.rotation = pass.orifice.rotation;
    polygon.spin = pass.orifice.spin;
    Track mesh(RigidShape{window.mesh()}, {polygon.position, polygon.velocity, polygon.rotation},
               Orientation::fixed, 0);
    mesh.append(Curve::steady(mesh.motion(0), polygon.spin, 0, pass.end));
    const PassageProof proof = prove_passage(pass.agent, window, mesh, 0, pass.end);
    const PassageProof flat = prove_passage(pass.agent, polygon, 0, pass.end);
    // Beside the frame there is no wall.
    const Stand there = stand(polygon, flat.to);
    const Vector3d own = there.frame.transpose() * (flat.place - there.center);
    if (flat.verdict == PassageVerdict::touched && own.head<2>().cwiseAbs().maxCoeff() > out) continue;
    EXPECT_EQ(proof.verdict, flat.verdict);
    ++counts.verdicts[static_cast<std::size_t>(proof.verdict)];
    if (proof.verdict != PassageVerdict::passed) continue;
    EXPECT_NEAR(proof.time, flat.time, 1e-9);
    EXPECT_LE((proof.place - flat.place).norm(), 1e-7);
    const Vector3d side = mesh.motion(0).rotation * window.flat().normal();
    EXPECT_EQ(proof.direction, flat.direction * (side.dot(polygon.rotation.col(2)) > 0 ? 1 : -1));
    EXPECT_LE(proof.least_distance, 1.02 * flat.least_distance + 1e-5) << "the rim is part of the mesh";
  }
  EXPECT_GT(counts.of(PassageVerdict::passed), testing::share(80));
  EXPECT_GT(counts.of(PassageVerdict::touched), testing::share(20));
}

TEST(Passage, GrazingIsUndecidedAndBadInputIsNamed) {
  const Track agent = straight(ball(1), {1, 0, -5}, {0, 0, 1}, 10);
  EXPECT_EQ(prove_passage(agent, facing(2 + 5e-9), 0, 10).verdict, PassageVerdict::undecided);
  EXPECT_EQ(prove_passage(agent, facing(2 + 5e-8), 0, 10).verdict, PassageVerdict::passed);
  EXPECT_EQ(prove_passage(agent, facing(2 - 5e-8), 0, 10).verdict, PassageVerdict::touched);
  const auto field = [&](const Track& track, double from, double to, const ProofOptions& options) {
    try {
      (void)prove_passage(track, facing(3), from, to, options);
    } catch (const InputError& e) {
      return e.field();
    }
    return std::string();
  };
  EXPECT_EQ(field(agent, -1, 5, {}), "from");
  EXPECT_EQ(field(agent, 0, 11, {}), "to");
  EXPECT_EQ(field(agent, 0, 10, {-1, 1e-7, 0}), "padding");
  EXPECT_EQ(field(agent, 0, 10, {1e-8, 0, 0}), "resolution");
  EXPECT_EQ(field(agent, 0, 10, {1e-8, 1e-7, -0.1}), "drift");
  const ShapeInTime disc = RigidShape{CombinedEllipse(Ellipse::from_axes({0, 0}, {1, 1}))};
  EXPECT_EQ(field(straight(disc, {0, 0, 0}, {1, 0, 0}, 10), 0, 10, {}), "agent");
}

}  // namespace
}  // namespace vericone::simulation::passage_test
