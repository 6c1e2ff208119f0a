// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/geometry/quadric.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/random.h"

namespace vericone::quadric_test {
namespace {

using Eigen::Matrix3d, Eigen::Matrix4d, Eigen::Vector2d, Eigen::Vector3d, Eigen::Vector4d;
using testing::Random;

/// Symmetric matrix of a x^2 + b y^2 + c z^2 + 2 g z + d.
Matrix4d form(double a, double b, double c, double g, double d) {
  Matrix4d q = Vector4d(a, b, c, d).asDiagonal();
  q(2, 3) = q(3, 2) = g;
  return q;
}

Matrix3d form2(double a, double b, double g, double d) {
  Matrix3d q = Vector3d(a, b, d).asDiagonal();
  q(1, 2) = q(2, 1) = g;
  return q;
}

/// A random affine map with small integers, so that what it does to an integer quadric is exact.
template <int D>
Eigen::Matrix<double, D + 1, D + 1> integer_map(Random& random) {
  while (true) {
    Eigen::Matrix<double, D + 1, D + 1> t = Eigen::Matrix<double, D + 1, D + 1>::Identity();
    for (int i = 0; i < D; ++i)
      for (int j = 0; j <= D; ++j) t(i, j) = random.integer(-4, 4);
    if (std::abs(t.determinant()) > 0.5) return t;
  }
}

int determinant_sign(const Matrix4d& q) {
  exact::RationalMatrix<4> m;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) m[i][j] = q(i, j);
  return exact::determinant<4>(m).sign();
}

TEST(QuadricKind, EveryClassInSpaceUnderEveryAffineMap) {
  struct Case {
    const char* name;
    Matrix4d q;
    QuadricKind kind;
    int det_sign;
  };
  const Case cases[] = {
      {"ellipsoid", form(1, 2, 3, 0, -1), QuadricKind::ellipsoid, -1},
      {"imaginary ellipsoid", form(1, 2, 3, 0, 1), QuadricKind::imaginary_ellipsoid, 1},
      {"one-sheeted hyperboloid", form(1, 1, -1, 0, -1), QuadricKind::one_sheet_hyperboloid, 1},
      {"two-sheeted hyperboloid", form(1, -1, -1, 0, -1), QuadricKind::two_sheet_hyperboloid, -1},
      {"elliptic paraboloid", form(1, 1, 0, 1, 0), QuadricKind::paraboloid, -1},
      {"hyperbolic paraboloid", form(1, -1, 0, 1, 0), QuadricKind::paraboloid, 1},
      {"cone", form(1, 1, -1, 0, 0), QuadricKind::degenerate, 0},
      {"point", form(1, 1, 1, 0, 0), QuadricKind::degenerate, 0},
      {"elliptic cylinder", form(1, 1, 0, 0, -1), QuadricKind::degenerate, 0},
      {"hyperbolic cylinder", form(1, -1, 0, 0, -1), QuadricKind::degenerate, 0},
      {"parabolic cylinder", form(1, 0, 0, 1, 0), QuadricKind::degenerate, 0},
      {"empty cylinder", form(1, 1, 0, 0, 1), QuadricKind::degenerate, 0},
      {"crossing planes", form(1, -1, 0, 0, 0), QuadricKind::degenerate, 0},
      {"line", form(1, 1, 0, 0, 0), QuadricKind::degenerate, 0},
      {"parallel planes", form(1, 0, 0, 0, -1), QuadricKind::degenerate, 0},
      {"double plane", form(1, 0, 0, 0, 0), QuadricKind::degenerate, 0},
      {"plane", form(0, 0, 0, 1, 0), QuadricKind::degenerate, 0},
      {"nothing", form(0, 0, 0, 0, 1), QuadricKind::degenerate, 0},
  };
  Random random(201);
  SCOPED_TRACE(random.trace());
  for (const Case& c : cases)
    for (int k = 0; k < 50; ++k) {
      SCOPED_TRACE(c.name);
      const Matrix4d t = integer_map<3>(random);
      const Matrix4d q = (k % 2 ? -1 : 1) * (t.transpose() * c.q * t);
      EXPECT_EQ(Quadric(q).kind(), c.kind);
      EXPECT_EQ(determinant_sign(q), c.det_sign);
    }
}

TEST(QuadricKind, EveryClassInThePlane) {
  struct Case {
    const char* name;
    Matrix3d q;
    QuadricKind kind;
  };
  const Case cases[] = {
      {"ellipse", form2(1, 2, 0, -1), QuadricKind::ellipsoid},
      {"imaginary ellipse", form2(1, 2, 0, 1), QuadricKind::imaginary_ellipsoid},
      {"hyperbola", form2(1, -1, 0, -1), QuadricKind::two_sheet_hyperboloid},
      {"other hyperbola", form2(1, -1, 0, 1), QuadricKind::two_sheet_hyperboloid},
      {"parabola", form2(1, 0, 1, 0), QuadricKind::paraboloid},
      {"point", form2(1, 1, 0, 0), QuadricKind::degenerate},
      {"crossing lines", form2(1, -1, 0, 0), QuadricKind::degenerate},
      {"parallel lines", form2(1, 0, 0, -1), QuadricKind::degenerate},
      {"double line", form2(1, 0, 0, 0), QuadricKind::degenerate},
      {"line", form2(0, 0, 1, 0), QuadricKind::degenerate},
  };
  Random random(202);
  SCOPED_TRACE(random.trace());
  for (const Case& c : cases)
    for (int k = 0; k < 50; ++k) {
      SCOPED_TRACE(c.name);
      const Matrix3d t = integer_map<2>(random);
      EXPECT_EQ(Conic((k % 2 ? -1 : 1) * (t.transpose() * c.q * t)).kind(), c.kind);
    }
}

TEST(QuadricKind, NoDiagonalAtAll) {
  // xy = 1: the elimination has no pivot on the diagonal. xy + zw has none either and is one-sheeted in
  // effect.
  EXPECT_EQ(Conic(Matrix3d{{0, 0.5, 0}, {0.5, 0, 0}, {0, 0, -1}}).kind(), QuadricKind::two_sheet_hyperboloid);
  Matrix4d saddle = Matrix4d::Zero();
  saddle(0, 1) = saddle(1, 0) = saddle(2, 3) = saddle(3, 2) = 0.5;
  EXPECT_EQ(Quadric(saddle).kind(), QuadricKind::paraboloid);
}

TEST(QuadricKind, OneUnitInTheLastPlaceDecides) {
  const double up = std::nextafter(1.0, 2.0), down = std::nextafter(1.0, 0.0);
  const auto kind = [](double c) {
    // x^2 + y^2 + z^2 + 2 c x y - 1: a cylinder at c = 1.
    Matrix4d q = form(1, 1, 1, 0, -1);
    q(0, 1) = q(1, 0) = c;
    return Quadric(q).kind();
  };
  EXPECT_EQ(kind(down), QuadricKind::ellipsoid);
  EXPECT_EQ(kind(1), QuadricKind::degenerate);
  EXPECT_EQ(kind(up), QuadricKind::one_sheet_hyperboloid);
}

TEST(Quadric, ValueAndPolar) {
  const auto e = Ellipsoid::from_axes({1, 2, 3}, {3, 2, 1}, rotation_from_heading(0.4, 0.3));
  const Quadric q = e.quadric();
  Random random(203);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 100; ++k) {
    const Vector3d n = random.vector<3>().normalized(), touching = e.support_point(n);
    // The polar of a surface point is its tangent plane, with the outward normal and the offset of the
    // support.
    const Vector4d plane = q.polar(touching);
    const double size = plane.head<3>().norm();
    EXPECT_LT((plane.head<3>() / size - n).norm(), 1e-13);
    EXPECT_NEAR(-plane(3) / size, e.support(n), 1e-12);
    // Reciprocity: p on the polar of r iff r on the polar of p.
    const Vector3d p = random.vector<3>(), r = random.vector<3>();
    EXPECT_NEAR(q.polar(p).dot(r.homogeneous()), q.polar(r).dot(p.homogeneous()), 1e-12);
    const Vector3d x = e.center() + e.factor() * random.uniform(0, 2) * n;
    EXPECT_EQ(q.value(x) > 0, (e.factor().inverse() * (x - e.center())).norm() > 1);
  }
}

