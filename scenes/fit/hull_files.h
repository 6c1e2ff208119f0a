// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces of hulls as mesh files and for pictures. They are for looking at: chords cut off what bulges.
#pragma once

#include <vericone/fitting/hull.h>
#include <vericone/geometry/mesh/surface.h>
#include <string>
#include <vector>

namespace vericone::fit {

/// One closed surface a piece; of a footprint the upright cylinder between its heights, the disc where these
/// are equal. Triangles say which quadric of their piece they are on; what closes a cylinder is on 1.
std::vector<CombinedSurface> hull_surfaces(const std::vector<fitting::Piece>& pieces);

/// Wavefront OBJ, a group "piece_i_quadric_j" for each quadric of a piece, both from 0.
std::string hull_obj(const std::vector<CombinedSurface>& surfaces);

/// PLY (text), faces with the properties "piece" and "quadric".
std::string hull_ply(const std::vector<CombinedSurface>& surfaces);

}  // namespace vericone::fit
