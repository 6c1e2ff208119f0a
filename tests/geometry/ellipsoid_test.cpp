// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/geometry/quadric.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "support/random.h"

namespace vericone::ellipsoid_test {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using testing::Random;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

template <int D>
Eigen::Matrix<double, D, 1> random_axes(Random& random, double longest) {
  Eigen::Matrix<double, D, 1> axes;
  for (int i = 0; i < D; ++i) axes(i) = std::exp(random.uniform(0, std::log(longest)));
  return axes;
}

template <typename T>
class EllipsoidLaws : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(EllipsoidLaws, Dimensions);

TYPED_TEST(EllipsoidLaws, AxesShapeAndQuadricMakeTheSameBody) {
  constexpr int D = TypeParam::value;
  Random random(101);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 200; ++k) {
    const auto axes = random_axes<D>(random, 10);
    const auto e = BasicEllipsoid<D>::from_axes(5 * random.vector<D>(), axes, random.rotation<D>());
    for (const auto& other :
         {BasicEllipsoid<D>::from_shape(e.center(), e.shape()), BasicEllipsoid<D>::from_quadric(e.quadric()),
          BasicEllipsoid<D>::from_quadric(BasicQuadric<D>(-3.5 * e.quadric().matrix()))}) {
      EXPECT_FALSE(other.defined_by_factor());
      EXPECT_LT((other.center() - e.center()).norm(), 1e-12 * (1 + e.center().squaredNorm()));
      EXPECT_LT((other.shape() - e.shape()).norm(),
                1e-12 * (1 + e.center().squaredNorm()) * e.shape().norm());
      EXPECT_LT((other.factor() * other.factor().transpose() - other.shape()).norm(),
                1e-15 * 8 * e.shape().norm());
      EXPECT_NEAR(other.volume() / e.volume(), 1, 1e-10);
    }
  }
}

TYPED_TEST(EllipsoidLaws, SupportIsHomogeneousSubadditiveAndMovesWithTheBody) {
  constexpr int D = TypeParam::value;
  Random random(102);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 500; ++k) {
    const auto e =
        BasicEllipsoid<D>::from_axes(random.vector<D>(), random_axes<D>(random, 100), random.rotation<D>());
    const auto m = random.vector<D>(), n = random.vector<D>(), t = random.vector<D>();
    const double tolerance =
        1e-13 * (e.semi_axes().maxCoeff() + e.center().norm() + t.norm()) * (m.norm() + n.norm());
    const double scale = random.uniform(0.1, 10);
    EXPECT_NEAR(e.support(scale * n), scale * e.support(n), scale * tolerance);
    EXPECT_LE(e.support(m + n), e.support(m) + e.support(n) + tolerance);
    EXPECT_EQ(e.radius(-n), e.radius(n));
    EXPECT_NEAR(e.translated(t).support(n), e.support(n) + t.dot(n), tolerance);
    EXPECT_NEAR(e.scaled(scale).support(n), scale * e.support(n), scale * tolerance);
    EXPECT_NEAR(e.support_point(n).dot(n), e.support(n), tolerance);
    EXPECT_NEAR(e.quadric().value(e.support_point(n)), 0,
                1e-12 * e.quadric().matrix().norm() * (1 + e.support_point(n).squaredNorm()));
    EXPECT_NEAR(e.quadric().value(e.center()), -1, 1e-9);
  }
}

TEST(Ellipsoid, SupportIsTheLargestOverTheSurface) {
  Random random(103);
  SCOPED_TRACE(random.trace());
  constexpr int kSteps = 200;
  for (int k = 0; k < 20; ++k) {
    const Vector3d axes = random_axes<3>(random, 5), center = random.vector<3>(), n = random.vector<3>();
    const Matrix3d rotation = random.rotation<3>();
    const auto e = Ellipsoid::from_axes(center, axes, rotation);
    double best = -kInf;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j < 2 * kSteps; ++j) {
        const double polar = std::numbers::pi * i / kSteps, azimuth = std::numbers::pi * j / kSteps;
        const Vector3d u(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                         std::cos(polar));
        best = std::max(best, n.dot(center + rotation * axes.cwiseProduct(u)));
      }
    // A sample lies within h = pi/200 of the touching point on the unit sphere and loses at most h^2/2.
    EXPECT_LE(best, e.support(n) + 1e-12 * (1 + std::abs(best)));
    EXPECT_GE(best, e.support(n) - 1.3e-4 * e.radius(n));
  }
}

