// SPDX-License-Identifier: BSD-3-Clause
//
// First contact of two convex bodies whose cone a velocity is surely in: the least t with t w in K.
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

}  // namespace vericone
