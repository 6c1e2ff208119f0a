// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/lidar/visible_part.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace vericone::lidar {
namespace {

using Eigen::Vector3d;

constexpr int kMostQuarterings = 8;
constexpr double kMargin = 1e-9;  // of the distance, before which nothing may stand
constexpr double kEdge = 1e-9;    // rad, by which the field of view is wider than its outermost beams

/// Where a lidar can have beams.
class View {
 public:
  View(const Lidar& lidar, const Eigen::Isometry3d& agent)
      : lidar_(lidar), pose_(agent * lidar.pose), to_sensor_(pose_.inverse()) {
    const auto [low, high] =
        std::minmax_element(lidar.beams.elevations.begin(), lidar.beams.elevations.end());
    low_ = *low - kEdge;
    high_ = *high + kEdge;
    const auto [first, last] = std::minmax_element(lidar.beams.azimuths.begin(), lidar.beams.azimuths.end());
    middle_ = 0.5 * (*first + *last);
    half_ = 0.5 * (*last - *first) + kEdge;
    // A full turn but for its last step.
    if (lidar.beams.azimuths.size() > 2 &&
        half_ * 2 * double(lidar.beams.azimuths.size()) / double(lidar.beams.azimuths.size() - 1) >
            2 * std::numbers::pi - 1e-6)
      half_ = 4;
  }

  bool sees(const MeshScene& scene, const Vector3d& point) const {
    const Vector3d p = to_sensor_ * point;
    const double range = p.norm();
    if (!(range >= lidar_.min_range && range <= lidar_.max_range)) return false;
    const double elevation = std::atan2(p.z(), std::hypot(p.x(), p.y()));
    if (elevation < low_ || elevation > high_) return false;
    const double azimuth = std::remainder(std::atan2(p.y(), p.x()) - middle_, 2 * std::numbers::pi);
    return std::abs(azimuth) <= half_ && scene.sees(pose_.translation(), point, kMargin * range);
  }

 private:
  const Lidar& lidar_;
  Eigen::Isometry3d pose_, to_sensor_;
  double low_, high_, middle_, half_;
};

class Collector {
 public:
  Collector(const MeshScene& scene, std::vector<View> views, double resolution)
      : scene_(scene), views_(std::move(views)), resolution_(resolution) {}

  void add(const Vector3d& a, const Vector3d& b, const Vector3d& c, int depth = 0) {
    const double size = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
    // Corners a little inside: at a convex edge they belong to the neighbours as well.
    const Vector3d middle = (a + b + c) / 3;
    int seen = seen_from(middle);
    const bool last = size <= resolution_ || depth == kMostQuarterings;
    if (!last) {
      for (const Vector3d& corner : {a, b, c}) seen += seen_from(corner + 1e-6 * (middle - corner));
      if (seen == 0) return;
    }
    if (last ? seen == 1 : seen == 4) {
      const auto first = static_cast<std::uint32_t>(part_.points.size());
      part_.points.insert(part_.points.end(), {a, b, c});
      part_.triangles.push_back({first, first + 1, first + 2});
      part_.area += 0.5 * (b - a).cross(c - a).norm();
    } else if (!last) {
      const Vector3d ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
      add(a, ab, ca, depth + 1);
      add(b, bc, ab, depth + 1);
      add(c, ca, bc, depth + 1);
      add(ab, bc, ca, depth + 1);
    }
  }

  SurfacePart take() { return std::move(part_); }

 private:
  int seen_from(const Vector3d& point) const {
    return std::any_of(views_.begin(), views_.end(), [&](const View& v) { return v.sees(scene_, point); })
               ? 1
               : 0;
  }

  const MeshScene& scene_;
  std::vector<View> views_;
  double resolution_;
  SurfacePart part_;
};

}  // namespace

SurfacePart visible_part(const MeshScene& scene, const std::vector<Vector3d>& points,
                         const std::vector<Triangle>& triangles, const std::vector<Lidar>& lidars,
                         const Eigen::Isometry3d& agent, double resolution) {
  std::vector<View> views;
  for (std::size_t i = 0; i < lidars.size(); ++i) try {
      check(lidars[i]);
    } catch (const InputError& e) {
      throw e.within("lidars[" + std::to_string(i) + "]");
    }
  for (const Lidar& l : lidars) views.emplace_back(l, agent);
  Collector collector(scene, std::move(views), resolution);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const std::uint32_t corner : triangles[i])
      if (corner >= points.size())
        throw InputError("triangles[" + std::to_string(i) + "]", std::to_string(corner),
                         "indices of points, below " + std::to_string(points.size()));
  for (const Triangle& t : triangles) collector.add(points[t[0]], points[t[1]], points[t[2]]);
  return collector.take();
}

}  // namespace vericone::lidar
