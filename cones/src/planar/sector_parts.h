// SPDX-License-Identifier: BSD-3-Clause
//
// What both ways of computing a sector share.
#pragma once

#include <vericone/cones/planar/sector.h>

namespace vericone {

/// `side` = +1 for the clockwise edge (its direction is the inner normal turned clockwise), -1 for the other.
SectorEdge make_edge(const Ellipse& a, const Ellipse& b, const Eigen::Vector2d& normal, double side);

/// Direction of the bisector from that of the clockwise edge, in (-pi, pi].
double bisector_angle(const Eigen::Vector2d& right_direction, double psi);

/// Throws InputError naming "sector.relation" where there are none.
void require_edges(const Sector& sector);

Sector touching_sector(const Ellipse& a, const Ellipse& b, const Eigen::Vector2d& normal);
Sector overlapping_sector(const Ellipse& a, const Ellipse& b);

}  // namespace vericone
