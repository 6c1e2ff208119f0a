// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/geometry/min_volume_ellipsoid.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

#include "support/random.h"

namespace vericone::min_volume_ellipsoid_test {
namespace {

using Eigen::Matrix2Xd, Eigen::Matrix3d, Eigen::Matrix3Xd, Eigen::Vector2d, Eigen::Vector3d;
using exact::Rational;
using testing::Random;

template <int D>
using Points = Eigen::Matrix<double, D, Eigen::Dynamic>;

/// Exact, and by another formula than the library's: with S the defining shape and d = x - p,
/// det [[S, d], [d^T, 1]] = det S (1 - d^T S^{-1} d).
template <int D>
bool contains_exactly(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& x) {
  const auto s = exact::defining_shape(body);
  exact::RationalMatrix<D + 1> m;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) m[i][j] = s[i][j];
    m[i][D] = m[D][i] = Rational(x(i)) - Rational(body.center()(i));
  }
  m[D][D] = 1;
  return [&] {
    Rational det = 1;  // without pivoting: the leading minors are positive
    for (int k = 0; k <= D; ++k) {
      det *= m[k][k];
      if (k == D) break;
      for (int i = k + 1; i <= D; ++i) {
        const Rational f = m[i][k] / m[k][k];
        for (int j = k; j <= D; ++j) m[i][j] -= f * m[k][j];
      }
    }
    return det.sign() >= 0;
  }();
}

/// What holds for every result.
template <int D>
void expect_certified(const MinVolumeResult<D>& r, const Points<D>& points, double tolerance) {
  EXPECT_TRUE(r.converged());
  EXPECT_LE(r.optimality_gap, tolerance);
  EXPECT_GE(r.volume_ratio_bound, 1);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    ASSERT_TRUE(contains_exactly<D>(r.body, points.col(i))) << "point " << i;
  ASSERT_EQ(r.support.size(), r.weights.size());
  EXPECT_TRUE(std::ranges::is_sorted(r.support));
  EXPECT_NEAR(std::accumulate(r.weights.begin(), r.weights.end(), 0.0), 1, 1e-14);
  for (const double w : r.weights) EXPECT_GT(w, 0);
  EXPECT_GE(r.support.size(), std::size_t(D + 1));
}

Matrix3Xd fibonacci_sphere(int n) {
  Matrix3Xd p(3, n);
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n, turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    p.col(i) << std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z;
  }
  return p;
}

template <int D>
Points<D> random_points(Random& random, int n) {
  Points<D> p(D, n);
  for (int i = 0; i < n; ++i) p.col(i) = random.vector<D>();
  return p;
}

template <int D>
Points<D> cube_corners() {
  Points<D> p(D, 1 << D);
  for (int i = 0; i < 1 << D; ++i)
    for (int k = 0; k < D; ++k) p(k, i) = i >> k & 1 ? 1 : -1;
  return p;
}

TEST(MinVolumeEllipsoid, OfAnEllipsoidSurfaceIsThatEllipsoid) {
  const Matrix3Xd sphere = fibonacci_sphere(2000);
  const Vector3d center(10, -20, 30), axes(4, 2, 0.5);
  const Matrix3d rotation = rotation_from_heading(0.5, 0.8);
  const Matrix3Xd points = (rotation * axes.asDiagonal() * sphere).colwise() + center;
  const auto r = min_volume_ellipsoid<3>(points);
  expect_certified<3>(r, points, 1e-7);
  EXPECT_LT(r.volume_ratio_bound - 1, 2e-7);
  EXPECT_LT((r.body.center() - center).norm(), 1e-6);
  EXPECT_LT((r.body.semi_axes() - axes).norm(), 1e-6);
  EXPECT_NEAR(std::abs(r.body.axis_directions().col(0).dot(rotation.col(0))), 1, 1e-10);
}

