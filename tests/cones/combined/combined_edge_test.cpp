// SPDX-License-Identifier: BSD-3-Clause
//
// Edges found by Newton's method against the certified oracle and against what a contact is.
#include <gtest/gtest.h>
#include <vericone/cones/cone_geometry.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/combined/edge.h>
#include <vericone/testing/random_bodies.h>

#include <cmath>
#include <numbers>

namespace vericone::combined_edge_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using testing::RandomBodies;

CombinedEllipsoid dented(RandomBodies& random, const Vector3d& center) {
  const Vector3d axes(random.uniform(2, 6), random.uniform(2, 6), random.uniform(2, 6));
  const Matrix3d r = random.rotation();
  std::vector<Delimiter<3>> list;
  const int count = random.integer(1, 3);
  for (int i = 0; i < count; ++i)
    list.push_back(hyperboloid(2, {random.uniform(1, 2), 2, 3}, i == 0 ? r : random.rotation()));
  return {Ellipsoid::from_axes(center, axes, r), list};
}

/// Where the cone ends on a half-plane, by bisection of certified answers.
double bisected(const CombinedOracle& oracle, const Vector3d& u, const Vector3d& side) {
  double in = 0, out = std::numbers::pi;
  while (out - in > 1e-8) {
    const double t = 0.5 * (in + out);
    (oracle.membership(std::cos(t) * u + std::sin(t) * side) == Certified::out ? out : in) = t;
  }
  return out;
}

CombinedEdge farthest(const CombinedEllipsoid& a, const CombinedEllipsoid& b, const Vector3d& up) {
  CombinedEdge start;
  start.on_a = -up / a.gauge(up);
  start.on_b = up / b.gauge(up);
  return start;
}

TEST(CombinedEdges, AreWhereTheOracleSaysSo) {
  RandomBodies random(6161);
  SCOPED_TRACE(random.trace());
  int found = 0, right = 0;
  constexpr int kPairs = 60;
  for (int i = 0; i < kPairs; ++i) {
    const CombinedEllipsoid a = i % 2 ? CombinedEllipsoid(random.ellipsoid(random.in_box(3), 1, 4))
                                      : dented(random, random.in_box(3)),
                            b = dented(random, a.center() + random.uniform(14, 25) * random.direction());
    const CombinedOracle oracle(a, b);
    ASSERT_EQ(oracle.relation(), Relation::disjoint);
    const AxisFrame frame(b.center() - a.center());
    const double azimuth = random.uniform(0, 2 * std::numbers::pi);
    const Vector3d side = std::cos(azimuth) * frame.e1 + std::sin(azimuth) * frame.e2;
    const auto edge = CombinedEdges(a, b).near(frame.axis, side, farthest(a, b, side));
    if (!edge) continue;
    ++found;
    // The points touch: on both boundaries, apart along the edge, which the normal is perpendicular to.
    const Vector3d d = std::cos(edge->angle) * frame.axis + std::sin(edge->angle) * side;
    const Vector3d apart = b.center() - a.center() + edge->on_b - edge->on_a;
    EXPECT_NEAR(a.gauge(edge->on_a), 1, 1e-9) << i;
    EXPECT_NEAR(b.gauge(edge->on_b), 1, 1e-9) << i;
    EXPECT_LT(apart.cross(d).norm(), 1e-8 * apart.norm()) << i;
    EXPECT_NEAR(edge->normal.norm(), 1, 1e-12);
    EXPECT_NEAR(edge->normal.dot(d), 0, 1e-9) << i;
    // There may be a contact farther out, never one that is not in the cone.
    // Surfaces that the bodies do not have are as good as none.
    for (const auto& [count, surface] : {std::pair{1, 9}, {1, -1}, {7, 0}, {-2, 0}}) {
      CombinedEdge foreign = farthest(a, b, side);
      foreign.touched_a.count = foreign.touched_b.count = count;
      foreign.touched_a.surface[0] = foreign.touched_b.surface[0] = surface;
      const auto again = CombinedEdges(a, b).near(frame.axis, side, foreign);
      ASSERT_TRUE(again) << i;
      EXPECT_EQ(again->angle, edge->angle) << i;
    }
    const double known = bisected(oracle, frame.axis, side);
    EXPECT_LT(edge->angle, known + 1e-6) << i;
    right += std::abs(edge->angle - known) < 1e-6;
  }
  EXPECT_GT(found, kPairs * 3 / 4);
  EXPECT_GT(right, found * 3 / 4);
}

}  // namespace
}  // namespace vericone::combined_edge_test
