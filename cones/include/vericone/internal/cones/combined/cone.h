// SPDX-License-Identifier: BSD-3-Clause
//
// The true collision cone of two combined quadrics (combined.h), certified. An answer other than `undecided`
// is proved: `in` by a point of A and a point of B that meet, `out` by nonnegative multipliers of the
// quadrics for which no point of a box can satisfy them all, box by box (docs/explanation/theory.md, 7).
//
// Both bodies are star-shaped about their centres, so K = B + (-A) is star-shaped about c = p_B - p_A, and
// the cone contains with every direction all directions between it and c: on each half-plane bounded by the
// line of centres it is *one* interval that begins at c. On other planes through the apex it may be several
// intervals.
#pragma once

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/combined.h>
#include <vericone/internal/cones/combined/edge.h>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

namespace vericone {

/// Where the cone ends on a half-plane: angles from the line of centres, both proved.
struct EdgeBracket {
  double in = 0, out = std::numbers::pi;  // rad; the first is in, the second and all beyond are out
  std::optional<CombinedEdge> edge;       // the contact between them, where Newton's method leads to it
};

/// Two bodies prepared for many directions. Not for several threads at once: scratch memory is kept between
/// calls.
class CombinedOracle {
 public:
  /// `tolerance` (0 < tolerance < 1): boxes are refined to this part of A's extent before `undecided` is
  /// said. Throws InputError naming "tolerance".
  CombinedOracle(const CombinedEllipsoid& a, const CombinedEllipsoid& b, double tolerance = 1e-6);
  ~CombinedOracle();
  CombinedOracle(CombinedOracle&&) noexcept;
  CombinedOracle& operator=(CombinedOracle&&) noexcept;

  [[nodiscard]] const CombinedEllipsoid& a() const;
  [[nodiscard]] const CombinedEllipsoid& b() const;

  /// Disjoint or overlapping, proved; nothing where the bodies touch or nearly do. Never `touching`, unless
  /// both are ellipsoids, whose relation is decided exactly.
  [[nodiscard]] std::optional<Relation> relation() const;

  /// Where the relative velocity w = v_A - v_B lies. Of overlapping bodies every w != 0 is in; undecided
  /// where relation() is not known or touching. w = 0 is out. Two disjoint ellipsoids are decided exactly (on
  /// the boundary: `in`, the cone is closed); otherwise bodies inside and around the two are asked first,
  /// exactly, and only what lies between them is searched. Cost: 0.1 us where they decide, else some 10 to
  /// 100 us; what is needed to search is made, and allocated, when it is first asked for.
  [[nodiscard]] Certified membership(const Eigen::Vector3d& w) const;
  /// The same for w = v_a - v_b, the difference taken without rounding. Throws InputError naming
  /// "agent_velocity[i]" or "obstacle_velocity[i]".
  [[nodiscard]] Certified membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;

  /// The same for a direction near an edge that is known: as a rule decided by the contact there, in 2 us.
  [[nodiscard]] Certified membership(const Eigen::Vector3d& w, const CombinedEdge& near) const;

  /// The end of the cone on the half-plane of u (line of sight, from A to B, unit) and `side` (unit,
  /// perpendicular to it): bracketed to `width` radians, or to what stays undecided. Contacts are followed
  /// outwards until nothing is met beyond the last one; where they lead nowhere, angles are halved. `start`:
  /// an edge of a half-plane nearby, or of a moment before. Bodies are to be disjoint. Cost: some 10 us from
  /// such an edge, some 50 us without; more where surfaces are grazed that bend away from the other body.
  [[nodiscard]] EdgeBracket edge(const Eigen::Vector3d& u, const Eigen::Vector3d& side, double width,
                                 const CombinedEdge* start = nullptr) const;

  /// Relation and membership in one.
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;
  /// The same of contacts within a horizon alone, as Pair::verdict(). Bodies may meet several times: of what
  /// begins later than now, only the first contact is known.
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                const Horizon& horizon) const;