TEST(MinVolumeEllipsoid, OfAnEllipseIsThatEllipse) {
  Matrix2Xd points(2, 500);
  for (int i = 0; i < 500; ++i) points.col(i) << 7 + 3 * std::cos(0.1 * i), -2 + 0.25 * std::sin(0.1 * i);
  const auto r = min_volume_ellipsoid<2>(points);
  expect_certified<2>(r, points, 1e-7);
  EXPECT_LT((r.body.semi_axes() - Vector2d(3, 0.25)).norm(), 1e-6);
}

/// Affine images of the regular simplex: centre at the centroid, S = D/(D+1) sum (v-c)(v-c)^T, all weights
/// equal; in the plane the Steiner circumellipse, area 4 pi / (3 sqrt 3) times the triangle's.
template <int D>
void check_simplices() {
  Random random(300 + D);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 100; ++k) {
    const Points<D> v = random_points<D>(random, D + 1);
    const Eigen::Matrix<double, D, 1> c = v.rowwise().mean();
    const Points<D> from_c = v.colwise() - c;
    const Eigen::Matrix<double, D, D> shape = from_c * from_c.transpose() * (double(D) / (D + 1));
    const double thin =
        std::sqrt(shape.jacobiSvd().singularValues()(0) / shape.jacobiSvd().singularValues()(D - 1));
    const auto r = min_volume_ellipsoid<D>(v);
    expect_certified<D>(r, v, 1e-7);
    EXPECT_LT((r.body.center() - c).norm(), 1e-13 * thin);
    EXPECT_LT((r.body.shape() - shape).norm(), 1e-13 * thin * shape.norm());
    EXPECT_LT(r.volume_ratio_bound - 1, 1e-13 * thin);
    for (const double w : r.weights) EXPECT_NEAR(w, 1.0 / (D + 1), 1e-12);
    if (D == 2) {
      const double area = 0.5 * std::abs((v(0, 1) - v(0, 0)) * (v(1, 2) - v(1, 0)) -
                                         (v(0, 2) - v(0, 0)) * (v(1, 1) - v(1, 0)));
      EXPECT_NEAR(r.body.volume() / (area * 4 * std::numbers::pi / (3 * std::sqrt(3.0))), 1, 1e-12 * thin);
    }
  }
}
TEST(MinVolumeEllipsoid, OfATriangleIsTheSteinerEllipse) { check_simplices<2>(); }
TEST(MinVolumeEllipsoid, OfATetrahedronIsItsCircumscribedEllipsoid) { check_simplices<3>(); }

