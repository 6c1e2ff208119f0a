// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact of two ellipsoids in motion, found by marching through time.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <optional>

namespace vericone::verify {

/// How near A + shift comes to B, in the coordinates that make B the unit ball about the origin.
struct BallDistance {
  double distance = 0;                                // to the origin; below 1: overlapping
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();  // the nearest point of A
};

/// Ellipsoids A and B prepared for many shifts of A.
///
/// In the coordinates x -> F_B^{-1} (x - p_B) the body B is the unit ball and A an ellipsoid; the point of A
/// nearest to the origin solves the one-dimensional secular equation of the Lagrange multiplier. Double
/// precision; errors of distance are a few eps times the ratio of the longest axis to B's shortest.
class ContactMarch {
 public:
  ContactMarch(const Ellipsoid& a, const Ellipsoid& b);

  [[nodiscard]] BallDistance distance(const Eigen::Vector3d& shift) const;

  /// What an eps of the coordinates of A + shift amounts to in distance(), in units of eps.
  [[nodiscard]] double resolution(const Eigen::Vector3d& shift) const;

  struct Result {
    std::optional<double> time;  // first t >= 0 at which A + t w touches B, seconds; nothing: never
    double closest = 0;          // the least distance seen
    /// How squarely they meet: the part of the speed that goes into the distance, 0 to 1. Where this is near
    /// 0, or where there is no contact and `closest` is near 1, rounding may have decided.
    double closing = 0;
    int steps = 0;
  };

  /// The distance is a convex function of time, so a step to where its tangent reaches 1 never passes the
  /// first contact, and once it no longer falls there is none to come.
  [[nodiscard]] Result first_contact(const Eigen::Vector3d& w) const;

 private:
  Eigen::Matrix3d to_ball_, axes_;    // space to B's ball; columns: axes of A there
  Eigen::Vector3d line_of_centers_;   // from B to A in space
  Eigen::Vector3d center_, squares_;  // centre and squared semi-axes of A there
};

}  // namespace vericone::verify
