// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/opening/opening.h>
#include <vericone/cones/opening/orifice.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>

#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <string>

#include "cones/opening/random_openings.h"
#include "support/campaign.h"

namespace vericone::opening_clearance_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using testing::least_over_rim, testing::random_placed, testing::RandomBodies, testing::rim_point,
    testing::share;
using Axes = Eigen::Matrix<double, 3, 2>;

Ellipsoid sphere(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

TEST(OpeningClearance, KnownBySight) {
  const PlacedOpening circle{Opening::circle(3), {0, 0, 10}, Axes::Identity()};
  const auto m = opening_clearance(sphere({1, 0, 0}, 1), circle, {0, 0, 2});
  EXPECT_DOUBLE_EQ(m.distance, 1);
  EXPECT_NEAR((m.normal - Vector3d(1, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((m.rim - Vector3d(3, 0, 10)).norm(), 0, 1e-12);
  EXPECT_NEAR((m.support - Vector3d(2, 0, 0)).norm(), 0, 1e-12);
  EXPECT_DOUBLE_EQ(m.time, 5);
  EXPECT_DOUBLE_EQ(opening_clearance(sphere({0, 7, 0}, 1), circle, {0, 0, 2}).distance, -5);
  EXPECT_DOUBLE_EQ(opening_clearance(sphere({0, 7, 0}, 1), circle, {0, 0, -2}).distance, -5);
  EXPECT_DOUBLE_EQ(opening_clearance(sphere({0, 0, 0}, 5), circle, {0, 0, 2}).distance, -2) << "too large";
  // Seen at an angle with the cosine 0.8: semi-axes 3 and 2.4.
  EXPECT_NEAR(opening_clearance(sphere({-7.5, 0, 0}, 1), circle, {0.6, 0, 0.8}).distance, 1.4, 1e-14);
  EXPECT_LT(opening_clearance(sphere({0, 0, 0}, 1), circle, {1, 0, 0}).distance, -10) << "along the wall";
  const PlacedOpening ell{
      Opening::polygon({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}), {0, 0, 10}, Axes::Identity()};
  const auto at = [&](double x, double y, double r) {
    return opening_clearance(sphere({x, y, 0}, r), ell, {0, 0, 1});
  };
  EXPECT_DOUBLE_EQ(at(0.5, 2, 0.25).distance, 0.25);
  EXPECT_DOUBLE_EQ(at(0.5, 2, 0.75).distance, -0.25);
  EXPECT_DOUBLE_EQ(at(0.75, 0.75, 0.25).distance, std::sqrt(0.125) - 0.25) << "the inner corner";
  EXPECT_DOUBLE_EQ(at(2, 3, 0.5).distance, -1.5) << "an edge";
  EXPECT_DOUBLE_EQ(at(-3, -4, 0.5).distance, -5.5) << "a vertex";
  EXPECT_LT(opening_clearance(sphere({0, 0, 0}, 1), ell, {1, 1, 0}).distance, -10) << "along the wall";
}

/// m where the distance to the rim is: by clearance() to next to points of it.
TEST(OpeningClearance, AgainstTheRimItselfAndTheVerdict) {
  RandomBodies random(1930);
  SCOPED_TRACE(random.trace());
  constexpr double kPoint = 1e-8;
  for (const int kind : {0, 1, 2}) {
    int passes = 0, fails = 0, distances = 0;
    for (int i = 0; i < share(2000); ++i) {
      const Ellipsoid agent = random.ellipsoid(random.in_box(5), i % 4 ? 0.05 : 0.005, 0.4);
      const PlacedOpening placed =
          random_placed(random, kind, agent.center() + random.uniform(1, 6) * random.direction());
      const OrificeOracle oracle(agent, placed);
      if (oracle.side() != WallSide::clear) continue;
      const Vector3d w = placed.center + random.uniform(0, 1) * random.direction() - agent.center();
      const OpeningClearance m = opening_clearance(agent, placed, w);
      EXPECT_NEAR(m.normal.dot(w), 0, 1e-14 * w.norm());
      EXPECT_NEAR(m.normal.norm(), 1, 1e-14);
      const bool through = oracle.transit(w) == Transit::passes || oracle.transit(-w) == Transit::passes;
      if (std::abs(m.distance) > 1e-12) {
        ASSERT_EQ(m.distance > 0, through) << "case " << i << ", m " << m.distance;
      }
      (through ? passes : fails)++;
      if (m.distance > 0 && i % 4) {
        ++distances;
        const double truth = least_over_rim(
            [&](double t) { return clearance(agent, sphere(rim_point(placed, t), kPoint), w).distance; },
            placed.opening.polygonal() ? 16 * int(placed.opening.vertices().size()) : 180);
        ASSERT_NEAR(m.distance, truth + kPoint, 1e-9) << "case " << i;
      }
      if (placed.opening.convex()) {
        // No direction has less, whatever the sign.
        const Vector3d e1 = w.unitOrthogonal(), e2 = w.normalized().cross(e1);
        for (int k = 0; k < 200; ++k) {
          const double t = 2 * std::numbers::pi * k / 200;
          const Vector3d n = std::cos(t) * e1 + std::sin(t) * e2;
          const double opening =
              -least_over_rim([&](double s) { return -n.dot(rim_point(placed, s)); },
                              placed.opening.polygonal() ? int(placed.opening.vertices().size()) : 90);
          ASSERT_LE(m.distance, opening - agent.support(n) + 1e-9) << "case " << i;
          if (i % 8) break;
        }
      }
    }
    EXPECT_GT(passes, share(50));
    EXPECT_GT(fails, share(300));
    EXPECT_GT(distances, share(30));
  }
}

TEST(OpeningClearance, GradientsAgainstDifferences) {
  RandomBodies random(1931);
  SCOPED_TRACE(random.trace());
  int compared = 0, skipped = 0;
  for (int i = 0; i < share(3000); ++i) {
    const Ellipsoid agent = random.ellipsoid(random.in_box(5), 0.05, 0.4);
    const PlacedOpening placed =
        random_placed(random, i % 3, agent.center() + random.uniform(1, 6) * random.direction());
    const Vector3d w = placed.center + random.uniform(0, 1.5) * random.direction() - agent.center();
    if (std::abs(placed.normal().dot(w)) < 0.1 * w.norm()) continue;
    const OpeningClearance m = opening_clearance(agent, placed, w);
    const Vector3d dw = random.direction(), dc = random.direction();
    constexpr double h = 1e-5;
    const auto at = [&](double s, double t) {
      PlacedOpening moved = placed;
      moved.center += t * dc;
      return opening_clearance(agent, moved, w + s * w.norm() * dw);
    };
    const auto more = at(h, 0), less = at(-h, 0), further = at(0, h), nearer = at(0, -h);
    bool smooth = true;  // the same minimum on both sides
    for (const auto& other : {more, less, further, nearer})
      smooth = smooth && (other.normal - m.normal).norm() < 100 * h && (other.rim - m.rim).norm() < 0.01;
    if (!smooth) {
      ++skipped;
      continue;
    }
    ++compared;
    ASSERT_NEAR((more.distance - less.distance) / (2 * h), m.gradient_velocity().dot(w.norm() * dw), 1e-5)
        << "case " << i;
    ASSERT_NEAR((further.distance - nearer.distance) / (2 * h), m.gradient_center().dot(dc), 1e-5)
        << "case " << i;
  }
  std::cout << "[ compared ] " << compared << ", " << skipped << " at a change of minima\n";
  EXPECT_GT(compared, 9 * skipped);
}

TEST(OpeningClearance, Hulls) {
  RandomBodies random(1932);
  SCOPED_TRACE(random.trace());
  int positive = 0;
  for (int i = 0; i < share(1200); ++i) {
    const Vector3d half(random.uniform(0.02, 0.4), random.uniform(0.02, 0.4), random.uniform(0.02, 0.4));
    const Pose pose{random.in_box(5), random.rotation()};
    const WorldBody body(Placed(HullBody::box(-half, half), pose));
    const PlacedOpening placed =
        random_placed(random, i % 3, pose.position + random.uniform(1, 6) * random.direction());
    const Vector3d w = placed.center + random.uniform(0, 0.7) * random.direction() - pose.position;
    const OpeningClearance m = opening_clearance(body, placed, w);
    EXPECT_NEAR(m.distance, m.normal.dot(m.rim - m.support), 1e-14);
    // The box as its eight corners: inside a convex opening iff all are; then the nearest decides.
    double least = std::numeric_limits<double>::infinity();
    const HullBody box = HullBody::box(-half, half);
    for (const Vector3d& x : box.points())
      least = std::min(least, opening_clearance(sphere(pose.to_world(x), 1e-12), placed, w).distance);
    if (placed.opening.convex()) {
      ASSERT_NEAR(m.distance, least, 1e-9) << "case " << i;
    } else if (m.distance > 0) {
      ASSERT_LE(m.distance, least + 1e-9) << "case " << i;
    }
    // Between the balls inside and about it.
    if (m.distance > 0) {
      ASSERT_LE(m.distance,
                opening_clearance(sphere(pose.position, half.minCoeff()), placed, w).distance + 1e-9);
      ++positive;
    } else {
      ASSERT_LE(opening_clearance(sphere(pose.position, half.norm()), placed, w).distance, 1e-9)
          << "case " << i;
    }
  }
  EXPECT_GT(positive, share(100));
}

TEST(OpeningClearance, WhatHasNoAnswer) {
  const PlacedOpening circle{Opening::circle(3), {0, 0, 10}, Axes::Identity()};
  const auto field = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const InputError& e) {
      return e.field();
    }
    return "none";
  };
  EXPECT_EQ(field([&] { (void)opening_clearance(Ellipsoid(), circle, {0, 0, 0}); }), "relative_velocity");
  const WorldBody cloud(Placed(Assembly::cloud({Vector3d(0, 0, 0)}, 1)));
  EXPECT_EQ(field([&] { (void)opening_clearance(cloud, circle, {0, 0, 1}); }), "agent");
}

}  // namespace
}  // namespace vericone::opening_clearance_test
