// SPDX-License-Identifier: BSD-3-Clause
#include "glb/body_surface.h"

#include <vericone/geometry/mesh/surface.h>
#include <cmath>
#include <map>
#include <numbers>
#include <variant>

#include "glb/hull_surface.h"

namespace vericone::glb {
namespace {

using Eigen::Vector3d;

constexpr double kResolution = 0.12;  // of quadrics, in parts of their semi-axes

void add_surface(Drawn& to, const Drawn& more) {
  const auto first = static_cast<std::uint32_t>(to.points.size());
  to.points.insert(to.points.end(), more.points.begin(), more.points.end());
  for (const auto& t : more.triangles) to.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

Drawn quadric_surface(const CombinedEllipsoid& body) {
  const CombinedSurface found = surface(body, kResolution);
  Drawn drawn{found.vertices, {}};
  for (const auto& triangle : found.triangles) {
    auto& corners = drawn.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) corners[k] = static_cast<std::uint32_t>(triangle.vertices[k]);
  }
  return drawn;
}

/// Equal corners become one.
Drawn joined(const std::vector<std::array<Vector3d, 3>>& triangles) {
  Drawn drawn;
  std::map<std::array<double, 3>, std::uint32_t> index;
  for (const auto& corners : triangles) {
    auto& triangle = drawn.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& x = corners[k];
      const auto [it, is_new] =
          index.try_emplace({x.x(), x.y(), x.z()}, static_cast<std::uint32_t>(drawn.points.size()));
      if (is_new) drawn.points.push_back(x);
      triangle[k] = it->second;
    }
  }
  return drawn;
}

/// The hull of the points farthest along the directions of a grid about z, whose rings stand beside the poles
/// and the equator, where bodies about z have their edges.
Drawn convex_surface(const Convex& body, int rings) {
  std::vector<Vector3d> points{body.support_point(Vector3d::UnitZ()), body.support_point(-Vector3d::UnitZ())};
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < 2 * rings; ++j) {
      const double polar = std::numbers::pi * (i + 0.5) / rings,
                   azimuth = std::numbers::pi * (j + 0.5) / rings;
      points.push_back(body.support_point(
          {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)}));
    }
  return hull_surface(points);
}

Drawn box_surface(const Box& box) {
  Drawn drawn;
  for (int i = 0; i < 8; ++i)
    drawn.points.emplace_back((i & 1 ? box.high : box.low).x(), (i & 2 ? box.high : box.low).y(),
                              (i & 4 ? box.high : box.low).z());
  drawn.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return drawn;
}

Drawn balls_surface(const Assembly& pieces) {
  constexpr std::size_t kMostBalls = 2000;
  const std::vector<Vector3d>& centers = pieces.by_slot().balls;
  if (pieces.radius() == 0 || centers.size() > kMostBalls) return {centers, {}};
  const double resolution = centers.size() <= 20 ? kResolution : 0.6;
  const Drawn one = [&] {
    const CombinedSurface found =
        surface(Ellipsoid::from_axes(Vector3d::Zero(), Vector3d::Constant(pieces.radius()),
                                     Eigen::Matrix3d::Identity()),
                resolution);
    Drawn ball{found.vertices, {}};
    for (const auto& t : found.triangles)
      ball.triangles.push_back(
          {std::uint32_t(t.vertices[0]), std::uint32_t(t.vertices[1]), std::uint32_t(t.vertices[2])});
    return ball;
  }();
  Drawn all;
  for (const Vector3d& center : centers) {
    Drawn ball = one;
    for (Vector3d& x : ball.points) x += center;
    add_surface(all, ball);
  }
  return all;
}

Drawn assembly_surface(const Assembly& pieces) {
  const Assembly::Storage& all = pieces.by_slot();
  Drawn drawn;
  switch (pieces.kind()) {
    case PieceKind::triangle:
      return joined(all.triangles);
    case PieceKind::ball:
      return balls_surface(pieces);
    case PieceKind::box:
      for (const Box& box : all.boxes) add_surface(drawn, box_surface(box));
      return drawn;
    case PieceKind::hull:
      for (const HullBody& hull : all.hulls) add_surface(drawn, hull_surface(hull.points()));
      return drawn;
    case PieceKind::convex:
      break;
  }
  const int rings = pieces.size() <= 20 ? 24 : pieces.size() <= 200 ? 8 : 4;
  for (const Convex& body : all.convexes) add_surface(drawn, convex_surface(body, rings));
  return drawn;
}

struct SurfaceOf {
  Drawn operator()(const CombinedEllipsoid& body) const { return quadric_surface(body); }
  Drawn operator()(const HullBody& hull) const { return hull_surface(hull.points()); }
  Drawn operator()(const Assembly& pieces) const { return assembly_surface(pieces); }
  Drawn operator()(const Convex& body) const { return convex_surface(body, 24); }
  Drawn operator()(const std::vector<CombinedEllipsoid>& pieces) const {
    Drawn all;
    for (const CombinedEllipsoid& piece : pieces) add_surface(all, quadric_surface(piece));
    return all;
  }
};

}  // namespace

Drawn body_surface(const Body& body, const Vector3d& origin) {
  Drawn drawn = std::visit(SurfaceOf{}, body.shape());
  for (Vector3d& x : drawn.points) x -= origin;
  return drawn;
}

Drawn flat_surface(const CombinedEllipse& body) {
  Drawn drawn;
  drawn.points.emplace_back(0, 0, 0);
  const Eigen::Vector2d center = body.center();
  for (const BoundaryArc& arc : outline(body, 0.05))
    for (const Eigen::Vector2d& x : arc.points) {
      const Vector3d raised(x.x() - center.x(), x.y() - center.y(), 0);
      if ((raised - drawn.points.back()).norm() > 0) drawn.points.push_back(raised);
    }
  const auto count = static_cast<std::uint32_t>(drawn.points.size());
  for (std::uint32_t i = 1; i < count; ++i) drawn.triangles.push_back({0, i, i + 1 < count ? i + 1 : 1});
  return drawn;
}

Drawn flat_surface(const std::vector<std::vector<Eigen::Vector2d>>& outlines, const Vector3d& origin) {
  Drawn drawn;
  for (const auto& outline : outlines) {
    const auto first = static_cast<std::uint32_t>(drawn.points.size());
    for (const Eigen::Vector2d& x : outline)
      drawn.points.emplace_back(x.x() - origin.x(), x.y() - origin.y(), 0);
    for (std::uint32_t i = 2; i < outline.size(); ++i)
      drawn.triangles.push_back({first, first + i - 1, first + i});
  }
  return drawn;
}

Drawn world_surface(const WorldBody& body, const Vector3d& origin) {
  if (body.flat()) {
    Drawn flat = flat_surface(*body.flat());
    for (Vector3d& x : flat.points) x.head<2>() += body.flat()->center() - origin.head<2>();
    return flat;
  }
  const Placed placed = body.as_placed();
  Drawn drawn = body_surface(placed.body, Vector3d::Zero());
  for (Vector3d& x : drawn.points) x = placed.pose.to_world(x) - origin;
  return drawn;
}

}  // namespace vericone::glb
