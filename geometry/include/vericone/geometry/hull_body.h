// SPDX-License-Identifier: BSD-3-Clause
//
// The convex hull of finitely many points: convex polyhedra, and the hulls of point clouds and meshes.
#pragma once

#include <vericone/geometry/error.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace vericone {

/// The solid convex hull of one or more points, lengths in metres, given by the points alone: no facets are
/// needed or computed. Points inside the hull, repeated points, and flat hulls (a polygon, a segment, a
/// single point) are allowed. Exact predicates take the coordinates as they are stored.
class HullBody {
 public:
  /// The origin.
  HullBody() : points_{Eigen::Vector3d::Zero()} {}

  /// Throws InputError naming "points" where there is none, and "points[i][k]" for a coordinate that is not
  /// finite. Linear in the number of points.
  explicit HullBody(std::vector<Eigen::Vector3d> points) : points_(std::move(points)) {
    if (points_.empty()) throw InputError("points", "no point", "one point or more");
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (!std::isfinite(points_[i](k)))
          throw InputError("points[" + std::to_string(i) + "][" + std::to_string(k) + "]",
                           to_text(points_[i](k)), "a finite number (m)");
  }

  /// The eight corners of the box between two opposite corners, which may share coordinates.
  [[nodiscard]] static HullBody box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    std::vector<Eigen::Vector3d> corners;
    corners.reserve(8);
    for (int i = 0; i < 8; ++i)
      corners.emplace_back((i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z());
    return HullBody(std::move(corners));
  }

  [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const { return points_; }
  [[nodiscard]] std::size_t size() const { return points_.size(); }

  /// Support function max n.x over the body; rounded. Linear in the number of points.
  [[nodiscard]] double support(const Eigen::Vector3d& n) const {
    double most = n.dot(points_.front());
    for (const Eigen::Vector3d& x : points_) most = std::max(most, n.dot(x));
    return most;
  }

  /// Each coordinate is rounded once. Throws InputError like the constructor.
  [[nodiscard]] HullBody translated(const Eigen::Vector3d& by) const {
    std::vector<Eigen::Vector3d> moved = points_;
    for (Eigen::Vector3d& x : moved) x += by;
    return HullBody(std::move(moved));
  }

  /// The image under x -> scale * x; each coordinate is rounded once.
  [[nodiscard]] HullBody scaled(double scale) const {
    std::vector<Eigen::Vector3d> image = points_;
    for (Eigen::Vector3d& x : image) x *= scale;
    return HullBody(std::move(image));
  }

 private:
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace vericone
