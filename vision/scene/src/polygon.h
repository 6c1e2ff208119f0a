// SPDX-License-Identifier: BSD-3-Clause
//
// Convex polygons in pictures, with smooth edges.
#pragma once

#include <vericone/geometry/camera.h>
#include <vericone/geometry/pose.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace vericone::vision {

using Polygon = std::vector<Eigen::Vector2d>;  // px, either way round

/// A flat convex outline in the world as it is seen: cut off in front of the camera and some pixels beyond
/// the picture. Empty where nothing of it is there.
Polygon seen(const Camera& camera, const Pose& pose, const std::vector<Eigen::Vector3d>& outline);

/// Hull of points.
Polygon hull_of(Polygon points);

/// Calls paint(u, v, share) for every pixel that the polygon covers, the share to one side of an edge taken
/// from the distance of the pixel's middle: right to a hundredth for edges longer than a pixel.
template <typename Paint>
void fill(const Polygon& polygon, int width, int height, const Paint& paint) {
  if (polygon.size() < 3) return;
  double area = 0, top = 1e300, bottom = -1e300;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    area += a.x() * b.y() - a.y() * b.x();
    top = std::min(top, a.y());
    bottom = std::max(bottom, a.y());
  }
  // n . x + d is the distance inwards.
  std::vector<Eigen::Vector3d> edges;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], along = polygon[(i + 1) % polygon.size()] - a;
    const double length = along.norm();
    if (length < 1e-9) continue;
    const Eigen::Vector2d n = Eigen::Vector2d(-along.y(), along.x()) * ((area > 0 ? 1 : -1) / length);
    edges.emplace_back(n.x(), n.y(), -n.dot(a));
  }
  const int first = std::max(0, int(std::floor(top))), last = std::min(height - 1, int(std::ceil(bottom)));
  for (int v = first; v <= last; ++v) {
    double from = 0, to = width - 1.0, within_from = 0, within_to = width - 1.0;
    const auto cut = [&](const Eigen::Vector3d& e, double offset, double& low, double& high) {
      const double rest = e.y() * v + e.z() + offset;  // e.x u + rest >= 0
      if (std::abs(e.x()) < 1e-12) {
        if (rest < 0) high = low - 1;
      } else if (e.x() > 0) {
        low = std::max(low, -rest / e.x());
      } else {
        high = std::min(high, -rest / e.x());
      }
    };
    for (const Eigen::Vector3d& e : edges) {
      cut(e, 0.5, from, to);
      cut(e, -0.5, within_from, within_to);
    }
    for (int u = int(std::ceil(from)); u <= int(std::floor(to)); ++u) {
      double share = 1;
      if (u < within_from || u > within_to)
        for (const Eigen::Vector3d& e : edges)
          share *= std::clamp(e.x() * u + e.y() * v + e.z() + 0.5, 0.0, 1.0);
      if (share > 0) paint(u, v, share);
    }
  }
}

}  // namespace vericone::vision
