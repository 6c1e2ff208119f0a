// SPDX-License-Identifier: GPL-3.0-or-later
//
// The inner common tangents of two ellipses without rounding: the reference for the planar sector.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/internal/verify/spatial/enclosed_real.h>
#include <vericone/verify/planar/campaign.h>

#include <array>
#include <optional>

namespace vericone::verify {

/// A line that touches both bodies and has them on opposite sides.
struct InnerTangent {
  EnclosedReal direction;                              // angle of the line from A towards B, in (-pi, pi]
  std::array<EnclosedReal, 2> point_on_a, point_on_b;  // x and y of the points of contact
};

/// The sector of directions that lead from A to B.
struct InnerTangents {
  InnerTangent right, left;  // right edge (clockwise) and left edge of the sector, looking from A to B
  EnclosedReal psi;          // opening from right to left, in (0, pi)
  EnclosedReal theta_b;      // direction of the bisector, in (-pi, pi]
};

struct ExactTangents {
  PlanarRelation relation;
  std::optional<InnerTangents> tangents;  // there exactly when `relation` is separated
};

/// Relation and inner common tangents of two ellipses.
///
/// All decisions (relation, number of tangents, which of the four are inner, which is left) are exact. Angles
/// are enclosed by adjacent doubles, or by one double where they are 0 exactly; so psi is good to the last
/// bit however small. Coordinates of contact points are enclosed by doubles at most two apart; a coordinate
/// that is 0 exactly may be enclosed by [-e, e] with e below 1e-50 of the size of the bodies.
///
/// Precondition: none beyond what Ellipse guarantees. Throws std::logic_error if the two independent exact
/// constructions inside (primal pencil and dual resultant) contradict each other. About 2 ms.
[[nodiscard]] ExactTangents exact_inner_tangents(const Ellipse& a, const Ellipse& b);

}  // namespace vericone::verify
