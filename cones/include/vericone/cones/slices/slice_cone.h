// SPDX-License-Identifier: BSD-3-Clause
//
// The source's 3-D cone: planar sectors on planes through the line of centres (source, 6.3.1, Algorithm 3).
#pragma once

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/combined.h>
#include <cstdint>
#include <optional>
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

// The source's 3-D cone of combined quadrics: planar sectors of the sections by planes through the line of
// centres (source, 6.3.2, Fig 6.6).

/// How the sector of a plane is found.
enum class SliceSector : std::uint8_t {
  all_candidates,   // combined_sector(): the sections' true sector, any two bodies
  source_printed,   // sector_by_source() with TangentChoice::printed
  source_by_sides,  // sector_by_source() with TangentChoice::by_sides, what 6.3.2 says
};

/// The union of planar sectors of two combined quadrics. It is *not* the collision cone, for the same reason
/// as SliceCone. Every direction within a slice is a collision of points of the two sections, so it is in the
/// collision cone; what lies *between* slices need not be, because the cone of these bodies need not be
/// convex, and no count of planes makes the polygon of the edges a bound in either direction. Edges are
/// within [0, pi] of the line of sight: more than pi / 2 where one body lies in the other's mouth.
struct CombinedSliceCone {
  /// Nothing where it could not be decided whether the bodies touch; there are no slices then.
  std::optional<Relation> relation;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  // unit, from A to B
  std::vector<Slice> slices;                       // empty unless disjoint

  int hulls_overlap = 0;  // planes on which a section reaches into the other's hull: no hull tangents there
  // With the source's own choice of tangents only:
  int source_failures = 0;  // planes on which it found no two tangents; these slices are combined_sector()'s
  int source_differences =
      0;  // planes on which an edge is off by more than 1e-9 rad; kept as the source says

  /// The polygon of the edges. Solid angle of overlapping bodies 4 pi, without directions; of bodies that may
  /// touch NaN.
  [[nodiscard]] PolyhedralCone polyhedral() const;
};

/// `planes` >= 1 planes at equal angles, on the azimuths of slice_cone(). The source's choices take an
/// ellipsoid A and a B with at most one hyperboloid. Throws InputError naming "planes", "agent" or
/// "obstacle". Cost: docs/measured/benchmarks.md; more where the bodies' ellipsoids overlap, since only then
/// is it a question whether the bodies do.
[[nodiscard]] CombinedSliceCone combined_slice_cone(const CombinedEllipsoid& a, const CombinedEllipsoid& b,
                                                    int planes,
                                                    SliceSector sectors = SliceSector::all_candidates);

}  // namespace vericone