TEST(MinVolumeEllipsoid, OfACubeIsItsCircumscribedSphere) {
  for (const double scale : {1e-3, 1.0, 1e6}) {
    const Matrix3Xd cube = (scale * cube_corners<3>()).colwise() + Vector3d(scale, 0, 0);
    const auto r = min_volume_ellipsoid<3>(cube);
    expect_certified<3>(r, cube, 1e-7);
    EXPECT_LT((r.body.shape() / (3 * scale * scale) - Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_LT((r.body.center() / scale - Vector3d(1, 0, 0)).norm(), 1e-12);
  }
  const Matrix2Xd square = cube_corners<2>();
  const auto r = min_volume_ellipsoid<2>(square);
  expect_certified<2>(r, square, 1e-7);
  EXPECT_NEAR(r.body.volume(), 2 * std::numbers::pi, 1e-12);
}

template <int D>
void check_equivariance() {
  Random random(310 + D);
  SCOPED_TRACE(random.trace());
  const MinVolumeOptions tight{.tolerance = 1e-12};
  for (int k = 0; k < 50; ++k) {
    const Points<D> p = random_points<D>(random, random.integer(D + 1, 300));
    Eigen::Matrix<double, D, D> map;
    do
      for (int i = 0; i < D * D; ++i) map(i) = random.normal();
    while (std::abs(map.determinant()) < 0.05);
    map *= std::pow(10, random.uniform(-3, 3));
    const Eigen::Matrix<double, D, 1> shift = map * (10 * random.vector<D>());
    const Points<D> image = (map * p).colwise() + shift;
    const auto r = min_volume_ellipsoid<D>(p, tight);
    const auto s = min_volume_ellipsoid<D>(image, tight);
    ASSERT_TRUE(r.converged() && s.converged());
    const Eigen::Matrix<double, D, D> back = map.inverse();
    EXPECT_LT((back * (s.body.center() - shift) - r.body.center()).norm(), 1e-9);
    EXPECT_LT((back * s.body.shape() * back.transpose() - r.body.shape()).norm(),
              1e-9 * r.body.shape().norm());
    EXPECT_NEAR(s.body.volume() / (r.body.volume() * std::abs(map.determinant())), 1, 1e-11);
  }
}
TEST(MinVolumeEllipsoid, FollowsAffineMapsOfThePlane) { check_equivariance<2>(); }
TEST(MinVolumeEllipsoid, FollowsAffineMapsOfSpace) { check_equivariance<3>(); }

TEST(MinVolumeEllipsoid, DoesNotDependOnTheOrder) {
  Random random(320);
  SCOPED_TRACE(random.trace());
  const Matrix3Xd p = random_points<3>(random, 1000);
  const MinVolumeOptions tight{.tolerance = 1e-12};
  const auto r = min_volume_ellipsoid<3>(p, tight);
  std::vector<int> order(1000);
  std::iota(order.begin(), order.end(), 0);
  for (int k = 0; k < 20; ++k) {
    random.shuffle(order.begin(), order.end());
    const Matrix3Xd shuffled = p(Eigen::all, order);
    const auto s = min_volume_ellipsoid<3>(shuffled, tight);
    EXPECT_LT((s.body.shape() - r.body.shape()).norm(), 1e-10 * r.body.shape().norm());
    std::vector<Eigen::Index> support;
    for (const Eigen::Index i : s.support) support.push_back(order[std::size_t(i)]);
    EXPECT_THAT(support, ::testing::UnorderedElementsAreArray(r.support));
  }
}

TEST(MinVolumeEllipsoid, IsDeterministic) {
  Random random(321);
  SCOPED_TRACE(random.trace());
  const Matrix3Xd p = random_points<3>(random, 5000);
  const auto r = min_volume_ellipsoid<3>(p);
  const auto s = min_volume_ellipsoid<3>(std::vector<Vector3d>(p.colwise().begin(), p.colwise().end()));
  EXPECT_EQ(r.body.factor(), s.body.factor());
  EXPECT_EQ(r.body.center(), s.body.center());
  EXPECT_EQ(r.weights, s.weights);
}

TEST(MinVolumeEllipsoid, ContainsEveryPointExactlyWhateverTheShape) {
  Random random(330);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 40; ++k) {
    const double ratio = std::pow(10, random.uniform(0, 8));
    const Matrix3d map =
        random.rotation<3>() * Vector3d(1, random.uniform(1 / ratio, 1), 1 / ratio).asDiagonal();
    Matrix3Xd p = random_points<3>(random, 300);
    if (k % 2) p.colwise().normalize();
    const Matrix3Xd image = (map * p).colwise() + random.vector<3>();
    const auto r = min_volume_ellipsoid<3>(image);
    expect_certified<3>(r, image, 1e-7);
    EXPECT_LT(r.volume_ratio_bound - 1, 3e-7 + 4e-15 * ratio);
  }
}

TEST(MinVolumeEllipsoid, RepeatedPointsAndPointsInsideChangeNothing) {
  Random random(331);
  SCOPED_TRACE(random.trace());
  const Matrix3d map = random.rotation<3>();
  Matrix3Xd p(3, 8 * 500 + 1000);
  const Matrix3Xd cube = map * cube_corners<3>();
  for (int i = 0; i < 8 * 500; ++i) p.col(i) = cube.col(i % 8);
  for (int i = 8 * 500; i < p.cols(); ++i)
    p.col(i) = random.uniform(0, 1.7) * random.vector<3>().normalized();
  const auto r = min_volume_ellipsoid<3>(p);
  expect_certified<3>(r, p, 1e-7);
  EXPECT_NEAR(r.body.volume() / (4 * std::sqrt(3.0) * std::numbers::pi), 1, 3e-7);
}

/// Weak duality, seen from the other side: no ellipsoid that contains the points is smaller than the bound
/// allows.
TEST(MinVolumeEllipsoid, NoContainingBodyIsSmaller) {
  Random random(332);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 50; ++k) {
    const Matrix3Xd p = random_points<3>(random, 30);
    const auto r = min_volume_ellipsoid<3>(p);
    for (int n = 0; n < 50; ++n) {
      // The found body disturbed, then grown until it contains the points.
      const double size = std::pow(10, random.uniform(-6, -1));
      Matrix3d factor = r.body.factor();
      for (int i = 0; i < 9; ++i) factor(i) += size * random.normal();
      const Vector3d center = r.body.center() + size * random.vector<3>();
      const double growth =
          std::sqrt((factor.inverse() * (p.colwise() - center)).colwise().squaredNorm().maxCoeff());
      const double volume = 4 * std::numbers::pi / 3 * std::abs(factor.determinant()) * std::pow(growth, 3);
      EXPECT_LE(r.body.volume(), volume * r.volume_ratio_bound * (1 + 1e-12));
    }
  }
}

