// SPDX-License-Identifier: BSD-3-Clause
//
// Polygons cut into triangles.
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/outline.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace vericone::files {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// A polygon as seen along a coordinate axis: that coordinate left out, so that nothing is rounded and turns
/// are told exactly.
class Outline {
 public:
  Outline(const std::vector<Eigen::Vector3d>& points, Eigen::Index axis)
      : points_(points), i_((axis + 1) % 3), j_((axis + 2) % 3) {}

  Eigen::Vector2d at(std::uint32_t a) const { return {points_[a](i_), points_[a](j_)}; }

  /// Which way a to b to c turns: 1, 0, -1.
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return outlines::turn(at(a), at(b), at(c));
  }

  /// Whether x is inside the triangle, or between the ends of its last side; `way`: how the triangle turns.
  bool holds(const Triangle& t, int way, std::uint32_t x) const {
    return way * turn(t[0], t[1], x) > 0 && way * turn(t[1], t[2], x) > 0 && way * turn(t[2], t[0], x) >= 0;
  }

 private:
  const std::vector<Eigen::Vector3d>& points_;
  Eigen::Index i_ = 0, j_ = 1;
};

/// How large the polygon looks along each coordinate axis.
Eigen::Vector3d sizes_along_axes(const std::vector<Eigen::Vector3d>& points, const Face& face) {
  Eigen::Vector3d sizes = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& first = points[face[0]];
  for (std::size_t k = 2; k < face.size(); ++k)
    sizes += (points[face[k - 1]] - first).cross(points[face[k]] - first).cwiseAbs();
  return sizes;
}

/// The corners of a polygon in square cells, about one a cell: which are near a triangle.
class CornerGrid {
 public:
  CornerGrid(const Outline& outline, const Face& corners) {
    Eigen::Vector2d high = low_ = outline.at(corners[0]);
    for (const std::uint32_t c : corners)
      low_ = low_.cwiseMin(outline.at(c)), high = high.cwiseMax(outline.at(c));
    side_ = std::max(1, int(std::sqrt(double(corners.size()))));
    // Halved so that it is finite; of no width, or less than can be divided by: one cell.
    const Eigen::Vector2d half = 0.5 * high - 0.5 * low_;
    for (int k = 0; k < 2; ++k) per_half_(k) = half(k) > 0x1p-900 ? side_ / half(k) : 0;
    cells_.resize(std::size_t(side_) * std::size_t(side_));
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto [i, j] = cell(outline.at(corners[k]));
      cells_[std::size_t(i * side_ + j)].push_back(std::uint32_t(k));
    }
  }

  /// Whether `holds(k)` for a corner number k of the cells that the triangle's box touches.
  template <typename Holds>
  bool any_near(const Outline& outline, const Triangle& t, const Holds& holds) const {
    const Eigen::Vector2d a = outline.at(t[0]), b = outline.at(t[1]), c = outline.at(t[2]);
    const auto low = cell(a.cwiseMin(b).cwiseMin(c)), high = cell(a.cwiseMax(b).cwiseMax(c));
    for (int i = low[0]; i <= high[0]; ++i)
      for (int j = low[1]; j <= high[1]; ++j)
        for (const std::uint32_t k : cells_[std::size_t(i * side_ + j)])
          if (holds(k)) return true;
    return false;
  }

 private:
  /// Rises with each coordinate, rounded or not: that is all that any_near() needs.
  std::array<int, 2> cell(const Eigen::Vector2d& x) const {
    std::array<int, 2> place{};
    for (int k = 0; k < 2; ++k) {
      const double at = (0.5 * x(k) - 0.5 * low_(k)) * per_half_(k);
      place[std::size_t(k)] = int(std::clamp(at, 0., double(side_ - 1)));
    }
    return place;
  }

  Eigen::Vector2d low_, per_half_;
  int side_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
};

