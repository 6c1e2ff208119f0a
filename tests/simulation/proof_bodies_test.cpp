// SPDX-License-Identifier: BSD-3-Clause
//
// Proofs of bodies other than ellipsoids: delimited ones, whose shape may change, and hulls.
#include <gtest/gtest.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/combined/sector.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/simulation/proof.h>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "moving_pairs.h"

namespace vericone::simulation::proof_bodies_test {
namespace {

TEST(Proof, PlanarBodiesThatChangeTheirShape) {
  SCOPED_TRACE("seed 33");
  Random random(33);
  std::array<int, 3> counts{};
  for (int i = 0; i < 150; ++i) {
    const auto make = [&](bool changes) {
      const Vector3d v = random.flat_vector(15);
      const Motion start{random.flat_vector(20), v, rotation_from_heading(std::atan2(v.y(), v.x()), 0)};
      Oscillation k;
      if (changes) k = {0, 1, random.uniform(0.5, 4), random.uniform(0, 6), true};
      return turning(random, DentedConic{random.uniform(1, 6), random.uniform(1, 4), k}, start, 15, 3);
    };
    const Track a = make(i % 2 == 0), b = make(true);
    const PairProof proof = prove(a, b, 0, 3);
    ++counts[static_cast<std::size_t>(proof.verdict)];
    expect_sampled(proof, 3, [&](double t) {
      return combined_sector(*a.state(t).shape.flat(), *b.state(t).shape.flat()).sector.relation !=
             Relation::disjoint;
    });
  }
  EXPECT_GT(counts[0], 30);
  EXPECT_GT(counts[1], 30);
  EXPECT_EQ(counts[2], 0);
}

TEST(Proof, BodiesInSpaceThatChangeTheirShape) {
  SCOPED_TRACE("seed 34");
  Random random(34);
  std::array<int, 3> counts{};
  for (int i = 0; i < 60; ++i) {
    const Vector3d p = random.vector(12), q = random.vector(12);
    const Motion start_a{p, towards(random, p, 3, 4), random.rotation()};
    const Motion start_b{q, towards(random, q, 3, 4), random.rotation()};
    const Track a = turning(
        random, ellipsoid({random.uniform(1, 3), random.uniform(1, 3), random.uniform(1, 3)}), start_a, 5, 3);
    const Track b = turning(random,
                            DentedQuadric{{random.uniform(1, 4), random.uniform(1, 4), random.uniform(1, 4)},
                                          {0.5, 0.45, random.uniform(0.5, 4), random.uniform(0, 6), false}},
                            start_b, 5, 3);
    const PairProof proof = prove(a, b, 0, 3);
    ++counts[static_cast<std::size_t>(proof.verdict)];
    // Points of the surface of A inside B.
    if (proof.verdict == ProofVerdict::touched && proof.to == 0) continue;  // met from the beginning
    Random directions(99);
    const double end = proof.verdict == ProofVerdict::touched ? proof.from : 3;
    for (int j = 0; j < 200; ++j) {
      const double t = random.uniform(0, end);
      const auto body_a = *a.state(t).shape.quadric();
      const auto body_b = *b.state(t).shape.quadric();
      for (int m = 0; m < 50; ++m) {
        const Vector3d x = body_a.ellipsoid().support_point(directions.vector(1));
        EXPECT_GT(body_b.gauge(x - body_b.center()), 1);
      }
    }
    if (proof.verdict == ProofVerdict::touched) {
      const auto body_a = *a.state(proof.to).shape.quadric();
      const auto body_b = *b.state(proof.to).shape.quadric();
      EXPECT_LE(body_a.gauge(proof.place - body_a.center()), 1 + 1e-2);
      EXPECT_LE(body_b.gauge(proof.place - body_b.center()), 1 + 1e-2);
    }
  }
  EXPECT_GT(counts[0], 10);
  EXPECT_GT(counts[1], 10);
  EXPECT_LE(counts[2], 2);
}

TEST(Proof, ABallThatVisitsADentIsNotCalledTouched) {
  // The dents are at x = +-1.2 on the axis and the ellipsoid's end, which they cut off, at 3.8.
  const DentedQuadric dented{{4, 3, 3}, {0.91, 0, 0, 0, false}};
  const Track b = straight(dented, {0, 0, 0}, {0, 0, 0}, 6);
  for (const auto& [depth, verdict] :
       {std::pair(1.9, ProofVerdict::avoided), std::pair(1.0, ProofVerdict::touched)}) {
    // In along the axis until x = depth, then out.
    Track a(ball(0.3), {{8, 0, 0}, {-2 * (8 - depth) / 3, 0, 0}, Matrix3d::Identity()}, Orientation::fixed,
            0);
    a.advance({2 * (8 - depth) / 9, 0, 0}, 6);
    const PairProof proof = prove(a, b, 0, 6);
    EXPECT_EQ(proof.verdict, verdict) << depth;
    if (verdict == ProofVerdict::touched) {
      // x(t) - 0.3 = 1.2: the time is where 8 - v t + a t^2 / 2 = 1.5.
      const double rate = 7.0 * 2 / 9, when = 3 - std::sqrt(2 * (1.5 - 1.0) / rate);
      EXPECT_NEAR(proof.to, when, 1e-4);
      EXPECT_LE(proof.from, when);
    }
  }
  // The same in the plane.
  const DentedConic flat{4, 3, {0.91, 0, 0, 0, false}};
  const Track fixed = straight(flat, {0, 0, 0}, {0, 0, 0}, 6);
  for (const auto& [depth, verdict] :
       {std::pair(1.9, ProofVerdict::avoided), std::pair(1.0, ProofVerdict::touched)}) {
    Track a(DentedConic{0.3, 0.3, {}}, {{8, 0, 0}, {-2 * (8 - depth) / 3, 0, 0}, Matrix3d::Identity()},
            Orientation::fixed, 0);
    a.advance({2 * (8 - depth) / 9, 0, 0}, 6);
    EXPECT_EQ(prove(a, fixed, 0, 6).verdict, verdict) << depth;
    EXPECT_EQ(prove(fixed, a, 0, 6).verdict, verdict) << depth;
  }
}

// x = 4 sqrt(1 - k + rho^2 / 9) in the dent, so the corners of a cube's face touch first, at rho^2 = 2 h^2.
TEST(Proof, ACubeThatVisitsADentIsNotCalledTouched) {
  const double k = 0.91, h = 0.2, first = 4 * std::sqrt(1 - k + 2 * h * h / 9) + h;
  const ShapeInTime cube = RigidShape{HullBody::box(Vector3d::Constant(-h), Vector3d::Constant(h))};
  const Matrix3d turn = Eigen::AngleAxisd(1, Vector3d(1, 2, 2).normalized()).toRotationMatrix();
  // Of a dent that is never shallower than k the verdict is the same where the cube goes far in, or not at
  // all.
  for (const double amplitude : {0.0, 0.03})
    for (const double depth : {1.9, first + 0.02, first - 0.02, 1.0}) {
      if (amplitude > 0 && std::abs(depth - first) < 0.1) continue;
      const DentedQuadric dented{{4, 3, 3}, {k + amplitude, amplitude, 40, 0, false}};
      const Track b = straight(dented, {1, 1, 1}, {0, 0, 0}, 6, turn);
      Track a(
          cube,
          {Vector3d(1, 1, 1) + turn * Vector3d(8, 0, 0), turn * Vector3d(-2 * (8 - depth) / 3, 0, 0), turn},
          Orientation::fixed, 0);
      a.advance(turn * Vector3d(2 * (8 - depth) / 9, 0, 0), 6);
      const PairProof proof = depth == 1 ? prove(b, a, 0, 6) : prove(a, b, 0, 6);
      const bool meets = depth < first;
      ASSERT_EQ(proof.verdict, meets ? ProofVerdict::touched : ProofVerdict::avoided) << depth;
      if (!meets) {
        EXPECT_GT(proof.least_distance, 0);
        EXPECT_LE(proof.least_distance, depth - first);
      } else if (amplitude == 0) {
        // x(t) = 8 - v t + a t^2 / 2, which turns round at 3 s. That they meet is certified some mm later.
        const double rate = 2 * (8 - depth) / 9, when = 3 - std::sqrt(2 * (first - depth) / rate);
        EXPECT_LE(proof.from, when + 1e-9) << depth;
        EXPECT_GE(proof.to, when - 1e-9) << depth;
        EXPECT_LT(proof.to - when, 0.03) << depth;
      }
    }
}

TEST(Proof, HullsAgainstExactTimes) {
  SCOPED_TRACE("seed 35");
  Random random(35);
  std::array<int, 3> counts{};
  for (int i = 0; i < 300; ++i) {
    std::vector<Vector3d> points;
    for (int j = 0; j < 12; ++j) points.push_back(random.vector(3));
    const ShapeInTime hull = RigidShape{HullBody(points)};
    const Vector3d axes(random.uniform(0.5, 4), random.uniform(0.5, 4), random.uniform(0.5, 4));
    const ShapeInTime other =
        i % 3 == 0 ? ShapeInTime(RigidShape{HullBody::box(-axes, axes)}) : ellipsoid(axes);
    const Vector3d p = random.vector(15), q = random.vector(15);
    const Track a = straight(other, p, towards(random, p, 5, 5), 5, random.rotation());
    const Track b = straight(hull, q, towards(random, q, 5, 5), 5, random.rotation());
    const PairProof proof = prove(a, b, 0, 5), exchanged = prove(b, a, 0, 5);
    ++counts[static_cast<std::size_t>(proof.verdict)];
    EXPECT_EQ(proof.verdict, exchanged.verdict);
    const auto oracle = [&](double t) {
      const auto shape_a = a.state(t).shape;
      const HullBody body_b = *b.state(t).shape.hull();
      if (const auto* points_a = shape_a.hull()) return HullOracle(*points_a, body_b);
      return HullOracle(shape_a.quadric()->ellipsoid(), body_b);
    };
    expect_sampled(proof, 5, [&](double t) { return oracle(t).relation() != Relation::disjoint; });
    const HullOracle now = oracle(0);
    if (now.relation() != Relation::disjoint) continue;
    const Vector3d w = a.state(0).velocity - b.state(0).velocity;
    // Never meeting at all must be proved; meeting for ever includes the time asked about.
    if (now.membership(w) == Membership::out) {
      EXPECT_EQ(proof.verdict, ProofVerdict::avoided);
    }
  }
  EXPECT_GT(counts[0], 80);
  EXPECT_GT(counts[1], 80);
  EXPECT_EQ(counts[2], 0);
}

/// Whether a ball and the body are apart, by the exact or certified predicate of their kind.
bool ball_is_apart(const Vector3d& center, double radius, const WorldBody& body) {
  if (const auto* flat = body.flat()) {
    const Ellipse disc = Ellipse::from_axes(center.head<2>(), Eigen::Vector2d::Constant(radius));
    return combined_sector(disc, *flat).sector.relation == Relation::disjoint;
  }
  const Ellipsoid ball = Ellipsoid::from_axes(center, Vector3d::Constant(radius));
  if (const auto* hull = body.hull()) return HullOracle(ball, *hull).relation() == Relation::disjoint;
  const auto relation = CombinedOracle(ball, *body.quadric()).relation();
  return !relation || *relation == Relation::disjoint;
}

TEST(Proof, ABallGrownByTheLeastDistanceStillDoesNotMeet) {
  SCOPED_TRACE("seed 37");
  Random random(37);
  std::array<int, 3> avoided{}, sharp{};
  for (int i = 0; i < 240; ++i) {
    const std::size_t kind = static_cast<std::size_t>(i) % 3;
    const bool flat = kind == 2;
    const double radius = random.uniform(0.5, 3);
    ShapeInTime shape_a = ball(radius), shape_b;
    const Oscillation k{0, 1, random.uniform(0.5, 4), random.uniform(0, 6), true};  // pinched at times
    if (kind == 0) {
      std::vector<Vector3d> points;
      for (int j = 0; j < 8; ++j) points.push_back(random.vector(4));
      shape_b = RigidShape{HullBody(points)};
    } else if (kind == 1) {
      shape_b = DentedQuadric{{random.uniform(1, 4), random.uniform(1, 4), random.uniform(1, 4)}, k};
    } else {
      shape_a = DentedConic{radius, radius, {}};
      shape_b = DentedConic{random.uniform(1, 6), random.uniform(1, 6), k};
    }
    const auto start = [&] {
      Vector3d p = random.vector(20);
      Vector3d v = towards(random, p, 4, 8);
      if (flat) p.z() = v.z() = 0;
      return Motion{p, v, flat ? random.rotation_about_z() : random.rotation()};
    };
    const Track a = turning(random, shape_a, start(), 8, 4), b = turning(random, shape_b, start(), 8, 4);
    const PairProof proof = prove(a, b, 0, 4);
    EXPECT_NE(proof.verdict, ProofVerdict::undecided) << i;
    if (proof.verdict != ProofVerdict::avoided) continue;
    ++avoided[kind];
    bool near = false;
    const int samples = kind == 1 ? 100 : 1000;
    for (int j = 0; j <= samples; ++j) {
      const double t = 4.0 * j / samples;
      const WorldBody body = b.state(t).shape;
      const Vector3d center = a.motion(t).position;
      EXPECT_TRUE(ball_is_apart(center, radius + proof.least_distance * (1 - 1e-9), body)) << i;
      near = near || !ball_is_apart(center, radius + 1.1 * proof.least_distance + 1e-3, body);
    }
    sharp[kind] += near;
  }
  for (std::size_t kind = 0; kind < 3; ++kind) {
    EXPECT_GT(avoided[kind], 15) << kind;
    // Planes tell the distance of the convex hulls, which is less than that of a body seen through its dent.
    EXPECT_GE(sharp[kind], kind == 0 ? avoided[kind] : avoided[kind] / 2) << kind;
  }
}

TEST(Proof, DistancesOfBoxesAreBounds) {
  // Faces that pass at a distance of 0.25.
  const Track a = straight(RigidShape{HullBody::box({-1, -1, -1}, {1, 1, 1})}, {-10, 0, 0}, {4, 0, 0}, 5);
  const Track b = straight(RigidShape{HullBody::box({-1, -1, -1}, {1, 1, 1})}, {0, 0.5, 2.25}, {0, 0, 0}, 5);
  const PairProof proof = prove(a, b, 0, 5);
  ASSERT_EQ(proof.verdict, ProofVerdict::avoided);
  EXPECT_LE(proof.least_distance, 0.25);
  EXPECT_GE(proof.least_distance, 0.2474);
}

}  // namespace
}  // namespace vericone::simulation::proof_bodies_test
