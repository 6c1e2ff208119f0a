// SPDX-License-Identifier: BSD-3-Clause
//
// Collision cones of combined quadrics in the plane: ellipses delimited by hyperbolas (source, 5.2.2).
#pragma once

#include <vericone/cones/planar/sector.h>
#include <vericone/geometry/combined.h>
#include <optional>
#include <vector>

namespace vericone {

/// What an edge of the sector touches on a body: a boundary arc (of conic `first`) or a corner (of `first`
/// and `second`); conic 0 is the ellipse, i + 1 the delimiter i.
struct Touch {
  bool corner = false;
  int first = 0, second = 0;
};

/// The sector of two combined quadrics. Both bodies are star-shaped about their centres, so K = B + (-A) is
/// star-shaped about c and the cone is *one* sector about c whatever the dents do, each side of it less than
/// pi from c: the largest signed angle from c to b - a. It is attained at a common tangent, at a tangent
/// through a corner, or at a line through two corners. Where one body reaches into the other's dent the edges
/// are not tangents of the convex hulls (`hulls_overlap`), and psi exceeds pi.
struct CombinedSector {
  /// Relation: `overlapping` is proved by a common point, `disjoint` exact where the ellipses are disjoint
  /// and otherwise right unless the bodies come nearer than rounding. `touching` only of two plain ellipses.
  Sector sector;
  Touch left_a, left_b, right_a, right_b;
  bool hulls_overlap = false;  // psi > pi
};

/// The sector by comparing all candidates: exact up to rounding (docs/measured/planar-accuracy.md). Cost:
/// about 2 us where the ellipses are disjoint, no allocation for up to three delimiters.
[[nodiscard]] CombinedSector combined_sector(const CombinedEllipse& a, const CombinedEllipse& b);

/// Rates of psi and theta_b, rad/s, in closed form; an edge through a corner moves with the corner. The
/// motion's shape rates are those of the ellipses; missing delimiter rates are zero. Throws
/// InputError naming "sector.relation" where it is not that of disjoint bodies, and "sector.left_a" (and so
/// on) where it touches a conic that the body does not have.
[[nodiscard]] SectorRates combined_sector_rates(const CombinedSector& sector, const CombinedEllipse& a,
                                                const CombinedEllipse& b, const PlanarMotion& motion,
                                                const std::vector<DelimiterRate<2>>& rates_a = {},
                                                const std::vector<DelimiterRate<2>>& rates_b = {});

/// How the source chooses among the tangents.
enum class TangentChoice {
  printed,  // 5.2.2.2, steps 1 to 5: the two corners nearest to the lost point of tangency, tests by centres;
            // both tangents of one corner are kept only where that corner grazes A
  keep_both,  // the same, but both are kept wherever both pass step 4, which may also be meant
  by_sides,   // 6.3.2: centres on opposite sides and all corners on one side, over all corners
};

/// The source's own way: common tangents of the ellipses by degenerate conics (Algorithm 3), kept where they
/// touch the body; otherwise tangents from corners by pole and polar, (5.6) and (5.7) as corrected
/// (errata, 3.5), chosen as said. `a` an ellipse, `b` delimited by one hyperbola, as in the source. Nothing
/// where the procedure finds no two tangents. Not exact: see docs/measured/planar-accuracy.md for how often
/// each choice errs. Throws InputError naming "obstacle.hyperboloids" where there are several.
[[nodiscard]] std::optional<Sector> sector_by_source(const Ellipse& a, const CombinedEllipse& b,
                                                     TangentChoice choice);

}  // namespace vericone
