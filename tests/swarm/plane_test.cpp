// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/swarm/swarm.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace vericone::swarm {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using engagements::Random;
using Wide = Eigen::Matrix<long double, 3, 1>;

struct Closed {
  Wide normal, change;
};

/// The published form for balls: either the cut-off, a ball of radius r / horizon about c / horizon, or the
/// cone, whose point nearest to v lies across the generator at t c, the larger root of a quadratic.
Closed closed_form(const Wide& c, long double r, const Wide& v, long double horizon) {
  const Wide w = v - c / horizon;
  const long double along = w.dot(c);
  if (along < 0 && along * along > r * r * w.squaredNorm()) {
    const Wide n = w / w.norm();
    return {n, (r / horizon - w.norm()) * n};
  }
  const long double a = c.squaredNorm(), b = c.dot(v),
                    e = v.squaredNorm() - c.cross(v).squaredNorm() / (c.squaredNorm() - r * r);
  const long double t = (b + std::sqrt(b * b - a * e)) / a;
  const Wide across = v - t * c, n = across / across.norm();
  return {n, (r * t - across.norm()) * n};
}

struct Drawn {
  Vector3d between, velocity;
  double horizon;
};
Drawn drawn(Random& random, double reach) {
  const double far = reach * random.uniform(1.01, 12), speed = random.uniform(0, 4);
  const Vector3d c = far * random.direction();
  return {c, speed * random.direction(), random.uniform(0.5, 20)};
}

TEST(ReciprocalPlane, OfBallsIsThePublishedOne) {
  int cut = 0;
  for (std::uint64_t k = 0; k < 20000; ++k) {
    Random random(421, k);
    const double p = random.uniform(0.1, 3), q = random.uniform(0.1, 3);
    const auto [c, v, horizon] = drawn(random, p + q);
    const ReciprocalPlane plane = reciprocal_plane(Solid::ball(p), Solid::ball(q), c, v, horizon);
    const Closed truth = closed_form(c.cast<long double>(), p + q, v.cast<long double>(), horizon);
    EXPECT_LT((plane.normal - truth.normal.cast<double>()).norm(), 1e-12) << k;
    EXPECT_LT((plane.change - truth.change.cast<double>()).norm(), 1e-12 * (1 + v.norm())) << k;
    cut += plane.normal.dot(c) + p + q < -1e-9;
  }
  EXPECT_GT(cut, 1000);
  EXPECT_LT(cut, 19000);
}

TEST(ReciprocalPlane, OfEllipsoidsOfOneShapeIsThatOfTheBallsTheyAreMappedTo) {
  for (std::uint64_t k = 0; k < 20000; ++k) {
    Random random(422, k);
    const Matrix3d turned = random.rotation();
    const Vector3d axes(random.uniform(0.3, 3), random.uniform(0.3, 3), random.uniform(0.3, 3));
    const double p = random.uniform(0.2, 2), q = random.uniform(0.2, 2);
    const Matrix3d map = turned * axes.asDiagonal();
    const auto [y, w, horizon] = drawn(random, p + q);
    const ReciprocalPlane plane =
        reciprocal_plane({p * axes, turned, false}, {q * axes, turned, false}, map * y, map * w, horizon);
    const Closed truth = closed_form(y.cast<long double>(), p + q, w.cast<long double>(), horizon);
    const Vector3d normal = (map.transpose().inverse() * truth.normal.cast<double>()).normalized();
    EXPECT_LT((plane.normal - normal).norm(), 1e-12) << k;
    EXPECT_LT((plane.change - map * truth.change.cast<double>()).norm(), 1e-12 * (1 + (map * w).norm())) << k;
  }
}

double width(const Solid& solid, const Vector3d& n) {
  return (solid.half.asDiagonal() * solid.rotation.transpose() * n).norm();
}

Solid any_ellipsoid(Random& random) {
  const Vector3d axes(random.uniform(0.5, 3), random.uniform(0.5, 1.5), random.uniform(0.5, 1.5));
  return {axes, random.rotation(), false};
}

