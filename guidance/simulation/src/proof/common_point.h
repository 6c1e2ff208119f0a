// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/cones/opening/opening.h>
#include <vericone/geometry/world_body.h>
#include <Eigen/Core>
#include <optional>

namespace vericone::simulation {

/// Of a body in the frame of an opening, whose rim lies in the plane z = 0: a point that it has in common
/// with the rim or, where `wall`, with the plane outside of the opening, by more than `slack` metres. Nothing
/// where there is none or none was found.
std::optional<Eigen::Vector2d> common_point(const WorldBody& body, const Opening& opening, bool wall,
                                            double slack);

}  // namespace vericone::simulation
