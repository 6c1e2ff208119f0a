// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/error.h>
#include <Eigen/Core>

namespace vericone {

/// The unit vector perpendicular to the unit vector `u` in the plane that it spans with `across`. Throws
/// InputError naming "across" when that is no plane.
inline Eigen::Vector3d second_axis(const Eigen::Vector3d& u, const Eigen::Vector3d& across) {
  Eigen::Vector3d rest = across - across.dot(u) * u;
  if (!across.allFinite() || !(rest.norm() > 1e-12 * across.norm()))
    throw InputError(
        "across", "[" + to_text(across.x()) + ", " + to_text(across.y()) + ", " + to_text(across.z()) + "]",
        "finite and not along the line of centres");
  rest.normalize();
  // Twice: what is left of a vector nearly along u is not perpendicular to it yet.
  return (rest - rest.dot(u) * u).normalized();
}

}  // namespace vericone
