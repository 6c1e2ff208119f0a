// SPDX-License-Identifier: BSD-3-Clause
//
// The source's 3-D cone: planar sectors on planes through the line of centres (source, 6.3.1, Algorithm 3).
#pragma once

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vector>

namespace vericone {

/// The sector of the two sections on one plane through both centres. In the plane, angles are measured from
/// the line of sight c towards the plane's second axis.
struct Slice {
  double azimuth =
      0;             // angle of the plane's second axis about the line of sight, radians, from AxisFrame::e1
  double left = 0;   // edge towards the second axis, radians from the line of sight, > 0
  double right = 0;  // edge towards the other side, > 0

  [[nodiscard]] double psi() const { return left + right; }
  /// Bisector, radians from the line of sight.
  [[nodiscard]] double theta_b() const { return 0.5 * (left - right); }
};

/// The union of planar sectors. It is *not* the collision cone: on each plane it sees only collisions of
/// points that both lie in that plane, so it is contained in the collision cone, in general strictly
/// (docs/explanation/theory.md, 3). It is exact for two spheres and on common planes of symmetry. The cone
/// spanned by its directions is contained in the collision cone as well, because that one is convex.
struct SliceCone {
  Relation relation = Relation::overlapping;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  // unit, from A to B
  std::vector<Slice> slices;                       // empty unless disjoint
  int support_fallbacks = 0;  // planes on which Algorithm 3 had no real answer and supports were used

  /// The cone spanned by the directions. Solid angle of touching bodies 2 pi, of overlapping ones 4 pi, as
  /// for the exact cone, without directions.
  [[nodiscard]] PolyhedralCone polyhedral() const;
};

/// `planes` >= 1 planes at equal angles. Touching bodies and overlapping ones have no slices; see relation.
/// Cost: about 3 us a plane. Throws InputError naming "planes".
[[nodiscard]] SliceCone slice_cone(const Ellipsoid& a, const Ellipsoid& b, int planes);

/// The sector of the sections on the plane spanned by the line of centres and `across` (any vector not
/// parallel to it). Throws InputError naming "across", or "bodies" where they are not disjoint.
[[nodiscard]] Slice slice_sector(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& across);

}  // namespace vericone