/// Without a certificate: the same body to rounding, which no bound vouches for.
TEST(MinVolumeEllipsoid, WithoutACertificate) {
  Random random(31);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 50; ++i) {
    Matrix2Xd points(2, 12);
    for (Eigen::Index k = 0; k < 12; ++k)
      points.col(k) = Vector2d(random.uniform(-50, 50), random.uniform(-9, 9));
    MinVolumeOptions options;
    const MinVolumeResult<2> proved = min_volume_ellipsoid<2>(points, options);
    options.certified = false;
    const MinVolumeResult<2> quick = min_volume_ellipsoid<2>(points, options);
    EXPECT_TRUE(quick.converged());
    EXPECT_TRUE(std::isnan(quick.volume_ratio_bound));
    EXPECT_EQ(quick.support, proved.support);
    EXPECT_EQ(quick.weights, proved.weights);
    EXPECT_LT((quick.body.shape() - proved.body.shape()).norm(), 1e-9 * proved.body.shape().norm());
    EXPECT_LT((quick.body.center() - proved.body.center()).norm(), 1e-12 * 50);
  }
}

TEST(MinVolumeEllipsoid, SaysWhenItDidNotConverge) {
  Random random(333);
  SCOPED_TRACE(random.trace());
  const Matrix3Xd p = random_points<3>(random, 500);
  const auto best = min_volume_ellipsoid<3>(p);
  for (const int limit : {1, 2, 3, 5, 8}) {
    const auto r = min_volume_ellipsoid<3>(p, {.max_iterations = limit});
    EXPECT_EQ(r.status, MinVolumeStatus::iteration_limit);
    EXPECT_FALSE(r.converged());
    EXPECT_EQ(r.iterations, limit);
    EXPECT_GT(r.optimality_gap, 1e-7);
    for (Eigen::Index i = 0; i < p.cols(); ++i) ASSERT_TRUE(contains_exactly<3>(r.body, p.col(i)));
    EXPECT_LE(r.body.volume() / best.body.volume(), r.volume_ratio_bound);
    EXPECT_LE(r.volume_ratio_bound, std::pow(1 + 4 * r.optimality_gap / 3, 1.5) * (1 + 1e-12));
  }
  const auto r = min_volume_ellipsoid<3>(p, {.tolerance = 1e-300});
  EXPECT_TRUE(r.status == MinVolumeStatus::rounding_limit || r.optimality_gap <= 1e-300);
  EXPECT_LT(r.volume_ratio_bound, 1 + 1e-13);
}

