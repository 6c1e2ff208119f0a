// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/opening/opening.h>
#include <vericone/geometry/body.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "cones/opening/random_openings.h"
#include "support/campaign.h"

namespace vericone::rim_distance_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using testing::least_over_rim, testing::random_placed, testing::RandomBodies, testing::rim_point,
    testing::share;

Ellipsoid sphere(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

/// Both bounds hold, and are as near as asked; and every threshold is answered rightly.
template <typename Body>
RimDistance checked(const Body& body, const PlacedOpening& placed, double truth, double exactness) {
  RimDistance last;
  for (const double tolerance : {0.5, 1e-2, 1e-6}) {
    const RimDistance d = last = rim_distance(body, placed, {.tolerance = tolerance});
    EXPECT_LE(d.least, truth + exactness);
    EXPECT_GE(d.most, truth - exactness);
    EXPECT_LE(d.most - d.least, tolerance * d.most + 1e-12);
    if (d.least > 0) {
      EXPECT_NEAR((d.rim - d.body).norm(), d.most, 1e-12);
    }
  }
  for (const double factor : {0.5, 0.999, 1.001, 2.}) {
    const double threshold = factor * truth;
    if (std::abs(threshold - truth) < 1e-8) continue;
    const RimDistance d = rim_distance(body, placed, {.tolerance = 0, .threshold = threshold});
    EXPECT_EQ(d.least > threshold, factor < 1) << factor;
    EXPECT_EQ(d.most <= threshold, factor > 1) << factor;
  }
  return last;
}

TEST(RimDistance, KnownBySight) {
  const PlacedOpening circle{Opening::circle(5), {10, 0, 0}, Eigen::Matrix<double, 3, 2>::Identity()};
  checked(sphere({10, 0, 0}, 2), circle, 3, 1e-13);
  checked(sphere({10, 0, 12}, 1), circle, 12, 1e-13);
  checked(sphere({18, 0, 4}, 2), circle, 3, 1e-13);
  checked(Ellipsoid::from_axes({10, 0, 0}, {4, 1, 1}), circle, 1, 1e-13);
  EXPECT_EQ(rim_distance(sphere({15, 0, 0.5}, 1), circle).least, 0);
  EXPECT_LT(rim_distance(sphere({15, 0, 0.5}, 1), circle).most, 1e-12);
  const PlacedOpening square{Opening::polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}), {0, 0, 0}, circle.axes};
  checked(sphere({0, 0, 0}, 0.5), square, 0.5, 1e-13);
  checked(sphere({0.3, 0.1, 0}, 0.5), square, 0.2, 1e-13);
  checked(sphere({4, 5, 0}, 1), square, 4, 1e-13);
  checked(WorldBody(HullBody::box({-0.5, -0.75, -3}, {0.5, 0.75, 3})), square, 0.25, 1e-13);
}

TEST(RimDistance, AgainstTheRimItself) {
  RandomBodies random(1910);
  SCOPED_TRACE(random.trace());
  std::array<double, 3> points{};
  int cases = 0;
  for (int i = 0; i < share(1200); ++i) {
    const PlacedOpening placed = random_placed(random, i % 3, random.in_box(5));
    const bool thin = i % 5 == 0;
    const Ellipsoid made =
        random.ellipsoid(placed.center + random.in_box(i % 2 ? 0.5 : 2), thin ? 0.002 : 0.05, 0.6);
    const Ellipsoid body = i % 4 == 0 && !thin ? Ellipsoid::from_shape(made.center(), made.shape()) : made;
    // The ball of a radius that is next to nothing: the distance of a point to the body, by other code.
    constexpr double kPoint = 1e-7;
    const double truth = least_over_rim(
        [&](double t) { return separation(body, sphere(rim_point(placed, t), kPoint)).distance; },
        (thin ? 16 : 1) * (placed.opening.polygonal() ? 16 * int(placed.opening.vertices().size()) : 180));
    if (truth == 0) {
      EXPECT_LT(rim_distance(body, placed).least, 2 * kPoint);
      continue;
    }
    const RimDistance d = checked(body, placed, truth + kPoint, 1e-9);
    points[i % 3] += d.points;
    ++cases;
    if (HasFailure()) FAIL() << "case " << i;
  }
  EXPECT_GT(cases, share(600));
  std::cout << "[ points   ] to 1e-6: circle " << 3 * points[0] / cases << ", ellipse "
            << 3 * points[1] / cases << ", polygon " << 3 * points[2] / cases << '\n';
}

TEST(RimDistance, Hulls) {
  RandomBodies random(1911);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < share(400); ++i) {
    const PlacedOpening placed = random_placed(random, i % 3, random.in_box(5));
    const Vector3d half(random.uniform(0.05, 0.6), random.uniform(0.05, 0.6), random.uniform(0.05, 0.6));
    const Pose pose{placed.center + random.in_box(i % 2 ? 0.5 : 2), random.rotation()};
    const WorldBody body(Placed(HullBody::box(-half, half), pose));
    const double truth = least_over_rim(
        [&](double t) { return (pose.to_body(rim_point(placed, t)).cwiseAbs() - half).cwiseMax(0).norm(); },
        placed.opening.polygonal() ? 16 * int(placed.opening.vertices().size()) : 720);
    if (truth == 0) {
      EXPECT_EQ(rim_distance(body, placed).least, 0);
      continue;
    }
    checked(body, placed, truth, 1e-9);
    if (HasFailure()) FAIL() << "case " << i;
  }
}

