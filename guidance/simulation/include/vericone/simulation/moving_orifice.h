// SPDX-License-Identifier: BSD-3-Clause
//
// An opening that moves: what agents pass through.
#pragma once

#include <vericone/cones/mesh_window.h>
#include <vericone/cones/opening/opening.h>
#include <vericone/guidance/orifice.h>
#include <vericone/simulation/track.h>
#include <memory>
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

  /// Of a window of a mesh: the mesh is its wall, its frame the orifice's, and `opening`, with this centre
  /// and these axes in that frame, the flat one that stands for it (MeshWindow::flat()); `wall` is not read.
  std::shared_ptr<const MeshWindow> window;
  Eigen::Vector3d flat_center = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 2> flat_axes = Eigen::Matrix<double, 3, 2>::Identity();

  /// As laws see it, which foresee the turning of a window as if it were about its own middle.
  [[nodiscard]] guidance::OrificeState at(double t) const;
};

/// The mesh of a window as it moves from when it appears until `to`. Requires a window.
[[nodiscard]] Track mesh_track(const MovingOrifice& orifice, double to);

}  // namespace vericone::simulation
