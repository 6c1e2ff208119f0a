// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/mesh/surface.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <vericone/internal/fitting/canonical.h>
#include <vericone/internal/fitting/containing.h>
#include <vericone/internal/fitting/convex_hull.h>
#include <vericone/internal/geometry/decompositions.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>

namespace vericone::fitting::containing_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Points on the boundary of a body, evenly over directions from its centre.
Sample boundary(const CombinedEllipsoid& body, int count) {
  Sample sample;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, r = std::sqrt(1 - z * z), a = 2.399963229728653 * k;
    const Vector3d u(r * std::cos(a), r * std::sin(a), z);
    sample.points.push_back(body.center() + u / body.gauge(u));
  }
  return sample;
}

CombinedEllipsoid waisted() {
  return CombinedEllipsoid(Ellipsoid::from_axes({0, 0, 0}, {3, 1.5, 1.2}),
                           {hyperboloid(1, {1.2, 0.6, 0.5}, Matrix3d::Identity())});
}

CombinedEllipsoid dented() {
  return CombinedEllipsoid(Ellipsoid::from_axes({0, 0, 0}, {1, 2.5, 2}),
                           {hyperboloid(2, {0.35, 1, 0.9}, Matrix3d::Identity())});
}

double largest_gauge(const Piece& piece, const std::vector<Vector3d>& points) {
  double most = 0;
  for (const Vector3d& x : points) most = std::max(most, piece.body.gauge(x - piece.body.center()));
  return most;
}

/// A body whose boundary the points fill is found again: nothing smaller of its kind contains them.
void expect_found(const CombinedEllipsoid& body, Shape shape) {
  const CanonicalSample sample = canonical(boundary(body, 4000));
  const ContainingFit fit = containing_fit(sample, shape);
  EXPECT_TRUE(fit.converged) << fit.stationarity;
  EXPECT_LE(largest_gauge(fit.piece, sample.points), 1 + 1e-9);
  const double truth = volume(body).value / std::pow(sample.frame.scale, 3);
  // The points leave gaps of a fiftieth of the body: what contains them may be smaller by about their square.
  EXPECT_LT(fit.volume, truth * (1 + 1e-9));
  EXPECT_GT(fit.volume, truth * 0.98);
  EXPECT_NEAR(fit.volume / volume(fit.piece.body).value, 1, 1e-7);
}

TEST(ContainingFit, FindsAWaistAgain) { expect_found(waisted(), Shape::biconvex); }
TEST(ContainingFit, FindsDentsAgain) { expect_found(dented(), Shape::biconcave); }

TEST(ContainingFit, EllipsoidIsTheMinimumVolumeEllipsoid) {
  const CanonicalSample sample = canonical(boundary(waisted(), 500));
  const ContainingFit fit = containing_fit(sample, Shape::ellipsoid);
  EXPECT_NEAR(fit.volume / min_volume_ellipsoid<3>(sample.points).body.volume(), 1, 1e-12);
  EXPECT_LT(fit.volume_ratio_bound, 1 + 1e-6);
}

TEST(ContainingFit, IsNeverLargerThanTheEllipsoid) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 4; ++i) {
    Sample cloud;
    for (int k = 0; k < 60; ++k)
      cloud.points.emplace_back(3 * normal(engine), normal(engine), normal(engine));
    const CanonicalSample sample = canonical(cloud);
    const double ellipsoid = containing_fit(sample, Shape::ellipsoid).volume;
    for (const Shape shape : {Shape::biconcave, Shape::biconvex}) {
      const ContainingFit fit = containing_fit(sample, shape);
      EXPECT_LE(fit.volume, ellipsoid) << i;
      EXPECT_LE(largest_gauge(fit.piece, sample.points), 1 + 1e-9) << i;
    }
  }
}

/// Moves along random directions in the space of bodies, each surface then moved outwards until the points
/// are inside again, do not make the body smaller.
void expect_local_minimum(const CombinedEllipsoid& truth, Shape shape) {
  const CanonicalSample sample = canonical(boundary(truth, 600));
  const ContainingFit fit = containing_fit(sample, shape);
  ASSERT_TRUE(fit.converged);
  const CombinedEllipsoid& best = fit.piece.body;
  const double least = volume(best).value;
  std::mt19937_64 engine(17);
  std::normal_distribution<double> normal;
  const auto noise = [&](double size) -> Matrix3d {
    const Matrix3d m = Matrix3d::NullaryExpr([&] { return size * normal(engine); });
    return (m + m.transpose()) / 2;
  };
  int larger = 0;
  for (int k = 0; k < 300; ++k) {
    const double size = std::pow(10.0, -1 - k % 4);
    const Vector3d center =
        best.center() + size * 0.1 * Vector3d::NullaryExpr([&] { return normal(engine); });
    Matrix3d shape_matrix = best.ellipsoid().shape();
    shape_matrix += size * noise(shape_matrix.norm());
    shape_matrix = ((shape_matrix + shape_matrix.transpose()) / 2).eval();
    if (!(symmetric_eigenvalues<3>(shape_matrix)(0) > 0)) continue;
    Delimiter<3> delimiter = best.delimiters().front();
    delimiter.matrix += size * noise(delimiter.matrix.norm());
    delimiter.matrix = ((delimiter.matrix + delimiter.matrix.transpose()) / 2).eval();
    const Matrix3d inverse = shape_matrix.inverse();
    double grow = 0, level = 0;
    for (const Vector3d& x : sample.points) {
      const Vector3d y = x - center;
      grow = std::max(grow, y.dot(inverse * y));
      level = std::max(level, y.dot(delimiter.matrix * y));
    }
    delimiter.level = level;
    const Matrix3d grown = grow * shape_matrix;
    const double moved =
        volume(CombinedEllipsoid::trusted(Ellipsoid::from_shape(center, (grown + grown.transpose()) / 2),
                                          {delimiter}))
            .value;
    EXPECT_GT(moved, least * (1 - 1e-7)) << "size " << size;
    larger += moved > least * (1 + 1e-7);
  }
  EXPECT_GT(larger, 200);  // and most make it larger, or nothing was moved
}

