// SPDX-License-Identifier: GPL-3.0-or-later
//
// Assemblies that are convex bodies in disguise against the exact predicates of those bodies.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/internal/verify/spatial/minkowski_bounds.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone::verify::assembly_convex_test {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kSeed = 1;

Vector3d some_axes(SeededRandom& random) {
  Vector3d axes;
  for (int i = 0; i < 3; ++i) axes(i) = random.uniform(0.5, 3);
  return axes;
}

Vector3d towards(const Vector3d& c, SeededRandom& random) {
  return c + random.uniform(0, 1) * c.norm() * random.direction<3>();
}

/// The image of a geodesic sphere in the body, times `scale` about its centre.
std::vector<Vector3d> geodesic(const Ellipsoid& body, const GeodesicSphere& sphere, double scale) {
  std::vector<Vector3d> points;
  for (const Vector3d& u : sphere.vertices) points.push_back(body.center() + body.factor() * (scale * u));
  return points;
}

std::vector<Assembly::Triangle> facets(const GeodesicSphere& sphere) {
  std::vector<Assembly::Triangle> r;
  for (const auto& f : sphere.facets)
    r.push_back({static_cast<std::uint32_t>(f(0)), static_cast<std::uint32_t>(f(1)),
                 static_cast<std::uint32_t>(f(2))});
  return r;
}

/// Membership, contacts and misses of two descriptions of one body as seen from outside.
void expect_same(const AssemblyOracle& a, const AssemblyOracle& b, const Vector3d& w) {
  ASSERT_EQ(a.membership(w), b.membership(w));
  const auto s = a.first_contact(w), t = b.first_contact(w);
  ASSERT_EQ(s.has_value(), t.has_value());
  if (s) {
    EXPECT_LE(s->earliest, t->latest);
    EXPECT_LE(t->earliest, s->latest);
  }
  const AssemblyMiss d = a.miss_distance(w), e = b.miss_distance(w);
  EXPECT_LE(d.least, e.most);
  EXPECT_LE(e.least, d.most);
}

TEST(AssemblyConvex, MeshOfAHullIsTheHull) {
  const GeodesicSphere sphere(2);
  std::array<int, 3> answers{};
  for (std::uint64_t index = 0; index < 30; ++index) {
    SCOPED_TRACE(index);
    SeededRandom random(980, kSeed, index);
    const Vector3d c = random.uniform(8, 15) * random.direction<3>(), axes = some_axes(random);
    const Ellipsoid body = Ellipsoid::from_axes(c, axes, random.rotation());
    const std::vector<Vector3d> points = geodesic(body, sphere, 1);
    const HullBody hull(points);
    const Assembly mesh = Assembly::mesh(points, facets(sphere)), solid = Assembly::polyhedra({hull});
    const auto check = [&](const auto& agent, const std::vector<Vector3d>& corners) {
      const AssemblyOracle of_mesh(agent, mesh), of_solid(agent, solid);
      const HullOracle exact(agent, hull);
      ASSERT_EQ(exact.relation(), Relation::disjoint);
      ASSERT_EQ(of_mesh.relation(), Relation::disjoint);
      for (int k = 0; k < 20; ++k) {
        Vector3d w = towards(c, random);
        // Exactly through a corner of the sum.
        const auto i = static_cast<std::size_t>(random.integer(0, static_cast<int>(points.size()) - 1));
        if (k % 4 == 0) w = points[i] - corners[static_cast<std::size_t>(k) % corners.size()];
        const Membership m = exact.membership(w);
        ++answers[static_cast<std::size_t>(m)];
        EXPECT_EQ(of_mesh.membership(w), m);
        EXPECT_EQ(of_solid.membership(w), m);
        expect_same(of_mesh, of_solid, w);
      }
    };
    const Vector3d agent_axes = some_axes(random);
    check(Ellipsoid::from_axes({0, 0, 0}, agent_axes, random.rotation()), {Vector3d::Zero()});
    const HullBody box = HullBody::box({-1, -1, -1}, {1, 1, 1});
    check(box, box.points());
  }
  EXPECT_GT(answers[0], 200);
  EXPECT_GT(answers[2], 200);
}

