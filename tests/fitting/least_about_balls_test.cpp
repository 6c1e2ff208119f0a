// SPDX-License-Identifier: BSD-3-Clause
#include "containing/least_about_balls.h"

#include <gtest/gtest.h>
#include <vericone/fitting/fit.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <vericone/internal/fitting/containing.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "containing/ball_place.h"
#include "support/random.h"

namespace vericone::fitting::least_about_balls_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;
using testing::Random;

std::vector<Vector3d> spiral(int count) {
  std::vector<Vector3d> all;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, r = std::sqrt(1 - z * z), a = 2.399963229728653 * k;
    all.emplace_back(r * std::cos(a), r * std::sin(a), z);
  }
  return all;
}

std::vector<Vector3d> plate(int count, double thickness, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector3d> points;
  for (int k = 0; k < count; ++k)
    points.emplace_back(random.uniform(-1.2, 1.2), random.uniform(-0.4, 0.4),
                        random.uniform(-0.5, 0.5) * thickness);
  return points;
}

double squared_gauge(const Ellipsoid& body, const Vector3d& x) {
  return (body.axis_directions().transpose() * (x - body.center()))
      .cwiseQuotient(body.semi_axes())
      .squaredNorm();
}

/// Against places all over the ball.
TEST(GreatestInBall, IsNotSurpassedOnTheBall) {
  Random random(3);
  const std::vector<Vector3d> places = spiral(20'000);
  for (int i = 0; i < 200; ++i) {
    Vector3d lambda, g;
    for (int k = 0; k < 3; ++k) {
      lambda(k) = random.uniform(-1, 1) * std::pow(10, random.uniform(-3, 3));
      g(k) = i % 4 == k ? 0 : random.uniform(-1, 1) * std::pow(10, random.uniform(-3, 3));
    }
    const double radius = std::pow(10, random.uniform(-3, 3));
    const auto value = [&](const Vector3d& d) { return 2 * g.dot(d) + d.dot(lambda.cwiseProduct(d)); };
    const Vector3d d = greatest_in_ball<3>(lambda, g, radius);
    EXPECT_LE(d.norm(), radius * (1 + 1e-12));
    double most = 0;  // the middle
    for (const Vector3d& u : places) most = std::max(most, value(radius * u));
    const double size = radius * g.norm() + radius * radius * lambda.norm();
    EXPECT_GE(value(d), most - 1e-12 * size) << i;
    EXPECT_LE(value(d), most + 1e-3 * size) << i;
  }
}

TEST(LeastAboutBalls, OfOneBallIsTheBall) {
  const auto space = least_about_balls<3>({Vector3d(1, 2, 3)}, 0.5);
  EXPECT_NEAR((space.body.center() - Vector3d(1, 2, 3)).norm(), 0, 1e-9);
  EXPECT_NEAR(space.body.volume() / (pi / 6), 1, 1e-9);
  const auto plane = least_about_balls<2>({Vector2d(1, 2)}, 0.5);
  EXPECT_NEAR(plane.body.volume() / (pi / 4), 1, 1e-9);
  EXPECT_TRUE(space.converged && plane.converged);
}

/// Balls around a circle: the body is a spheroid by symmetry. Given its equator, the least half-height is the
/// greatest over the places of one ball; the equator is found by thirds.
TEST(LeastAboutBalls, OfARingIsTheSpheroidOfTheMeridian) {
  for (const double radius : {1.0, 0.1, 1e-3, 1e-6}) {
    const auto height = [&](double equator) {
      double square = 0;
      for (int k = 1; k < 20'000; ++k) {
        const double a = pi * k / 20'000, x = (1 + radius * std::cos(a)) / equator;
        if (x >= 1) return 1e300;
        square = std::max(square, std::pow(radius * std::sin(a), 2) / ((1 - x) * (1 + x)));
      }
      return std::sqrt(square);
    };
    double low = 1 + radius, high = 3 * low;
    for (int step = 0; step < 100; ++step) {
      const double third = (high - low) / 3;
      if (std::pow(low + third, 2) * height(low + third) < std::pow(high - third, 2) * height(high - third))
        high -= third;
      else
        low += third;
    }
    const double volume = 4 * pi / 3 * low * low * height(low);
    std::vector<Vector3d> ring;
    for (int k = 0; k < 60; ++k) ring.emplace_back(std::cos(pi * k / 30), std::sin(pi * k / 30), 0);
    const auto found = least_about_balls<3>(ring, radius);
    EXPECT_TRUE(found.converged) << radius << ": " << found.gap;
    EXPECT_NEAR(found.body.volume() / volume, 1, 1e-6) << radius;
    EXPECT_LT(found.volume_ratio_bound, 1 + 1e-6) << radius;
  }
}

/// Whatever the thickness: against the least ellipsoid of very many places in the balls, which is smaller.
TEST(LeastAboutBalls, IsTheLeastHoweverThinTheCentresLie) {
  const std::vector<Vector3d> places = spiral(4000);
  for (const double thickness : {1.0, 0.1, 0.01, 1e-4, 1e-8, 0.0}) {
    const std::vector<Vector3d> points = plate(60, thickness, 5);
    for (const double radius : {0.3, 0.03, 0.001}) {
      const auto found = least_about_balls<3>(points, radius);
      EXPECT_TRUE(found.converged) << thickness << ' ' << radius << ": " << found.gap;
      EXPECT_LT(found.volume_ratio_bound, 1 + 1e-6);
      EXPECT_GE(found.volume_ratio_bound, 1);
      std::vector<Vector3d> inside;
      double most = 0;
      for (const Vector3d& x : points)
        for (const Vector3d& u : places) {
          inside.push_back(x + radius * u);
          most = std::max(most, squared_gauge(found.body, inside.back()));
        }
      EXPECT_LE(most, 1 + 1e-9);
      const double less = min_volume_ellipsoid<3>(inside).body.volume();
      EXPECT_LT(found.body.volume() / less, 1.01) << thickness << ' ' << radius;
      EXPECT_GT(found.body.volume() / less, 1 - 1e-6);
    }
  }
}

Sample scan_of(std::vector<Vector3d> points) { return {std::move(points), {}}; }

FitOptions options(Shape shape, double margin) {
  FitOptions all;
  all.shape = shape;
  all.margin = margin;
  return all;
}

/// Every shape contains the balls by proof, and none is larger than the ellipsoid.
TEST(Margins, OfThinScansDoNotGrowOutOfBounds) {
  const double margin = 0.03;
  for (const double thickness : {0.002, 0.0}) {
    const Sample plate_scan = scan_of(plate(40, thickness, 12));
    const double least = least_about_balls<3>(plate_scan.points, margin).body.volume();
    for (const Shape shape : {Shape::ellipsoid, Shape::biconcave, Shape::biconvex, Shape::star}) {
      if (shape == Shape::star && thickness == 0) continue;  // stars take seconds
      const FitResult fit = fitting::fit(plate_scan, options(shape, margin));
      EXPECT_TRUE(fit.certified) << to_string(shape);
      ASSERT_TRUE(fit.volume);
      EXPECT_LT(fit.volume->value, least * 1.0001) << to_string(shape);
      EXPECT_LT(fit.inflation, 1.001);
      const Vector3d axes = fit.pieces[0].body.ellipsoid().semi_axes();
      EXPECT_LT(axes.maxCoeff(), 10 * 1.9);
    }
  }
}

TEST(Margins, OfPiecesDoNotGrowOutOfBounds) {
  const Sample scan = scan_of(plate(400, 0.002, 13));
  FitOptions pieces = options(Shape::ellipsoid, 0.03);
  const FitResult one = fitting::fit(scan, pieces);
  pieces.pieces = 3;
  const FitResult three = fitting::fit(scan, pieces);
  EXPECT_TRUE(one.certified && three.certified);
  EXPECT_LT(three.volume->value, one.volume->value);
}

/// A thin surface near the points is swollen, not scaled by margin over thickness.
TEST(Margins, OfThinSurfacesDoNotGrowOutOfBounds) {
  Random random(8);
  Sample scan;
  for (const Vector3d& u : spiral(600))
    scan.points.emplace_back(1.2 * u.x() + random.uniform(-1e-5, 1e-5), 0.8 * u.y(), 0.004 * u.z());
  const double margin = 0.05, least = least_about_balls<3>(scan.points, margin).body.volume();
  FitOptions near = options(Shape::ellipsoid, margin);
  near.mode = Mode::least_squares;
  near.coverage = 1;
  const FitResult fit = fitting::fit(scan, near);
  EXPECT_TRUE(fit.certified);
  EXPECT_LT(fit.volume->value, 1.2 * least);
}

TEST(Margins, OfFootprintsAreLeastToo) {
  std::vector<Vector3d> points;
  std::vector<Vector2d> places;
  for (int k = 0; k <= 40; ++k) {
    points.emplace_back(0.1 * k - 2, 0, k % 5);  // on a line
    for (int j = 0; j < 3600; ++j)
      places.emplace_back(points.back().x() + 0.2 * std::cos(pi * j / 1800), 0.2 * std::sin(pi * j / 1800));
  }
  const FitResult fit = fitting::fit(scan_of(points), options(Shape::ellipse, 0.2));
  EXPECT_TRUE(fit.certified);
  EXPECT_NEAR(*fit.area / min_volume_ellipsoid<2>(places).body.volume(), 1, 1e-4);
}

}  // namespace
}  // namespace vericone::fitting::least_about_balls_test
