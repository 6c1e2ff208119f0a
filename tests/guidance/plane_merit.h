// SPDX-License-Identifier: BSD-3-Clause
//
// What the choices of a plane make least, from the sectors themselves.
#pragma once

#include <vericone/cones/slices/slice_cone.h>
#include <vericone/guidance/plane_view.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <vericone/internal/cones/slices/slice_sector.h>
#include <cmath>
#include <numbers>

namespace vericone::testing {

inline const Ellipsoid& ellipsoid_of(const guidance::BodyState& body) {
  return body.shape.quadric()->ellipsoid();
}

inline Eigen::Vector3d line_of_sight(const guidance::BodyState& a, const guidance::BodyState& b) {
  return (b.position - a.position).normalized();
}

/// What a choice makes least on the plane of `e`, from the sectors themselves.
inline double merit(const guidance::BodyState& a, const guidance::BodyState& b, guidance::SectorMethod method,
                    const guidance::PlaneOptions& options, const Eigen::Vector3d& e) {
  const Eigen::Vector3d u = line_of_sight(a, b), w = a.velocity - b.velocity;
  double left, right;
  if (method == guidance::SectorMethod::true_cone) {
    const PlaneSector s = true_sector(ellipsoid_of(a), ellipsoid_of(b), e);
    left = s.left.angle, right = s.right.angle;
  } else {
    const Slice s = slice_sector(ellipsoid_of(a), ellipsoid_of(b), e);
    left = s.left, right = s.right;
  }
  if (options.choice == guidance::PlaneChoice::largest_opening) return -(left + right);
  if (options.choice == guidance::PlaneChoice::least_y) {
    // (5.1): sin^2 of the angle from the bisector less that of half the opening.
    const double angle = std::atan2(-w.dot(e), -w.dot(u)) - 0.5 * (left - right);
    return std::pow(std::sin(angle), 2) - std::pow(std::sin(0.5 * (left + right)), 2);
  }
  const auto angle_to = [&](const Eigen::Vector3d& d) { return std::atan2(w.cross(d).norm(), w.dot(d)); };
  const double to_left = angle_to(std::cos(left) * u + std::sin(left) * e),
               to_right = angle_to(std::cos(right) * u - std::sin(right) * e);
  const double turn = std::min(to_left, to_right);
  if (options.choice == guidance::PlaneChoice::least_turn) return turn;
  // The acceleration of A, across its velocity, that turns w in this plane towards that edge.
  const Eigen::Vector3d n = u.cross(e), flat = a.velocity - a.velocity.dot(n) * n;
  Eigen::Vector3d push = n.cross(flat).normalized();
  const Eigen::Vector3d towards = to_left <= to_right ? n.cross(w) : -n.cross(w);
  if (push.dot(towards) < 0) push = -push;
  const double along = push.dot(options.wind) / options.wind.norm();
  return along >= -0.5 ? turn : 2 * std::numbers::pi - along;
}

}  // namespace vericone::testing
