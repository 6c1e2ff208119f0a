// SPDX-License-Identifier: BSD-3-Clause
//
// A mesh with a window as a body that moves.
#pragma once

#include <vericone/simulation/proof.h>

namespace vericone::simulation {

/// The mesh of a window as it moves from when it appears until `to`. Requires a window.
[[nodiscard]] Track mesh_track(const MovingOrifice& orifice, double to);

}  // namespace vericone::simulation
