// SPDX-License-Identifier: BSD-3-Clause
//
// Sectors of any two bodies on planes through their line of sight, of the true cone or by slices, with rates
// in closed form: what laws that work on a plane read.
#pragma once

#include <vericone/cones/pair.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/combined/plane_sector.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <vericone/internal/cones/hulls/hull_sectors.h>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

namespace vericone {

/// Which cone the plane is cut from. Planar bodies have one sector, whatever is asked.
enum class SectorMethod : std::uint8_t {
  slice,      // the source's: both bodies' sections by the plane (6.11); too small
  true_cone,  // the true cone's section: contacts outside the plane count
};

/// On the plane of u (line of sight) and e (across), radians from u towards e.
struct PlaneOpening {
  double psi = 0, theta_b = 0;

  [[nodiscard]] double left() const { return theta_b + 0.5 * psi; }
  [[nodiscard]] double right() const { return theta_b - 0.5 * psi; }
};

/// Rates of an opening, rad/s: of psi, and of theta_b against fixed axes.
struct OpeningRates {
  double psi = 0, theta_b = 0;
};

/// Whether there are sectors of bodies of these kinds: of two planar ones, by the true cone of any two in
/// space, by slices of two combined ones and of an ellipsoid and a hull.
[[nodiscard]] bool has_sectors(const WorldBody& a, const WorldBody& b, SectorMethod method);

/// Two bodies at an instant, prepared to be seen on many planes through their line of sight. Refers to the
/// bodies. No allocation for two ellipsoids.
class PlaneCones {
 public:
  /// `from`, `to`: the ends of the line of sight, A's reference point and B's, metres; of ellipses,
  /// ellipsoids and combined bodies their centres. `memory`: edges of the step before, and for the one after.
  /// Throws InputError like pair_of().
  PlaneCones(const WorldBody& a, const WorldBody& b, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
             SectorMethod method, EdgeMemory* memory = nullptr);

  /// A motion, and what the opening does in it; nothing where that has no closed form: slices of hulls, and
  /// edges of which no contact is known.
  struct Moving {
    SpatialMotion motion;
    std::optional<OpeningRates> rates;
  };

  /// u: the line of sight; e perpendicular to it, both unit. Nothing where the bodies are not apart (on the
  /// plane, for slices), have no sectors of this kind, or an oracle does not decide; no rates are written
  /// then. Edges of combined bodies' true sectors are proved to 1e-7 rad; what cannot be decided counts as
  /// in. Cost: guidance/plane_view.h.
  [[nodiscard]] std::optional<PlaneOpening> on(const Eigen::Vector3d& u, const Eigen::Vector3d& e,
                                               std::span<Moving> moving = {}) const;

  /// d psi / d azimuth, rad / rad, as the plane turns about the line of sight, in closed form: true sectors
  /// of ellipsoids; nothing for others.
  [[nodiscard]] std::optional<double> opening_slope(const Eigen::Vector3d& e) const;

  /// Radians to which the edges are right, where that is not rounding.
  [[nodiscard]] double tolerance() const;
  /// Whether edges turn smoothly with the plane: those of ellipsoids, which pass from no contact to another.
  [[nodiscard]] bool smooth() const;

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
  struct Ellipsoids {
    Ellipsoids(const Ellipsoid& agent, const Ellipsoid& obstacle)
        : a(agent), b(obstacle), planes(agent, obstacle) {}
    const Ellipsoid &a, &b;
    SectorPlanes planes;
  };
  struct TrueHull {
    TrueHull(const Ellipsoid& of_agent, const HullBody& of_obstacle)
        : agent(of_agent), hull(of_obstacle), oracle(of_agent, of_obstacle) {}
    const Ellipsoid& agent;
    const HullBody& hull;
    HullOracle oracle;
  };
  struct TrueCombined {
    TrueCombined(const CombinedEllipsoid& a, const CombinedEllipsoid& b, EdgeMemory* of_before);
    CombinedOracle oracle;
    EdgeMemory* memory;
    mutable EdgeMemory own;  // where there is no other: of the plane before
  };
  /// The rest: meshes, clouds, maps, unions, and agents that are hulls or these.
  using Kind = std::variant<None, Planar, Slices, HullSlices, Ellipsoids, TrueHull, TrueCombined, Pair>;
  struct Ask;
  [[nodiscard]] Kind kind_of(SectorMethod method, EdgeMemory* memory) const;

  const WorldBody &a_, &b_;
  Eigen::Vector3d from_, to_;
  Kind kind_;
};

}  // namespace vericone
