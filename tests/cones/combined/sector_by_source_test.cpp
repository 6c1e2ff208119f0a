// SPDX-License-Identifier: BSD-3-Clause
//
// The source's procedure for an ellipse and its "confocal quadric" (5.2.2.2), and what is wrong in print.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/sector.h>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <numbers>

#include "../../../cones/src/combined/source/pole_polar.h"
#include "support/random_combined.h"

namespace vericone::sector_by_source_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using std::numbers::pi;
using testing::RandomBodies;

TEST(TangentsByPolar, TouchTheEllipse) {
  RandomBodies random(561);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 2000; ++i) {
    const Ellipse e = Ellipse::from_axes(3 * random.direction_2d(), Vector2d(random.uniform(1, 6), 2),
                                         rotation_2d(random.uniform(-pi, pi)));
    const Matrix3d dual = e.quadric().matrix().inverse();
    const Vector2d from = e.center() + random.uniform(7, 30) * random.direction_2d();
    const auto tangents = tangents_by_polar(dual, from);
    ASSERT_TRUE(tangents) << i;
    for (const PolarTangent& t : *tangents) {
      // A tangent, through the point, that touches at a point of the ellipse.
      ASSERT_LT(std::abs(t.line.dot(dual * t.line)), 1e-9) << i;
      ASSERT_LT(std::abs(t.line.dot(from.homogeneous())), 1e-12) << i;
      ASSERT_LT(std::abs(t.line.dot(t.point.homogeneous())), 1e-9) << i;
      const Vector3d q = t.point.homogeneous();
      ASSERT_LT(std::abs(q.dot(e.quadric().matrix() * q)), 1e-9) << i;
    }
    ASSERT_FALSE(tangents_by_polar(dual, e.center())) << i;
  }
}

/// (5.6) as printed: a'^2 in K_0, v' in K_1, arctan of the quotient. Residuals t^T C_1 t of its two lines,
/// or nothing where it has no real gamma.
std::optional<double> residual(const Matrix3d& dual, const Vector2d& from, bool square, bool quotient) {
  const double a = dual(0, 0), b = dual(1, 1), c = dual(0, 1), d = dual(0, 2), e = dual(1, 2), f = dual(2, 2);
  const double u = from.x(), v = from.y();
  const double k2 = (b - a) + 2 * (d * u - e * v) + f * (v * v - u * u);
  const double k0 = (square ? a * a : a) - 2 * d * u + f * u * u;
  const double k1 = -2 * (c - (d * v + e * u) + f * u * v);
  const double sine = (2 * k0 + k2) / std::hypot(k1, k2);
  if (std::abs(sine) > 1) return std::nullopt;
  double worst = 0;
  for (const double sign : {1.0, -1.0}) {
    const double gamma =
        0.5 * ((quotient ? std::atan(k1 / k2) : std::atan2(k1, k2)) + sign * (std::asin(sine) + pi / 2));
    const Vector3d t(-std::sin(gamma), std::cos(gamma), u * std::sin(gamma) - v * std::cos(gamma));
    worst = std::max(worst, std::abs(t.dot(dual * t)));
  }
  return worst;
}

TEST(TangentsByPolar, AsPrintedTheyDoNot) {
  const Ellipse e = Ellipse::from_axes(Vector2d(1, -2), Vector2d(1.25, 0.75), rotation_2d(0.4));
  // One scale for all: the dual conic with -1 at its end and the ellipse within unit size of its centre.
  const Matrix3d dual = e.quadric().matrix().inverse();
  RandomBodies random(562);
  SCOPED_TRACE(random.trace());
  int wrong_square = 0, wrong_quotient = 0, right = 0;
  constexpr int kCases = 500;
  for (int i = 0; i < kCases; ++i) {
    const Vector2d from = e.center() + random.uniform(2, 6) * random.direction_2d();
    const auto corrected = residual(dual, from, false, false), printed = residual(dual, from, true, false),
               quotient = residual(dual, from, false, true);
    right += corrected && *corrected < 1e-12;
    wrong_square += !printed || *printed > 1e-3;
    wrong_quotient += quotient && *quotient > 1e-3;
  }
  EXPECT_EQ(right, kCases);
  EXPECT_GT(wrong_square, 9 * kCases / 10);             // a' = a'^2 for a' = 0 and 1 only
  EXPECT_NEAR(wrong_quotient, kCases / 2, kCases / 5);  // where K_2 < 0
}

TEST(SectorBySource, BothChoicesOnTheExampleOfTheSource) {
  const Ellipse f1 = Ellipse::from_axes(Vector2d::Zero(), Vector2d(6, 2), rotation_2d(pi / 4));
  for (const double k : {0.0, 0.3, 0.9, 1.0}) {
    const CombinedEllipse f2 = dented_conic(Vector2d(45, 0), 6, 2, k, 2 * pi / 3);
    const Sector exact = combined_sector(f1, f2).sector;
    for (const TangentChoice choice : {TangentChoice::printed, TangentChoice::by_sides}) {
      const auto source = sector_by_source(f1, f2, choice);
      ASSERT_TRUE(source) << k;
      EXPECT_NEAR(source->psi, exact.psi, 1e-9) << k;
      EXPECT_NEAR(source->theta_b, exact.theta_b, 1e-9) << k;
    }
  }
}

TEST(SectorBySource, KnowsOneHyperbolaOnly) {
  const CombinedEllipse star(Ellipse::from_axes(Vector2d(20, 0), Vector2d(4, 4)),
                             {hyperbola(Vector2d(1, 1), 0), hyperbola(Vector2d(1, 1), 1)});
  try {
    sector_by_source(Ellipse(), star, TangentChoice::printed);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), "obstacle.hyperboloids");
  }
}

}  // namespace
}  // namespace vericone::sector_by_source_test
