// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "cone/cone.h"
#include "input/body.h"

namespace vericone {

/// `vericone cone` of a body of pieces: a mesh, a cloud, an octree map or the convex hull of points.
void run_pieces_cone(const ConeCommand& options, const scenes::Scene& scene, std::ostream& out);

}  // namespace vericone
