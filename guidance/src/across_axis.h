// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/cones/cone_geometry.h>
#include <Eigen/Core>

namespace vericone::guidance {

/// The part of `v` across the unit vector `u`, unit; where there is none, some axis that `u` alone decides.
inline Eigen::Vector3d across_axis(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  Eigen::Vector3d rest = v - v.dot(u) * u;
  if (!(rest.norm() > 1e-12 * v.norm())) return AxisFrame(u).e1;
  rest.normalize();
  // Twice: what is left of a vector nearly along u is not perpendicular to it yet.
  return (rest - rest.dot(u) * u).normalized();
}

}  // namespace vericone::guidance
