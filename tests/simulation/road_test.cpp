// SPDX-License-Identifier: BSD-3-Clause
//
// Ways of vehicles on the ground: the figures that the source prints, differences, and curves of them.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/curve.h>
#include <vericone/simulation/track.h>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone::simulation::road_test {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

/// Central differences of five points.
template <typename F>
Vector2d difference(const F& f, double t, double h) {
  return (8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h);
}

void expect_rates(const Road& road, double t) {
  const auto position = [&](double s) { return road.at(s).position; };
  const auto velocity = [&](double s) { return road.at(s).velocity; };
  const RoadPoint at = road.at(t);
  EXPECT_LT((difference(position, t, 1e-2) - at.velocity).norm(), 1e-9 * (1 + at.velocity.norm())) << t;
  EXPECT_LT((difference(velocity, t, 1e-2) - at.acceleration).norm(), 1e-9) << t;
}

TEST(Road, SquircleHasThePrintedSpeeds) {
  const double r = 1000, s = 0.9;
  const auto road = squircle_road({0, -20}, r, s, 360);
  EXPECT_LT((road->at(0).position - Vector2d(0, -20)).norm(), 1e-9);
  EXPECT_NEAR(std::atan2(road->at(0).velocity.y(), road->at(0).velocity.x()), 0, 1e-12);
  double least = 1e9, most = 0, hardest = 0, way = 0, off = 0;
  const int n = 36000;
  for (int i = 0; i < n; ++i) {
    const RoadPoint at = road->at(360.0 * i / n);
    least = std::min(least, at.velocity.norm());
    most = std::max(most, at.velocity.norm());
    hardest = std::max(hardest, at.acceleration.norm());
    way += at.velocity.norm() * 360.0 / n;  // exact for a periodic function
    const Vector2d p = at.position - Vector2d(0, -20 + r);
    off = std::max(off, std::abs(p.squaredNorm() - std::pow(s * p.x() * p.y() / r, 2) - r * r) / (r * r));
  }
  // The source prints 14.79 and 22.63 m/s.
  EXPECT_NEAR(least, 14.7885, 1e-4);
  EXPECT_NEAR(most, 22.6266, 1e-4);
  EXPECT_NEAR(way, 6946, 1);
  EXPECT_NEAR(hardest, 0.665, 1e-3);
  EXPECT_LT(off, 1e-14);
  for (double t = 0.5; t < 360; t += 7.3) expect_rates(*road, t);
  EXPECT_LT((road->at(360).position - road->at(0).position).norm(), 1e-9);
}

TEST(Road, SquareOfNothingIsACircle) {
  const auto road = squircle_road({2, 1}, 50, 0, 20);
  for (double t = 0; t < 20; t += 0.7) {
    const double angle = 2 * pi * t / 20 - pi / 2;
    EXPECT_LT(
        (road->at(t).position - Vector2d(2, 51) - 50 * Vector2d(std::cos(angle), std::sin(angle))).norm(),
        1e-12);
    EXPECT_NEAR(road->at(t).acceleration.norm(), 50 * std::pow(2 * pi / 20, 2), 1e-12);
  }
}

/// Those of 3.4.1 (errata 4.3).
std::shared_ptr<const Road> lanes() {
  std::vector<LaneChange> changes;
  for (const auto& [t, a] : {std::pair{5.0, -1.0}, {15, 1}, {25, -1}, {35, -1}, {55, 1}, {75, -1}, {105, 1}})
    changes.push_back({t, 2, a});
  return lane_road({50, -30}, {22.22, 0}, changes);
}

TEST(Road, LaneChangesAreFourMetres) {
  const auto road = lanes();
  for (const auto& [t, y] :
       {std::pair{4.0, -30.0}, {9.0, -34.0}, {20, -30}, {30, -34}, {50, -38}, {120, -34}}) {
    EXPECT_NEAR(road->at(t).position.y(), y, 1e-12) << t;
    EXPECT_NEAR(road->at(t).position.x(), 50 + 22.22 * t, 1e-9);
    EXPECT_EQ(road->at(t).velocity, Vector2d(22.22, 0)) << t;
  }
  EXPECT_NEAR(road->at(7).velocity.y(), -2, 1e-12);
  EXPECT_EQ(road->at(6.9).acceleration, Vector2d(0, -1));
  EXPECT_EQ(road->at(7.1).acceleration, Vector2d(0, 1));
  for (const double t : {2.0, 6.0, 8.0, 16.5, 40.0}) expect_rates(*road, t);
  // Aside is aside of any direction; pulses that overlap add up.
  const auto north = lane_road({0, 0}, {0, 10}, {{1, 2, 1}, {2, 2, 1}});
  EXPECT_NEAR(north->at(10).position.x(), -8, 1e-12);
  EXPECT_NEAR(north->at(2.5).acceleration.x(), -2, 1e-12);
}

TEST(Road, CurvesKeepTheErrorStated) {
  for (const auto& road :
       {lanes(), squircle_road({0, -20}, 1000, 0.9, 360), squircle_road({0, 0}, 20, 0.99, 30)})
    for (const double error : {1e-3, 1e-9}) {
      const double begins = 3;
      const std::vector<Curve> curves = curves_of(*road, 0.8, begins, begins + 60, error, begins);
      Track track({}, curves.front().start(), Orientation::fixed, begins);
      for (const Curve& curve : curves) track.append(curve);
      EXPECT_EQ(track.end(), begins + 60);
      double worst = 0, turned = 0;
      for (int i = 0; i <= 20000; ++i) {
        const double t = begins + 60.0 * i / 20000;
        const RoadPoint at = road->at(t - begins);
        const Motion motion = track.motion(t);
        worst = std::max(worst,
                         (motion.position - Eigen::Vector3d(at.position.x(), at.position.y(), 0.8)).norm());
        const Vector2d ahead = at.velocity.normalized();
        turned = std::max(turned, (motion.rotation.col(0).head<2>() - ahead).norm());
      }
      EXPECT_LT(worst, error);
      EXPECT_LT(turned, error);
    }
  // Lanes are parabolas between their jumps: one curve each.
  EXPECT_EQ(curves_of(*lanes(), 0, 0, 120, 1e-3).size(), 22u);
}

TEST(Road, BadRoadsAreNamed) {
  const auto refused = [](auto make) -> std::string {
    try {
      make();
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  EXPECT_EQ(refused([] { lane_road({0, 0}, {0, 0}, {{1, 2, 1}}); }), "velocity");
  EXPECT_EQ(refused([] { lane_road({0, 0}, {1, 0}, {{1, 2, 1}, {-1, 2, 1}}); }), "changes[1].at");
  EXPECT_EQ(refused([] { lane_road({0, 0}, {1, 0}, {{1, 0, 1}}); }), "changes[0].seconds");
  EXPECT_EQ(refused([] { squircle_road({0, 0}, 0, 0.9, 1); }), "radius");
  EXPECT_EQ(refused([] { squircle_road({0, 0}, 1, 1, 1); }), "squareness");
  EXPECT_EQ(refused([] { squircle_road({0, 0}, 1, 0.9, -1); }), "period");
  EXPECT_EQ(refused([] { curves_of(*lanes(), 0, 5, 5, 1e-3); }), "to");
  EXPECT_EQ(refused([] { curves_of(*lanes(), 0, 5, 6, 0); }), "error");
  EXPECT_EQ(refused([] { lane_road({0, 0}, {0, 0}, {}); }), "");
}

}  // namespace
}  // namespace vericone::simulation::road_test
