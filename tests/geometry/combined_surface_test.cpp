// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/mesh/surface.h>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "combined_bodies.h"
#include "support/random.h"

namespace vericone::combined_surface_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using std::numbers::pi;
using testing::Random;

/// Volumes of revolution about x, cut with discs: none of the library's formulas.
double biconcave_volume(double a, double b, double alpha, double beta) {
  const double rim2 = (b * b + beta * beta) / (b * b / (a * a) + beta * beta / (alpha * alpha));
  const double rim = std::sqrt(rim2);
  const double dent =
      beta * beta * ((rim2 * rim - alpha * alpha * alpha) / (3 * alpha * alpha) - (rim - alpha));
  const double end = b * b * ((a - rim) - (a * a * a - rim2 * rim) / (3 * a * a));
  return 4 * pi / 3 * a * b * b - 2 * pi * (dent + end);
}

double waisted_volume(double a, double b, double alpha, double beta) {
  const double rim2 = (b * b - beta * beta) / (b * b / (a * a) + beta * beta / (alpha * alpha));
  const double rim = std::sqrt(rim2);
  const double waist = beta * beta * (rim + rim2 * rim / (3 * alpha * alpha));
  const double end = b * b * ((a - rim) - (a * a * a - rim2 * rim) / (3 * a * a));
  return 2 * pi * (waist + end);
}

/// The image under a linear map: any triaxial, turned body has the volume of one of revolution times det.
CombinedEllipsoid image(const CombinedEllipsoid& body, const Matrix3d& g) {
  const Matrix3d f = g * body.ellipsoid().factor(), inverse = g.inverse();
  std::vector<Delimiter<3>> delimiters;
  for (const auto& d : body.delimiters()) {
    const Matrix3d m = inverse.transpose() * d.matrix * inverse;
    delimiters.push_back({0.5 * (m + m.transpose()), d.level});
  }
  const Matrix3d shape = f * f.transpose();
  return {Ellipsoid::from_shape(Vector3d(1, -2, 3), 0.5 * (shape + shape.transpose())), delimiters};
}

Matrix3d random_map(Random& random) {
  return random.rotation<3>() *
         Vector3d(random.uniform(0.3, 3), random.uniform(0.3, 3), random.uniform(0.3, 3)).asDiagonal() *
         random.rotation<3>();
}

TEST(CombinedVolume, OfRevolutionAgainstClosedForm) {
  Random random(41);
  SCOPED_TRACE(random.trace());
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    const double a = random.uniform(0.5, 4), b = random.uniform(0.5, 4);
    const Matrix3d g = random_map(random);
    // From shallow to nearly pinched.
    const double alpha = a * (i % 3 == 0 ? std::pow(10, random.uniform(-4, -1)) : random.uniform(0.1, 0.99));
    const double beta = random.uniform(0.1, 4);
    const auto dented =
        image({Ellipsoid::from_axes({0, 0, 0}, {a, b, b}), {hyperboloid(2, {alpha, beta, beta})}}, g);
    const double throat = b * (i % 3 == 0 ? std::pow(10, random.uniform(-4, -1)) : random.uniform(0.1, 0.99));
    const auto waisted = image({Ellipsoid::from_axes({0, 0, 0}, {a, b, b}),
                                {hyperboloid(1, {random.uniform(0.1, 4), throat, throat})}},
                               g);
    const double det = g.determinant();
    const VolumeEstimate v = volume(dented);
    const double expected = det * biconcave_volume(a, b, alpha, beta);
    // The closed form cancels where dents are shallow or deep: some roundings of the whole ellipsoid. The
    // matrix of the image is rounded: by so much against its level.
    const Vector3d stretch = g.jacobiSvd().singularValues();
    const double kappa = std::pow(stretch(0) / stretch(2), 2);
    const auto rounding = [&](double thinness, double value) {
      return 1e-13 * dented.ellipsoid().volume() + 1e-16 * kappa * thinness * thinness * value;
    };
    EXPECT_NEAR(v.value, expected, v.error + rounding(a / alpha, expected)) << i;
    // The body itself is known to this from its rounded matrix, where it is thin.
    EXPECT_LT(v.error, (1e-12 + 1e-14 * a * a / (alpha * alpha)) * v.value);
    worst = std::max(worst, std::abs(v.value - expected) / expected);

    const VolumeEstimate w = volume(waisted);
    const double x = std::sqrt(-1 / (g.transpose() * waisted.delimiters()[0].matrix * g)(0, 0));
    EXPECT_NEAR(w.value, det * waisted_volume(a, b, x, throat), w.error + rounding(b / throat, w.value)) << i;
    EXPECT_LT(w.error, (1e-12 + 1e-14 * b * b / (throat * throat)) * w.value);
  }
  std::cout << "[ figures  ] worst relative difference from the closed form " << worst << '\n';
}

