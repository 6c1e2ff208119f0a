// SPDX-License-Identifier: BSD-3-Clause
//
// The agent in the coordinates in which questions about assemblies are answered.
#pragma once

#include <vericone/geometry/convex.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/hull_body.h>
#include <vericone/internal/geometry/hierarchy.h>
#include <Eigen/Core>
#include <algorithm>
#include <initializer_list>
#include <limits>
#include <memory>
#include <vector>

#include "round/scene.h"

namespace vericone::assembly {

/// One rounding of a double.
inline constexpr double kUlp = 0x1p-53;

/// Where an agent's own origin stands beside an obstacle's: x_obstacle = (x_agent + agent) - obstacle,
/// metres. The sum is nowhere rounded.
struct Place {
  Eigen::Vector3d agent = Eigen::Vector3d::Zero(), obstacle = Eigen::Vector3d::Zero();
};

/// y = G (x - p). G is any matrix as stored, so nothing depends on how well it inverts the agent's factor:
/// what the agent becomes, E, lies between two balls whose radii are proved. A hull keeps G = 1 and becomes
/// the points a_i - p; so does an ellipsoid where lengths in space are asked for, and any other convex body:
/// its margin then counts as rounding.
///
/// Computed coordinates y of a point x differ from the exact ones by at most error(|x - p|).
class Frame {
 public:
  /// `place`: where the agent's own origin is in the coordinates of x. Throws InputError naming "agent".
  explicit Frame(const Ellipsoid& agent, const Place& place = {});
  explicit Frame(const HullBody& agent, const Place& place = {});
  explicit Frame(const Convex& agent, const Place& place = {});
  /// With G = 1.
  static Frame in_space(const Ellipsoid& agent, const Place& place = {});

  /// p; rounded, see off_origin().
  const Eigen::Vector3d& origin() const { return origin_; }
  const Eigen::Matrix3d& to_frame() const { return to_frame_; }

  /// G = 1.
  bool is_space() const { return is_space_; }

  /// E is nearly a ball about 0.
  bool round() const { return round_; }
  /// Where round(): E is between the balls of these radii; otherwise the margin, which support() leaves out.
  double inner() const { return inner_; }
  double outer() const { return outer_; }

  /// Where not round(): the point of E with the most n.e; rounded.
  Eigen::Vector3d support(const Eigen::Vector3d& n) const;
  /// How far E as support() knows it is from E.
  double support_error() const { return support_error_; }

  /// At least the support max n.e over E; `length`: |n|.
  double extent(const Eigen::Vector3d& n, double length) const {
    if (round_) return outer_ * length;
    if (convex_)
      return convex_->farthest(n).value +
             (support_error_ + outer_ + 16 * kUlp * ball_) * length * (1 + 8 * kUlp);
    if (points_.empty()) return (factor_.transpose() * n).norm() * (1 + 16 * kUlp) + support_error_ * length;
    return std::min(ball_ * length, n.cwiseAbs().dot(reach_)) * (1 + 8 * kUlp);
  }
  /// The same, no more than rounding above it; in the time of a support call.
  double least_extent(const Eigen::Vector3d& n, double length) const {
    if (round_ || convex_ || points_.empty()) return extent(n, length);
    return n.dot(support(n)) + (outer_ + 8 * kUlp * ball_) * length;
  }
  /// Largest |e| over E, at most.
  double ball() const { return ball_; }

  /// In space: the agent is in the box p - reach .. p + reach.
  const Eigen::Vector3d& reach() const { return reach_; }

  /// See above; `size`: |x - p| or more, in space, and for hulls the size of the agent added. Infinite where
  /// squares of lengths leave the range of doubles: then doubles prove nothing, and exact predicates decide.
  double error(double size) const { return 16 * kUlp * norm_ * size + beyond_range_; }
  double beyond_range() const { return beyond_range_; }
  /// At most how far G origin() is from G p, and all of beyond_range(): for those who take x - origin() where
  /// others take relative().
  double off_origin() const { return off_origin_ + beyond_range_; }
  /// What it is compared with may be off by so much more (m).
  void widen(double distance) { off_origin_ += norm_ * distance * (1 + 8 * kUlp); }

  /// To be told how large what it is used for is: |x - p|, at most.
  void check_range(double largest);

  /// Of G, at least.
  double norm() const { return norm_; }

  /// Back from the frame, for what is only reported.
  Eigen::Vector3d to_space(const Eigen::Vector3d& y) const { return origin_ + from_frame_ * y; }

  Eigen::Vector3d relative(const Eigen::Vector3d& x) const { return (x - origin_) - rest_; }

 private:
  /// p = x + place, for a point x of the agent's own frame.
  void set_origin(const Eigen::Vector3d& x, const Place& place);
  Eigen::Vector3d farthest_of_many(const Eigen::Vector3d& n) const;

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero(), reach_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d rest_ = Eigen::Vector3d::Zero();  // of p beside origin_
  Eigen::Matrix3d to_frame_ = Eigen::Matrix3d::Identity(), from_frame_ = Eigen::Matrix3d::Identity();
  bool round_ = false, is_space_ = true;
  double beyond_range_ = 0;  // what origin_ and rest_ are off by, seen in the frame; or infinity
  double off_origin_ = 0;    // what origin_ alone is off by, seen in the frame
  double norm_ = 1;          // of G, Frobenius, rounded up
  double inner_ = 0, outer_ = 0, ball_ = 0, support_error_ = 0;
  std::vector<Eigen::Vector3d> points_;  // of a hull, by slot of the hierarchy where there is one
  Hierarchy hierarchy_;                  // of the points, where they are many
  Eigen::Matrix3d factor_ = Eigen::Matrix3d::Identity();  // of an ellipsoid in space
  std::shared_ptr<const RoundBody> convex_;               // about p, where it is more than points
};

/// The directions asked about: rays from the apex and all between them (none: the apex alone).
struct Directions {
  Eigen::Vector3d ray[3];  // in the frame, unit
  double length[3] = {};   // of the rays as given, in the frame
  int count = 0;
  double error = 0;  // of each ray, as a vector

  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // in the frame, unit
  double least_cosine = 1;  // between it and the rays; spread too far if not positive

  Directions() = default;
  Directions(const Frame& frame, std::initializer_list<Eigen::Vector3d> rays_in_space);

  bool spread_too_far() const { return !(least_cosine > 0.02); }

  /// At most the largest n.d over unit directions d asked about; >= 0. A unit d is a combination of rays with
  /// weights whose sum is at most 1 / least_cosine.
  double slant(const Eigen::Vector3d& unit_normal) const {
    if (count > 1 && spread_too_far()) return std::numeric_limits<double>::infinity();
    double most = 0;
    for (int i = 0; i < count; ++i) most = std::max(most, unit_normal.dot(ray[i]) + error + 8 * kUlp);
    return count > 1 ? 1.01 * most / least_cosine : most;
  }
};

}  // namespace vericone::assembly
