// SPDX-License-Identifier: BSD-3-Clause
//
// An opening at an instant, as guidance sees it.
#pragma once

#include <vericone/cones/opening/opening.h>
#include <Eigen/Core>

namespace vericone::guidance {

/// It moves with a constant velocity and turns about its centre at a constant rate.
struct OrificeState {
  PlacedOpening opening;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      // rad/s, in world axes

  /// `seconds` later.
  [[nodiscard]] OrificeState after(double seconds) const;
};

}  // namespace vericone::guidance
