// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/geometry/ellipsoid.h>
#include <optional>

namespace vericone {

template <int D>
struct ContactFrame;
struct NearestPlane;
struct Stretch;

/// Of the frame's bodies on A's way from one displacement to another, nearest as the contact function
/// measures; nothing where they meet, to rounding.
std::optional<NearestPlane> nearest_plane(const ContactFrame<3>& frame, const Eigen::Vector3d& start,
                                          const Eigen::Vector3d& end);

namespace exact {

/// Whether two ellipsoids overlap on a stretch (`in`), only touch, or stay apart; however they lie now.
Membership within(const Ellipsoid& a, const Ellipsoid& b, const Stretch& stretch);

}  // namespace exact
}  // namespace vericone
