// SPDX-License-Identifier: BSD-3-Clause
//
// The section of a spatial cone by a plane through the line of sight: what planar guidance laws need, of any
// two bodies.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace vericone {

struct BodyRate;

/// Surfaces of a combined quadric that are touched at a point y from its centre, the ellipsoid's being 0: the
/// unit outward normal there is the sum of weight M y over them.
struct TouchedSurfaces {
  int count = 0;
  std::array<int, 3> surface{};
  std::array<double, 3> weight{};
};

/// One side of a sector: moved along it, A grazes B.
struct GrazingEdge {
  double angle = 0;  // radians from the line of sight, positive towards its own side
  /// Radians. Beyond angle + error, up to half a turn, no direction of its half-plane collides; at
  /// angle - error one does, unless none of the plane is known to. 0: right to rounding.
  double error = 0;
  // Where they graze each other, metres: of A from its reference point, of B from its own, as they stand now.
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero(), on_b = Eigen::Vector3d::Zero();
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();  // m, by which A moves to that contact
  // Unit, of both bodies there, from A towards B; perpendicular to the edge, not in the plane. Zero where
  // neither it nor the points are known.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  TouchedSurfaces touched_a, touched_b;  // of combined quadrics, where normal is known
};

/// The least sector { cos(phi) u + sin(phi) e : -right.angle <= phi <= left.angle } that holds all directions
/// of the cone in the plane, u the line of sight (unit, from the reference point of A to that of B) and e the
/// plane's second axis. Of convex and of star-shaped bodies it is the cone's section; in that of others there
/// may be gaps. Unlike a slice (slice_cone.h) it accounts for contacts outside the plane.
struct PlaneSector {
  using Edge = GrazingEdge;

  Eigen::Vector3d line_of_sight = Eigen::Vector3d::Zero(),
                  across = Eigen::Vector3d::Zero();  // u, e, orthonormal
  double distance = 0;                               // metres between the reference points
  Edge left, right;                                  // towards +e and -e

  [[nodiscard]] double psi() const { return left.angle + right.angle; }
  /// Bisector, radians from the line of sight towards e.
  [[nodiscard]] double theta_b() const { return 0.5 * (left.angle - right.angle); }
  /// Whether the contacts of both edges are known, from which rates follow.
  [[nodiscard]] bool has_contacts() const { return !left.normal.isZero(0) && !right.normal.isZero(0); }
};

/// Edges as they were found last: the next ones, of a plane nearby or of a moment later, are looked for near
/// them. That makes a step several times cheaper and changes nothing beyond the width to which edges are
/// proved.
struct EdgeMemory {
  std::optional<GrazingEdge> left, right;
};

/// How a rigid body moves: its reference point at `velocity` (m/s), turning about it (rad/s).
struct Twist {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), omega = Eigen::Vector3d::Zero();
};

/// How two bodies move, turn and change, and the plane with them.
struct SpatialMotion {
  Eigen::Vector3d v_a = Eigen::Vector3d::Zero(), v_b = Eigen::Vector3d::Zero();          // m/s
  Eigen::Vector3d omega_a = Eigen::Vector3d::Zero(), omega_b = Eigen::Vector3d::Zero();  // rad/s
  const BodyRate *rate_a = nullptr, *rate_b = nullptr;                                   // none: rigid
  double plane_spin = 0;  // rad/s, of the plane about the line of sight, beyond the turning of the latter
};

/// Closed-form rates, rad/s. The plane turns with the line of sight (u' is its rate, e turns with it without
/// spinning) plus plane_spin.
struct PlaneSectorRates {
  double left = 0, right = 0;  // of the two edge angles
  double line_of_sight = 0;    // in-plane turning of u towards e

  [[nodiscard]] double psi() const { return left + right; }
  /// Of the bisector against the line of sight; add line_of_sight for the rate against fixed axes.
  [[nodiscard]] double theta_b() const { return 0.5 * (left - right); }
};

/// Of two rigid bodies that move and turn; `plane_spin`: of the plane about the line of sight, rad/s, beyond
/// the turning of the latter. Nothing where the sector does not know its contacts. Right to rounding of
/// ellipsoids, to 1e-5 of the largest angular rate in play of other bodies. At corners, where the contact
/// jumps, one-sided. No allocation.
[[nodiscard]] std::optional<PlaneSectorRates> sector_rates(const PlaneSector& sector, const Twist& a,
                                                           const Twist& b, double plane_spin = 0);

/// The same from how fast the contacts move along their normals, from A towards B, m/s: of B's point less
/// that of A's, shapes that change included. `velocity`: of B's reference point less that of A's.
[[nodiscard]] PlaneSectorRates sector_rates(const PlaneSector& sector, double left_speed, double right_speed,
                                            const Eigen::Vector3d& velocity, double plane_spin);

}  // namespace vericone
