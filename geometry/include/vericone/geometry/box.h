// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace vericone {

/// An axis-aligned solid box between two opposite corners, low <= high in each coordinate; metres. Flat ones
/// and points are boxes too.
struct Box {
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d center() const { return 0.5 * (low + high); }
  [[nodiscard]] Eigen::Vector3d half_widths() const { return 0.5 * (high - low); }
  [[nodiscard]] bool contains(const Eigen::Vector3d& x) const {
    return (low.array() <= x.array()).all() && (x.array() <= high.array()).all();
  }
  void include(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
};

}  // namespace vericone
