// SPDX-License-Identifier: BSD-3-Clause
//
// From the frame of a sample to the world.
#pragma once

#include <vericone/fitting/fit.h>

namespace vericone::fitting {

/// Footprints are in the world already.
Piece to_world(const Piece& piece, const Frame& frame);

/// Lengths, places and directions (what is unknown is told in metres already); quadrics are not set.
SurfaceFit to_world(const SurfaceFit& fit, const Frame& frame);

}  // namespace vericone::fitting
