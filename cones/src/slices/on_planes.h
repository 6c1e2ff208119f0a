// SPDX-License-Identifier: BSD-3-Clause
//
// What the slice cones share: planes at equal angles through an axis, and a plane's sector as a slice.
#pragma once

#include <vericone/cones/planar/sector.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/geometry/error.h>
#include <numbers>
#include <string>

namespace vericone {

/// Throws InputError naming "planes".
inline void require_planes(int planes) {
  if (planes < 1 || planes > 1'000'000)
    throw InputError("planes", std::to_string(planes), "a whole number from 1 to 1000000");
}

/// look(azimuth, across) on each, until it returns false; whether it never did. Asked to stop, throws
/// Interrupted.
template <typename Look>
bool on_planes(const AxisFrame& frame, int planes, const Look& look) {
  for (int j = 0; j < planes; ++j) {
    checkpoint();
    const double azimuth = std::numbers::pi * j / planes;
    if (!look(azimuth, frame.across(azimuth))) return false;
  }
  return true;
}

/// Of a sector about the plane's x axis, the line of sight.
inline Slice slice_of(double azimuth, const Sector& sector) {
  return {azimuth, 0.5 * sector.psi + sector.theta_b, 0.5 * sector.psi - sector.theta_b};
}

}  // namespace vericone
