// SPDX-License-Identifier: BSD-3-Clause
//
// Bounded errors of a vector: a convex set about zero, of which all that is asked is how far it reaches.
#pragma once

#include <vericone/cones/pair.h>
#include <vericone/geometry/ellipsoid.h>
#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
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

// Collision cones under bounded errors: whether all errors collide, none does, or it depends on the error.
// Proofs: docs/explanation/robust-cone.md.

/// What is known: the true p_B - p_A is that given and an error of `position`, the true v_A - v_B that given
/// and an error of `velocity`, whatever the other is. InputError naming "horizon" (not positive), or
/// "acceleration", "attitude_a", "attitude_b", "size" (negative, not finite).
struct RelativeErrors {
  ErrorSet position;                                         // m
  ErrorSet velocity;                                         // m/s
  double horizon = std::numeric_limits<double>::infinity();  // s; later contacts do not count
  double acceleration =
      0;  // m/s^2, of the relative motion, in any direction at any time; needs a finite horizon
  double attitude_a = 0, attitude_b = 0;  // rad: each body may be turned by that much about any axis
  double size = 0;  // m: no point of a body is further from where it is thought, both bodies together
};

enum class RobustVerdict : std::uint8_t {
  out,        // no error collides within the horizon
  in,         // every one does
  depends,    // one does, and another does not
  undecided,  // none of them could be proved, see robust_verdict
};
[[nodiscard]] const char* to_string(RobustVerdict verdict);

struct RelativeError {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m, of p_B - p_A
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of v_A - v_B
};

/// `in` and `out` are proved, and so are both errors of `depends`: they lie in their sets, exactly as the
/// doubles that they are, and the exact predicates say of them what is said here.
struct RobustAnswer {
  RobustVerdict verdict = RobustVerdict::undecided;
  /// `out`: unit, from A towards B. For all errors the gap along it stays open:
  ///   n.c - h_A(n) - h_B(-n) - h_P(n) > max(0, T (n.w + h_W(n)))
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /// `depends`: one that collides and one that passes, with attitudes as given and without acceleration. With
  /// errors of size a body may be moved whole by as much, and positions are off by up to `size` more.
  RelativeError collides, passes;
  /// Parts of the sphere of normals that were looked at for `in` and `depends`.
  int cells = 0;
};

/// Two ellipsoids, v_a and v_b in m/s. Never wrong. `undecided` are, with errors of position, velocity and
/// size, grazes too fine for doubles (3 of 100,000 in docs/measured/robust-cone.md); with errors of attitude
/// or accelerations also what lies between the bounds that stand for them, or depends on them alone: of 2,000
/// engagements 14 % with 0.3 rad, 12 % with 1 m/s^2 for 2 s. Without any error the exact predicates decide
/// (`undecided` only where the contact is as late as the horizon, to rounding), and `normal` may prove `out`
/// but for rounding. No allocation without errors of attitude or size, no throw but of RelativeErrors, and
/// InputError naming "agent_velocity[i]" or "obstacle_velocity[i]". Cost: 1 to 5 us
/// (docs/measured/robust-cone.md); grazes up to 2 ms, four times as much with accelerations.
[[nodiscard]] RobustAnswer robust_verdict(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& v_a,
                                          const Eigen::Vector3d& v_b, const RelativeErrors& errors);

/// Bodies of any kind. Ellipsoids as above; hulls, and assemblies and unions of one convex piece, by their
/// points. Of all others the convex hull is what must be `out` (a combined body counts by the ellipsoid that
/// delimits it), errors of `depends` are decided by the pair, and `in` is not proved: `undecided`. Without
/// any error the pair's own verdict is the answer, with `normal` 0 where no plane separates the hulls. Bodies
/// of more than 1e6 points are refused, InputError naming "body". Allocates; linear in the points.
[[nodiscard]] RobustAnswer robust_verdict(const Pair& pair, const Eigen::Vector3d& v_a,
                                          const Eigen::Vector3d& v_b, const RelativeErrors& errors);

/// The clearance of all errors, metres: the largest, over unit n with n.w + h_W(n) = 0, of
/// n.c - h_A(n) - h_B(-n) - h_P(n). Where it is positive and `time` is too, no error comes nearer, and one
/// comes as near. Where it is negative some error collides or did. Without errors it is m(w) of clearance.h.
struct RobustClearance {
  double distance = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // the maximiser
  double time = 0;  // s, the multiplier of n.w + h_W(n): when the error that comes nearest passes

  [[nodiscard]] Eigen::Vector3d gradient_center() const { return normal; }
  [[nodiscard]] Eigen::Vector3d gradient_velocity() const { return -time * normal; }
};

/// Rounded, not proved. Nothing where errors may be as large as the relative velocity w = v_A - v_B along it:
/// no normal keeps its gap then. No allocation. Cost: 2 to 5 us (docs/measured/robust-cone.md).
[[nodiscard]] std::optional<RobustClearance> robust_clearance(const Ellipsoid& a, const Ellipsoid& b,
                                                              const Eigen::Vector3d& w,
                                                              const ErrorSet& position,
                                                              const ErrorSet& velocity);

}  // namespace vericone
