// SPDX-License-Identifier: BSD-3-Clause
//
// A body at an instant, as guidance sees it.
#pragma once

#include <vericone/geometry/world_body.h>
#include <Eigen/Core>
#include <cstdint>

namespace vericone::guidance {

/// Whether a body's orientation follows its velocity.
enum class Turning : std::uint8_t {
  none,          // as omega says, whatever it commands
  with_heading,  // omega = v x a / |v|^2 for its own acceleration a (a body without roll)
};

struct BodyState {
  WorldBody shape;  // its centre is `position`; of hulls, the reference point
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s
  Eigen::Vector3d omega =
      Eigen::Vector3d::Zero();  // rad/s; of a body that turns with its heading, beyond that
  Turning turning = Turning::none;
  BodyRate rate;

  [[nodiscard]] bool planar() const { return shape.planar(); }
};

/// Throws InputError naming "position", "velocity" or "omega" where a number is not finite, and "shape" where
/// an ellipse, an ellipsoid, a combined or a placed body is not at `position`, to 1e-6 of the distance from
/// the origin. Laws do not look: one that is asked of a body in two places answers for both.
void check(const BodyState& body);

}  // namespace vericone::guidance