/// The hull of two ellipsoids against the hull of points of both, which lies in it and nearly fills it.
TEST(RimDistance, BetweenTwoEllipsoids) {
  RandomBodies random(1912);
  SCOPED_TRACE(random.trace());
  constexpr int kPoints = 400;
  int apart = 0, turned_a_little = 0, near = 0;
  for (int i = 0; i < share(400); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const PlacedOpening placed = random_placed(random, i % 3, random.in_box(5));
    const Vector3d axes(random.uniform(0.05, 0.4), random.uniform(0.05, 0.4), random.uniform(0.05, 0.4));
    const Matrix3d turned = random.rotation();
    // Parallel, or turned by up to half a radian, or anyhow.
    const Vector3d turn = random.in_box(i % 4 == 0 ? 0 : i % 4 == 3 ? 3 : 0.3);
    const Matrix3d other =
        turn.isZero(0) ? turned : Matrix3d(Eigen::AngleAxisd(turn.norm(), turn.normalized()) * turned);
    const Vector3d start = placed.center + random.in_box(1.5);
    const Ellipsoid from = Ellipsoid::from_axes(start, axes, turned),
                    to = Ellipsoid::from_axes(start + random.in_box(i % 2 ? 1.5 : 0.1), axes, other);
    std::vector<Vector3d> points;
    for (const Ellipsoid& end : {from, to})
      for (int k = 0; k < kPoints; ++k) {
        const double z = -1 + (2 * k + 1.0) / kPoints, r = std::sqrt(1 - z * z),
                     angle = 2.399963229728653 * k;
        points.push_back(end.center() + end.factor() * Vector3d(r * std::cos(angle), r * std::sin(angle), z));
      }
    const RimDistance d = rim_distance(from, to, placed, {.tolerance = 1e-3, .most_points = 2000});
    const RimDistance within = rim_distance(WorldBody(HullBody(points)), placed, {.tolerance = 1e-3});
    EXPECT_LE(d.least, within.most + 1e-12);
    EXPECT_GE(d.most, within.least - 0.02 * axes.maxCoeff());
    EXPECT_LE(d.least, rim_distance(from, placed).most + 1e-12);
    EXPECT_LE(d.least, rim_distance(to, placed).most + 1e-12);
    if (within.least < 0.05) continue;
    ++apart;
    const double slack = 0.02 * axes.maxCoeff();
    if (i % 4 == 0) {
      EXPECT_GE(d.least, 0.99 * within.least - slack);
    }
    if (i % 4 == 1 || i % 4 == 2) {
      ++turned_a_little;
      near += d.least >= 0.9 * within.least - slack;
    }
  }
  EXPECT_GE(near, 0.9 * turned_a_little);  // no promise, but of use
  EXPECT_GT(apart, share(100));
}

TEST(RimDistance, ManyVerticesAreTheCircle) {
  std::vector<Eigen::Vector2d> p;
  constexpr int kVertices = 4096;
  for (int i = 0; i < kVertices; ++i)
    p.emplace_back(std::cos(2 * std::numbers::pi * i / kVertices),
                   std::sin(2 * std::numbers::pi * i / kVertices));
  RandomBodies random(1912);
  SCOPED_TRACE(random.trace());
  PlacedOpening round = random_placed(random, 0, {1, 2, 3}), many = round;
  round.opening = Opening::circle(1);
  many.opening = Opening::polygon(p);
  const double sagitta = 1 - std::cos(std::numbers::pi / kVertices);
  for (int i = 0; i < 50; ++i) {
    const Ellipsoid body = random.ellipsoid(round.center + random.in_box(1), 0.05, 0.6);
    const RimDistance a = rim_distance(body, round, {.tolerance = 1e-9}),
                      b = rim_distance(body, many, {.tolerance = 1e-9});
    EXPECT_NEAR(a.least, b.least, sagitta + 1e-8) << "case " << i;
  }
}

TEST(RimDistance, WhatHasNoAnswer) {
  const PlacedOpening circle{Opening::circle(5), {10, 0, 0}, Eigen::Matrix<double, 3, 2>::Identity()};
  PlacedOpening nowhere = circle;
  nowhere.center.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(rim_distance(sphere({0, 0, 0}, 1), nowhere).least, 0);
  EXPECT_EQ(rim_distance(sphere({0, 0, 0}, 1), nowhere).most, std::numeric_limits<double>::infinity());
  const WorldBody cloud(Placed(Assembly::cloud({Vector3d(0, 0, 0)}, 1)));
  try {
    (void)rim_distance(cloud, circle);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), "body");
  }
}

}  // namespace
}  // namespace vericone::rim_distance_test
