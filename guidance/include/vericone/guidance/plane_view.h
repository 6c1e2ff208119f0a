// SPDX-License-Identifier: BSD-3-Clause
//
// An engagement seen on one plane through the line of sight: the states and the cone that planar laws read.
#pragma once

#include <vericone/cones/plane_cones.h>
#include <vericone/guidance/kinematics.h>
#include <vericone/guidance/laws.h>
#include <cstdint>
#include <optional>
#include <vector>

namespace vericone::guidance {

using vericone::SectorMethod;

enum class RateMethod : std::uint8_t {
  analytic,     // closed form where there is one (below), else `differenced`
  differenced,  // central differences of the cone along the bodies' momentary motion: h = 1e-4 of the time
                // r / |V| (turning and changing included), 1e-3 for hulls' and 5e-3 for combined bodies' true
                // sectors, whose edges are right to 1e-9 and 1e-7 rad
  none,         // zero: for the source's backward differences see guide.h
};

/// u = line_of_sight, e = across: orthonormal. The plane's angles are measured from u towards e, so theta =
/// 0.
struct PlaneView {
  Eigen::Vector3d line_of_sight, across;
  PlanarState state;
  PlaneCone cone;

  [[nodiscard]] Eigen::Vector3d normal() const { return line_of_sight.cross(across); }
  /// World direction of A's (B's) lateral acceleration, heading + pi/2 in the plane: perpendicular to the
  /// whole velocity.
  [[nodiscard]] Eigen::Vector3d lateral_a() const;
  [[nodiscard]] Eigen::Vector3d lateral_b() const;
};

/// Both in one.
[[nodiscard]] std::optional<PlaneView> plane_view(const BodyState& a, const BodyState& b,
                                                  const Eigen::Vector3d& across, SectorMethod method,
                                                  RateMethod rates, double plane_spin = 0,
                                                  EdgeMemory* memory = nullptr);

// On which plane to avoid (source, 6.4.1). All planes hold the line of sight.

enum class PlaneChoice : std::uint8_t {
  largest_opening,     // maximum psi, the source's choice in 6.5
  least_turn,          // an edge is the least angle, in space, from the relative velocity w = v_A - v_B: the
                       // plane through the direction of the cone's boundary that is nearest to w
  least_y,             // minimum y: the deepest inside
  wind_aware,          // least turn among the planes on which A's acceleration towards the edge (+-lateral_a)
                       // has a part along the wind of at least -0.5; where there is none, the largest part
  steepest_clearance,  // spanned by the line of sight and the gradient of m(w): ellipsoids, or the ellipsoids
                       // around combined bodies and hulls
  of_motion,           // spanned by the line of sight and the relative velocity: y < 0 there iff it collides
};
[[nodiscard]] const char* to_string(PlaneChoice choice);

struct PlaneOptions {
  PlaneChoice choice = PlaneChoice::largest_opening;
  int planes = 24;  // candidates at equal angles over half a turn
  /// Go on to the optimum, to 1e-4 rad (1e-3 where edges come from oracles), from every candidate that is
  /// better than its neighbours. Otherwise the best candidate is taken, as the source does, and nothing is
  /// followed.
  bool refine = true;
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();  // m/s, for wind_aware
};

/// One candidate: for the choice, and for pictures of y and psi on all planes (Fig 6.9).
struct PlaneCandidate {
  double azimuth = 0;  // of `across` about the line of sight, rad from AxisFrame(line of sight).e1
  double psi = 0, theta_b = 0, y = 0, v_r_hat = 0;  // rad, rad, dimensionless, m/s
};

/// All `planes` candidates. Those on which there is no sector are left out.
[[nodiscard]] std::vector<PlaneCandidate> all_planes(const BodyState& a, const BodyState& b,
                                                     SectorMethod method, int planes);

/// The second axis of the plane chosen, unit. `previous`: that of the last call, whose sign is kept; where it
/// is given the optimum is followed from it by 2 to 12 evaluations, and all candidates are compared only
/// where it is none any more. A local optimum is followed as long as it is one. Nothing where no plane has a
/// sector. Planar bodies: the plane itself. Deterministic: of planes equally good to rounding the first
/// is taken, counted from the plane of motion. steepest_clearance and of_motion look at no sector; where w is
/// zero or along the line of sight there is no such plane, and the largest opening is taken. No allocation
/// with ellipsoids. Cost: see docs/explanation/guidance-planes.md.
[[nodiscard]] std::optional<Eigen::Vector3d> choose_plane(const BodyState& a, const BodyState& b,
                                                          SectorMethod method, const PlaneOptions& options,
                                                          const Eigen::Vector3d* previous = nullptr,
                                                          EdgeMemory* memory = nullptr);

}  // namespace vericone::guidance
