// SPDX-License-Identifier: BSD-3-Clause
#include "distance/scan_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vericone::fitting {
namespace {

using Eigen::Vector3d;

double squared_to_segment(const Vector3d& x, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a, d = x - a;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp(d.dot(along) / length, 0.0, 1.0) : 0;
  return (d - t * along).squaredNorm();
}

/// Right for triangles without area as well: then no point is over the inside.
double squared_to_triangle(const Vector3d& x, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double size = normal.squaredNorm();
  const auto is_left = [&](const Vector3d& from, const Vector3d& to) {
    return normal.dot((to - from).cross(x - from)) > 0;
  };
  if (size > 0 && is_left(a, b) && is_left(b, c) && is_left(c, a)) {
    const double height = normal.dot(x - a);
    return height * height / size;
  }
  return std::min({squared_to_segment(x, a, b), squared_to_segment(x, b, c), squared_to_segment(x, c, a)});
}

double squared_to_box(const Vector3d& x, const Hierarchy::Node& node) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::max({double(node.low[k]) - x(k), x(k) - double(node.high[k]), 0.0});
    sum += d * d;
  }
  return sum;
}

}  // namespace

ScanDistance::ScanDistance(const Sample& sample) : triangles_(sample.triangles) {
  Vector3d low = sample.points.front(), high = low;
  for (const Vector3d& p : sample.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  origin_ = low + 0.5 * (high - low);
  points_.reserve(sample.points.size());
  for (const Vector3d& p : sample.points) points_.push_back(p - origin_);
  std::vector<Box> boxes;
  if (triangles_.empty()) {
    for (const Vector3d& p : points_) boxes.push_back({p, p});
  } else {
    for (const auto& [a, b, c] : triangles_)
      boxes.push_back({points_[a].cwiseMin(points_[b]).cwiseMin(points_[c]),
                       points_[a].cwiseMax(points_[b]).cwiseMax(points_[c])});
  }
  tree_ = Hierarchy(boxes);
}

double ScanDistance::to_piece(std::uint32_t piece, const Vector3d& x) const {
  if (triangles_.empty()) return (x - points_[piece]).squaredNorm();
  const auto& [a, b, c] = triangles_[piece];
  return squared_to_triangle(x, points_[a], points_[b], points_[c]);
}

double ScanDistance::operator()(const Vector3d& point) const {
  const Vector3d x = point - origin_;
  const auto nodes = tree_.nodes();
  double best = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, std::uint32_t>> open{{squared_to_box(x, nodes[0]), 0}};
  while (!open.empty()) {
    const auto [bound, index] = open.back();
    open.pop_back();
    if (bound >= best) continue;
    const Hierarchy::Node& node = nodes[index];
    if (node.is_leaf()) {
      for (std::uint32_t k = 0; k < node.count; ++k)
        best = std::min(best, to_piece(tree_.order()[node.first + k], x));
      continue;
    }
    std::pair near{squared_to_box(x, nodes[node.first]), node.first};
    std::pair far{squared_to_box(x, nodes[node.first + 1]), node.first + 1};
    if (far.first < near.first) std::swap(near, far);
    open.push_back(far);
    open.push_back(near);
  }
  return std::sqrt(best);
}

}  // namespace vericone::fitting
