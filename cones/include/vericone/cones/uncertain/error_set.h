// SPDX-License-Identifier: BSD-3-Clause
//
// Bounded errors of a vector: a convex set about zero, of which all that is asked is how far it reaches.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace vericone {

/// All errors that may be: a sum of a ball, ellipsoids and segments about 0, so with e it holds -e. Metres
/// for positions, m/s for velocities. Copies of balls do not allocate.
class ErrorSet {
 public:
  /// No error: 0 alone.
  ErrorSet() = default;

  /// |e| <= radius. Throws InputError naming "ball" where it is negative or not finite.
  [[nodiscard]] static ErrorSet ball(double radius);

  /// Semi-axes (positive) along the columns of `rotation`. Throws InputError naming "semi_axes[i]" or
  /// "rotation".
  [[nodiscard]] static ErrorSet ellipsoid(const Eigen::Vector3d& semi_axes,
                                          const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity());

  /// |e_i| <= half(i), along the world's axes; may be flat. Throws InputError naming "box[i]".
  [[nodiscard]] static ErrorSet box(const Eigen::Vector3d& half);

  /// The sums of s_i g_i with |s_i| <= 1. Throws InputError naming "zonotope[i]" where a generator is not
  /// finite.
  [[nodiscard]] static ErrorSet zonotope(std::span<const Eigen::Vector3d> generators);

  /// The sums of the errors of a ball, of ellipsoids { F u : |u| <= 1 } and of segments { s g : |s| <= 1 }: a
  /// set of what radius(), factors() and segments() say. Throws InputError naming "ball", "factors[i]" or
  /// "zonotope[i]" where a number is not finite, or the radius negative.
  [[nodiscard]] static ErrorSet sum(double radius, std::vector<Eigen::Matrix3d> factors,
                                    std::vector<Eigen::Vector3d> segments);

  /// Every sum of an error of one and one of the other.
  friend ErrorSet operator+(ErrorSet x, const ErrorSet& y);

  /// Whether 0 is the only error.
  [[nodiscard]] bool none() const { return !(radius_ > 0) && factors_.empty() && segments_.empty(); }

  /// Support function max n.e, and an e at which it is reached; rounded. No allocation.
  [[nodiscard]] double support(const Eigen::Vector3d& n) const;
  [[nodiscard]] Eigen::Vector3d support_point(const Eigen::Vector3d& n) const;

  /// No error is longer, rounding aside.
  [[nodiscard]] double reach() const;

  // What it is the sum of: { F u : |u| <= 1 } and { s g : |s| <= 1 }.
  [[nodiscard]] double radius() const { return radius_; }
  [[nodiscard]] const std::vector<Eigen::Matrix3d>& factors() const { return factors_; }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& segments() const { return segments_; }

 private:
  double radius_ = 0;
  std::vector<Eigen::Matrix3d> factors_;
  std::vector<Eigen::Vector3d> segments_;
};

}  // namespace vericone
