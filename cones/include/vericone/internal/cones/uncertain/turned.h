// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies around and within one that is turned by a bounded angle.
#pragma once

#include <vericone/cones/uncertain/robust.h>

namespace vericone {

/// An ellipsoid around the body however it is turned about its centre by at most `angle` (rad), and one
/// within: S +- sin(angle) (a^2 - c^2) I with the largest and least semi-axis, rounded outwards and inwards.
/// Throw InputError naming "angle".
[[nodiscard]] Ellipsoid around_turned(const Ellipsoid& body, double angle);

[[nodiscard]] Ellipsoid within_turned(const Ellipsoid& body, double angle);

}  // namespace vericone