TEST(AssemblyConvex, OneBallIsAnEllipsoid) {
  std::array<int, 3> answers{};
  for (std::uint64_t index = 0; index < 200; ++index) {
    SCOPED_TRACE(index);
    SeededRandom random(981, kSeed, index);
    const Vector3d c = random.uniform(3, 15) * random.direction<3>(), axes = some_axes(random);
    const Ellipsoid agent = Ellipsoid::from_axes({0, 0, 0}, axes, random.rotation());
    const double radius = random.uniform(0.1, 3);
    const ConeOracle exact(agent, Ellipsoid::from_axes(c, Vector3d::Constant(radius)));
    const AssemblyOracle oracle(agent, Assembly::cloud({c}, radius));
    ASSERT_EQ(oracle.relation(), exact.relation());
    if (exact.relation() != Relation::disjoint) continue;
    for (int k = 0; k < 20; ++k) {
      const Vector3d w = towards(c, random);
      const Membership m = exact.membership(w);
      ++answers[static_cast<std::size_t>(m)];
      EXPECT_EQ(oracle.membership(w), m);
    }
  }
  EXPECT_GT(answers[0], 500);
  EXPECT_GT(answers[2], 500);
}

TEST(AssemblyConvex, FineMeshesBracketTheEllipsoid) {
  const GeodesicSphere sphere(3);
  // Facets of the unit mesh are this near to the centre.
  double nearest = 1;
  for (const auto& f : sphere.facets) {
    const Vector3d a = sphere.vertices[f(0)], b = sphere.vertices[f(1)], c = sphere.vertices[f(2)];
    nearest = std::min(nearest, (b - a).cross(c - a).normalized().dot(a));
  }
  for (std::uint64_t index = 0; index < 6; ++index) {
    SCOPED_TRACE(index);
    SeededRandom random(982, kSeed, index);
    const Vector3d c = random.uniform(8, 15) * random.direction<3>(), axes = some_axes(random),
                   agent_axes = some_axes(random);
    const Ellipsoid body = Ellipsoid::from_axes(c, axes, random.rotation()),
                    agent = Ellipsoid::from_axes({0, 0, 0}, agent_axes, random.rotation());
    const ConeOracle exact(agent, body);
    const AssemblyOracle inner(agent, Assembly::mesh(geodesic(body, sphere, 1 - 1e-12), facets(sphere))),
        outer(agent, Assembly::mesh(geodesic(body, sphere, (1 + 1e-12) / nearest), facets(sphere)));
    ASSERT_EQ(outer.relation(), Relation::disjoint);
    int between = 0;
    for (int k = 0; k < 200; ++k) {
      const Vector3d w = towards(c, random);
      const bool in = exact.membership(w) != Membership::out;
      if (inner.membership(w) != Membership::out) {
        EXPECT_TRUE(in);
      }
      if (in) {
        EXPECT_EQ(outer.membership(w), Membership::in);
      }
      between += in && inner.membership(w) == Membership::out;
      const auto late = inner.first_contact(w), early = outer.first_contact(w);
      if (const auto t = time_to_contact(agent, body, w); t && late) {
        ASSERT_TRUE(early);
        EXPECT_LE(early->earliest, *t * (1 + 1e-12));
        EXPECT_GE(late->latest, *t * (1 - 1e-12));
      }
    }
    EXPECT_LE(between, 10);
    const Vector3d axis = c.normalized(), first = axis.unitOrthogonal(), second = axis.cross(first);
    for (int k = 0; k < 16; ++k) {
      const double turn = 2 * std::numbers::pi * k / 16;
      const Vector3d side = std::cos(turn) * first + std::sin(turn) * second;
      // The edge of a convex cone about the axis, by bisection.
      double low = 0, high = std::numbers::pi;
      while (high - low > 1e-12) {
        const double t = 0.5 * (low + high);
        (exact.membership(std::cos(t) * axis + std::sin(t) * side) != Membership::out ? low : high) = t;
      }
      const ExtremeDirection i = inner.extreme(axis, side, 1e-6), o = outer.extreme(axis, side, 1e-6);
      ASSERT_TRUE(i.any && o.any);
      EXPECT_LE(i.low, high + 1e-12);
      EXPECT_GE(o.high, low - 1e-12);
      EXPECT_LT(o.high - i.low, 0.02);
    }
    if (index > 1) continue;
    ConeMapOptions options;
    options.resolution = 0.02;
    const ConeMap inside = cone_map(inner, options), outside = cone_map(outer, options);
    const double solid = true_cone(agent, body, 192).solid_angle;
    EXPECT_LE(inside.colliding, solid);
    EXPECT_GE(outside.colliding + outside.undecided, solid);
    EXPECT_LT(outside.colliding + outside.undecided - inside.colliding, 0.15 * solid);
  }
}