TEST(CombinedVolume, PinchedBodies) {
  // Level 0, the asymptotic cone: what the dented body shrinks to.
  const Ellipsoid ball = Ellipsoid::from_axes({0, 0, 0}, {2, 2, 2});
  const Delimiter<3> cones{Vector3d(1, -1, -1).asDiagonal().toDenseMatrix(), 0};
  // A ball of radius 2 without the double cone of half angle 45 degrees.
  EXPECT_NEAR(volume({ball, {cones}}).value, 4 * pi / 3 * 8 * std::sqrt(0.5), 1e-13);
  const Delimiter<3> inside{Vector3d(-1, 1, 1).asDiagonal().toDenseMatrix(), 0};
  EXPECT_NEAR(volume({ball, {inside}}).value, 4 * pi / 3 * 8 * (1 - std::sqrt(0.5)), 1e-13);
}

TEST(CombinedVolume, StarsAgainstSampling) {
  Random random(42);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 12; ++i) {
    const CombinedEllipsoid body = testing::random_star(random, 1 + i % 4);
    const VolumeEstimate v = volume(body);
    EXPECT_LT(v.error, 1e-6 * v.value);
    // Fraction of the ellipsoid that is in the body.
    constexpr int kPoints = 100'000;
    int inside = 0;
    for (int k = 0; k < kPoints; ++k) {
      const Vector3d u = random.vector<3>().normalized() * std::cbrt(random.uniform(0, 1));
      inside += body.gauge(body.ellipsoid().factor() * u) <= 1;
    }
    const double p = static_cast<double>(inside) / kPoints, deviation = std::sqrt(p * (1 - p) / kPoints);
    EXPECT_NEAR(v.value / body.ellipsoid().volume(), p, 5 * deviation) << i;
    // Volume is measured the same in other axes and units.
    const VolumeEstimate doubled = volume(body.scaled(2));
    EXPECT_NEAR(doubled.value, 8 * v.value, 8 * (v.error + doubled.error));
  }
}

TEST(CombinedArea, DentedConicAgainstClosedForm) {
  for (int i = 0; i <= 100; ++i) {
    const double k = i / 100.0, a = 6, b = 2;
    // Strips parallel to x' between the hyperbola's branches up to y' = b sqrt(k), then in the ellipse.
    const double dents = k < 1 ? (1 - k) * std::asinh(std::sqrt(k / (1 - k))) : 0;
    const double expected = 2 * a * b * (dents + (1 + k) * std::acos(std::sqrt(k / (1 + k))));
    EXPECT_NEAR(area(dented_conic({3, 4}, a, b, k, 0.7)), expected, 1e-13 * expected) << k;
  }
  EXPECT_NEAR(area(dented_conic({0, 0}, 6, 2, 0, 0)), 12 * pi, 1e-13);
  EXPECT_NEAR(area(dented_conic({0, 0}, 6, 2, 1, 0)), 12 * pi, 1e-13);
}

