// SPDX-License-Identifier: BSD-3-Clause
#include "solids/small_box.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

double turn_of_three(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Counter-clockwise (Andrew).
std::vector<Vector2d> planar_hull(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  if (points.size() < 3) return points;
  std::vector<Vector2d> hull;
  const auto add = [&](const Vector2d& x, std::size_t first) {
    while (hull.size() >= first + 2 && turn_of_three(hull[hull.size() - 2], hull.back(), x) <= 0)
      hull.pop_back();
    hull.push_back(x);
  };
  for (const Vector2d& x : points) add(x, 0);
  const std::size_t upper = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], upper);
  hull.pop_back();
  return hull;
}

struct Stretches {
  Vector3d low = Vector3d::Constant(1e300), high = Vector3d::Constant(-1e300);
  void add(const Vector3d& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
};

Box3 box_of_axes(const std::vector<Vector3d>& points, const Matrix3d& axes) {
  Stretches along;
  for (const Vector3d& x : points) along.add(axes.transpose() * x);
  constexpr double kThinPart = 1e-6;
  const Vector3d edges = along.high - along.low;
  const Vector3d thick = edges.array() + kThinPart * edges.maxCoeff();
  return {axes * (0.5 * (along.low + along.high)), 0.5 * edges, axes, thick.prod()};
}

/// The least with the axis z.
Box3 about_axis(const std::vector<Vector3d>& points, const Vector3d& z) {
  const Matrix3d frame = frame_about(z);
  std::vector<Vector2d> shadow;
  for (const Vector3d& x : points) shadow.push_back((frame.transpose() * x).head<2>());
  const std::vector<Vector2d> hull = planar_hull(std::move(shadow));
  double least = 1e300;
  Vector2d along(1, 0);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    if (!(edge.norm() > 0)) continue;
    const Vector2d u = edge.normalized(), v(-u.y(), u.x());
    double low = 1e300, high = -1e300, deep = 0;
    for (const Vector2d& x : hull) {
      low = std::min(low, u.dot(x));
      high = std::max(high, u.dot(x));
      deep = std::max(deep, v.dot(x - hull[i]));
    }
    if ((high - low) * deep >= least) continue;
    least = (high - low) * deep;
    along = u;
  }
  Matrix3d turn = Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << along.x(), -along.y(), along.y(), along.x();
  return box_of_axes(points, frame * turn);
}

}  // namespace

Matrix3d frame_about(const Vector3d& z) {
  Matrix3d frame;
  frame.col(2) = z.normalized();
  frame.col(0) = frame.col(2).unitOrthogonal();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

Box3 small_box(const std::vector<Vector3d>& points, const std::vector<Vector3d>& directions,
               std::size_t followed) {
  constexpr int kMostTurns = 60;
  std::vector<Box3> boxes;
  for (const Vector3d& z : directions) boxes.push_back(about_axis(points, z));
  const auto smaller = [](const Box3& a, const Box3& b) { return a.volume < b.volume; };
  std::stable_sort(boxes.begin(), boxes.end(), smaller);
  if (boxes.size() > followed) boxes.resize(followed);
  for (Box3& box : boxes)
    for (int turn = 0, idle = 0; turn < kMostTurns && idle < 3; ++turn) {
      const Box3 next = about_axis(points, box.axes.col(turn % 3));
      idle = next.volume < box.volume * (1 - 1e-9) ? 0 : idle + 1;
      if (smaller(next, box)) box = next;
    }
  return *std::min_element(boxes.begin(), boxes.end(), smaller);
}

}  // namespace vericone::fitting
