// SPDX-License-Identifier: BSD-3-Clause
//
// Certified constructions: intervals that contain the true value, for those who need a bound and not only a
// rounded number. An approximation is found in floating point and a bracket around it is proved by exact
// predicates or by interval arithmetic; the bracket grows until the proof succeeds. Times to contact:
// times/contact_time_enclosure.h. Sectors of ellipses: planar/enclose_sector.h. Proofs against exact
// arithmetic: tests/cones/ellipsoids/enclosures_test.cpp.
//
// One assumption beyond IEEE 754: the mathematics library's sin, cos and atan2 are off by at most two units
// in the last place (glibc documents one).
#pragma once

#include <vericone/cones/ellipsoids/plane_sector.h>
#include <optional>

namespace vericone {

/// m(w) of clearance.h, metres: below by the value at one normal that is exactly perpendicular to w; above,
/// where the shadows are apart, by the distance of two of their points, and where they overlap by a branch
/// and bound over all normals. Median width for bodies of 1 to 10 m: 1e-13 m where m > 0, 3e-11 m where m < 0;
/// up to 1e-3 m where all normals are equally good (spheres hit head on). Cost: 1.5 us where m > 0, 75 us
/// where m < 0. Throws InputError naming "relative_velocity" where w is zero or not finite. The interval is
/// infinite where lengths leave the range 1e-140 to 1e140.
[[nodiscard]] Interval enclose_clearance(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& w);

/// Distance between two bodies, metres: [0, 0] where they touch or overlap, decided exactly. Median
/// width for bodies of 1 to 10 m: 1e-13 m. Cost: 2.3 us.
[[nodiscard]] Interval enclose_separation(const Ellipsoid& a, const Ellipsoid& b);

/// Edges of the true cone on a plane through the line of sight (plane_sector.h), radians from the line of
/// sight.
struct PlaneSectorEnclosure {
  Interval left, right;
  [[nodiscard]] Interval psi() const { return left + right; }
  [[nodiscard]] Interval theta_b() const { return (left - right) * Interval(0.5); }
};

/// Proved by the interval rung of ConeOracle for every direction in a box around each end of the bracket.
/// Requires disjoint bodies; throws InputError as true_sector does. Nothing where the interval rung cannot
/// tell, for bodies closer than rounding. Cost: about 8 us.
[[nodiscard]] std::optional<PlaneSectorEnclosure> enclose_plane_sector(const Ellipsoid& a, const Ellipsoid& b,
                                                                       const Eigen::Vector3d& across);

}  // namespace vericone
