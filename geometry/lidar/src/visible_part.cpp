// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/lidar/lidar.h>

#include <vericone/geometry/error.h>
#include <vericone/lidar/lidar.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace vericone::lidar {
namespace {

using Eigen::Vector3d;

constexpr int kMostGridQuarterings = 20, kMostQuarterings = 8;
constexpr double kMargin = 1e-9;  // of the distance, before which nothing may stand
constexpr double kEdge = 1e-9;    // rad, by which the field of view is wider than its outermost beams

/// Where a lidar can have beams.
class View {
 public:
  View(const Lidar& lidar, const Eigen::Isometry3d& agent)
      : lidar_(lidar),
        pose_(agent * lidar.pose),
        to_sensor_(pose_.inverse()),
        spacing_(lidar.beams.spacing()) {
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

  /// Whether a ball may reach into the field of view and the ranges; then whether it looks wider than
  /// neighbouring beams are apart.
  enum class Look { outside, narrow, wide };
  Look look(const Vector3d& middle, double radius) const {
    const Vector3d p = to_sensor_ * middle;
    const double range = p.norm();
    if (range + radius < lidar_.min_range || range - radius > lidar_.max_range) return Look::outside;
    if (radius < range) {
      const double around = std::asin(radius / range),
                   elevation = std::atan2(p.z(), std::hypot(p.x(), p.y()));
      if (elevation + around < low_ || elevation - around > high_) return Look::outside;
      // Near the poles all azimuths.
      if (const double across = radius / std::hypot(p.x(), p.y()); across < 1) {
        const double azimuth = std::remainder(std::atan2(p.y(), p.x()) - middle_, 2 * std::numbers::pi);
        if (std::abs(azimuth) - std::asin(across) > half_) return Look::outside;
      }
    }
    return spacing_ > 0 && 2 * radius > spacing_ * range ? Look::wide : Look::narrow;
  }

 private:
  const Lidar& lidar_;
  Eigen::Isometry3d pose_, to_sensor_;
  double low_, high_, middle_, half_, spacing_;
};

/// Where beams hit a triangle.
using Hits = std::vector<Vector3d>;

class Collector {
 public:
  Collector(const MeshScene& scene, std::vector<View> views, double resolution)
      : scene_(scene), views_(std::move(views)), resolution_(resolution) {}

  void add(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Hits& hits) {
    checkpoint();
    look_at({a, b, c}, hits, 0, 0);
  }

  SurfacePart take() {
    for (const Corners& t : kept_) {
      const auto first = static_cast<std::uint32_t>(part_.points.size());
      part_.points.insert(part_.points.end(), t.begin(), t.end());
      part_.triangles.push_back({first, first + 1, first + 2});
      part_.area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
    }
    return std::move(part_);
  }

 private:
  using Corners = std::array<Vector3d, 3>;

  /// Keeps what of a piece is seen; true where that is all of it. `grid`, `depth`: quarterings so far, to the
  /// grid of the beams and after it.
  bool look_at(const Corners& t, const Hits& hits, int grid, int depth) {
    const auto& [a, b, c] = t;
    const double size = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
    const Vector3d middle = (a + b + c) / 3;
    if (depth == 0) {
      const double radius = std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()});
      bool wide = false, outside = true;
      for (const View& view : views_) {
        const View::Look look = view.look(middle, radius * (1 + 1e-12));
        wide = wide || look == View::Look::wide;
        outside = outside && look == View::Look::outside;
      }
      if (outside && hits.empty()) return false;
      // Four points of a piece say nothing of what stands between beams before it.
      if (wide && size > resolution_ && grid < kMostGridQuarterings) return quarter(t, hits, grid + 1, depth);
    }
    // Corners a little inside: at a convex edge they belong to the neighbours as well.
    int seen = seen_from(middle);
    const bool last = size <= resolution_ || depth == kMostQuarterings;
    if (!last)
      for (const Vector3d& corner : t) seen += seen_from(corner + 1e-6 * (middle - corner));
    if (seen == 0 && hits.empty()) return false;
    if (!last && seen < 4) return quarter(t, hits, grid, depth + 1);
    kept_.push_back(t);
    return true;
  }

  bool quarter(const Corners& t, const Hits& hits, int grid, int depth) {
    const auto& [a, b, c] = t;
    const Vector3d ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    // To the corner whose weight is above a half, else to the middle piece.
    std::array<Hits, 4> parts;
    const Vector3d normal = (b - a).cross(c - a);
    const double whole = normal.squaredNorm();
    for (const Vector3d& x : hits) {
      const double at_b = (x - a).cross(c - a).dot(normal) / whole,
                   at_c = (b - a).cross(x - a).dot(normal) / whole;
      parts[1 - at_b - at_c > 0.5 ? 0 : at_b > 0.5 ? 1 : at_c > 0.5 ? 2 : 3].push_back(x);
    }
    const std::size_t before = kept_.size();
    bool all = look_at({a, ab, ca}, parts[0], grid, depth);
    all = look_at({b, bc, ab}, parts[1], grid, depth) && all;
    all = look_at({c, ca, bc}, parts[2], grid, depth) && all;
    all = look_at({ab, bc, ca}, parts[3], grid, depth) && all;
    if (!all) return false;
    kept_.resize(before);
    kept_.push_back(t);
    return true;
  }

  int seen_from(const Vector3d& point) const {
    return std::any_of(views_.begin(), views_.end(), [&](const View& v) { return v.sees(scene_, point); })
               ? 1
               : 0;
  }

  const MeshScene& scene_;
  std::vector<View> views_;
  double resolution_;
  std::vector<Corners> kept_;
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
  std::vector<Hits> hits(triangles.size());
  for (Lidar lidar : lidars) {
    lidar.range_noise = lidar.dropout = 0;
    for (const Return& r : scan(scene, lidar, agent, 0).returns) hits[r.triangle].push_back(r.in_world);
  }
  for (std::size_t i = 0; i < triangles.size(); ++i)
    collector.add(points[triangles[i][0]], points[triangles[i][1]], points[triangles[i][2]], hits[i]);
  return collector.take();
}

}  // namespace vericone::lidar
