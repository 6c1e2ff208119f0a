// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/opening/opening.h>
#include <vericone/internal/cones/opening/placed.h>
#include <vericone/internal/geometry/outline.h>
#include <vericone/internal/geometry/requires.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <string>
#include <utility>

#include "answers/elementary.h"
#include "opening/outline.h"

namespace vericone {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using outlines::turn;

std::string named(std::size_t i) { return "polygon[" + std::to_string(i) + "]"; }

/// Best first over squares that are halved: no point of a square is deeper than its middle by more than half
/// its diagonal.
Vector2d deepest_point(const Opening& opening) {
  struct Square {
    Vector2d middle;
    double half, depth;
    [[nodiscard]] double most() const { return depth + half * std::numbers::sqrt2; }
    bool operator<(const Square& other) const { return most() < other.most(); }
  };
  Vector2d low = opening.vertices().front(), high = low;
  for (const Vector2d& v : opening.vertices()) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const Vector2d middle = 0.5 * low + 0.5 * high;
  const double half = (0.5 * high - 0.5 * low).maxCoeff();
  std::priority_queue<Square> open;
  open.push({middle, half, opening.depth(middle)});
  Square best = open.top();
  constexpr int kMost = 4000;  // squares; thin outlines end here with what they have
  for (int asked = 0; asked < kMost && !open.empty(); asked += 4) {
    const Square top = open.top();
    open.pop();
    if (best.depth > 0 && !(top.most() > 1.01 * best.depth)) break;
    for (const Vector2d& corner : {Vector2d(-1, -1), Vector2d(1, -1), Vector2d(-1, 1), Vector2d(1, 1)}) {
      const Vector2d m = top.middle + 0.5 * top.half * corner;
      const Square part{m, 0.5 * top.half, opening.depth(m)};
      if (part.depth > best.depth) best = part;
      open.push(part);
    }
  }
  return best.middle;
}

double depth_in_polygon(const std::vector<Vector2d>& p, const Vector2d& x) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;
  const Vector2d* a = &p.back();
  for (const Vector2d& b : p) {
    nearest = std::min(nearest, (x - nearest_on_segment(*a, b, x)).squaredNorm());
    // A ray towards +x: the edge has one end above it and one not.
    if ((a->y() > x.y()) != (b.y() > x.y())) inside = inside != ((b.y() > a->y()) == (turn(*a, b, x) > 0));
    a = &b;
  }
  return inside ? std::sqrt(nearest) : -std::sqrt(nearest);
}

}  // namespace

Opening Opening::circle(double radius) {
  if (!(radius > 0 && std::isfinite(radius)))
    throw InputError("radius", to_text(radius), "a positive finite number (m)");
  Opening opening;
  opening.semi_axes_ = {radius, radius};
  opening.reach_ = radius;
  return opening;
}

Opening Opening::ellipse(const Vector2d& semi_axes) {
  for (int i = 0; i < 2; ++i)
    if (!(semi_axes(i) > 0 && std::isfinite(semi_axes(i))))
      throw InputError("semi_axes[" + std::to_string(i) + "]", to_text(semi_axes(i)),
                       "a positive finite number (m)");
  Opening opening;
  opening.semi_axes_ = semi_axes;
  opening.reach_ = semi_axes.maxCoeff();
  return opening;
}

Opening Opening::polygon(std::vector<Vector2d> vertices) {
  const std::size_t n = vertices.size();
  if (n < 3) throw InputError("polygon", std::to_string(n) + " vertices", "3 vertices or more");
  for (std::size_t i = 0; i < n; ++i) {
    if (!vertices[i].allFinite())
      throw InputError(named(i), "[" + to_text(vertices[i].x()) + ", " + to_text(vertices[i].y()) + "]",
                       "two finite numbers (m)");
    if (vertices[i] == vertices[i == 0 ? n - 1 : i - 1])
      throw InputError(named(i), "[" + to_text(vertices[i].x()) + ", " + to_text(vertices[i].y()) + "]",
                       "another point than the vertex before");
  }
  if (std::all_of(vertices.begin(), vertices.end(),
                  [&](const Vector2d& v) { return turn(vertices[0], vertices[1], v) == 0; }))
    throw InputError("polygon", "vertices on one line", "vertices that enclose an area");
  outlines::require_simple(vertices, "polygon");

  const auto at = [&](std::size_t i) -> const Vector2d& { return vertices[i % n]; };
  const std::size_t corner = outlines::leftmost(vertices);
  if (turn(at(corner + n - 1), at(corner), at(corner + 1)) < 0)
    std::reverse(vertices.begin(), vertices.end());

  Opening opening;
  opening.vertices_ = std::move(vertices);
  const std::vector<Vector2d>& p = opening.vertices_;
  for (std::size_t i = 0; i < n; ++i) {
    opening.convex_ = opening.convex_ && turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) >= 0;
    opening.reach_ = std::max(opening.reach_, p[i].norm() * (1 + 4 * kUnitRoundoff));
  }
  opening.deepest_ = deepest_point(opening);
  return opening;
}

double Opening::depth(const Vector2d& point) const {
  VERICONE_REQUIRES(point.allFinite(), "point", "a number that is not finite", "finite (m)");
  if (polygonal()) return depth_in_polygon(vertices_, point);
  const double outside = point.cwiseQuotient(semi_axes_).norm() - 1;
  if (semi_axes_.x() == semi_axes_.y()) return semi_axes_.x() - point.norm();
  return std::copysign((nearest_on_ellipse(semi_axes_, point) - point).norm(), -outside);
}

void require_placed(const PlacedOpening& placed) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(placed.center(i)))
      throw InputError("center[" + std::to_string(i) + "]", to_text(placed.center(i)), "a finite number (m)");
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(placed.axes(i, j)))
        throw InputError("axes[" + std::to_string(j) + "][" + std::to_string(i) + "]",
                         to_text(placed.axes(i, j)), "a finite number");
  const auto u = exact::direction_on_grid<3>(placed.axes.col(0)),
             v = exact::direction_on_grid<3>(placed.axes.col(1));
  bool plane = false;
  for (int i = 0; i < 3; ++i) plane = plane || u[i] * v[(i + 1) % 3] != u[(i + 1) % 3] * v[i];
  if (!plane) throw InputError("axes", "two on one line", "two linearly independent vectors");
}

}  // namespace vericone