  /// Whether all directions of the convex hull of two, less than a right angle apart and not zero, are in
  /// (out): true is certain, false says nothing.
  /// `at_from`, `at_to`: edges near both to look for contacts from, and there alone, where neither body is an
  /// ellipsoid; `between`: one half way, if there is one.
  [[nodiscard]] bool all_in(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                            const CombinedEdge* at_from = nullptr, const CombinedEdge* at_to = nullptr,
                            const CombinedEdge* between = nullptr) const;
  /// `left`: where to write the points that were in the way of a proof, for two bodies neither of which is an
  /// ellipsoid.
  [[nodiscard]] bool all_out(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                             CombinedEdge* left = nullptr) const;

  /// Whether all w with n.w >= 0 are out, proved from an edge whose contact is nearly farthest along n: true
  /// is certain, false says nothing. So it is where the edge lies on the convex hull of the cone. Cost: 5 us.
  [[nodiscard]] bool half_space_out(const Eigen::Vector3d& n, const CombinedEdge& touching) const;

  /// First contact of A moving by w t: an interval that contains the time, seconds. Nothing where
  /// membership(w) is not `in`, and for bodies so thin that nothing can be searched. `width`: of the
  /// interval, relative to the time needed to cross |c| and both bodies; wider where a contact is so flat
  /// that boxes do not tell. Cost: about 1 ms.
  [[nodiscard]] std::optional<Interval> time_to_contact(const Eigen::Vector3d& w, double width = 1e-8) const;

  /// Boxes searched since the construction: a measure of effort that is the same on every machine.
  [[nodiscard]] std::uint64_t boxes_searched() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// CombinedOracle(a, b, tolerance).relation() at less cost: the ellipsoids contain the bodies and are asked
/// first.
[[nodiscard]] std::optional<Relation> combined_relation(const CombinedEllipsoid& a,
                                                        const CombinedEllipsoid& b, double tolerance = 1e-6);

/// Certified inner and outer cone, star-shaped about the line of centres, with the true cone between.
struct CombinedCone {
  /// Nothing where it could not be decided whether the bodies touch: then there is no cone either.
  std::optional<Relation> relation;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  // unit, from A to B

  /// Both closed polygons of unit directions, counter-clockwise about the axis, star-shaped about it;
  /// successive directions may have the same azimuth. Empty unless disjoint. Where nothing could be proved
  /// out, outer has the directions -axis and the solid angle 4 pi.
  PolyhedralCone inner, outer;

  double solid_angle = 0;        // steradian, the middle of the two
  double solid_angle_error = 0;  // sr, half their difference: a bound, no estimate
  /// The same for the section at distance 1 along the axis; infinite where outer reaches 90 degrees.
  double cross_section_area = 0;
  double cross_section_area_error = 0;  // dimensionless

  std::uint64_t boxes = 0;  // searched: a measure of effort that is the same on every machine
};

/// Refined until the solid angles of inner and outer cone differ by at most `tolerance` (1e-9 to below 1)
/// of the outer one, or until `most_boxes` have been searched (by default about 0.3 s); the bound returned
/// says what was reached. What has begun then is brought to an end: some 400,000 boxes at most.
/// Overlapping bodies: every velocity (4 pi, no directions). Throws InputError naming "tolerance". Cost: see
/// docs/measured/benchmarks.md.
[[nodiscard]] CombinedCone combined_cone(const CombinedEllipsoid& a, const CombinedEllipsoid& b,
                                         double tolerance = 0.01, std::uint64_t most_boxes = 2'000'000);

/// A range of directions cos(t) x_axis + sin(t) y_axis on a plane through the apex.
struct PlaneInterval {
  double from = 0, to = 0;  // radians, from < to
  Certified answer = Certified::undecided;
};

/// The section of the cone by a plane, as intervals that cover the full turn from -pi to pi: adjacent ones of
/// the same answer are joined, so `in` intervals number as the truth does at this resolution (radians).
/// x_axis, y_axis orthonormal.
[[nodiscard]] std::vector<PlaneInterval> plane_intervals(const CombinedOracle& oracle,
                                                         const Eigen::Vector3d& x_axis,
                                                         const Eigen::Vector3d& y_axis,
                                                         double resolution = 1e-3);

}  // namespace vericone
