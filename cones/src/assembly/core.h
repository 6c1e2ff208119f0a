// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/interval.h>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "assembly/frame.h"

namespace vericone::assembly {

/// A convex piece in the frame, with the points of a hull agent taken off: what has to come within `rounding`
/// of the directions asked about for the piece to be met.
class Core {
 public:
  static Core of_points(const Frame& frame, const Eigen::Vector3d* points, std::size_t count,
                        double radius = 0);
  static Core of_box(const Frame& frame, const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  static Core of_ball(const Frame& frame, const Eigen::Vector3d& center, double radius);
  /// `body` must outlive it.
  static Core of_convex(const Frame& frame, const Convex& body, double radius = 0);

  /// The point of the core with the least n.k; rounded, off by less than error() in place. `on_piece`: the
  /// point of the piece that it comes from.
  Eigen::Vector3d support(const Eigen::Vector3d& n, Eigen::Vector3d& on_piece) const {
    on_piece = piece_support(n);
    const bool at_end = along_ && n.dot(*along_) > 0;
    const Eigen::Vector3d apex = at_end ? Eigen::Vector3d(offset + *along_) : offset;
    if (frame_->round()) return on_piece - apex;
    return on_piece - frame_->support(n) - apex;
  }

  /// From now on about a stretch of the agent's way, metres, not a place: all that comes within rounding of
  /// the apex on it.
  void stretch(const std::array<Interval, 3>& start, const std::array<Interval, 3>& end);
  /// From the nearest place of the stretch to the core's middle, or any vector; not zero.
  Eigen::Vector3d away() const;

  const Eigen::Vector3d& center() const { return center_; }
  /// Of every computed point of the core.
  double error() const { return error_; }
  /// Largest |k| over the core and what rounds it, at most.
  double reach() const { return reach_; }
  /// A body is met where the core comes nearer than `inner_rounding`, and not where it stays farther than
  /// `outer_rounding`.
  double inner_rounding() const { return inner_rounding_; }
  double outer_rounding() const { return outer_rounding_; }
  /// By which the piece itself is rounded beyond support(), m; 0 where the frame is not space.
  double own_radius() const { return own_radius_; }

  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // where the apex is: t d for a moving agent

 private:
  enum class Kind { points, box, ball, convex };
  Core(const Frame& frame, Kind kind) : frame_(&frame), kind_(kind) {}
  void finish(double size_in_space);
  Eigen::Vector3d piece_support(const Eigen::Vector3d& n) const;
  Eigen::Vector3d convex_support(const Eigen::Vector3d& n) const;

  const Frame* frame_;
  Kind kind_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  static constexpr std::size_t kFew = 8;
  Eigen::Vector3d few_[kFew];              // the points, mapped; a box: its three half edges
  std::optional<Eigen::Vector3d> along_;   // to the end of a stretch, in the frame
  const Eigen::Vector3d* many_ = nullptr;  // hulls of more points, not mapped
  std::size_t count_ = 0;
  const Convex* convex_ = nullptr;
  double radius_ = 0;  // of a ball in space that is an ellipsoid in the frame
  double own_radius_ = 0;
  double error_ = 0, reach_ = 0, inner_rounding_ = 0, outer_rounding_ = 0;
};

}  // namespace vericone::assembly