TEST(Ellipsoid, VolumeAndAxes) {
  const auto e = Ellipsoid::from_axes({1, 2, 3}, {2, 5, 3}, rotation_from_heading(0.3, -0.4));
  EXPECT_NEAR(e.volume(), 4 * std::numbers::pi / 3 * 30, 1e-12);
  EXPECT_LT((e.semi_axes() - Vector3d(5, 3, 2)).norm(), 1e-14);
  EXPECT_NEAR(std::abs(e.axis_directions().col(0).dot(rotation_from_heading(0.3, -0.4).col(1))), 1, 1e-15);
  EXPECT_NEAR(Ellipse::from_axes({0, 0}, {2, 5}).volume(), 10 * std::numbers::pi, 1e-13);
  EXPECT_EQ(Ellipsoid().semi_axes(), Vector3d(1, 1, 1));
}

/// The quadric k = (x-p)^T A (x-p) with small integers in A and p, k such that every entry is a double: the
/// exact centre and shape are known, and what cancels, 1e18 against 1e6, is as bad as a matrix of doubles can
/// hold.
TEST(Ellipsoid, QuadricFarFromTheOriginLosesNothing) {
  const Vector3d p(0x1p30, -0x1p31, 3 * 0x1p29);
  const Matrix3d a{{4, 1, 0}, {1, 2, -1}, {0, -1, 3}};
  const double k = 0x1p20;
  Eigen::Matrix4d q;
  q << a, -a * p, (-a * p).transpose(), p.dot(a * p) - k;
  const auto e = Ellipsoid::from_quadric(Quadric(q));
  EXPECT_EQ(e.center(), p);
  // The inverse of A by hand: det A = 17.
  const Matrix3d adjugate{{5, -3, -1}, {-3, 12, 4}, {-1, 4, 7}};
  ASSERT_EQ(a * adjugate, 17 * Matrix3d::Identity());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(e.shape()(i, j), k * adjugate(i, j) / 17, 1e-15 * k * std::abs(adjugate(i, j)) / 17);
}

TEST(Ellipsoid, ThinBodiesKeepTheirThickness) {
  Random random(104);
  SCOPED_TRACE(random.trace());
  for (const double ratio : {1e6, 1e8})
    for (int k = 0; k < 100; ++k) {
      const Vector3d axes(1, 0.3, 1 / ratio);
      const Matrix3d r = random.rotation<3>();
      const auto e = Ellipsoid::from_axes({0, 0, 0}, axes, r);
      // A direction and an entry of the factor are only good to eps: relative to the thickness, eps times the
      // ratio.
      const double tolerance = 1e-15 * ratio;
      EXPECT_NEAR(e.radius(r.col(2)) * ratio, 1, tolerance);
      EXPECT_NEAR(e.semi_axes()(2) * ratio, 1, tolerance);
      EXPECT_NEAR(e.volume() * ratio / (0.4 * std::numbers::pi), 1, tolerance);
      EXPECT_TRUE(exact::positive_definite<3>(exact::defining_shape(e)));
    }
  for (const double ratio : {1e6, 1e8, 1e100}) {
    const auto flat = Ellipsoid::from_shape({0, 0, 0}, Vector3d(1, 0.25, 1 / (ratio * ratio)).asDiagonal());
    EXPECT_DOUBLE_EQ(flat.semi_axes()(2) * ratio, 1);
    EXPECT_DOUBLE_EQ(flat.radius({0, 0, 1}) * ratio, 1);
  }
}

TEST(Ellipsoid, ShapeOfAThinTurnedBodyGivesTheAxisThatTheMatrixHas) {
  // S = [[1, s], [s, s^2 + t^2]] with s, t powers of two: the Cholesky factor [[1, 0], [s, t]] is exact,
  // although t is 2^-26 times s and its square only just within reach of the entry.
  const double s = 0.5, t = 0x1p-26;
  const auto e = Ellipse::from_shape({0, 0}, Matrix2d{{1, s}, {s, s * s + t * t}});
  EXPECT_EQ(e.factor(), (Matrix2d{{1, 0}, {s, t}}));
}

TEST(Ellipsoid, WhatDefinesTheBodyIsKept) {
  const auto by_factor = Ellipsoid::from_axes({0, 0, 0}, {3, 2, 1}, rotation_from_heading(1, 0.5));
  EXPECT_TRUE(by_factor.defined_by_factor());
  const Matrix3d shape{{2, 1, 0}, {1, 2, 0.5}, {0, 0.5, 3}};
  const auto by_shape = Ellipsoid::from_shape({1, 1, 1}, shape);
  EXPECT_FALSE(by_shape.defined_by_factor());
  EXPECT_EQ(by_shape.shape(), shape);
  EXPECT_EQ(exact::defining_shape(by_shape)[1][2], exact::Rational(0.5));
  EXPECT_EQ(exact::defining_shape(by_shape.translated({1, 0, 0})), exact::defining_shape(by_shape));
}