TEST(ReciprocalPlane, HasAllVelocitiesThatLeadToContactOnOneSide) {
  for (std::uint64_t k = 0; k < 2000; ++k) {
    Random random(423, k);
    const Solid a = any_ellipsoid(random), b = any_ellipsoid(random);
    const auto [c, v, horizon] = drawn(random, a.reach() + b.reach());
    for (const Nearest nearest : {Nearest::in_shape, Nearest::in_speed}) {
      const ReciprocalPlane plane = reciprocal_plane(a, b, c, v, horizon, nearest);
      const double offset = plane.normal.dot(v + plane.change);
      double most = -std::numeric_limits<double>::infinity();
      for (int draw = 0; draw < 200; ++draw) {
        const Vector3d n = random.direction();
        const auto tip = [&](const Solid& solid) -> Vector3d {
          const Vector3d u = solid.half.asDiagonal() * solid.rotation.transpose() * n;
          return solid.rotation * (solid.half.asDiagonal() * u / u.norm());
        };
        most = std::max(most, plane.normal.dot(c + tip(a) + tip(b)) / random.uniform(1e-3, horizon));
      }
      EXPECT_LE(most, offset + 1e-9) << k;
      // And touches them.
      const double gap = plane.normal.dot(c) + width(a, plane.normal) + width(b, plane.normal);
      EXPECT_LT(std::abs(gap < -1e-9 ? gap / horizon - offset : offset) * (gap < -1e-9 || gap < 1e-9), 1e-9)
          << k;
      EXPECT_LT(gap, 1e-9) << k;
    }
  }
}

TEST(ReciprocalPlane, InSpeedIsTheNearestOnTheConeSide) {
  int sides = 0;
  for (std::uint64_t k = 0; k < 800; ++k) {
    Random random(424, k);
    const Solid a = any_ellipsoid(random), b = any_ellipsoid(random);
    const auto [c, v, horizon] = drawn(random, a.reach() + b.reach());
    const ReciprocalPlane plane = reciprocal_plane(a, b, c, v, horizon, Nearest::in_speed);
    const auto gap = [&](const Vector3d& n) { return n.dot(c) + width(a, n) + width(b, n); };
    if (gap(plane.normal) < -1e-9) continue;
    ++sides;
    // Planes through the apex, 300 around the way, each turned until it touches.
    const Vector3d ahead = c.normalized(), e = ahead.unitOrthogonal(), f = ahead.cross(e);
    double most = -std::numeric_limits<double>::infinity();
    for (int turn = 0; turn < 300; ++turn) {
      const double angle = 2 * M_PI * turn / 300;
      const Vector3d aside = std::cos(angle) * e + std::sin(angle) * f;
      double low = 0, high = M_PI / 2;  // from across the way to against it
      for (int half = 0; half < 60; ++half) {
        const double middle = 0.5 * (low + high);
        (gap(std::cos(middle) * aside - std::sin(middle) * ahead) > 0 ? low : high) = middle;
      }
      most = std::max(most, (std::cos(high) * aside - std::sin(high) * ahead).dot(v));
    }
    EXPECT_GE(plane.normal.dot(v), most - 1e-7 * v.norm()) << k;
    EXPECT_NEAR(plane.normal.dot(v + plane.change), 0, 1e-12);
    EXPECT_LT(plane.change.cross(plane.normal).norm(), 1e-12);
  }
  EXPECT_GT(sides, 100);
}

TEST(ReciprocalPlane, IsNegatedBitForBitWhereBothAreExchanged) {
  for (std::uint64_t k = 0; k < 2000; ++k) {
    Random random(425, k);
    const Solid a = any_ellipsoid(random), b = k % 2 ? any_ellipsoid(random) : Solid::ball(1.25);
    const auto [c, v, horizon] = drawn(random, a.reach() + b.reach());
    const Vector3d velocity = k % 7 == 0 ? Vector3d(0.1 * c) : v;  // straight at each other
    for (const Nearest nearest : {Nearest::in_shape, Nearest::in_speed}) {
      const ReciprocalPlane one = reciprocal_plane(a, b, c, velocity, horizon, nearest),
                            other = reciprocal_plane(b, a, -c, -velocity, horizon, nearest);
      EXPECT_EQ(one.normal, -other.normal) << k;
      EXPECT_EQ(one.change, -other.change) << k;
    }
  }
}

TEST(ReciprocalPlane, TowardsABoxAllowsTheGapOverTheHorizon) {
  Solid box;
  box.half = Vector3d(0.5, 10, 10);
  box.box = true;
  // A ball of 1 m, 4 m before the face, at 3 m/s towards it: 2.5 m in 2 s are 1.25 m/s.
  const ReciprocalPlane plane =
      reciprocal_plane(Solid::ball(1), box, Vector3d(4, 0, 0), Vector3d(3, 0.5, 0), 2);
  EXPECT_LT((plane.normal - Vector3d(-1, 0, 0)).norm(), 1e-14);
  EXPECT_LT((plane.change - Vector3d(-1.75, 0, 0)).norm(), 1e-14);
}

}  // namespace
}  // namespace vericone::swarm
