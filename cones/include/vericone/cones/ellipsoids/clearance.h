// SPDX-License-Identifier: BSD-3-Clause
//
// Lengths and times of an engagement: how far off a miss is, how deep a hit, when, and how far apart now.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <optional>

namespace vericone {

/// m(w) = max over unit n perpendicular to w of g(n) = n.c - rho_A(n) - rho_B(n): the signed distance between
/// the shadows of A and B along the relative velocity w = v_A - v_B. Positive: the distance at which the
/// lines of motion pass; zero: grazing; negative: collision, the least sideways shift of A that would avoid
/// it. It is constant along the motion and smooth where it is positive.
struct Clearance {
  double distance = 0;                               // m(w), metres
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // the maximising unit normal n*, from A towards B
  double time = 0;  // s, when the supporting points n* belongs to pass each other; negative: in the past

  /// Derivatives by the envelope theorem: of m with respect to c = p_B - p_A, and to w.
  [[nodiscard]] Eigen::Vector3d gradient_center() const { return normal; }
  [[nodiscard]] Eigen::Vector3d gradient_velocity() const { return -time * normal; }
};

/// Any two bodies; throws InputError naming "relative_velocity" where w is zero or not finite. Where m > 0
/// the maximiser is unique and found to rounding; where m < 0 the largest of several local maxima is searched
/// for on a grid refined at the bodies' thin directions, so a reported depth is never too small. NaN where
/// doubles do not resolve the depth: shadows with an axis ratio beyond 1e15 may have it. Cost: 1 us where m >
/// 0, 5 us where m < 0.
[[nodiscard]] Clearance clearance(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& w);

/// Distance between two disjoint bodies and the unit normal of the closest points, from A towards B.
/// Zero (and the contact normal) for touching bodies, zero and a zero normal for overlapping ones.
struct Separation {
  double distance = 0;  // metres
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};
[[nodiscard]] Separation separation(const Ellipsoid& a, const Ellipsoid& b);

/// First t >= 0, in seconds, at which A moving by w t touches B; nothing when it never does, 0 when they
/// touch or overlap now, infinite where it exceeds the doubles. Whether there is a contact is decided
/// exactly; the time has a relative error of a few roundings away from grazing, where it grows like the
/// square root of the rounding. Gaps below rounding and numbers whose squares leave the doubles take the
/// exact time, 1 ms.
[[nodiscard]] std::optional<double> time_to_contact(const Ellipsoid& a, const Ellipsoid& b,
                                                    const Eigen::Vector3d& w);

/// In seconds, of prepared bodies and w = v_a - v_b, whose verdict is that of the unrounded difference.
[[nodiscard]] std::optional<double> time_to_contact(const ConeOracle& oracle, const Eigen::Vector3d& v_a,
                                                    const Eigen::Vector3d& v_b);

/// The time alone, for a w known to be in the cone of disjoint bodies; NaN, or a number without a meaning,
/// for others and where squares leave the doubles. Cost: about 1 us.
[[nodiscard]] double contact_time(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& w);

/// Clearance of the motion that lies ahead: m(w) when the closest passage is still to come or a collision is,
/// the present distance when the bodies are moving apart. Sign agrees with the exact verdict; NaN as in
/// clearance(). The difference of the velocities may exceed the doubles.
[[nodiscard]] double clearance_ahead(const ConeOracle& oracle, const Eigen::Vector3d& v_a,
                                     const Eigen::Vector3d& v_b);

// Certified constructions: intervals that contain the true value, for those who need a bound and not only a
// rounded number. An approximation is found in floating point and a bracket around it is proved by exact
// predicates or by interval arithmetic; the bracket grows until the proof succeeds. Times to contact:
// times/contact_time_enclosure.h. Sectors of ellipses: planar/enclose_sector.h. Proofs against exact
// arithmetic: tests/cones/ellipsoids/enclosures_test.cpp.
//
// One assumption beyond IEEE 754: the mathematics library's sin, cos and atan2 are off by at most two units
// in the last place (glibc documents one).

/// m(w) of clearance.h, metres: below by the value at one normal that is exactly perpendicular to w; above,
/// where the shadows are apart, by the distance of two of their points, and where they overlap by a branch
/// and bound over all normals. Median width for bodies of 1 to 10 m: 1e-13 m where m > 0, 3e-11 m where m <
/// 0; up to 1e-3 m where all normals are equally good (spheres hit head on). Cost: 1.5 us where m > 0, 75 us
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
