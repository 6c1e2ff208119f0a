// SPDX-License-Identifier: BSD-3-Clause
//
// Nearest points of quadrics in their principal axes, with the multiplier: for fits, millions of them.
#pragma once

#include <Eigen/Core>

namespace vericone::fitting {

struct SecularFoot {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double multiplier = 0;  // t of y - z = t diag(l) z
  double distance = 0;    // |y - z|, with the sign of the quadric's value at y
};

/// The point z of { z : sum l_i z_i^2 = 1 } nearest to y. `l` increasing, the last positive; zero for the
/// axis of a cylinder. Where several are equally near, that on the positive side. Absolute error some
/// roundings of the largest coordinate.
SecularFoot secular_foot(const Eigen::Vector3d& l, const Eigen::Vector3d& y);

}  // namespace vericone::fitting
