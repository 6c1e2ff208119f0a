// SPDX-License-Identifier: BSD-3-Clause
//
// Volume of an ellipsoid and its delimiters with derivatives: what containing fits minimise.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace vericone::fitting {

/// log volume of { y : y^T A y <= 1, y^T M_i y <= 1 for all i } and its derivatives: d log V = tr(dA G_A) +
/// sum tr(dM_i G_i), with symmetric G.
struct StarVolume {
  double log = 0;
  Eigen::Matrix3d by_ellipsoid = Eigen::Matrix3d::Zero();
  std::vector<Eigen::Matrix3d> by_delimiter;
};

/// V = 1/3 integral over the sphere of max(u^T A u, u^T M_i u)^(-3/2), where A is a unit matrix by a linear
/// map; on half-planes through an axis in closed form, over the half-planes by the trapezoidal rule. One
/// delimiter: right to about 1e-9, 5 us. Several: the rule's error is up to some 1e-4 (its half-planes are
/// fixed, where rims are not), 100 us; the derivatives are exactly those of what is returned. False where A
/// is not positive definite.
bool star_volume(const Eigen::Matrix3d& ellipsoid, std::span<const Eigen::Matrix3d> delimiters,
                 StarVolume& result);

}  // namespace vericone::fitting
