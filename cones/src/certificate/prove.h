// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/cones/answers.h>
#include <string>

#include "certificate/bodies.h"
#include "certificate/write.h"

namespace vericone::certificates {

/// Two bodies that move straight for a while.
struct Question {
  const Stated &agent, &obstacle;
  Eigen::Vector3d v_a, v_b;  // m/s
  Horizon horizon;
};

/// Writes the proof of a verdict; false where none is found, and why.
bool prove(const Question& question, Verdict verdict, Text& proof, std::string& reason);

}  // namespace vericone::certificates
