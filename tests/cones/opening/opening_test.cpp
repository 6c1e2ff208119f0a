// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/opening/opening.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/opening/placed.h>
#include <vericone/testing/random_bodies.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "cones/opening/random_openings.h"
#include "support/campaign.h"

namespace vericone::opening_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using testing::moved_by_ulps, testing::RandomBodies, testing::share;

template <typename Call>
std::string field(const Call& call) {
  try {
    call();
  } catch (const InputError& e) {
    return e.field();
  }
  return "none";
}
std::string field_of(std::vector<Vector2d> vertices) {
  return field([&] { (void)Opening::polygon(vertices); });
}

TEST(Opening, BadInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(field([&] { (void)Opening::circle(0); }), "radius");
  EXPECT_EQ(field([&] { (void)Opening::circle(nan); }), "radius");
  EXPECT_EQ(field([&] { (void)Opening::ellipse({1, -1}); }), "semi_axes[1]");
  EXPECT_EQ(field_of({{0, 0}, {1, 0}}), "polygon");
  EXPECT_EQ(field_of({{0, 0}, {1, 0}, {nan, 1}}), "polygon[2]");
  EXPECT_EQ(field_of({{0, 0}, {1, 0}, {1, 0}, {1, 1}}), "polygon[2]");
  EXPECT_EQ(field_of({{0, 0}, {1, 0}, {1, 1}, {0, 0}}), "polygon[0]") << "closed by itself";
  EXPECT_EQ(field_of({{0, 0}, {1, 0}, {2, 0}, {3, 0}}), "polygon") << "no area";
  EXPECT_EQ(field_of({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), "polygon[2]") << "crosses";
  EXPECT_EQ(field_of({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}), "polygon[2]")
      << "touches an edge with a vertex";
  EXPECT_EQ(field_of({{0, 0}, {4, 0}, {2, 0}, {2, 4}}), "polygon[1]") << "folds back";
  EXPECT_EQ(field_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 6}, {0, 2}}), "polygon[4]")
      << "folds back on one before";
  PlacedOpening placed;
  placed.axes.col(1) = -3 * placed.axes.col(0);
  EXPECT_EQ(field([&] { require_placed(placed); }), "axes");
  placed.axes(2, 1) = nan;
  EXPECT_EQ(field([&] { require_placed(placed); }), "axes[1][2]");
  placed.center.y() = nan;
  EXPECT_EQ(field([&] { require_placed(placed); }), "center[1]");
}

TEST(Opening, SimplicityIsExact) {
  // A notch whose tip comes to an edge, which it crosses, touches or stays off by one unit in the last place.
  const auto notched = [](const Vector2d& tip) {
    return std::vector<Vector2d>{{0, 0}, {3, 1}, {3, 4}, tip, {0, 4}};
  };
  const Vector2d on(1.5, 0.5);  // of the edge from (0, 0) to (3, 1)
  EXPECT_EQ(field_of(notched(on)), "polygon[2]");
  for (int ulps = 1; ulps <= 8; ++ulps) {
    EXPECT_EQ(field_of(notched({on.x(), moved_by_ulps(on.y(), ulps)})), "none");
    EXPECT_EQ(field_of(notched({on.x(), moved_by_ulps(on.y(), -ulps)})), "polygon[2]");
    EXPECT_EQ(field_of(notched({moved_by_ulps(on.x(), -ulps), on.y()})), "none");
    EXPECT_EQ(field_of(notched({moved_by_ulps(on.x(), ulps), on.y()})), "polygon[2]");
  }
  // Against every pair of edges by rational arithmetic's little brother: small integers.
  RandomBodies random(1900);
  SCOPED_TRACE(random.trace());
  int simple = 0;
  for (int i = 0; i < share(20000); ++i) {
    std::vector<Vector2d> p(static_cast<std::size_t>(random.integer(3, 8)));
    for (Vector2d& v : p) v = Vector2d(random.integer(0, 6), random.integer(0, 6));
    const std::size_t n = p.size();
    // Points of edges that are multiples of 1/60 along them, and crossings by signs of areas, in long
    // integers.
    const auto area = [](const Vector2d& a, const Vector2d& b, const Vector2d& c) {
      return std::lround((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()));
    };
    bool good = true;
    for (std::size_t j = 0; j < n; ++j) {
      const Vector2d &a = p[j], &b = p[(j + 1) % n];
      good = good && a != b;
      for (std::size_t k = 0; k < n; ++k) {
        const Vector2d &c = p[k], &d = p[(k + 1) % n];
        // A vertex on an edge it does not belong to, or a proper crossing.
        if (k != j && k != (j + 1) % n && area(a, b, c) == 0 && (c - a).dot(c - b) <= 0) good = false;
        if (area(a, b, c) * area(a, b, d) < 0 && area(c, d, a) * area(c, d, b) < 0) good = false;
      }
    }
    ASSERT_EQ(field_of(p) == "none", good) << "case " << i;
    simple += good;
  }
  EXPECT_GT(simple, share(1000));
}

