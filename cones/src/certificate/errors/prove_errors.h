// SPDX-License-Identifier: BSD-3-Clause
//
// What proves a verdict about all errors of a position and a velocity.
#pragma once

#include <vericone/cones/uncertain/robust.h>

#include "certificate/error_set.h"
#include "certificate/prove.h"

namespace vericone::certificates {

/// Two bodies of which one is seen with errors, until the horizon's end.
struct UncertainQuestion {
  const Stated &agent, &obstacle;
  Eigen::Vector3d v_a, v_b;  // m/s
  const StatedErrors &position, &velocity;
  double until;  // s; infinite: for ever

  [[nodiscard]] Eigen::Vector3d w() const { return v_a - v_b; }
};

// Each writes a proof; false where none was found.

/// No error collides: a plane along this normal, more or less, that keeps its gap for all of them.
bool prove_all_out(const UncertainQuestion& question, const Eigen::Vector3d& normal, Text& proof);

/// Every error collides, of one convex piece each: points for all normals, by octants.
bool prove_all_in(const UncertainQuestion& question, Text& proof);

/// One of the errors collides, another one passes.
bool prove_depends(const UncertainQuestion& question, const Pair& pair, const RelativeError& collides,
                   const RelativeError& passes, Text& proof);

}  // namespace vericone::certificates