TEST(CombinedArea, StarsAgainstTheirOutline) {
  Random random(43);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 50; ++i) {
    const CombinedEllipse body = testing::random_planar_star(random, 1 + i % 4);
    double shoelace[2];
    for (int fine = 0; fine < 2; ++fine) {
      std::vector<Vector2d> p;
      for (const BoundaryArc& arc : outline(body, fine ? 0.002 : 0.02))
        for (std::size_t k = 0; k + 1 < arc.points.size(); ++k) {
          p.push_back(arc.points[k] - body.center());
          EXPECT_NEAR(body.gauge(p.back()), 1, 1e-9);
        }
      shoelace[fine] = 0;
      for (std::size_t k = 0; k < p.size(); ++k) {
        const Vector2d &u = p[k], &v = p[(k + 1) % p.size()];
        shoelace[fine] += 0.5 * (u.x() * v.y() - u.y() * v.x());
      }
    }
    const double exact = area(body);
    // Chords err by the square of their length.
    EXPECT_NEAR(shoelace[0], exact, 3e-3 * exact) << i;
    EXPECT_NEAR(shoelace[1], exact, 3e-5 * exact) << i;
  }
}

TEST(Outline, ArcsMeetInTheCorners) {
  Random random(44);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 50; ++i) {
    const CombinedEllipse body = i == 0   ? CombinedEllipse(Ellipse::from_axes({1, 2}, {3, 4}))
                                 : i == 1 ? dented_conic({1, 2}, 6, 2, 1, 0.3)
                                          : testing::random_planar_star(random, 1 + i % 4);
    const auto arcs = outline(body);
    const auto all = corners(body);
    EXPECT_EQ(arcs.size(), std::max<std::size_t>(1, all.size())) << i;
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      const auto& next = arcs[(k + 1) % arcs.size()];
      EXPECT_LT((arcs[k].points.back() - next.points.front()).norm(), 1e-9);
      if (all.empty()) continue;
      double nearest = 1e300;
      for (const Corner& c : all)
        if (std::set<int>{c.first, c.second} == std::set<int>{arcs[k].conic, next.conic})
          nearest = std::min(nearest, (c.point - arcs[k].points.back()).norm());
      EXPECT_LT(nearest, 1e-9) << i;
    }
  }
}

/// Closed, consistently oriented, of the given Euler characteristic, and every vertex where it should be.
void expect_sound(const CombinedEllipsoid& body, const CombinedSurface& s, int euler = 2) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : s.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t.vertices[k], t.vertices[(k + 1) % 3]}];
  for (const auto& [e, count] : edges) {
    ASSERT_EQ(count, 1) << "an edge twice in one direction";
    ASSERT_TRUE(edges.contains({e.second, e.first})) << "an open edge";
  }
  EXPECT_EQ(static_cast<int>(s.vertices.size()) - static_cast<int>(edges.size() / 2) +
                static_cast<int>(s.triangles.size()),
            euler);
  // Coordinates are rounded: by so much the forms' terms, which cancel where a body is thin.
  const Matrix3d inverse = body.ellipsoid().factor().inverse();
  double largest = inverse.squaredNorm();
  for (const auto& d : body.delimiters()) largest = std::max(largest, d.matrix.norm());
  const auto rounding = [&](const Vector3d& x) {
    const double reach = x.norm() + body.center().norm();
    return 100 * std::numeric_limits<double>::epsilon() * (1 + largest * reach * reach);
  };
  for (const Vector3d& x : s.vertices) {
    if (x == body.center()) continue;
    // A pinched body's lines all end on its ellipsoid.
    const double gauge = euler == 2 ? body.gauge(x - body.center()) : (inverse * (x - body.center())).norm();
    ASSERT_NEAR(gauge, 1, rounding(x));
  }
  // Each vertex of a triangle is on the triangle's quadric, so those of rims are on both.
  for (const auto& t : s.triangles)
    for (const int v : t.vertices) {
      const Vector3d x = s.vertices[static_cast<std::size_t>(v)], y = x - body.center();
      if (y.isZero()) continue;
      const double value = t.quadric == 0
                               ? (inverse * y).squaredNorm() - 1
                               : body.delimiters()[static_cast<std::size_t>(t.quadric - 1)].value(y);
      // The mesh takes a node for one on a rim up to this (relative).
      constexpr double kOnRim = 1e-10;
      ASSERT_LT(std::abs(value), rounding(x) + kOnRim * (1 + largest * y.squaredNorm()))
          << "quadric " << t.quadric;
    }
}

