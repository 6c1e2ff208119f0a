// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/scene.h"

namespace vericone {

struct AssemblyOracle::State : assembly::Scene {
  State(const Ellipsoid& agent, const Eigen::Vector3d& at, const Assembly& body, const Pose& pose)
      : Scene(agent, at, body, pose), space(assembly::Frame::in_space(*ellipsoid(), place())) {
    space.check_range(largest());
  }
  State(const HullBody& agent, const Eigen::Vector3d& at, const Assembly& body, const Pose& pose)
      : Scene(agent, at, body, pose), space(frame()) {}

  assembly::Frame space;  // where lengths are those of space
  Relation relation = Relation::disjoint;
};

}  // namespace vericone
