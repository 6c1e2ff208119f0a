// SPDX-License-Identifier: BSD-3-Clause
//
// The true collision cone of two ellipsoids, with its own certified error bound.
#pragma once

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vector>

namespace vericone {

/// A point of the cone's boundary.
struct BoundarySample {
  Eigen::Vector3d direction;  // unit, a relative velocity that grazes
  Eigen::Vector3d normal;     // unit, inner normal of the cone there: the contact normal, from A towards B
  Eigen::Vector3d contact;    // direction times the distance to travel until the bodies touch, metres
};

/// The collision cone C = { w : the ray along w meets K = B + (-A) } of two ellipsoids, by tracing its
/// silhouette.
///
/// The cone is convex. Its polar, the set of separating normals, is { n : n.c >= rho_A(n) + rho_B(n) }; it is
/// traced from a normal inside it that the contact function supplies, so bodies whose line of centres does
/// not separate them need no special care. Each sample is exact up to rounding; solid angle and section area
/// come from the trapezoidal rule on the closed smooth curve with its analytic derivative and converge faster
/// than any power of 1/samples (docs/explanation/theory.md, 4).
///
/// Touching bodies: the cone is the half-space beyond the common tangent plane (solid angle 2 pi, no
/// samples). Overlapping bodies: every velocity (4 pi, no samples). Zero axis: the same centre, or distances
/// whose squares leave the range of doubles.
struct TrueCone {
  Relation relation = Relation::overlapping;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  // unit, from A to B; inside the cone
  std::vector<BoundarySample> boundary;            // counter-clockwise about the axis
  double solid_angle = 0;                          // steradian
  /// Area of the section at distance 1 along the axis, dimensionless. Infinity when the cone reaches a right
  /// angle from the axis somewhere: such a cone has no bounded section, use solid_angle.
  double cross_section_area = 0;
};

/// `samples` >= 3 points of the boundary. Cost: about 2 us and 0.06 us a sample, 0.12 us where their number
/// is odd. Throws InputError naming "samples".
[[nodiscard]] TrueCone true_cone(const Ellipsoid& a, const Ellipsoid& b, int samples);

/// Two polyhedral cones with inner <= C <= outer, and what they say about the exact cone's numbers.
///
/// Inner: spanned by boundary directions moved towards the axis by a few roundings until the exact predicate
/// says that each is in C; C is convex, so all of it is in C. Outer: the intersection of half-spaces whose
/// normals are moved inwards until each is exactly certified to separate. The gap falls as samples^-2.
struct ConeBounds {
  PolyhedralCone inner, outer;
  /// The exact cone's numbers, clamped to what inner and outer allow: for very thin bodies and few samples
  /// the trapezoidal rule has not converged yet, and the bounds know.
  double solid_angle = 0;
  double cross_section_area = 0;
  /// The truth differs from these two by at most this: the larger of the distances to inner and outer, plus
  /// 1e-12 of the value for the rounding of the areas themselves.
  double solid_angle_error = 0;
  double cross_section_area_error = 0;
};

/// `cone` = true_cone(a, b, ...) of disjoint bodies. Throws InputError naming "bodies" where a and b are not
/// disjoint, and "cone.relation", "cone.boundary" or "cone.axis" where the cone is that of such bodies, a
/// default-constructed one, or has not the axis of a and b. One of other bodies with the same centres gives
/// bounds that hold all the same, and are wide. Cost: about 0.5 us a sample, up to 1.6
/// for bodies ten and more times as far apart as they are wide; milliseconds for bodies closer than rounding
/// tells.
[[nodiscard]] ConeBounds cone_bounds(const TrueCone& cone, const Ellipsoid& a, const Ellipsoid& b);

}  // namespace vericone