TEST(Surface, ClosedOrientedAndOfTheRightVolume) {
  Random random(45);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 24; ++i) {
    const CombinedEllipsoid body = i == 0 ? CombinedEllipsoid(Ellipsoid::from_axes({1, 2, 3}, {1, 2, 5}))
                                          : testing::random_star(random, i % 5);
    const VolumeEstimate v = volume(body);
    double gap[2];
    for (int fine = 0; fine < 2; ++fine) {
      const CombinedSurface s = surface(body, fine ? 0.1 : 0.2);
      expect_sound(body, s);
      if (HasFatalFailure()) FAIL() << "body " << i;
      gap[fine] = std::abs(enclosed_volume(s) - v.value) / body.ellipsoid().volume();
    }
    // Second order; convex and concave parts may cancel in the coarse one, hence the plain bound.
    EXPECT_LT(gap[0], 2e-2) << i;
    EXPECT_LT(gap[1], 5e-3) << i;
  }
}

TEST(Surface, ConvergesToTheVolumeInSecondOrder) {
  for (const CombinedEllipsoid& body : {testing::biconcave(), testing::waisted()}) {
    const double v = volume(body).value;
    const double coarse = std::abs(enclosed_volume(surface(body, 0.16)) - v),
                 fine = std::abs(enclosed_volume(surface(body, 0.04)) - v);
    EXPECT_LT(fine, coarse / 8);
    EXPECT_LT(fine, 1e-3 * v);
  }
}

TEST(Surface, RimsAreWhereTwoQuadricsMeet) {
  const CombinedEllipsoid dented = testing::biconcave();
  const CombinedSurface s = surface(dented);
  const auto edges = rims(s);
  EXPECT_GT(edges.size(), 40u);
  std::map<int, int> degree;
  for (const auto& e : edges)
    for (const int v : e) {
      ++degree[v];
      const Vector3d y = s.vertices[static_cast<std::size_t>(v)];
      EXPECT_NEAR(dented.delimiters()[0].value(y), 0, 1e-12);
      EXPECT_NEAR(dented.ellipsoid().quadric().value(y), 0, 1e-12);
    }
  for (const auto& [v, count] : degree) EXPECT_EQ(count, 2) << "rims are closed curves";
  // The parts of (6.6) and (6.7) together are the whole.
  const CombinedSurface edh = part(s, SurfacePart::ellipsoid), hde = part(s, SurfacePart::delimiters);
  EXPECT_EQ(edh.triangles.size() + hde.triangles.size(), s.triangles.size());
  EXPECT_EQ(edh.vertices.size() + hde.vertices.size(), s.vertices.size() + degree.size());
  for (const auto& t : hde.triangles) EXPECT_EQ(t.quadric, 1);
  // No dents beyond the rim's plane: by symmetry the rim circles have one x each.
  EXPECT_TRUE(rims(edh).empty());
}

TEST(Surface, FindsSmallAndNarrowFeatures) {
  // Dents of 1 % of the body, a dent a hundred times as long as wide, and a body that a waist thins to 1 %.
  const Ellipsoid ball = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1});
  for (const auto& d : {hyperboloid(2, {0.99, 0.01, 0.01}), hyperboloid(2, {0.5, 0.01, 1.0}),
                        hyperboloid(1, {0.05, 0.01, 0.01}), hyperboloid(1, {0.3, 0.01, 0.2})}) {
    const CombinedEllipsoid body(ball, {d});
    const CombinedSurface s = surface(body, 0.1);
    expect_sound(body, s);
    EXPECT_GE(rims(s).size(), 30u);
    const VolumeEstimate v = volume(body);
    EXPECT_NEAR(enclosed_volume(s), v.value, 2e-2 * v.value);
  }
}

