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
  State(const Convex& agent, const Eigen::Vector3d& at, const Assembly& body, const Pose& pose)
      : Scene(agent, at, body, pose), space(frame()) {}

  assembly::Frame space;                   // where lengths are those of space
  Relation relation = Relation::disjoint;  // touching where it is not decided
  bool decided = true;

  /// Takes what was found, nothing: not decided.
  void set(const std::optional<Relation>& found) {
    decided = found.has_value();
    relation = found.value_or(Relation::touching);
  }
};

}  // namespace vericone
