// SPDX-License-Identifier: BSD-3-Clause
//
// Sectors of two bodies on planes through their line of sight, by kind of body.
#pragma once

#include <vericone/cones/combined/cone.h>
#include <vericone/cones/combined/edge.h>
#include <vericone/cones/ellipsoids/plane_sector.h>
#include <vericone/cones/hulls/hull_sectors.h>
#include <vericone/guidance/plane_view.h>
#include <optional>
#include <variant>

namespace vericone::guidance {

/// On the plane of u (line of sight) and e (across), radians from u towards e.
struct Opening {
  double psi = 0, theta_b = 0;

  double left() const { return theta_b + 0.5 * psi; }
  double right() const { return theta_b - 0.5 * psi; }
};

/// The part of `v` across the unit vector `u`, unit; where there is none, some axis that `u` alone decides.
Eigen::Vector3d across_axis(const Eigen::Vector3d& u, const Eigen::Vector3d& v);

/// Rates of an opening beside the plane's own turning.
struct OpeningRates {
  double psi = 0, theta_b = 0;
};

/// How both bodies move beyond what the states say, seen from axes that turn with the plane.
struct TurningMotion {
  Eigen::Vector3d omega_a = Eigen::Vector3d::Zero(), omega_b = Eigen::Vector3d::Zero();
  double closing = 0;                 // V_r, m/s
  const ShapeRate* rate_a = nullptr;  // none: zero
  const ShapeRate* rate_b = nullptr;
};

/// Sections of combined bodies by the plane of both centres, that of A about the origin and that of B about
/// (distance, 0).
struct Sections {
  CombinedEllipse a, b;
  CombinedSector sector;

  bool disjoint() const { return sector.sector.relation == Relation::disjoint; }
  Opening opening() const { return {sector.sector.psi, sector.sector.theta_b}; }
};
Sections sections_of(const CombinedEllipsoid& a, const CombinedEllipsoid& b, const Eigen::Vector3d& u,
                     const Eigen::Vector3d& e);
/// Closed form. Requires disjoint sections.
OpeningRates section_rates(const Sections& sections, const CombinedEllipsoid& a, const CombinedEllipsoid& b,
                           const Eigen::Vector3d& u, const Eigen::Vector3d& e, const TurningMotion& motion);

/// The section of a hull by the plane, and of the agent; nothing where the plane misses the hull or the
/// agent's section reaches into it.
std::optional<Opening> hull_section(const Ellipsoid& agent, const HullBody& hull, const Eigen::Vector3d& u,
                                    const Eigen::Vector3d& e);

/// Closed form, from the contacts: only how fast the points in contact move along their normal counts.
/// Requires contacts. `velocity`: of B from A; `motion`: without `closing`, turning as seen from fixed axes.
OpeningRates contact_rates(const PlaneSector& sector, const BodyState& a, const BodyState& b,
                           const Eigen::Vector3d& velocity, double plane_spin, const TurningMotion& motion);

/// The true sector of a hull; by the assembly's search where that of hulls says nothing. Refers to the
/// bodies.
class TrueHull {
 public:
  TrueHull(const Ellipsoid& agent, const HullBody& hull, const Eigen::Vector3d& position);
  std::optional<PlaneSector> on(const Eigen::Vector3d& e) const;

 private:
  const Ellipsoid& agent_;
  const HullBody& hull_;
  HullOracle oracle_;
  Eigen::Vector3d position_;
};

/// The true sector of dented bodies: edges of the certified oracle, each looked for near the one before.
class TrueCombined {
 public:
  static constexpr double kEdge = 1e-7;  // rad

  /// `memory`: of the step before, and for the one after.
  TrueCombined(const CombinedEllipsoid& a, const CombinedEllipsoid& b, EdgeMemory* memory);
  std::optional<PlaneSector> on(const Eigen::Vector3d& e) const;

 private:
  CombinedOracle oracle_;
  EdgeMemory* memory_;
  mutable EdgeMemory own_;  // where there is no other: of the plane before
};

/// Two bodies at an instant, prepared to be seen on many planes through their line of sight. Refers to the
/// bodies.
class PlaneCones {
 public:
  PlaneCones(const BodyState& a, const BodyState& b, SectorMethod method, EdgeMemory* memory = nullptr);

  /// u: the line of sight; e perpendicular to it, unit. Nothing as fill_cone() says.
  std::optional<Opening> on(const Eigen::Vector3d& u, const Eigen::Vector3d& e) const;

  /// With the contacts, for true sectors of all but two ellipsoids; nothing for others.
  std::optional<PlaneSector> true_sector(const Eigen::Vector3d& e) const;

  /// d psi / d azimuth as the plane turns about the line of sight, in closed form: true sectors of
  /// ellipsoids; nothing for others.
  std::optional<double> opening_slope(const Eigen::Vector3d& e) const;

  /// Radians to which the edges are right, where that is not rounding.
  double tolerance() const;
  /// Whether edges turn smoothly with the plane: those of ellipsoids, which pass from no contact to another.
  bool smooth() const;

 private:
  struct None {};
  struct Planar {
    const CombinedEllipse &a, &b;
  };
  struct Slices {
    const CombinedEllipsoid &a, &b;
  };
  struct HullSlices {
    const Ellipsoid& agent;
    const HullBody& hull;
  };
  /// The rest: meshes, clouds, maps, unions, and agents that are hulls or these.
  struct TruePair {
    Pair pair;
    Eigen::Vector3d from, to;
  };
  using Kind = std::variant<None, Planar, Slices, HullSlices, SectorPlanes, TrueHull, TrueCombined, TruePair>;
  static Kind kind_of(const BodyState& a, const BodyState& b, SectorMethod method, EdgeMemory* memory);

  Kind kind_;
};

}  // namespace vericone::guidance
