// SPDX-License-Identifier: BSD-3-Clause
//
// An opening that moves: what agents pass through.
#pragma once

#include <vericone/cones/opening/opening.h>
#include <vericone/guidance/orifice.h>
#include <string>

namespace vericone::simulation {

/// A flat opening with a constant velocity that turns about its centre at a constant rate. With s = t -
/// appears its centre is position + velocity s and its rotation Exp(spin s) rotation; the opening lies in the
/// first two columns of that, and its normal is the third.
struct MovingOrifice {
  std::string name;
  Opening opening = Opening::circle(1);
  Eigen::Vector3d position = Eigen::Vector3d::Zero(),
                  velocity = Eigen::Vector3d::Zero();      // when it appears; m, m/s
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // the same
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();          // rad/s, in world axes
  double appears = 0;                                      // s: neither passed nor touched before
  bool wall = true;  // an infinite thin wall about the opening; false: its rim alone

  [[nodiscard]] guidance::OrificeState at(double t) const;
};

}  // namespace vericone::simulation
