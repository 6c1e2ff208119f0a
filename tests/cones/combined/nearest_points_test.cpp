// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/nearest_points.h>
#include <vericone/internal/cones/random_engagement.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace vericone::nearest_points_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double kEver = std::numeric_limits<double>::infinity();

/// On the body's surface: the gauge about its centre is 1.
template <typename Body, typename Vector>
void expect_on_boundary(const Body& body, const Vector& x) {
  EXPECT_NEAR(body.gauge(x - body.center()), 1, 1e-9);
}

TEST(NearestPoints, OfEllipsoidsAreAsFarApartAsTheMissDistance) {
  int missed = 0;
  for (std::uint64_t i = 0; i < 30; ++i) {
    const auto [a, b] = engagements::random_engagement(20261123, i);
    engagements::Random random(7, i);
    const Vector3d w = random.uniform(0.5, 5) * random.direction(), still = Vector3d::Zero();
    const Pair pair{Placed(Body(a)), Placed(Body(b))};
    if (pair.verdict(w, still) != Verdict::out) continue;
    ++missed;
    const Miss miss = pair.miss(w, still);
    const auto found = nearest_points(CombinedEllipsoid(a), CombinedEllipsoid(b), w, 0, kEver);
    EXPECT_NEAR(found.distance, miss.distance, 1e-8 * (1 + miss.distance)) << i;
    EXPECT_NEAR((found.on_obstacle - found.on_agent).norm(), found.distance, 1e-9);
    expect_on_boundary(CombinedEllipsoid(b), found.on_obstacle);
    expect_on_boundary(CombinedEllipsoid(a), Vector3d(found.on_agent - found.time * w));
  }
  EXPECT_GT(missed, 10);
}

/// Against all pairs of 1,000 points each.
TEST(NearestPoints, OfDentedEllipsesAreNoFartherThanSamplesSay) {
  const CombinedEllipse a(Ellipse::from_axes(Vector2d(0, 0), Vector2d(2, 1), Eigen::Matrix2d::Identity()),
                          {hyperbola(Vector2d(1, 0.5))});
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  const CombinedEllipse b(Ellipse::from_axes(Vector2d(6, 1), Vector2d(2, 1.5), turn),
                          {hyperbola(Vector2d(1.2, 0.8))});
  const auto found = nearest_points(a, b, Vector2d(0, 0), 0, 0);
  double least = kEver;
  constexpr int kCount = 1000;
  const auto point = [](const CombinedEllipse& body, int i) {
    const double t = 2 * std::numbers::pi * i / kCount;
    const Vector2d d(std::cos(t), std::sin(t));
    return Vector2d(body.center() + d / body.gauge(d));
  };
  std::vector<Vector2d> on_a, on_b;
  for (int i = 0; i < kCount; ++i) {
    on_a.push_back(point(a, i));
    on_b.push_back(point(b, i));
  }
  for (const Vector2d& x : on_a)
    for (const Vector2d& y : on_b) least = std::min(least, (x - y).norm());
  EXPECT_LE(found.distance, least);
  EXPECT_GT(found.distance, least - 0.01);
  expect_on_boundary(a, found.on_agent);
  expect_on_boundary(b, found.on_obstacle);
}

TEST(NearestPoints, KeepsToTheTimesAsked) {
  const CombinedEllipsoid a(
      Ellipsoid::from_axes(Vector3d(0, 0, 0), Vector3d(1, 1, 1), Eigen::Matrix3d::Identity()));
  const CombinedEllipsoid b(
      Ellipsoid::from_axes(Vector3d(10, 3, 0), Vector3d(1, 1, 1), Eigen::Matrix3d::Identity()));
  const Vector3d w(2, 0, 0);
  EXPECT_NEAR(nearest_points(a, b, w, 0, kEver).time, 5, 1e-6);
  EXPECT_NEAR(nearest_points(a, b, w, 0, kEver).distance, 1, 1e-9);
  EXPECT_NEAR(nearest_points(a, b, w, 0, 3).time, 3, 1e-9);
  EXPECT_NEAR(nearest_points(a, b, w, 0, 3).distance, 3, 1e-9);  // centres (4, 3) apart
  EXPECT_THROW(static_cast<void>(nearest_points(a, b, w, -1, 3)), InputError);
  EXPECT_THROW(static_cast<void>(nearest_points(a, b, w, 2, 1)), InputError);
}

}  // namespace
}  // namespace vericone::nearest_points_test
