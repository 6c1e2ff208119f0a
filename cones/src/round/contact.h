// SPDX-License-Identifier: BSD-3-Clause
//
// First contact of two convex bodies whose cone a velocity is surely in: the least t with t w in K. And by
// the same search whether there is a contact in a stretch of time at all.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "round/scene.h"

namespace vericone {

/// Times in multiples of the velocity given, lengths in metres.
struct RoundContact {
  double earliest = 0, latest = 0;  // proved: a plane has K ahead before, a point of K is met at
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // unit, from the agent towards the obstacle
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    // of the obstacle, rounded
};

/// By the simplex method on the shadow of K: three points of K around the line of w bound the time from
/// above, the plane through them, moved to K, from below, and its point of K is the next. Nothing where the
/// two do not come together within rounding soon. `w`: of ordinary size, the line of it meets K ahead.
std::optional<RoundContact> round_contact(const RoundScene& scene, const Eigen::Vector3d& w) noexcept;

/// Where the origin lies to all that K is while the agent goes straight from one displacement to another.
struct RoundMeeting {
  std::optional<bool> inside = {};  // in its interior, or outside of it; nothing where that is not certain
  // Where outside:
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // n.x > 0 on all of it
  double part = 0;                                   // of the way, about where the plane comes to touch it
  bool touching = false;                             // it nearly does
};

/// By the search of first contacts, along the line from the origin to a point amid it. Displacements: metres,
/// off by two roundings at most. `plane`: goes on until one that parts them touches it, nearly, if that is
/// near.
RoundMeeting round_meeting(const RoundScene& scene, const Eigen::Vector3d& first, const Eigen::Vector3d& last,
                           bool plane) noexcept;

/// Whether some t w is in the interior of K, from <= t <= until, or none is in K; nothing where that is not
/// certain. `w`: off by one rounding.
std::optional<bool> round_within(const RoundScene& scene, const Eigen::Vector3d& w, double from,
                                 double until) noexcept;

}  // namespace vericone