TEST(MinVolumeEllipsoid, TakesAHundredThousandPoints) {
  const Matrix3Xd p = Vector3d(3, 2, 1).asDiagonal() * fibonacci_sphere(100'000);
  const auto r = min_volume_ellipsoid<3>(p);
  EXPECT_TRUE(r.converged());
  EXPECT_NEAR(r.body.volume() / (8 * std::numbers::pi), 1, 3e-7);
}

struct BadPoints {
  std::string name;
  std::function<Matrix3Xd()> points;
  MinVolumeOptions options;
  std::string field, value;
};

void PrintTo(const BadPoints& bad, std::ostream* out) { *out << bad.name; }

class MinVolumeErrors : public ::testing::TestWithParam<BadPoints> {};

TEST_P(MinVolumeErrors, NameFieldAndValue) {
  const BadPoints& bad = GetParam();
  const Matrix3Xd p = bad.points();
  try {
    min_volume_ellipsoid<3>(p, bad.options);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), bad.field);
    EXPECT_THAT(error.value(), ::testing::HasSubstr(bad.value));
    EXPECT_FALSE(error.requirement().empty());
  }
}

Matrix3Xd flattened(const Matrix3d& map) {
  Random random(340);
  return (map * random_points<3>(random, 50)).colwise() + Vector3d(1, 2, 3);
}
Matrix3Xd tilted(const Vector3d& axes) {
  return flattened(rotation_from_heading(0.6, 0.7) * axes.asDiagonal());
}
Matrix3Xd cube_with(int column, double value) {
  Matrix3Xd p = cube_corners<3>();
  p(1, column) = value;
  return p;
}

INSTANTIATE_TEST_SUITE_P(
    Table, MinVolumeErrors,
    ::testing::Values(
        BadPoints{"none", [] { return Matrix3Xd(3, 0); }, {}, "points", "0 points"},
        BadPoints{"one", [] { return Matrix3Xd(Matrix3Xd::Ones(3, 1)); }, {}, "points", "1 point"},
        BadPoints{"three", [] { return Matrix3Xd(Matrix3d::Identity()); }, {}, "points", "3 points"},
        BadPoints{
            "equal", [] { return Matrix3Xd(Matrix3Xd::Constant(3, 9, 0.1)); }, {}, "points", "all equal"},
        BadPoints{"line",
                  [] {
                    return tilted({1, 0, 0});
                  },
                  {},
                  "points",
                  "on one line"},
        BadPoints{"plane",
                  [] {
                    return tilted({1, 2, 0});
                  },
                  {},
                  "points",
                  "in one plane"},
        BadPoints{"plane_to_rounding",
                  [] {
                    return tilted({1, 2, 1e-16});
                  },
                  {},
                  "points",
                  "in one plane"},
        BadPoints{"nan", [] { return cube_with(5, std::nan("")); }, {}, "points[5][1]", "nan"},
        BadPoints{"infinite",
                  [] { return cube_with(2, -std::numeric_limits<double>::infinity()); },
                  {},
                  "points[2][1]",
                  "-inf"},
        BadPoints{"huge", [] { return cube_with(0, 1e200); }, {}, "points[0][1]", "1e+200"},
        BadPoints{"zero_tolerance", [] { return cube_corners<3>(); }, {.tolerance = 0}, "tolerance", "0"},
        BadPoints{"negative_tolerance",
                  [] { return cube_corners<3>(); },
                  {.tolerance = -1e-7},
                  "tolerance",
                  "-1e-07"},
        BadPoints{"nan_tolerance",
                  [] { return cube_corners<3>(); },
                  {.tolerance = std::nan("")},
                  "tolerance",
                  "nan"},
        BadPoints{"large_tolerance", [] { return cube_corners<3>(); }, {.tolerance = 1}, "tolerance", "1"},
        BadPoints{
            "no_iterations", [] { return cube_corners<3>(); }, {.max_iterations = 0}, "max_iterations", "0"}),
    [](const auto& instance) { return instance.param.name; });

TEST(MinVolumeEllipsoid, FlatInThePlane) {
  Matrix2Xd p(2, 10);
  for (int i = 0; i < 10; ++i) p.col(i) << i, 3 * i;
  try {
    min_volume_ellipsoid<2>(p);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("on one line"));
  }
  EXPECT_THROW(min_volume_ellipsoid<2>(std::vector<Vector2d>{}), InputError);
}

}  // namespace
}  // namespace vericone::min_volume_ellipsoid_test