TEST(ContainingFit, WaistsAreLocalMinima) { expect_local_minimum(waisted(), Shape::biconvex); }
TEST(ContainingFit, DentsAreLocalMinima) { expect_local_minimum(dented(), Shape::biconcave); }

/// A long triangle bridges the waist: the points alone would allow one, the triangle does not.
TEST(ContainingFit, TrianglesCountForDents) {
  Sample mesh = boundary(waisted(), 1500);
  const ContainingFit of_points = containing_fit(canonical(mesh), Shape::biconvex);
  const ConvexHull hull = convex_hull(mesh.points);
  mesh.triangles = hull.triangles;
  const CanonicalSample sample = canonical(mesh);
  const ContainingFit of_hull = containing_fit(sample, Shape::biconvex);
  EXPECT_GT(of_hull.volume, of_points.volume * 1.02);
  const double convex = hull.volume / std::pow(sample.frame.scale, 3);
  EXPECT_GT(of_hull.volume, convex);
  for (const auto& t : sample.triangles)
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; i + j <= 8; ++j) {
        const Vector3d x =
            (i * sample.points[t[0]] + j * sample.points[t[1]] + (8 - i - j) * sample.points[t[2]]) / 8;
        ASSERT_LE(of_hull.piece.body.gauge(x - of_hull.piece.body.center()), 1 + 1e-8);
      }
}

TEST(ContainingFit, MarginsKeepBallsInside) {
  const CanonicalSample sample = canonical(boundary(waisted(), 400));
  const double margin = 0.03;
  std::mt19937_64 engine(9);
  std::normal_distribution<double> normal;
  for (const Shape shape : {Shape::ellipsoid, Shape::biconvex}) {
    const ContainingFit bare = containing_fit(sample, shape);
    const ContainingFit fit = containing_fit(sample, shape, {.margin = margin});
    EXPECT_GT(fit.volume, bare.volume * 1.05);
    EXPECT_LT(fit.volume, bare.volume * 1.6);
    for (const Vector3d& x : sample.points)
      for (int k = 0; k < 20; ++k) {
        const Vector3d u = Vector3d::NullaryExpr([&] { return normal(engine); }).normalized();
        ASSERT_LE(fit.piece.body.gauge(x + margin * u - fit.piece.body.center()), 1 + 1e-9);
      }
  }
}

TEST(ContainingFit, MarginsOfFootprintsKeepDiscsInside) {
  const CanonicalSample sample = canonical(boundary(waisted(), 400));
  const double margin = 0.3, in_world = margin * sample.frame.scale;
  const ContainingFit fit = containing_fit(sample, Shape::ellipse, {.margin = margin});
  ASSERT_TRUE(fit.piece.footprint);
  const Ellipse& ellipse = *fit.piece.footprint;
  for (const Vector3d& y : sample.points)
    for (int k = 0; k < 720; ++k) {
      const double a = std::numbers::pi / 360 * k;
      const Eigen::Vector2d x =
          sample.frame.to_world(y).head<2>() + in_world * Eigen::Vector2d(std::cos(a), std::sin(a));
      ASSERT_LE((ellipse.factor().inverse() * (x - ellipse.center())).norm(), 1 + 1e-9);
    }
}

TEST(ContainingFit, FootprintsAreMinimumAreaEllipses) {
  const CanonicalSample sample = canonical(boundary(waisted(), 500));
  const ContainingFit fit = containing_fit(sample, Shape::ellipse);
  ASSERT_TRUE(fit.piece.footprint);
  std::vector<Eigen::Vector2d> flat;
  for (const Vector3d& y : sample.points) flat.push_back(sample.frame.to_world(y).head<2>());
  EXPECT_NEAR(fit.piece.footprint->volume() / min_volume_ellipsoid<2>(flat).body.volume(), 1, 1e-12);
  double low = 1e9, high = -1e9;
  for (const Vector3d& y : sample.points) {
    low = std::min(low, sample.frame.to_world(y).z());
    high = std::max(high, sample.frame.to_world(y).z());
  }
  EXPECT_EQ(fit.piece.low, low);
  EXPECT_EQ(fit.piece.high, high);
}

}  // namespace
}  // namespace vericone::fitting::containing_test