/// Ears: corners whose triangle with their neighbours turns as the polygon does and holds no other corner.
/// Each is cut off, so that the triangles cover what the outline winds round, as often as it does.
class Ears {
 public:
  /// `way`: how the polygon turns, 1 or -1.
  Ears(const Outline& outline, const Face& corners, int way)
      : outline_(outline),
        corners_(corners),
        way_(way),
        grid_(outline, corners),
        next_(corners.size()),
        before_(corners.size()),
        left_(corners.size()) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      next_[k] = std::uint32_t((k + 1) % corners.size());
      before_[k] = std::uint32_t((k + corners.size() - 1) % corners.size());
    }
  }

  /// False where some corners are left that are no ears: the polygon then turns the other way, or winds round
  /// parts of itself both ways.
  bool cut(std::vector<Triangle>& triangles) {
    std::uint32_t at = 0;
    for (std::size_t passed = 0; left_ > 2;) {
      if (passed > left_) return false;
      if (!is_ear(at)) {
        at = next_[at];
        ++passed;
        continue;
      }
      triangles.push_back(triangle(at));
      const std::uint32_t a = before_[at], b = next_[at];
      next_[a] = b;
      before_[b] = a;
      before_[at] = kGone;
      --left_;
      passed = 0;
      // The corner before is the other that may be an ear now.
      at = is_ear(a) ? a : b;
    }
    return true;
  }

 private:
  static constexpr std::uint32_t kGone = std::numeric_limits<std::uint32_t>::max();

  Triangle triangle(std::uint32_t k) const { return {corners_[before_[k]], corners_[k], corners_[next_[k]]}; }

  /// A corner on a straight edge is one: nobody else's triangle reaches the edge's neighbour there.
  bool is_ear(std::uint32_t k) const {
    const Triangle t = triangle(k);
    const int turn = way_ * outline_.turn(t[0], t[1], t[2]);
    return turn == 0 || (turn > 0 && !grid_.any_near(outline_, t, [&](std::uint32_t other) {
             return before_[other] != kGone &&
                    (outline_.holds(t, way_, corners_[other]) || enters(t, other, k));
           }));
  }

  /// Whether the outline comes by a corner of the triangle once more, and from there goes into it: at the
  /// ends of a bridge to a hole.
  bool enters(const Triangle& t, std::uint32_t other, std::uint32_t k) const {
    if (other == k || other == before_[k] || other == next_[k]) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (corners_[other] != t[i]) continue;
      for (const std::uint32_t x : {corners_[before_[other]], corners_[next_[other]]})
        if (way_ * outline_.turn(t[i], t[(i + 1) % 3], x) > 0 &&
            way_ * outline_.turn(t[(i + 2) % 3], t[i], x) > 0)
          return true;
    }
    return false;
  }

  const Outline& outline_;
  const Face& corners_;
  int way_;
  CornerGrid grid_;
  std::vector<std::uint32_t> next_, before_;  // of the corners that are left; kGone: not one of them
  std::size_t left_;
};

/// Whether the fan of triangles turns one way: then it covers what the outline winds round.
bool is_even(const Outline& outline, std::span<const Triangle> fan) {
  bool left = false, right = false;
  for (const Triangle& t : fan) {
    const int turn = outline.turn(t[0], t[1], t[2]);
    left = left || turn > 0;
    right = right || turn < 0;
  }
  return !(left && right);
}

/// Appends the polygon's triangles; false where there are none.
bool cut_polygon(const std::vector<Eigen::Vector3d>& points, const Face& face,
                 std::vector<Triangle>& triangles) {
  const std::size_t before = triangles.size();
  for (std::size_t k = 2; k < face.size(); ++k) triangles.push_back({face[0], face[k - 1], face[k]});
  if (face.size() <= 3) return true;
  Eigen::Vector3d sizes = sizes_along_axes(points, face);
  Eigen::Index axis = 0;
  sizes.maxCoeff(&axis);
  if (is_even(Outline(points, axis), std::span(triangles).subspan(before))) return true;
  // A polygon that is far from flat may cross itself as seen along one axis and not along another.
  const double least = 0.5 * sizes(axis);
  for (; sizes.maxCoeff(&axis) > 0 && sizes(axis) >= least; sizes(axis) = 0) {
    const Outline outline(points, axis);
    for (const int way : {1, -1}) {
      triangles.resize(before);
      if (Ears(outline, face, way).cut(triangles)) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<Triangle> triangles_of(const std::vector<Eigen::Vector3d>& points,
                                   const std::vector<Face>& faces) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Face& f = faces[i];
    for (std::size_t k = 0; k < f.size(); ++k)
      if (f[k] >= points.size() || !points[f[k]].allFinite())
        throw InputError("faces[" + std::to_string(i) + "][" + std::to_string(k) + "]", std::to_string(f[k]),
                         "the number of a finite point, below " + std::to_string(points.size()));
    if (!cut_polygon(points, f, triangles))
      throw InputError("faces[" + std::to_string(i) + "]",
                       "face " + std::to_string(i) + ", a polygon of " + std::to_string(f.size()) +
                           " corners that crosses itself",
                       "one that does not, as seen along one of the coordinate axes");
  }
  return triangles;
}

}  // namespace vericone::files
