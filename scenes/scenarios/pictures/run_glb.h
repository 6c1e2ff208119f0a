// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/run.h>
#include <vericone/simulation/scenario.h>
#include <string>

namespace vericone::scenario {

/// A run as GLB (glb/glb_file.h): bodies that move and turn, their ways as lines, and in the extras what is
/// proved of every pair. At most 400 poses a body, straight and by slerp in between; a body whose dents
/// change is as it appears. Throws InputError naming "--glb".
[[nodiscard]] std::string run_glb(const simulation::Scenario& scenario, const simulation::Run& run);

}  // namespace vericone::scenario
