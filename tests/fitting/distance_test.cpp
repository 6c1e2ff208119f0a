// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/fitting/fit.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/mesh/surface.h>
#include <vericone/internal/fitting/signed_distance.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "distance/body_distance.h"
#include "support/random.h"

namespace vericone::fitting::distance_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using testing::Random;

/// An ellipsoid about (0.5, -0.2, 1) with so many delimiters that cut it, of both kinds, of revolution or
/// not.
CombinedEllipsoid random_body(Random& random, int delimiters) {
  const auto lengths = [&](double low, double high) {
    Vector3d v;
    for (int k = 0; k < 3; ++k) v(k) = random.uniform(low, high);
    return v;
  };
  const Ellipsoid ellipsoid = Ellipsoid::from_axes({0.5, -0.2, 1}, lengths(0.4, 1.5), random.rotation<3>());
  std::vector<Delimiter<3>> all;
  while (static_cast<int>(all.size()) < delimiters) {
    Vector3d axes = lengths(0.1, 1);
    if (random.integer(0, 2) == 0) axes.z() = axes.y();
    const Delimiter<3> one = hyperboloid(random.integer(1, 2), axes, random.rotation<3>());
    try {
      (void)CombinedEllipsoid(ellipsoid, {one});
      all.push_back(one);
    } catch (const InputError&) {  // misses the ellipsoid
    }
  }
  return {ellipsoid, all};
}

double to_segment(const Vector3d& x, const Vector3d& a, const Vector3d& b) {
  const double t = std::clamp((x - a).dot(b - a) / std::max(1e-300, (b - a).squaredNorm()), 0.0, 1.0);
  return (x - a - t * (b - a)).norm();
}

double to_triangle(const Vector3d& x, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a);
  if (n.dot((b - a).cross(x - a)) >= 0 && n.dot((c - b).cross(x - b)) >= 0 &&
      n.dot((a - c).cross(x - c)) >= 0 && n.norm() > 0)
    return std::abs(n.dot(x - a)) / n.norm();
  return std::min({to_segment(x, a, b), to_segment(x, b, c), to_segment(x, c, a)});
}

TEST(SignedDistance, AlongNormalsOfEllipsoids) {
  Random random(800);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 3000; ++k) {
    const double scale = std::pow(10, random.uniform(-3, 3));
    Vector3d axes;
    for (int i = 0; i < 3; ++i) axes(i) = scale * std::pow(10, random.uniform(-2, 0));
    const Vector3d center = scale * random.vector<3>();
    const Ellipsoid e = Ellipsoid::from_axes(center, axes, random.rotation<3>());
    const Vector3d normal = random.vector<3>().normalized(), foot = e.support_point(normal);
    const double out = scale * std::pow(10, random.uniform(-6, 3));
    EXPECT_NEAR(signed_distance(e, foot + out * normal), out, 1e-12 * (out + scale));
    // Inside up to the least radius of curvature the foot stays the nearest point.
    const double in = random.uniform(0, 0.999) * axes.minCoeff() * axes.minCoeff() / axes.maxCoeff();
    EXPECT_NEAR(signed_distance(e, foot - in * normal), -in, 1e-12 * scale);
  }
}

TEST(SignedDistance, OfPlanesOfSymmetry) {
  const double a = 5, b = 3, c = 2;
  const Ellipsoid e = Ellipsoid::from_axes(Vector3d::Zero(), {a, b, c});
  const Ellipse flat = Ellipse::from_axes(Vector2d::Zero(), {a, b});
  EXPECT_NEAR(signed_distance(e, Vector3d::Zero()), -c, 1e-15);
  EXPECT_NEAR(signed_distance(flat, Vector2d::Zero()), -b, 1e-15);
  for (const double x : {0.1, 2.0, 3.19, 3.21, 4.19, 4.21, 4.9, 5.0, 7.0}) {
    // On the long axis the foot leaves the axis before the centre of curvature.
    const double in_plane = x < (a * a - b * b) / a ? -b * std::sqrt(1 - x * x / (a * a - b * b)) : x - a;
    const double in_space = x < (a * a - c * c) / a ? -c * std::sqrt(1 - x * x / (a * a - c * c)) : x - a;
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_NEAR(signed_distance(flat, Vector2d(sign * x, 0)), in_plane, 1e-14) << x;
      EXPECT_NEAR(signed_distance(e, {sign * x, 0, 0}), in_space, 1e-14) << x;
      // Next to the axis, where the root is next to the pole.
      EXPECT_NEAR(signed_distance(e, {sign * x, 1e-13, -1e-13}), in_space, 1e-11) << x;
    }
  }
}