TEST(Opening, OutlinesAsTheyAre) {
  const Opening square = Opening::polygon({{0, 0}, {0, 2}, {2, 2}, {2, 0}});  // clockwise
  ASSERT_EQ(square.vertices().size(), 4u);
  EXPECT_EQ(square.vertices()[1], Vector2d(2, 2)) << "kept counterclockwise";
  EXPECT_TRUE(square.convex());
  EXPECT_NEAR(square.deepest().x(), 1, 0.01);
  EXPECT_GE(square.depth(square.deepest()), 0.99);
  EXPECT_DOUBLE_EQ(square.reach(), std::sqrt(8.));
  const Opening ell = Opening::polygon({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}});
  EXPECT_FALSE(ell.convex());
  EXPECT_DOUBLE_EQ(ell.depth({2, 2}), -1);
  EXPECT_DOUBLE_EQ(ell.depth({0.5, 3}), 0.5);
  EXPECT_GE(ell.depth(ell.deepest()), 0.98 * (2 - std::numbers::sqrt2))
      << "touches both sides and the corner";
  EXPECT_TRUE(Opening::circle(3).convex());
  EXPECT_DOUBLE_EQ(Opening::circle(3).depth({0, 5}), -2);
  EXPECT_DOUBLE_EQ(Opening::circle(3).depth({0, 0}), 3);
  const Opening oval = Opening::ellipse({2, 1});
  EXPECT_DOUBLE_EQ(oval.depth({0, 0}), 1);
  EXPECT_DOUBLE_EQ(oval.depth({3, 0}), -1);
  EXPECT_DOUBLE_EQ(oval.depth({0, 3}), -2);
  EXPECT_DOUBLE_EQ(oval.depth({1.75, 0}), 0.25);
  EXPECT_NEAR(oval.depth({1.5, 0}), 0.5, 1e-15) << "the centre of curvature";
}

TEST(Opening, DepthOfEllipses) {
  RandomBodies random(1901);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < share(4000); ++i) {
    const Vector2d axes(random.log_uniform(1e-4, 1), random.log_uniform(1e-4, 1));
    const Opening oval = Opening::ellipse(axes);
    const Vector2d x = 1.5 * axes.cwiseProduct(random.uniform(0, 1) * random.direction_2d());
    // Along the rim, then nearer and nearer.
    const auto distance = [&](double t) {
      return (Vector2d(axes.x() * std::cos(t), axes.y() * std::sin(t)) - x).norm();
    };
    double best = 0;
    for (int k = 0; k < 720; ++k)
      if (const double t = k * std::numbers::pi / 360; distance(t) < distance(best)) best = t;
    for (double step = std::numbers::pi / 720; step > 1e-9; step *= 0.5)
      for (const double t : {best - step, best + step})
        if (distance(t) < distance(best)) best = t;
    ASSERT_NEAR(std::abs(oval.depth(x)), distance(best), 1e-12) << "case " << i;
    ASSERT_EQ(oval.depth(x) > 0, x.cwiseQuotient(axes).norm() < 1) << "case " << i;
  }
}

TEST(Opening, TheDeepestPoint) {
  RandomBodies random(1902);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < share(200); ++i) {
    const Opening star = testing::random_polygon(random, random.integer(3, 12), 0.3);
    const double deepest = star.depth(star.deepest());
    for (int k = 0; k < 300; ++k)
      ASSERT_LE(star.depth(star.reach() * random.uniform(0, 1) * random.direction_2d()), 1.011 * deepest)
          << "case " << i;
  }
}

}  // namespace
}  // namespace vericone::opening_test
