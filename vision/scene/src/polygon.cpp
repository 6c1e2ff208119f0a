// SPDX-License-Identifier: BSD-3-Clause
#include "polygon.h"

#include <array>

namespace vericone::vision {

Polygon seen(const Camera& camera, const Pose& pose, const std::vector<Eigen::Vector3d>& outline) {
  constexpr double kNear = 0.1, kBeyond = 8;  // m, px
  std::vector<Eigen::Vector3d> points;
  points.reserve(outline.size() + 5);
  for (const Eigen::Vector3d& point : outline) points.push_back(pose.to_body(point));
  const double left = (-kBeyond - camera.centre.x()) / camera.focal,
               right = (camera.width + kBeyond - camera.centre.x()) / camera.focal,
               top = (-kBeyond - camera.centre.y()) / camera.focal,
               bottom = (camera.height + kBeyond - camera.centre.y()) / camera.focal;
  // n . x >= d, one after the other (Sutherland and Hodgman).
  const std::array<Eigen::Vector4d, 5> planes{
      Eigen::Vector4d(0, 0, 1, kNear), Eigen::Vector4d(1, 0, -left, 0), Eigen::Vector4d(-1, 0, right, 0),
      Eigen::Vector4d(0, 1, -top, 0), Eigen::Vector4d(0, -1, bottom, 0)};
  for (const Eigen::Vector4d& plane : planes) {
    std::vector<Eigen::Vector3d> kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d &a = points[i], &b = points[(i + 1) % points.size()];
      const double da = plane.head<3>().dot(a) - plane.w(), db = plane.head<3>().dot(b) - plane.w();
      if (da >= 0) kept.push_back(a);
      if ((da >= 0) != (db >= 0)) kept.emplace_back(a + da / (da - db) * (b - a));
    }
    points = std::move(kept);
    if (points.size() < 3) return {};
  }
  Polygon polygon;
  for (const Eigen::Vector3d& point : points)
    polygon.emplace_back(camera.centre + camera.focal / point.z() * point.head<2>());
  return polygon;
}

Polygon hull_of(Polygon points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  Polygon hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const Eigen::Vector2d& p : points) {
      while (hull.size() >= begin + 2) {
        const Eigen::Vector2d a = hull.back() - hull[hull.size() - 2], b = p - hull.back();
        if (a.x() * b.y() - a.y() * b.x() > 0) break;
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace vericone::vision