TEST(Surface, ExtremeBodiesAreClosedToo) {
  Random random(46);
  SCOPED_TRACE(random.trace());
  const auto spread = [&](double low, double high) {
    return std::exp(random.uniform(std::log(low), std::log(high)));
  };
  for (int i = 0; i < 12; ++i) {
    const Ellipsoid e = Ellipsoid::from_axes(
        random.vector<3>(), {spread(0.01, 10), spread(0.01, 10), spread(0.01, 10)}, random.rotation<3>());
    std::vector<Delimiter<3>> all;
    for (int k = 0; k <= i % 4; ++k) {
      const int sheets = random.integer(1, 2);
      Vector3d axes(spread(0.01, 100), spread(0.01, 100), spread(0.01, 100));
      (sheets == 2 ? axes(0) : axes(1)) = random.uniform(0.02, 0.99);
      const Matrix3d inverse = e.factor().inverse();
      const Matrix3d m =
          inverse.transpose() * hyperboloid(sheets, axes, random.rotation<3>()).matrix * inverse;
      all.push_back({0.5 * (m + m.transpose()), 1});
    }
    const CombinedEllipsoid body(e, all);
    expect_sound(body, surface(body, 0.3));
    if (HasFatalFailure()) FAIL() << "body " << i;
    EXPECT_LT(volume(body).error, 1e-6 * volume(body).value);
  }
}

TEST(Surface, PinchedBodiesShareTheirCentre) {
  const Ellipsoid ball = Ellipsoid::from_axes({1, 0, 0}, {2, 2, 2});
  const CombinedEllipsoid ring(ball, {{Vector3d(1, -1, -1).asDiagonal().toDenseMatrix(), 0}});
  const CombinedSurface s = surface(ring, 0.1);
  expect_sound(ring, s, 1);
  EXPECT_NEAR(enclosed_volume(s), volume(ring).value, 2e-2 * volume(ring).value);
  const CombinedEllipsoid cones(ball, {{Vector3d(-1, 1, 1).asDiagonal().toDenseMatrix(), 0}});
  const CombinedSurface t = surface(cones, 0.1);
  expect_sound(cones, t, 3);
  EXPECT_NEAR(enclosed_volume(t), volume(cones).value, 2e-2 * volume(cones).value);
}

int lines(const std::string& text, const std::string& beginning) {
  int count = 0;
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
    count += text.compare(at, beginning.size(), beginning) == 0;
  return count;
}

TEST(Surface, FilesHoldTheSameTriangles) {
  const CombinedSurface s = surface(testing::biconcave(), 0.5);
  const std::string obj = to_obj(s), ply = to_ply(s);
  EXPECT_EQ(lines(obj, "v "), static_cast<int>(s.vertices.size()));
  EXPECT_EQ(lines(obj, "f "), static_cast<int>(s.triangles.size()));
  EXPECT_EQ(lines(obj, "g quadric_"), 2);
  EXPECT_EQ(lines(ply, "3 "), static_cast<int>(s.triangles.size()));
  EXPECT_EQ(lines(ply, "element face " + std::to_string(s.triangles.size())), 1);
}

TEST(Surface, OfASurfaceMadeByHandVerticesMustBeThere) {
  for (const int vertex : {-1, 3, 2'147'483'647}) {
    const CombinedSurface s{{Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY()}, {{{0, 1, vertex}, 0}}};
    EXPECT_THROW((void)part(s, SurfacePart::ellipsoid), InputError);
    EXPECT_THROW((void)rims(s), InputError);
    EXPECT_THROW((void)enclosed_volume(s), InputError);
    EXPECT_THROW((void)to_obj(s), InputError);
    EXPECT_THROW((void)to_ply(s), InputError);
  }
  // Quadrics are names: any numbers.
  const CombinedSurface s{{Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY()},
                          {{{0, 1, 2}, 2'147'483'647}}};
  EXPECT_EQ(lines(to_obj(s), "g quadric_"), 1);
}

TEST(Surface, RefusesOtherResolutions) {
  for (const double resolution : {0.0, 2.0, std::nan("")}) {
    EXPECT_THROW(surface(CombinedEllipsoid(Ellipsoid()), resolution), InputError);
    EXPECT_THROW(outline(CombinedEllipse(Ellipse()), resolution), InputError);
  }
}

}  // namespace
}  // namespace vericone::combined_surface_test
