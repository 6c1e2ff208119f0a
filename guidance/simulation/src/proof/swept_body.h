// SPDX-License-Identifier: BSD-3-Clause
//
// What a body is during a piece of time, about its centre: all its shapes at one orientation, and the angle
// by which it may be turned from that.
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/geometry/hull_body.h>
#include <vericone/simulation/track.h>
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace vericone::simulation {

class SweptBody {
 public:
  /// All shapes of [from, to] at `rotation`; `angle` rad or less from it. Planar bodies stand in space as
  /// bodies whose sections by z = 0 they are.
  SweptBody(const ShapeInTime& shape, double reach, double from, double to, const Eigen::Matrix3d& rotation,
            double angle);

  bool hull() const { return hull_.has_value(); }
  const HullBody& points() const { return *hull_; }
  const CombinedEllipsoid& body() const { return body_; }
  bool is_ellipsoid() const { return !hull() && body_.is_ellipsoid(); }
  double reach() const { return reach_; }
  double angle() const { return angle_; }
  /// No point of the body moves by more than this while it turns.
  double sway() const;

  /// An upper bound of n.x over all points x of the body in all its shapes and orientations, |n| = 1: proved,
  /// with what the sums can round.
  double support(const Eigen::Vector3d& n) const;

  /// No point of the body in any of its shapes is farther from the centre.
  double extent() const;

  /// A point of the body (of its convex hull) farthest along n, at the middle orientation, rounded.
  Eigen::Vector3d support_point(const Eigen::Vector3d& n) const;

  /// An ellipsoid about the centre that contains the body at the middle orientation and has nearly its
  /// support along n; rounded.
  Ellipsoid around(const Eigen::Vector3d& n) const;

 private:
  // With the ellipsoid as the unit ball, |u|^2 <= 1 and u^T A_i u <= level_i, so for lambda >= 0 the body is
  // in the ellipsoid u^T M u <= level with M = I + sum lambda_i A_i, level = 1 + sum lambda_i level_i.
  struct Multipliers {
    Eigen::Matrix3d inverse;  // of M
    double level;
  };
  struct Seen {  // A_i
    Eigen::Matrix3d matrix, directions;
    Eigen::Vector3d values;
    double level;
  };
  /// The least of these ellipsoids along n, nearly.
  Multipliers multipliers(const Eigen::Vector3d& n) const;
  Multipliers of_one(const Eigen::Vector3d& m) const;
  Multipliers of_several(const Eigen::Vector3d& m) const;
  double turned(double squared, double across, double largest) const;

  CombinedEllipsoid body_;
  std::optional<HullBody> hull_;
  std::vector<Seen> seen_;
  double reach_, angle_;
};

}  // namespace vericone::simulation