TEST(SignedDistance, AlongTheAxisOfADent) {
  // The unit ball less the inside of a two-sheeted hyperboloid of revolution about x.
  const double a = 0.4, b = 0.3;
  const CombinedEllipsoid body(Ellipsoid(), {hyperboloid(2, {a, b, b})});
  const double rim_x = std::sqrt((1 / (b * b) + 1) / (1 / (a * a) + 1 / (b * b)));
  const double rim_r = std::sqrt(1 - rim_x * rim_x);
  const double leaves = a + b * b / a;                  // the foot is the vertex up to here,
  const double at_rim = rim_x * (1 + b * b / (a * a));  // then moves along the dent, then is the rim
  for (double x = a; x < 3; x += 0.01) {
    double wanted = x - a;
    if (x > leaves) {
      const double foot = x / (1 + b * b / (a * a));
      wanted = std::hypot(x - foot, b * std::sqrt(foot * foot / (a * a) - 1));
    }
    if (x > at_rim) wanted = std::hypot(x - rim_x, rim_r);
    EXPECT_NEAR(signed_distance(body, {x, 0, 0}), wanted, 1e-13) << x;
    EXPECT_NEAR(signed_distance(body, {-x, 0, 0}), wanted, 1e-13) << x;
  }
  EXPECT_NEAR(signed_distance(body, {0.3, 0, 0}), -0.1, 1e-14);
}

