// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace vericone {

/// v_a - v_b, divided by 2^exponent where it is too long for doubles.
struct VelocityDifference {
  static constexpr double kFast = 0x1p1020;  // beyond, the length of a velocity may leave the doubles

  Eigen::Vector3d w;
  int exponent = 0;

  VelocityDifference(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) : w(v_a - v_b) {
    if (w.cwiseAbs().maxCoeff() < kFast) return;
    exponent = 3;
    w = 0.125 * v_a - 0.125 * v_b;
  }
};

}  // namespace vericone
