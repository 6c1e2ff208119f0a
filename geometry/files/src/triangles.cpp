// SPDX-License-Identifier: BSD-3-Clause
//
// Polygons cut into triangles.
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace vericone::files {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// A polygon as seen along the axis from which its fan looks largest; turns are told exactly.
class Outline {
 public:
  Outline(const std::vector<Eigen::Vector3d>& points, const Face& face) : points_(points) {
    Eigen::Vector3d sizes = Eigen::Vector3d::Zero();
    const Eigen::Vector3d& first = points[face[0]];
    for (std::size_t k = 2; k < face.size(); ++k)
      sizes += (points[face[k - 1]] - first).cross(points[face[k]] - first).cwiseAbs();
    Eigen::Index axis = 0;
    sizes.maxCoeff(&axis);
    i_ = (axis + 1) % 3;
    j_ = (axis + 2) % 3;
  }

  /// Which way a to b to c turns: 1, 0, -1.
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Eigen::Vector3d &p = points_[a], &q = points_[b], &r = points_[c];
    // Of a difference of two products of differences (Shewchuk 1997, with room for underflow).
    const double left = (q(i_) - p(i_)) * (r(j_) - p(j_)), right = (q(j_) - p(j_)) * (r(i_) - p(i_)),
                 area = left - right;
    if (std::abs(area) > 0x1p-51 * (std::abs(left) + std::abs(right)) + 0x1p-1000) return area > 0 ? 1 : -1;
    using exact::Rational;
    const Rational px = p(i_), py = p(j_);
    return Rational((q(i_) - px) * (r(j_) - py) - (q(j_) - py) * (r(i_) - px)).sign();
  }

  /// Whether x is inside the triangle, or between the ends of its last side; `way`: how the triangle turns.
  bool holds(const Triangle& t, int way, std::uint32_t x) const {
    return way * turn(t[0], t[1], x) > 0 && way * turn(t[1], t[2], x) > 0 && way * turn(t[2], t[0], x) >= 0;
  }

 private:
  const std::vector<Eigen::Vector3d>& points_;
  Eigen::Index i_ = 0, j_ = 1;
};

/// Ears: corners whose triangle with their neighbours is inside the polygon. False where some are left that
/// have none: then the polygon crosses itself. `way`: how it turns.
bool cut_ears(const Outline& outline, Face corners, int way, std::vector<Triangle>& triangles) {
  std::size_t at = 0, passed = 0;
  while (corners.size() > 2) {
    const std::size_t n = corners.size();
    if (passed > n) return false;
    const Triangle ear{corners[(at + n - 1) % n], corners[at % n], corners[(at + 1) % n]};
    const int turn = way * outline.turn(ear[0], ear[1], ear[2]);
    const bool cuts = turn == 0 || (turn > 0 && std::none_of(corners.begin(), corners.end(), [&](auto x) {
                                      return outline.holds(ear, way, x);
                                    }));
    if (!cuts) {
      at = (at + 1) % n;
      ++passed;
      continue;
    }
    triangles.push_back(ear);
    corners.erase(corners.begin() + std::ptrdiff_t(at % n));
    at = at % n % corners.size();
    passed = 0;
  }
  return true;
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
    const std::size_t before = triangles.size();
    for (std::size_t k = 2; k < f.size(); ++k) triangles.push_back({f[0], f[k - 1], f[k]});
    if (f.size() <= 3) continue;
    // Where all triangles of the fan turn the same way, it is the polygon.
    const Outline outline(points, f);
    bool left = false, right = false;
    for (std::size_t k = before; k < triangles.size(); ++k) {
      const int turn = outline.turn(triangles[k][0], triangles[k][1], triangles[k][2]);
      left = left || turn > 0;
      right = right || turn < 0;
    }
    if (!(left && right)) continue;
    for (const int way : {1, -1}) {
      triangles.resize(before);
      if (cut_ears(outline, f, way, triangles)) break;
      if (way < 0)
        throw InputError("faces[" + std::to_string(i) + "]",
                         "face " + std::to_string(i) + ", a polygon of " + std::to_string(f.size()) +
                             " corners that crosses itself",
                         "one that does not, as seen along the axis from which it looks largest");
    }
  }
  return triangles;
}

}  // namespace vericone::files
