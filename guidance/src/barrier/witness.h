// SPDX-License-Identifier: BSD-3-Clause
//
// Where two convex bodies are nearest, once the normal is known: of an ellipsoid one point is extreme along
// it, of a hull the corners of a face, of a disc seen along its axis the rim. Those places of the faces, and
// the time, that lie on one normal.
#pragma once

#include <vericone/geometry/body.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace vericone::guidance::barriers {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Where a body of flat, round and straight parts is farthest along its own unit vector n, to `slack` metres.
/// A rim is a polygon of points on it.
inline std::vector<Vector3d> extreme(const vericone::Convex& body, const Vector3d& n, double slack) {
  constexpr int kAround = 48;
  const double least = body.support(n) - body.margin() - slack;
  std::vector<Vector3d> found;
  for (const vericone::Convex::Piece& piece : body.pieces()) {
    const Vector3d u = piece.factor.transpose() * n, center = piece.center + body.margin() * n;
    const double radius = u.norm(), value = n.dot(piece.center);
    if (!(value + radius >= least)) continue;
    if (piece.rank == 2 && value - radius >= least) {
      for (int k = 0; k < kAround; ++k) {
        const double angle = 2 * std::numbers::pi * k / kAround;
        found.push_back(center + piece.factor * Vector3d(std::cos(angle), std::sin(angle), 0));
      }
    } else {
      found.push_back(radius > 0 ? Vector3d(center + piece.factor * (u / radius)) : center);
    }
  }
  return found;
}

/// Points whose hull is where a convex body is farthest along a unit vector n, less the body's position.
/// `slack`: of the body's size.
inline std::vector<Vector3d> extreme(const Placed& body, const Vector3d& n, double slack) {
  const Vector3d own = body.pose.rotation.transpose() * n;
  if (const auto* one = body.body.quadric())
    return {body.pose.rotation * one->ellipsoid().support_point(own)};
  const Box bounds = body.body.bounds();
  const double room = slack * (bounds.high - bounds.low).norm();
  std::vector<Vector3d> found;
  if (const auto* convex = body.body.convex()) {
    for (const Vector3d& x : extreme(*convex, own, room)) found.push_back(body.pose.rotation * x);
    return found;
  }
  const double least = body.body.support(own) - room;
  for (const Vector3d& x : body.body.hull()->points())
    if (own.dot(x) >= least) found.push_back(body.pose.rotation * x);
  return found;
}

/// A point of the agent (m from its position), a time, and what is then between it and one of the obstacle.
struct Corner {
  Vector3d on_agent = Vector3d::Zero();
  double time = 0;
  Vector3d between = Vector3d::Zero();
  Vector2d across = Vector2d::Zero();  // `between` without its part along n
  double weight = 0;
};

/// At most three corners in the plane: leaves those whose hull has the point nearest to the origin on it,
/// with their weights there, and returns that point.
inline Vector2d reduce(std::vector<Corner>& corners) {
  const auto cross = [](const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  std::vector<Corner> best;
  Vector2d nearest = Vector2d::Constant(std::numeric_limits<double>::infinity());
  const auto consider = [&](std::vector<Corner> some) {
    Vector2d at = Vector2d::Zero();
    for (const Corner& x : some) {
      if (!(x.weight > 0)) return;
      at += x.weight * x.across;
    }
    if (!best.empty() && !(at.squaredNorm() < nearest.squaredNorm())) return;
    nearest = at;
    best = std::move(some);
  };
  const auto weighed = [](Corner x, double weight) {
    x.weight = weight;
    return x;
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& a = corners[i];
    consider({weighed(a, 1)});
    for (std::size_t k = 0; k < i; ++k) {
      const Corner& b = corners[k];
      const Vector2d way = b.across - a.across;
      const double part = -a.across.dot(way) / way.squaredNorm();
      consider({weighed(a, 1 - part), weighed(b, part)});
    }
  }
  if (corners.size() == 3) {
    const Vector2d &a = corners[0].across, &b = corners[1].across, &c = corners[2].across;
    const double of_a = cross(b, c), of_b = cross(c, a), of_c = cross(a, b), all = of_a + of_b + of_c;
    consider(
        {weighed(corners[0], of_a / all), weighed(corners[1], of_b / all), weighed(corners[2], of_c / all)});
  }
  corners = std::move(best);
  return nearest;
}

/// The corners, weights adding to 1, of the place where they are nearest; w is the relative velocity, and the
/// time one between two.
inline std::vector<Corner> witnesses(const Placed& agent, const Placed& obstacle, const Vector3d& n,
                                     double slack, const Vector3d& w, double earliest, double latest) {
  const Vector3d c = obstacle.pose.position - agent.pose.position, e = n.unitOrthogonal(), f = n.cross(e);
  const auto on_obstacle = extreme(obstacle, -n, slack);
  std::vector<Corner> all;
  for (const Vector3d& a : extreme(agent, n, slack))
    for (const Vector3d& b : on_obstacle)
      for (const double t : {earliest, latest}) {
        const Vector3d between = c + b - a - t * w;
        all.push_back({a, t, between, {e.dot(between), f.dot(between)}});
        if (earliest == latest) break;
      }
  // From the nearest corner, always the one that is farthest the other way (Gilbert, Johnson and Keerthi).
  const auto size = [](const Corner& x) { return x.across.squaredNorm(); };
  std::vector<Corner> some{
      *std::min_element(all.begin(), all.end(), [&](auto& x, auto& y) { return size(x) < size(y); })};
  constexpr int kMostSteps = 100;
  for (int step = 0; step < kMostSteps; ++step) {
    const Vector2d at = reduce(some);
    const Corner& next = *std::min_element(
        all.begin(), all.end(), [&](auto& x, auto& y) { return x.across.dot(at) < y.across.dot(at); });
    if (some.size() == 3 || !(at.dot(at - next.across) > 1e-14 * (size(next) + at.squaredNorm()))) break;
    some.push_back(next);
  }
  return some;
}

}  // namespace vericone::guidance::barriers
