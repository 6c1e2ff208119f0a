// SPDX-License-Identifier: BSD-3-Clause
#include "glb/hull_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace vericone::glb {
namespace {

using Eigen::Vector3d;

struct Face {
  std::array<std::uint32_t, 3> corners;
  Vector3d normal;  // unit, outward
  double offset;
};

std::size_t farthest(const std::vector<Vector3d>& points, const Vector3d& n) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (n.dot(points[i]) > n.dot(points[best])) best = i;
  return best;
}

/// In the order of the points.
std::vector<Vector3d> outer_points(const std::vector<Vector3d>& points) {
  constexpr int kRings = 48;
  std::vector<std::size_t> chosen;
  for (int i = 0; i <= kRings; ++i)
    for (int j = 0; j < 2 * kRings; ++j) {
      const double polar = std::numbers::pi * i / kRings, azimuth = std::numbers::pi * j / kRings;
      chosen.push_back(farthest(points, {std::sin(polar) * std::cos(azimuth),
                                         std::sin(polar) * std::sin(azimuth), std::cos(polar)}));
    }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::vector<Vector3d> outer;
  for (const std::size_t i : chosen) outer.push_back(points[i]);
  return outer;
}

/// The polygon of points in a plane with this normal, as a fan.
Drawn flat_hull(std::vector<Vector3d> points, const Vector3d& normal) {
  const Vector3d e = normal.unitOrthogonal(), f = normal.cross(e);
  const auto key = [&](const Vector3d& x) { return std::pair(e.dot(x), f.dot(x)); };
  std::sort(points.begin(), points.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  std::vector<Vector3d> polygon;  // Andrew's monotone chain
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = polygon.size();
    for (const Vector3d& x : points) {
      while (polygon.size() >= base + 2 &&
             normal.dot((polygon.back() - polygon[polygon.size() - 2]).cross(x - polygon.back())) <= 0)
        polygon.pop_back();
      polygon.push_back(x);
    }
    polygon.pop_back();
    std::reverse(points.begin(), points.end());
  }
  Drawn drawn{std::move(polygon), {}};
  for (std::uint32_t i = 1; i + 1 < drawn.points.size(); ++i) drawn.triangles.push_back({0, i, i + 1});
  return drawn;
}

class Hull {
 public:
  /// `start`: four points that are not in a plane.
  Hull(const std::vector<Vector3d>& points, const std::array<std::uint32_t, 4>& start, double least)
      : points_(points), least_(least) {
    for (const std::uint32_t i : start) inner_ += points[i] / 4;
    for (std::size_t k = 0; k < 4; ++k) add(start[k], start[(k + 1) % 4], start[(k + 2) % 4]);
    for (std::uint32_t i = 0; i < points.size(); ++i) take(i);
  }

  [[nodiscard]] Drawn drawn() const {
    Drawn drawn;
    std::map<std::uint32_t, std::uint32_t> index;
    for (const Face& face : faces_) {
      auto& triangle = drawn.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [it, is_new] =
            index.try_emplace(face.corners[k], static_cast<std::uint32_t>(drawn.points.size()));
        if (is_new) drawn.points.push_back(points_[face.corners[k]]);
        triangle[k] = it->second;
      }
    }
    return drawn;
  }

 private:
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    Vector3d n = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    n.stableNormalize();
    if (n.dot(points_[a] - inner_) < 0) {
      n = -n;
      std::swap(b, c);
    }
    faces_.push_back({{a, b, c}, n, n.dot(points_[a])});
  }

  /// The faces that the point sees give way to those from their rim to it.
  void take(std::uint32_t i) {
    std::vector<Face> kept;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Face& face : faces_) {
      if (face.normal.dot(points_[i]) - face.offset <= least_) {
        kept.push_back(face);
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = face.corners[k], b = face.corners[(k + 1) % 3];
        if (const auto back = edges.find({b, a}); back != edges.end())
          edges.erase(back);
        else
          edges[{a, b}] = 1;
      }
    }
    faces_ = std::move(kept);
    for (const auto& [edge, count] : edges) add(edge.first, edge.second, i);
  }

  const std::vector<Vector3d>& points_;
  double least_;
  Vector3d inner_ = Vector3d::Zero();
  std::vector<Face> faces_;
};

}  // namespace

Drawn hull_surface(const std::vector<Vector3d>& all) {
  constexpr std::size_t kMost = 2000;
  const std::vector<Vector3d> points = all.size() > kMost ? outer_points(all) : all;
  const std::size_t a = farthest(points, -Vector3d::UnitX());
  const auto most = [&](auto measure) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (measure(points[i]) > measure(points[best])) best = i;
    return best;
  };
  const std::size_t b = most([&](const Vector3d& x) { return (x - points[a]).norm(); });
  const Vector3d along = points[b] - points[a];
  const double size = along.norm(), least = 1e-11 * size;
  if (size == 0) return {{points[a]}, {}};
  const std::size_t c = most([&](const Vector3d& x) { return along.cross(x - points[a]).norm(); });
  Vector3d normal = along.cross(points[c] - points[a]);
  if (normal.norm() <= least * size) return {{points[a], points[b]}, {}, true};
  normal.normalize();
  const std::size_t d = most([&](const Vector3d& x) { return std::abs(normal.dot(x - points[a])); });
  if (std::abs(normal.dot(points[d] - points[a])) <= least) return flat_hull(points, normal);
  return Hull(points,
              {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c),
               static_cast<std::uint32_t>(d)},
              least)
      .drawn();
}

}  // namespace vericone::glb
