// SPDX-License-Identifier: BSD-3-Clause
//
// Two bodies at one time: whether they meet, by exact or certified predicates.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "proof/separation.h"

namespace vericone::simulation {

enum class Meeting : std::uint8_t {
  apart,    // proved
  meet,     // touching or overlapping, proved
  unknown,  // nearer than the predicate resolves
};

/// The bodies as posed in doubles at that time. Throws InputError naming "bodies" for one of the plane and
/// one of space.
Meeting meeting(const MovingPair& pair, const Moment& moment);

/// Whether a body is not convex, so that planes do not tell all.
bool delimited(const MovingPair& pair, const Moment& moment);

struct Inflation {
  double bound = 0;  // the bodies stay farther apart than this, proved, metres
  /// They come nearer than this at the middle of the piece, as far as inflated bodies tell; infinite: not
  /// asked.
  double gap = std::numeric_limits<double>::infinity();
};

/// For delimited bodies: proves that they stay apart over a whole piece, by inflating one of them by all that
/// both can move, turn and change meanwhile. Nothing where that fails. `padding`: what is added. `measure`:
/// by how much more they can be inflated, to a tenth; ten questions instead of one.
std::optional<Inflation> apart_by_inflation(const MovingPair& pair, const Piece& piece, double padding,
                                            bool measure);

/// The middle between the bodies' faces, edges or points next to a plane between them. `normal` of that
/// plane; zero: along the line of centres.
Eigen::Vector3d place_between(const MovingPair& pair, const Moment& moment, const Eigen::Vector3d& normal);

/// A point near both bodies where they meet, or nearly; also where no plane is between them.
Eigen::Vector3d place_of_meeting(const MovingPair& pair, const Moment& moment, const Eigen::Vector3d& normal);

}  // namespace vericone::simulation
