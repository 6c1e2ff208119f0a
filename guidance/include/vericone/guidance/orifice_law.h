// SPDX-License-Identifier: BSD-3-Clause
//
// An opening at an instant, as guidance sees it.
#pragma once

#include <vericone/cones/opening/opening.h>
#include <vericone/guidance/kinematics.h>
#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>

namespace vericone::guidance {

/// It moves with a constant velocity and turns about its centre at a constant rate.
struct OrificeState {
  PlacedOpening opening;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      // rad/s, in world axes

  /// `seconds` later.
  [[nodiscard]] OrificeState after(double seconds) const;
};

// Laws that take an agent through an opening: the source's (2.2)-(2.4) as corrected, and ours, which steers
// the clearance of the true shapes in metres. Pure functions of an instant. No throw of finite states; no
// allocation of ellipsoids and round openings.

enum class OrificeStatus : std::uint8_t {
  steering,
  saturated,  // steering with the most allowed
  clear,      // it passes as it flies: nothing commanded
  turning,    // the opening recedes, or lies behind: turns the velocity towards it with the most allowed
  coasting,   // within the opening's reach, and through it as it flies: nothing commanded any more
  no_effect,  // aimed at the centre, or inputs that do not change y: nothing commanded
  no_relative_velocity,  // nothing commanded
};
[[nodiscard]] const char* to_string(OrificeStatus status);

struct OrificeCommand {
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // of A, m/s^2, saturated
  double demanded = 0;                                     // m/s^2, before saturation
  double y = 0;  // (2.2), m^2: the miss of the centres squared less (R_B - R_A)^2
  double m = 0;  // metres, of the passage law: clearance of the shadows
  OrificeStatus status = OrificeStatus::clear;
};

struct OrificeLawOptions {
  double gain = 1;                                        // K, 1/s: y' = -K (y - reference)
  double reference = -0.1;                                // w, m^2: -(R_B - R_A)^2 < w < 0
  double most = std::numeric_limits<double>::infinity();  // m/s^2
  /// (delta, gamma): the acceleration is along this, with either sign. Left out: along the one that needs
  /// least, which is perpendicular to the relative velocity (the source gives none).
  std::optional<Direction> direction;
};

/// (2.4) with its third line corrected (errata 3.2), whose sign and size are those of y' along the direction.
/// It drives y to the reference from either side, so that A passes sqrt(w + (R_B - R_A)^2) beside the centre,
/// and takes every opening as facing the relative velocity: its tilt and its outline are not seen. (2.4)
/// does not look at the sign of V_r; here A turns towards the centre while V_r >= 0, and within R_B of it,
/// with y < 0, nothing is commanded. Cost: 30 ns.
[[nodiscard]] OrificeCommand orifice_law(const Cartesian<3>& motion, double opening_radius,
                                         double agent_radius, const OrificeLawOptions& options);

struct PassageLawOptions {
  double margin = 0.1;  // metres to keep from the rim, at least
  double beyond =
      0.05;         // metres more that it aims at, as far as the opening has room; nothing is commanded there
  double gain = 1;  // K, 1/s: m' = -K (m - margin - beyond), fading where the margin is kept
  double most = std::numeric_limits<double>::infinity();  // m/s^2
  bool longitudinal = false;  // may change the speed too; otherwise perpendicular to A's velocity
};

/// The clearance m of the shadows of A and of the opening along the relative velocity, metres, the opening as
/// it will be turned when A gets there, driven to the margin by the least acceleration; where the opening has
/// less room, to 0.95 of the clearance through its deepest point. Where m >= margin + beyond nothing is
/// commanded. Where that acceleration would lead too near to another side of the rim, both sides are steered
/// at once: no command is undone by the next. While A's centre moves away from the opening's plane, or along
/// it, A turns towards the opening's deepest point. Bodies other than ellipsoids and hulls are seen as
/// ellipsoids that contain them. Cost: docs/measured/benchmarks.md.
[[nodiscard]] OrificeCommand passage_law(const BodyState& a, const OrificeState& orifice,
                                         const PassageLawOptions& options);

/// Where A is to be for the opening, and when.
struct OrificeAim {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();     // m, in the world then
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of that point
  double seconds = 0;                                  // s
};
/// The deepest point of the opening as it will be when A is there, with A's way straight and `speed` the
/// speed with which A goes; left out: its closing speed, or, where it does not close in, its own. With a
/// `margin` (metres) and a way so oblique that A would not keep it: first a point before the opening, on A's
/// side, on the perpendicular through the deepest point.
[[nodiscard]] OrificeAim orifice_aim(const BodyState& a, const OrificeState& orifice,
                                     const std::optional<double>& speed = {},
                                     const std::optional<double>& margin = {});

}  // namespace vericone::guidance