TEST(Ellipsoid, NearlyOrthonormalRotationIsMadeOrthonormal) {
  Matrix3d r = rotation_from_heading(0.7, 0.2);
  r(0, 1) += 1e-7;
  const auto e = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}, r);
  EXPECT_LT((e.shape() - Matrix3d::Identity()).norm(), 1e-15 * 8);
}

struct BadInput {
  std::string name;
  std::function<void()> make;
  std::string field, value, requirement;
};

void PrintTo(const BadInput& bad, std::ostream* out) { *out << bad.name; }

class EllipsoidErrors : public ::testing::TestWithParam<BadInput> {};

TEST_P(EllipsoidErrors, NameFieldValueAndRequirement) {
  try {
    GetParam().make();
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), GetParam().field);
    EXPECT_THAT(error.value(), ::testing::HasSubstr(GetParam().value));
    EXPECT_THAT(error.requirement(), ::testing::HasSubstr(GetParam().requirement));
    EXPECT_EQ(error.what(), error.field() + ": got " + error.value() + ", must be " + error.requirement());
    EXPECT_THAT(error.what(), ::testing::Not(::testing::HasSubstr("\n")));
  }
}

void from_axes(const Vector3d& center, const Vector3d& axes, const Matrix3d& r = Matrix3d::Identity()) {
  Ellipsoid::from_axes(center, axes, r);
}
void from_shape(const Matrix3d& s) { Ellipsoid::from_shape({0, 0, 0}, s); }
void from_diagonal_quadric(double a, double b, double c, double d) {
  Ellipsoid::from_quadric(Quadric(Eigen::Vector4d(a, b, c, d).asDiagonal()));
}
const Matrix3d kReflection = Vector3d(1, 1, -1).asDiagonal();

INSTANTIATE_TEST_SUITE_P(
    Table, EllipsoidErrors,
    ::testing::Values(
        BadInput{"nan_center",
                 [] {
                   from_axes({0, kNan, 0}, {1, 1, 1});
                 },
                 "center[1]", "nan", "finite"},
        BadInput{"infinite_center",
                 [] {
                   from_axes({0, 0, -kInf}, {1, 1, 1});
                 },
                 "center[2]", "-inf", "finite"},
        BadInput{"zero_axis",
                 [] {
                   from_axes({0, 0, 0}, {1, 0, 1});
                 },
                 "semi_axes[1]", "0", "positive"},
        BadInput{"negative_axis",
                 [] {
                   from_axes({0, 0, 0}, {1, 1, -2});
                 },
                 "semi_axes[2]", "-2", "positive"},
        BadInput{"nan_axis",
                 [] {
                   from_axes({0, 0, 0}, {kNan, 1, 1});
                 },
                 "semi_axes[0]", "nan", "positive"},
        BadInput{"infinite_axis",
                 [] {
                   from_axes({0, 0, 0}, {1, kInf, 1});
                 },
                 "semi_axes[1]", "inf", "positive"},
        BadInput{"underflowing_axis",
                 [] {
                   from_axes({0, 0, 0}, {1, 1, 1e-200});
                 },
                 "semi_axes", "1e-200", "between"},
        BadInput{"overflowing_axis",
                 [] {
                   from_axes({0, 0, 0}, {1, 1, 1e200});
                 },
                 "semi_axes", "1e+200", "between"},
        BadInput{"skew_rotation",
                 [] {
                   from_axes({0, 0, 0}, {1, 1, 1}, Matrix3d::Ones());
                 },
                 "rotation", "[[1, 1, 1]", "orthonormal"},
        BadInput{"reflection",
                 [] {
                   from_axes({0, 0, 0}, {1, 1, 1}, kReflection);
                 },
                 "rotation", "-1", "not a reflection"},
        BadInput{"nan_rotation",
                 [] {
                   from_axes({0, 0, 0}, {1, 1, 1}, Matrix3d::Constant(kNan));
                 },
                 "rotation", "nan", "finite"},
        BadInput{"nan_shape", [] { from_shape(Vector3d(1, kNan, 1).asDiagonal()); }, "shape[1][1]", "nan",
                 "finite"},
        BadInput{"unsymmetric_shape",
                 [] {
                   from_shape(Matrix3d{{2, 1, 0}, {1.5, 2, 0}, {0, 0, 1}});
                 },
                 "shape", "1.5", "symmetric"},
        BadInput{"indefinite_shape", [] { from_shape(Vector3d(1, 1, -1).asDiagonal()); }, "shape", "-1",
                 "positive definite"},
        BadInput{"singular_shape", [] { from_shape(Matrix3d::Ones()); }, "shape", "[1, 1, 1]",
                 "positive definite"},
        BadInput{"hyperboloid", [] { from_diagonal_quadric(1, 1, -1, -1); }, "quadric", "-1",
                 "real ellipsoid"},
        BadInput{"imaginary_ellipsoid", [] { from_diagonal_quadric(1, 1, 1, 1); }, "quadric", "1",
                 "real ellipsoid"},
        BadInput{"point_quadric", [] { from_diagonal_quadric(1, 1, 1, 0); }, "quadric", "0",
                 "real ellipsoid"},
        BadInput{"tiny_quadric_ellipsoid", [] { from_diagonal_quadric(1e300, 1e300, 1e300, -1e-30); },
                 "quadric", "1e+300", "double precision"},
        BadInput{"infinite_translation",
                 [] {
                   Ellipsoid().translated({0, kInf, 0});
                 },
                 "center[1]", "inf", "finite"},
        BadInput{"zero_scale", [] { Ellipsoid().scaled(0); }, "scale", "0", "positive"},
        BadInput{"nan_scale", [] { Ellipsoid().scaled(kNan); }, "scale", "nan", "positive"},
        BadInput{"overflowing_scale", [] { Ellipsoid().scaled(1e200); }, "scale", "1e+200", "semi-axes"},
        BadInput{"long_quaternion",
                 [] {
                   rotation_3d({1, 1, 0, 0});
                 },
                 "rotation", "[1, 1, 0, 0]", "unit quaternion"},
        BadInput{"nan_quaternion",
                 [] {
                   rotation_3d({kNan, 0, 0, 0});
                 },
                 "rotation", "nan", "finite"}),
    [](const auto& instance) { return instance.param.name; });

