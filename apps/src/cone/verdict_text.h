// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/scenes/scene.h>
#include <iosfwd>

namespace vericone {

/// The verdict of the scene's velocities, and when and where they lead to the first contact or how near they
/// come: the digits that are certain.
void print_verdict(const scenes::Scene& scene, std::ostream& out);

}  // namespace vericone