TEST(Quadric, Errors) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const Matrix4d& m) -> std::string {
    try {
      Quadric q(m);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message(Matrix4d::Zero()), "quadric: got 0, must be not zero");
  EXPECT_EQ(message(form(1, 1, nan, 0, 1)), "quadric[2][2]: got nan, must be a finite number");
  Matrix4d skew = form(1, 1, 1, 0, -1);
  skew(0, 1) = 0.25;
  EXPECT_EQ(message(skew), "quadric[0][1]: got 0.25, must be equal to its mirror entry 0");
}

PlaneFrame random_plane(Random& random) {
  const Matrix3d r = random.rotation<3>();
  return {random.vector<3>(), r.col(0), r.col(1)};
}

TEST(Section, HasTheValuesOfTheQuadricOnThePlane) {
  Random random(204);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 200; ++k) {
    Matrix4d m;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j <= i; ++j) m(i, j) = m(j, i) = random.normal();
    const PlaneFrame plane = random_plane(random);
    const Quadric quadric(m);
    const Conic conic = section(quadric, plane);
    for (int n = 0; n < 10; ++n) {
      const Vector2d p = 3 * random.vector<2>();
      const Vector3d x = plane.to_space(p);
      EXPECT_NEAR(plane.normal().dot(x - plane.origin), 0, 1e-14 * (1 + x.norm()));
      EXPECT_NEAR(conic.value(p), quadric.value(x),
                  1e-13 * m.norm() * (1 + x.squaredNorm() + p.squaredNorm()));
    }
  }
}