TEST(AssemblyConvex, BoxesTheirTrianglesAndTheirOctants) {
  std::array<int, 3> answers{};
  for (std::uint64_t index = 0; index < 60; ++index) {
    SCOPED_TRACE(index);
    SeededRandom random(983, kSeed, index);
    std::vector<Box> boxes, cells;
    std::vector<Vector3d> points;
    std::vector<Assembly::Triangle> triangles;
    for (int b = 0; b < 5; ++b) {
      // Corners on eighths, so that halves are exact.
      Box box;
      const Vector3d corner = random.uniform(5, 12) * random.direction<3>();
      for (int i = 0; i < 3; ++i) {
        box.low(i) = std::round(8 * corner(i)) / 8;
        box.high(i) = box.low(i) + random.integer(1, 16) / 4.0;
      }
      boxes.push_back(box);
      const Vector3d half = box.half_widths();
      const auto at = static_cast<std::uint32_t>(points.size());
      for (int i = 0; i < 8; ++i) {
        const Vector3d low =
            box.low + Vector3d(i & 1 ? half.x() : 0, i & 2 ? half.y() : 0, i & 4 ? half.z() : 0);
        cells.push_back({low, low + half});
        points.push_back(box.low + 2 * (low - box.low));
      }
      for (const auto& [p, q, r, s] : {std::array<std::uint32_t, 4>{0, 1, 3, 2},
                                       {4, 5, 7, 6},
                                       {0, 1, 5, 4},
                                       {2, 3, 7, 6},
                                       {0, 2, 6, 4},
                                       {1, 3, 7, 5}}) {
        triangles.push_back({at + p, at + q, at + r});
        triangles.push_back({at + p, at + r, at + s});
      }
    }
    const Assembly whole = Assembly::boxes(boxes), parts = Assembly::boxes(cells),
                   surface = Assembly::mesh(points, triangles);
    const auto check = [&](const auto& agent) {
      const AssemblyOracle a(agent, whole), b(agent, parts), c(agent, surface);
      ASSERT_EQ(a.relation(), b.relation());
      // Inside a box its surface is not touched.
      if (a.relation() != Relation::disjoint) return;
      ASSERT_EQ(c.relation(), Relation::disjoint);
      for (int k = 0; k < 15; ++k) {
        Vector3d w = towards(boxes[static_cast<std::size_t>(k) % boxes.size()].center(), random);
        if (k % 3 == 0) w = points[static_cast<std::size_t>(random.integer(0, 39))];
        if (k % 3 == 1) w = w.array().round();
        ++answers[static_cast<std::size_t>(a.membership(w))];
        expect_same(a, b, w);
        expect_same(a, c, w);
      }
    };
    check(Ellipsoid::from_axes({0, 0, 0}, Vector3d::Constant(1)));
    const Vector3d axes = some_axes(random) / 2;
    check(Ellipsoid::from_axes({0, 0, 0}, axes, random.rotation()));
    check(HullBody::box({-1, -0.5, -0.25}, {1, 0.5, 0.25}));
  }
  EXPECT_GT(answers[0], 300);
  EXPECT_GT(answers[2], 300);
}

}  // namespace
}  // namespace vericone::verify::assembly_convex_test
