// SPDX-License-Identifier: BSD-3-Clause
//
// The convex body that stands for an agent in proofs of passage, in its own frame or as it stands somewhere.
#pragma once

#include <vericone/cones/opening/opening.h>
#include <vericone/simulation/track.h>
#include <Eigen/Core>
#include <vector>

namespace vericone::simulation {

/// An ellipsoid, or the hull of points where there are any.
struct Convex {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // of a hull the mean of its points: a point amid it
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Ones();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // a rotation
  std::vector<Eigen::Vector3d> points;

  [[nodiscard]] bool hull() const { return !points.empty(); }
  [[nodiscard]] double support(const Eigen::Vector3d& n) const;
  [[nodiscard]] Eigen::Vector3d support_point(const Eigen::Vector3d& n) const;
  /// Requires !hull().
  [[nodiscard]] Ellipsoid ellipsoid() const { return Ellipsoid::from_axes(center, semi_axes, axes); }
  /// The largest distance of a point from the origin, rounded up.
  [[nodiscard]] double reach() const;
  [[nodiscard]] Convex posed(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation) const;
  [[nodiscard]] RimDistance rim(const PlacedOpening& opening, const RimQuestion& question) const;
};

/// The convex hull of a body and the same elsewhere: all straight ways between.
struct Chords {
  Convex from, to;

  [[nodiscard]] double support(const Eigen::Vector3d& n) const;
  [[nodiscard]] Eigen::Vector3d support_point(const Eigen::Vector3d& n) const;
  [[nodiscard]] RimDistance rim(const PlacedOpening& opening, const RimQuestion& question) const;
};

/// The body itself where it is an ellipsoid or a hull, else an ellipsoid around it: around all that it is
/// during [from, to]. Throws InputError naming "agent" for a body of the plane.
[[nodiscard]] Convex convex_around(const ShapeInTime& shape, double from, double to);

}  // namespace vericone::simulation