TEST(Section, OfAnEllipsoidIsTheEllipseOnItsSurface) {
  Random random(205);
  SCOPED_TRACE(random.trace());
  int cut = 0;
  for (int k = 0; k < 200; ++k) {
    const auto body = Ellipsoid::from_axes(
        random.vector<3>(), Vector3d(1, 1, 1) + random.vector<3>().cwiseAbs(), random.rotation<3>());
    const PlaneFrame plane = random_plane(random);
    const Conic conic = section(body.quadric(), plane);
    const double distance = std::abs(plane.normal().dot(body.center() - plane.origin));
    ASSERT_GT(std::abs(distance - body.radius(plane.normal())), 1e-9);
    if (distance > body.radius(plane.normal())) {
      EXPECT_EQ(conic.kind(), QuadricKind::imaginary_ellipsoid);
      continue;
    }
    ++cut;
    const auto ellipse = Ellipse::from_quadric(conic);
    for (int i = 0; i < 16; ++i) {
      const Vector2d n(std::cos(i * std::numbers::pi / 8), std::sin(i * std::numbers::pi / 8));
      EXPECT_NEAR(body.quadric().value(plane.to_space(ellipse.support_point(n))), 0, 1e-10);
    }
  }
  EXPECT_GT(cut, 50);
}

TEST(PlaneFrame, DirectionsGoThereAndBack) {
  Random random(206);
  SCOPED_TRACE(random.trace());
  const PlaneFrame plane = random_plane(random);
  const Vector2d v = random.vector<2>();
  EXPECT_LT((plane.direction_to_plane(plane.direction_to_space(v)) - v).norm(), 1e-15 * 8);
  EXPECT_LT((plane.to_space(v) - plane.origin - plane.direction_to_space(v)).norm(), 1e-15 * 8);
}

}  // namespace
}  // namespace vericone::quadric_test