TEST(Ellipsoid, DefinitenessIsDecidedExactly) {
  // det [[1, a], [a, a^2]] = 0 exactly for a a power of two; one unit in the last place decides.
  const double a = 0x1p-20;
  EXPECT_THROW(Ellipse::from_shape({0, 0}, Matrix2d{{1, a}, {a, a * a}}), InputError);
  EXPECT_THROW(Ellipse::from_shape({0, 0}, Matrix2d{{1, a}, {a, std::nextafter(a * a, 0)}}), InputError);
  EXPECT_NO_THROW(Ellipse::from_shape({0, 0}, Matrix2d{{1, a}, {a, std::nextafter(a * a, 1)}}));
}

TEST(InputErrors, Within) {
  const InputError inner("semi_axes[1]", "-2", "positive");
  EXPECT_EQ(inner.within("obstacle").field(), "obstacle.semi_axes[1]");
  EXPECT_EQ(InputError("[3]", "0", "x").within("points").field(), "points[3]");
  EXPECT_EQ(InputError("", "0", "x").within("points").field(), "points");
  EXPECT_EQ(to_text(0.1), "0.1");
}

TEST(Rotations, HeadingTurnsTheXAxis) {
  Random random(105);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 200; ++k) {
    const double azimuth = random.uniform(-7, 7), elevation = random.uniform(-1.6, 1.6);
    const Matrix3d r = rotation_from_heading(azimuth, elevation);
    const Vector3d x(std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
                     std::sin(elevation));
    EXPECT_LT((r.col(0) - x).norm(), 1e-15);
    EXPECT_EQ(r(2, 1), 0);  // no roll: the y axis stays level
    EXPECT_LT((r.transpose() * r - Matrix3d::Identity()).norm(), 1e-15 * 4);
    EXPECT_NEAR(r.determinant(), 1, 1e-15 * 4);
    const Matrix3d by_turns =
        (Eigen::AngleAxisd(azimuth, Vector3d::UnitZ()) * Eigen::AngleAxisd(-elevation, Vector3d::UnitY()))
            .toRotationMatrix();
    EXPECT_LT((r - by_turns).norm(), 1e-15 * 4);
  }
}

TEST(Rotations, QuaternionAgreesWithEigen) {
  Random random(106);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 200; ++k) {
    const Eigen::Vector4d q = random.vector<4>().normalized();
    const Matrix3d expected = Eigen::Quaterniond(q(0), q(1), q(2), q(3)).toRotationMatrix();
    EXPECT_LT((rotation_3d(q) - expected).norm(), 1e-15 * 8);
    EXPECT_LT((rotation_3d((1 + 5e-7) * q) - expected).norm(), 1e-15 * 8);
  }
  EXPECT_LT((rotation_2d(std::numbers::pi / 2) * Vector2d(1, 0) - Vector2d(0, 1)).norm(), 1e-16);
}

}  // namespace
}  // namespace vericone::ellipsoid_test
