// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/scene.h"

namespace vericone {

struct AssemblyOracle::State : assembly::Scene {
  State(const Ellipsoid& agent, const Assembly& body, const Pose& pose)
      : Scene(agent, body, pose), space(assembly::Frame::in_space(*ellipsoid())) {
    space.check_range(largest());
  }
  State(const HullBody& agent, const Assembly& body, const Pose& pose)
      : Scene(agent, body, pose), space(frame()) {}

  assembly::Frame space;  // where lengths are those of space
  Relation relation = Relation::disjoint;
};

}  // namespace vericone
