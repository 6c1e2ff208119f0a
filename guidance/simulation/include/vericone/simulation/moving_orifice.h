// SPDX-License-Identifier: BSD-3-Clause
//
// An opening that moves: what agents pass through.
#pragma once

#include <vericone/cones/opening/opening.h>
#include <vericone/guidance/orifice.h>
#include <string>

namespace vericone::simulation {

/// A flat opening with a constant velocity that turns about its centre at a constant rate. At the time t its
/// centre is position + velocity t and its rotation Exp(spin t) rotation; the opening lies in the first two
/// columns of that, and its normal is the third.
struct MovingOrifice {
  std::string name;
  Opening opening = Opening::circle(1);
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();  // at t = 0; m, m/s
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();                                  // at t = 0
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  // rad/s, in world axes
  bool wall = true;  // an infinite thin wall about the opening; false: its rim alone

  [[nodiscard]] guidance::OrificeState at(double t) const;
};

}  // namespace vericone::simulation
