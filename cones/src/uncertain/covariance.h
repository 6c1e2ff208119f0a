// SPDX-License-Identifier: BSD-3-Clause
//
// Covariances as people have them: symmetric and positive semidefinite up to rounding.
#pragma once

#include <Eigen/Core>

namespace vericone::gaussian {

/// What may be taken from a covariance, as a part of its largest entry: ten printed digits always do.
constexpr double kClipped = 1e-8;

/// Symmetric and positive semidefinite as it stands, or made so; what that took, as a part of the largest
/// entry. Throws InputError naming `field`, with the asymmetry or the eigenvalue, where it takes more than
/// kClipped.
struct Covariance {
  Eigen::Matrix3d matrix;
  double clipped = 0;

  Covariance(const Eigen::Matrix3d& given, const char* field);
};

/// The same of two covariances and the one between them, in units of both deviations.
struct JointCovariance {
  Eigen::Matrix3d position, velocity, cross;
  double clipped = 0;

  JointCovariance(const Eigen::Matrix3d& of_position, const Eigen::Matrix3d& of_velocity,
                  const Eigen::Matrix3d& between);
};

}  // namespace vericone::gaussian
