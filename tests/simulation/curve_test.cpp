// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/curve.h>
#include <vericone/simulation/proof.h>
#include <Eigen/Geometry>
#include <cmath>

#include "moving_pairs.h"

namespace vericone::simulation::curve_test {
namespace {

Quintic random_quintic(Random& random, double size, double duration) {
  Quintic p;
  double power = 1;
  for (auto& c : p) {
    c = random.vector(size) / power;
    power *= duration;
  }
  return p;
}

Curve random_curve(Random& random, double size, double turn, double from, double to) {
  const double h = to - from;
  return {random_quintic(random, size, h), random_quintic(random, turn, h), random.rotation(), from, to};
}

/// Of an exactly orthogonal difference: the rotation vector from one to the other.
Vector3d turned(const Matrix3d& from, const Matrix3d& to) {
  const Eigen::AngleAxisd by(Matrix3d(to * from.transpose()));
  return by.angle() * by.axis();
}

TEST(Curve, DerivativesAreThoseOfThePositionAndTheRotation) {
  SCOPED_TRACE("seed 31");
  Random random(31);
  for (int i = 0; i < 200; ++i) {
    const double from = random.uniform(0, 5), h = std::pow(10, random.uniform(-2, 1));
    const Curve curve = random_curve(random, 2, i % 3 == 0 ? 3 : 0.3, from, from + h);
    for (int j = 0; j < 20; ++j) {
      const double t = from + h * random.uniform(0.01, 0.99), d = 1e-5 * h;
      const Motion before = curve.at(t - d), after = curve.at(t + d);
      const Vector3d v = curve.at(t).velocity;
      EXPECT_LE(((after.position - before.position) / (2 * d) - v).norm(), 1e-7 * (1 + v.norm() + 10 / h));
      const Vector3d a = curve.acceleration(t);
      EXPECT_LE(((after.velocity - before.velocity) / (2 * d) - a).norm(),
                1e-6 * (1 + a.norm() + 10 / h / h));
      const Vector3d omega = curve.turn(t);
      EXPECT_LE((turned(before.rotation, after.rotation) / (2 * d) - omega).norm(), 1e-6 * (1 + 100 / h));
      EXPECT_TRUE((curve.at(t).rotation.transpose() * curve.at(t).rotation).isIdentity(1e-14));
    }
    EXPECT_TRUE(curve.first_turn() == curve.turn(from));
    EXPECT_TRUE(curve.last_turn() == curve.turn(from + h));
  }
}

TEST(Curve, BoundsHoldEverywhereAndAreNotMuchTooLarge) {
  SCOPED_TRACE("seed 32");
  Random random(32);
  double slack_a = 0, slack_turn = 0, slack_bend = 0;
  const int curves = 300;
  for (int i = 0; i < curves; ++i) {
    const double h = std::pow(10, random.uniform(-2, 1));
    Curve curve = random_curve(random, 2, 0.5, 1, 1 + h);
    if (i % 4 == 0) {  // about one axis
      Quintic about;
      for (auto& c : about) c = {0, 0, random.uniform(-1, 1) / h};
      curve = Curve(random_quintic(random, 2, h), about, random.rotation(), 1, 1 + h);
    }
    double most_a = 0, most_turn = 0, most_bend = 0;
    const double d = 1e-4 * h;
    for (int j = 0; j <= 300; ++j) {
      const double t = 1 + d + (h - 2 * d) * j / 300;
      most_a = std::max(most_a, curve.acceleration(t).norm());
      most_turn = std::max(most_turn, curve.turn(t).norm());
      const Matrix3d bend =
          (curve.at(t - d).rotation - 2 * curve.at(t).rotation + curve.at(t + d).rotation) / (d * d);
      // A direction of the body: its images' second derivative.
      for (int k = 0; k < 3; ++k)
        most_bend = std::max(most_bend, bend.col(k).norm() - 1e-3 * (1 + 1 / h / h));
    }
    EXPECT_LE(most_a, curve.most_acceleration());
    EXPECT_LE(most_turn, curve.most_turn_rate());
    EXPECT_LE(most_bend, curve.most_turn_acceleration() * (1 + 1e-3));
    slack_a += curve.most_acceleration() / most_a / curves;
    slack_turn += curve.most_turn_rate() / most_turn / curves;
    slack_bend += curve.most_turn_acceleration() / most_bend / curves;
  }
  EXPECT_LT(slack_a, 1.5);
  EXPECT_LT(slack_turn, 1.5);
  EXPECT_LT(slack_bend, 4);
}

TEST(Curve, HermiteHasTheJetsAndIsOfSixthOrder) {
  SCOPED_TRACE("seed 33");
  Random random(33);
  for (int i = 0; i < 100; ++i) {
    const Jet a{random.vector(5), random.vector(3), random.vector(2)};
    const Jet b{random.vector(5), random.vector(3), random.vector(2)};
    const double h = std::pow(10, random.uniform(-2, 1));
    Quintic still;
    still.fill(Vector3d::Zero());
    const Curve curve(quintic(a, b, h), still, Matrix3d::Identity(), 0, h);
    EXPECT_LE((curve.end().position - b.value).norm(), 1e-13 * 50);
    EXPECT_LE((curve.end().velocity - b.first).norm(), 1e-12 * (1 + 10 / h));
    EXPECT_LE((curve.acceleration(h) - b.second).norm(), 1e-11 * (1 + 10 / h / h));
    EXPECT_TRUE(curve.start().position == a.value && curve.start().velocity == a.first);
  }
  // sin t: its sixth derivative is at most 1.
  for (const double h : {0.1, 0.5, 1.0}) {
    const auto jet = [](double t) {
      return Jet{{std::sin(t), 0, 0}, {std::cos(t), 0, 0}, {-std::sin(t), 0, 0}};
    };
    const Quintic p = quintic(jet(1), jet(1 + h), h);
    double worst = 0;
    for (int j = 0; j <= 1000; ++j) {
      const double t = h * j / 1000;
      double sum = 0;
      for (std::size_t k = p.size(); k-- > 0;) sum = sum * t + p[k].x();
      worst = std::max(worst, std::abs(sum - std::sin(1 + t)));
    }
    EXPECT_LE(worst, std::pow(h, 6) / 46080 + 1e-15);
    EXPECT_GE(worst, 0.5 * std::pow(h, 6) / 46080 * std::sin(1));
  }
}

TEST(Curve, SteadyOnesMoveAndSpinEvenly) {
  const Motion start{{1, 2, 3}, {0.5, 0, -1}, Eigen::AngleAxisd(0.4, Vector3d::UnitX()).toRotationMatrix()};
  const Vector3d spin(0.3, -0.2, 0.6);
  const Curve curve = Curve::steady(start, spin, 2, 12);
  EXPECT_TRUE(curve.at(7).position.isApprox(start.position + 5 * start.velocity, 1e-15));
  EXPECT_TRUE(curve.at(7).rotation.isApprox(
      Eigen::AngleAxisd(5 * spin.norm(), spin.normalized()).toRotationMatrix() * start.rotation, 1e-14));
  EXPECT_EQ(curve.most_acceleration(), 0);
  EXPECT_NEAR(curve.most_turn_rate(), spin.norm(), 1e-11);
  EXPECT_NEAR(curve.most_turn_acceleration(), spin.squaredNorm(), 1e-11);
}

TEST(Curve, BadOnesAreRefused) {
  Quintic p;
  p.fill(Vector3d::Zero());
  EXPECT_THROW(Curve(p, p, Matrix3d::Identity(), 1, 1), InputError);
  Quintic infinite = p;
  infinite[3].x() = 1.0 / 0.0;
  EXPECT_THROW(Curve(infinite, p, Matrix3d::Identity(), 0, 1), InputError);
  Track track(ball(1), {{0, 0, 0}, {1, 0, 0}, Matrix3d::Identity()}, Orientation::fixed, 0);
  EXPECT_THROW(track.append(Curve(p, p, Matrix3d::Identity(), 1, 2)), InputError);  // a gap in time
  p[0].x() = 1e-9;
  EXPECT_THROW(track.append(Curve(p, p, Matrix3d::Identity(), 0, 1)), InputError);  // in space
  p[0].x() = 0;
  EXPECT_THROW(track.append(Curve(p, p, -Matrix3d::Identity(), 0, 1)), InputError);
  track.append(Curve(p, p, Matrix3d::Identity(), 0, 1));
  EXPECT_EQ(track.end(), 1);
  Track follows(ball(1), {{0, 0, 0}, {1, 0, 0}, Matrix3d::Identity()}, Orientation::heading, 0);
  EXPECT_THROW(follows.append(Curve(p, p, Matrix3d::Identity(), 0, 1)), InputError);
}

/// Legs of both kinds, the velocity with a blow at every other joint.
Track mixed_track(Random& random, const ShapeInTime& shape, const Vector3d& position,
                  const Vector3d& velocity, double end) {
  Track track(shape, {position, velocity, random.rotation()}, Orientation::fixed, 0);
  for (int i = 0; track.end() < end; ++i) {
    const double from = track.end(), to = std::min(end, from + random.uniform(0.05, 0.4));
    const Motion now = track.motion(from);
    if (i % 3 == 2) {
      track.advance(random.vector(1), to);
      continue;
    }
    Quintic p = random_quintic(random, 0.02, to - from), turn = random_quintic(random, 0.1, to - from);
    p[0] = now.position;
    p[1] = now.velocity + (i % 2 ? random.vector(0.3) : Vector3d::Zero());
    turn[0].setZero();
    track.append(Curve(p, turn, now.rotation, from, to));
  }
  return track;
}

TEST(Curve, TracksOfBothKindsJoinAndStayWithinTheirBounds) {
  SCOPED_TRACE("seed 34");
  Random random(34);
  for (int i = 0; i < 20; ++i) {
    const Track track = mixed_track(random, ball(1), random.vector(3), random.vector(1), 4);
    for (std::size_t k = 0; k + 1 < track.legs().size(); ++k)
      EXPECT_LE((track.legs()[k]->end().position - track.legs()[k + 1]->start().position).norm(), 1e-13);
    double blows = 0;
    for (int j = 0; j < 200; ++j) {
      const double from = random.uniform(0, 3.5), to = random.uniform(from, 4), t = random.uniform(from, to);
      const Track::Bounds bounds = track.bounds(from, to);
      const double share = (t - from) / (to - from), dt = to - from;
      const Vector3d chord = (1 - share) * track.motion(from).position + share * track.motion(to).position;
      EXPECT_LE((track.motion(t).position - chord).norm(),
                bounds.acceleration * dt * dt / 8 + bounds.velocity_jumps * dt / 4 + 1e-12);
      const double angle = turned(track.motion(from).rotation, track.motion(t).rotation).norm();
      EXPECT_LE(angle, bounds.turn_rate * (t - from) + 1e-9);
      blows = std::max(blows, bounds.velocity_jumps);
    }
    EXPECT_GT(blows, 0.1);
    EXPECT_TRUE(track.state(1.234).omega ==
                (*std::find_if(track.legs().begin(), track.legs().end(), [](const auto& leg) {
                  return leg->to() > 1.234;
                }))->turn(1.234));
  }
}

TEST(Curve, ProofsOfSuchTracksAgreeWithExactPredicates) {
  SCOPED_TRACE("seed 35");
  Random random(35);
  int verdicts[3] = {};
  for (int i = 0; i < 150; ++i) {
    const Vector3d axes(random.uniform(0.5, 1), random.uniform(0.2, 0.5), random.uniform(0.1, 0.4));
    const Vector3d start = 2.2 * random.vector(1).normalized();
    const Track a = mixed_track(random, ellipsoid(axes), start, towards(random, start, 4, 0.4), 4);
    const Track b = mixed_track(random, ellipsoid(axes.reverse()), Vector3d::Zero(), random.vector(0.1), 4);
    const PairProof proof = prove(a, b, 0, 4);
    ++verdicts[int(proof.verdict)];
    const auto overlap = [&](double t) {
      return pair_of(a.state(t).shape, b.state(t).shape).relation() != Relation::disjoint;
    };
    expect_sampled(proof, 4, overlap);
    if (proof.verdict == ProofVerdict::avoided) {
      // The body grown by the distance proved does not meet the other either.
      const double grown = 0.999 * proof.least_distance - 1e-7;
      for (int j = 0; j <= 200 && grown > 0; ++j)
        EXPECT_EQ(pair_of(a.state(j * 0.02).shape.inflated(grown / 2), b.state(j * 0.02).shape).relation(),
                  Relation::disjoint);
    }
  }
  EXPECT_GT(verdicts[int(ProofVerdict::avoided)], 30);
  EXPECT_GT(verdicts[int(ProofVerdict::touched)], 30);
  EXPECT_LT(verdicts[int(ProofVerdict::undecided)], 3);
}

TEST(Curve, ABoundLeftOutIsNoticed) {
  // What the velocity's jumps add is needed: a body that bounces off within a piece of time whose ends and
  // middle say that it stays away, and touches for 20 ms.
  Track bouncing(ball(0.1), {{0, 0, 0}, {1, 0, 0}, Matrix3d::Identity()}, Orientation::fixed, 0);
  bouncing.append(Curve::steady({{0, 0, 0}, {1, 0, 0}, Matrix3d::Identity()}, Vector3d::Zero(), 0, 0.3));
  bouncing.append(Curve::steady({{0.3, 0, 0}, {-1, 0, 0}, Matrix3d::Identity()}, Vector3d::Zero(), 0.3, 1));
  const Track wall = straight(ball(0.1), {0.49, 0, 0}, Vector3d::Zero(), 1);
  EXPECT_EQ(bouncing.bounds(0, 1).acceleration, 0);
  EXPECT_EQ(bouncing.bounds(0, 1).velocity_jumps, 2);
  const PairProof proof = prove(bouncing, wall, 0, 1);
  EXPECT_EQ(proof.verdict, ProofVerdict::touched);
  EXPECT_NEAR(proof.to, 0.29, 1e-6);
}

}  // namespace
}  // namespace vericone::simulation::curve_test
