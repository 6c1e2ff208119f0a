// SPDX-License-Identifier: BSD-3-Clause
//
// How far a convex piece stays from the directions asked about.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

#include "assembly/core.h"
#include "assembly/frame.h"

namespace vericone::assembly {

/// The least |k - d| over points k of the core and d of the cone of directions, by Wolfe's algorithm for the
/// point of least norm in a polytope, with rays among the generators: -d_i are directions in which the
/// polytope extends without end.
struct Gap {
  enum class Answer : std::uint8_t { apart, met, close } answer = Answer::close;

  /// k - d where the search ended, and what it is made of: k a convex combination of points of the core, d
  /// with the weights `along`, >= 0, of the rays. |v| is the least distance, or more.
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d k = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_piece = Eigen::Vector3d::Zero();  // the point of the piece that k comes from
  double along[3] = {0, 0, 0};
  /// The distance is at least this (proved for the body where `apart`); along v where it is positive.
  double least = 0;
};

/// Where to stop.
enum class GapGoal : std::uint8_t {
  decide,  // as soon as the piece is proved to be apart from all directions, or met by some direction
  measure  // when |v| and `least` agree to rounding, or to `relative` of |v|
};

/// `answer`: apart: no direction meets the piece, proved; met: the direction of `along` meets it, proved;
/// close: neither could be proved. `first`: a normal to begin with, not zero. Ends after at most 64 steps.
Gap gap(const Core& core, const Directions& directions, const Eigen::Vector3d& first,
        GapGoal goal = GapGoal::decide, double relative = 0,
        double enough = std::numeric_limits<double>::infinity());

}  // namespace vericone::assembly