TEST(SignedDistance, OfADoubleConeAndItsTip) {
  // The ball less the double cone x^2 > y^2 + z^2: pinched to a point at its centre.
  const Matrix3d cone = Vector3d(1, -1, -1).asDiagonal();
  const CombinedEllipsoid body(Ellipsoid(), {{cone, 0}});
  for (const double x : {0.1, 0.5, 1.0, 1.4})
    EXPECT_NEAR(signed_distance(body, {x, 0, 0}), x * std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(signed_distance(body, {1.5, 0, 0}), std::hypot(1.5 - std::sqrt(0.5), std::sqrt(0.5)), 1e-14);
  EXPECT_NEAR(signed_distance(body, {2, 1, 0}), std::hypot(2 - std::sqrt(0.5), 1 - std::sqrt(0.5)), 1e-13);
  EXPECT_NEAR(signed_distance(body, {0, 0.25, 0}), -0.25 * std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(signed_distance(body, {0, 2, 0}), 1, 1e-15);
  EXPECT_EQ(signed_distance(body, Vector3d::Zero()), 0);
}

TEST(SignedDistance, AgreesWithATriangulatedSurface) {
  Random random(810);
  SCOPED_TRACE(random.trace());
  for (int b = 0; b < 24; ++b) {
    const CombinedEllipsoid body = random_body(random, b % 4);
    const BodyDistance distance(body);
    const CombinedSurface s = surface(body, 0.06);
    // How far the triangles are from the surface, along rays from the centre.
    double sag = 0;
    for (const auto& t : s.triangles) {
      Vector3d middle = Vector3d::Zero();
      for (const int v : t.vertices) middle += s.vertices[static_cast<std::size_t>(v)] / 3;
      const double gauge = body.gauge(middle - body.center());
      sag = std::max(sag, std::abs(1 / gauge - 1) * (middle - body.center()).norm());
    }
    for (int k = 0; k < 40; ++k) {
      const Vector3d x = body.center() + (k % 3 ? 1.4 : 0.6) * random.vector<3>();
      const double d = signed_distance(body, x);
      EXPECT_EQ(d, distance(x));
      EXPECT_EQ(d < 0, body.gauge(x - body.center()) < 1);
      double to_triangles = 1e300, to_vertices = 1e300;
      for (const auto& t : s.triangles) {
        const auto corner = [&](std::size_t i) {
          return s.vertices[static_cast<std::size_t>(t.vertices[i])];
        };
        to_triangles = std::min(to_triangles, to_triangle(x, corner(0), corner(1), corner(2)));
      }
      for (const Vector3d& v : s.vertices) to_vertices = std::min(to_vertices, (v - x).norm());
      EXPECT_LE(std::abs(d), to_vertices + 1e-12) << "body " << b << " point " << k;
      EXPECT_NEAR(std::abs(d), to_triangles, 2 * sag) << "body " << b << " point " << k;
    }
  }
}

TEST(SignedDistance, ChangesNoFasterThanThePointMoves) {
  // A candidate that was missed, for some points and not for others, would show as a jump.
  Random random(820);
  SCOPED_TRACE(random.trace());
  for (int b = 0; b < 60; ++b) {
    const CombinedEllipsoid body = random_body(random, b % 5);
    const BodyDistance distance(body);
    Vector3d x = body.center() + 3 * random.vector<3>();
    const Vector3d to = body.center() + 0.5 * random.vector<3>();
    constexpr int kSteps = 1500;
    const Vector3d step = (to - x) / kSteps;
    double before = distance(x);
    for (int k = 0; k < kSteps; ++k) {
      x += step;
      const double now = distance(x);
      EXPECT_LE(std::abs(now - before), step.norm() + 1e-12) << "body " << b << " step " << k;
      before = now;
    }
  }
}

TEST(SignedDistance, FollowsScaleAndRotation) {
  Random random(830);
  SCOPED_TRACE(random.trace());
  for (int b = 0; b < 20; ++b) {
    const CombinedEllipsoid body = random_body(random, b % 4);
    const Matrix3d turn = random.rotation<3>();
    const double scale = std::pow(10, random.uniform(-3, 3));
    const Ellipsoid& e = body.ellipsoid();
    const Matrix3d directions =
        e.factor() *
        Vector3d(1 / e.factor().col(0).norm(), 1 / e.factor().col(1).norm(), 1 / e.factor().col(2).norm())
            .asDiagonal();
    const Vector3d lengths = e.factor().colwise().norm();
    std::vector<Delimiter<3>> turned;
    for (const Delimiter<3>& d : body.delimiters()) {
      const Matrix3d m = turn * d.matrix * turn.transpose() / (scale * scale);
      turned.push_back({0.5 * (m + m.transpose()), d.level});
    }
    const CombinedEllipsoid image(
        Ellipsoid::from_axes(scale * (turn * e.center()), scale * lengths, turn * directions), turned);
    for (int k = 0; k < 20; ++k) {
      const Vector3d x = body.center() + random.vector<3>();
      const double d = signed_distance(body, x);
      EXPECT_NEAR(signed_distance(image, scale * (turn * x)) / scale, d, 1e-11);
    }
  }
}

TEST(SignedDistance, OfUnionsAndFootprints) {
  Piece ball, other, upright;
  other.body = Ellipsoid::from_axes({5, 0, 0}, {2, 2, 2});
  EXPECT_NEAR(signed_distance({ball, other}, {2.5, 0, 0}), 0.5, 1e-15);
  EXPECT_NEAR(signed_distance({ball, other}, {2, 0, 0}), 1, 1e-15);
  EXPECT_NEAR(signed_distance({ball, other}, {5, 0, 1}), -1, 1e-15);
  upright.footprint = Ellipse::from_axes({1, 1}, {3, 3});
  upright.high = 1;
  EXPECT_NEAR(signed_distance({upright}, {5, 4, 100}), 2, 1e-14);
  EXPECT_NEAR(signed_distance({upright}, {1, 2, -100}), -2, 1e-14);
}

}  // namespace
}  // namespace vericone::fitting::distance_test
