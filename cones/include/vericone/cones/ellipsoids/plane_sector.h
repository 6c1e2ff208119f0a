// SPDX-License-Identifier: BSD-3-Clause
//
// The section of the true 3-D cone by a plane through the line of centres: what planar guidance laws need.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>

namespace vericone {

/// The sector { phi : cos(phi) u + sin(phi) e is in C } with u the line of sight (unit, from A to B) and e
/// the plane's second axis. Unlike a slice (slice_cone.h) it accounts for contacts outside the plane.
struct PlaneSector {
  struct Edge {
    double angle = 0;  // radians from the line of sight, positive towards its own side
    Eigen::Vector3d normal =
        Eigen::Vector3d::Zero();  // unit contact normal, from A towards B; not in the plane
    Eigen::Vector3d contact = Eigen::Vector3d::Zero();  // displacement of A that brings it to grazing contact
  };
  Eigen::Vector3d line_of_sight = Eigen::Vector3d::Zero(),
                  across = Eigen::Vector3d::Zero();  // u, e, orthonormal
  Edge left, right;                                  // towards +e and -e

  [[nodiscard]] double psi() const { return left.angle + right.angle; }
  /// Bisector, radians from the line of sight towards e.
  [[nodiscard]] double theta_b() const { return 0.5 * (left.angle - right.angle); }
};

/// `across`: any vector not parallel to the line of centres; with it spans the plane. Throws InputError
/// naming "across", or "bodies" where they are not disjoint. Cost: about 1 us, 2 us where bodies are near
/// each other.
[[nodiscard]] PlaneSector true_sector(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& across);

/// Two bodies prepared for sectors on many planes. No allocation.
class SectorPlanes {
 public:
  SectorPlanes(const Ellipsoid& a, const Ellipsoid& b);

  /// Certified; false also of bodies so near each other that rounding could matter (true_sector() then asks
  /// integers).
  [[nodiscard]] bool disjoint() const { return disjoint_; }

  /// As true_sector(), which it asks integers for where disjoint() is false.
  [[nodiscard]] PlaneSector on(const Eigen::Vector3d& across) const;

 private:
  Ellipsoid a_, b_;
  Eigen::Vector3d c_, line_of_sight_, separating_ = Eigen::Vector3d::Zero();
  bool disjoint_ = false;
};

/// How the bodies, and the plane with them, move.
struct SpatialMotion {
  Eigen::Vector3d v_a = Eigen::Vector3d::Zero(), v_b = Eigen::Vector3d::Zero();          // m/s
  Eigen::Vector3d omega_a = Eigen::Vector3d::Zero(), omega_b = Eigen::Vector3d::Zero();  // rad/s
  // Rates of the shape matrices beyond turning, m^2/s.
  Eigen::Matrix3d shape_rate_a = Eigen::Matrix3d::Zero(), shape_rate_b = Eigen::Matrix3d::Zero();
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
/// `sector`: of a and b. Throws InputError naming "sector" for a default-constructed one, which has no plane,
/// and "bodies" for bodies with the same centre.
[[nodiscard]] PlaneSectorRates true_sector_rates(const PlaneSector& sector, const Ellipsoid& a,
                                                 const Ellipsoid& b, const SpatialMotion& motion);

}  // namespace vericone
