// SPDX-License-Identifier: BSD-3-Clause
//
// The source's laws in one plane, by dynamic inversion of the cone function y, (5.1) and (5.10): in the plane
// (5.12), (5.14), (5.16)-(5.17), and on planes of space (6.17), (6.19). All are pure functions; printed
// mistakes are corrected (errata 3.5, 3.6) and the neglected terms of moving planes are there (kinematics.h).
// No allocation, no throw.
#pragma once

#include <vericone/cones/uncertain/robust.h>
#include <vericone/guidance/kinematics.h>
#include <cstdint>
#include <limits>

namespace vericone::guidance {

/// The cone on the plane: opening and bisector, theta_b against the axis of the state's theta, and their
/// rates against fixed axes of the plane. Where A turns with its heading, its own lateral acceleration turns
/// the cone as well: rates are psi_rate + psi_rate_by_a a with a A's lateral acceleration; so with B and its
/// own.
struct PlaneCone {
  double psi = 0, theta_b = 0;                      // rad
  double psi_rate = 0, theta_b_rate = 0;            // rad/s
  double psi_rate_by_a = 0, theta_b_rate_by_a = 0;  // rad/s per m/s^2
  double psi_rate_by_b = 0, theta_b_rate_by_b = 0;  // rad/s per m/s^2
};

/// (5.10), y, its parts, and what changes it: y' = drift + by_lateral_a a_A + ... along the kinematics.
struct ConeRates {
  double y = 0;                         // dimensionless
  double v_r_hat = 0, v_theta_hat = 0;  // m/s, along and across the bisector
  double drift = 0;                     // 1/s
  double by_lateral_a = 0, by_longitudinal_a = 0, by_lateral_b = 0, by_longitudinal_b = 0;  // 1/s per m/s^2

  [[nodiscard]] bool colliding() const { return y < 0 && v_r_hat < 0; }
};
/// (5.11) in closed form. V = 0: all rates 0, y = -sin^2(psi/2).
[[nodiscard]] ConeRates cone_rates(const PlanarState& state, const PlaneCone& cone);

enum class LawStatus : std::uint8_t {
  steering,
  saturated,    // steering with the most allowed
  clear,        // y >= cease: nothing commanded
  receding,     // V_r_hat >= 0: nothing commanded (matching: V alone is braked)
  on_bisector,  // V_theta_hat = 0 within rounding, no first-order effect: the most on the chosen side
  ineffective,  // the inputs do not turn the relative velocity: the most, which turns the heading
  no_relative_velocity,  // V = 0: nothing commanded (avoidance), or arrived (rendezvous)
  no_sector,  // they will meet, but bodies of these kinds have no sector to command by: nothing commanded
};
[[nodiscard]] const char* to_string(LawStatus status);

struct LawOptions {
  double gain = 1;                                        // K, 1/s
  double reference = 0;                                   // w: y' = -K (y - w)
  double most = std::numeric_limits<double>::infinity();  // saturation, m/s^2
  /// Dimensionless. Avoidance commands nothing where y >= cease. The source stops at y > 0.
  double cease = 0;
  /// Sign of A's lateral acceleration where both sides are as good (on_bisector, ineffective).
  double side = 1;
  /// |by_lateral_a| below this part of the largest value it can have counts as no effect.
  double effect = 1e-9;
};

/// Throws InputError naming "gain" or "most" unless positive (`most` may be infinite), and "reference",
/// "cease" or "side". The laws do not look.
void check(const LawOptions& options);

struct LawCommand {
  double a = 0;         // lateral acceleration of A, m/s^2, saturated
  double demanded = 0;  // m/s^2, before saturation
  ConeRates rates;
  LawStatus status = LawStatus::clear;
};

/// (5.12), and (6.17) with a projected state. Aiming along the bisector, or with inputs without effect and no
/// finite `most`, commands 0.
[[nodiscard]] LawCommand avoidance(const PlanarState& state, const PlaneCone& cone,
                                   const LawOptions& options);

struct CooperativeCommand {
  double a = 0, b = 0;                    // lateral accelerations of A and B, m/s^2
  double demanded_a = 0, demanded_b = 0;  // m/s^2
  ConeRates rates;
  LawStatus status = LawStatus::clear;
};

/// (6.18)-(6.19) as corrected: a_B = mu a_A. Saturation scales both, which keeps their ratio.
[[nodiscard]] CooperativeCommand cooperative_avoidance(const PlanarState& state, const PlaneCone& cone,
                                                       const LawOptions& options, double mu);

/// (5.14) as corrected. One equation, two unknowns: the pair of least a_A^2 + a_B^2. Drives y to the
/// reference from either side, so that the bodies graze; `cease` is not read.
[[nodiscard]] CooperativeCommand cooperative_rendezvous(const PlanarState& state, const PlaneCone& cone,
                                                        const LawOptions& options);

struct MatchingCommand {
  double lateral = 0, longitudinal = 0;                    // of A, m/s^2
  double demanded_lateral = 0, demanded_longitudinal = 0;  // m/s^2
  ConeRates rates;
  double speed_squared = 0;  // y_2 = V_r^2 + V_theta^2, m^2/s^2
  LawStatus status = LawStatus::steering;
};

/// (5.16)-(5.17) as corrected: y to the reference with gain K and y_2 = V^2 to 0 with gain K_2. The
/// system's determinant is -2 V^2 (errata 3.5), so it is solved in closed form; on the bisector, where y has
/// no gradient, and moving apart, where it says nothing about meeting, only (5.17) is kept, by the least
/// acceleration. Saturation scales both, so that their resultant is at most `most`.
[[nodiscard]] MatchingCommand matching_rendezvous(const PlanarState& state, const PlaneCone& cone,
                                                  const LawOptions& options, double gain_speed);

// A law of our own: it steers the miss distance m(w) (clearance.h) to a distance in metres. No plane is
// chosen, and what is controlled is what matters.

struct ClearanceOptions {
  double required = 1;  // metres to pass at, at least
  double beyond = 0.1;  // metres more that it aims at, so that `required` is reached in finite time
  double gain = 1;      // K, 1/s: m' = -K (m - required - beyond)
  double most = std::numeric_limits<double>::infinity();  // m/s^2, of the whole acceleration
  bool longitudinal = false;  // may change the speed too; otherwise perpendicular to the velocity
  /// Without this the law stops commanding where m >= required; with it, it also comes back towards it.
  bool hold = false;
  /// Bounded errors of b.position - a.position (m) and a.velocity - b.velocity (m/s) as the law sees them.
  /// Where there are any, m is that of the worst error (RobustClearance), so `required` is kept for all.
  ErrorSet position_error = {}, velocity_error = {};
};

/// Throws InputError naming "gain" or "most" unless positive (`most` may be infinite), and "required" or
/// "beyond" unless finite and not negative. The law does not look.
void check(const ClearanceOptions& options);

struct ClearanceCommand {
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // of A, m/s^2, saturated
  double demanded = 0;                                     // m/s^2, before saturation
  double m = 0;                                            // metres
  double drift = 0;  // m' without any acceleration of A, m/s: turning and changing bodies
  Eigen::Vector3d by_acceleration = Eigen::Vector3d::Zero();  // gradient of m' with respect to it, s
  double time_to_closest = 0;  // s, of the supporting points; negative: receding
  LawStatus status = LawStatus::clear;
};

/// The acceleration of least magnitude with m' = -K (m - required - beyond), the turning of A with its
/// heading included. By the envelope theorem m' = -t n.(a_A - a_B) - (rates of both radii along n); n, t of
/// clearance(). Combined bodies and hulls are replaced by ellipsoids that contain them, so the real distance
/// is larger; pairs with a placed body or a hull as the agent are seen as they are (Pair::miss), by
/// ellipsoids around them only where they will meet. Where the bodies' centres and velocity leave the
/// direction open (spheres head on) it is that of clearance()'s own maximiser: deterministic. Moving apart:
/// nothing commanded, `receding`. Planar bodies: within the plane. Cost: ellipsoids 1.5 us where m > 0, 6 us
/// where m < 0; others that of a Pair and its miss().
///
/// With errors, the order is that of the worst one, which moves by w + v with n.v = h_W(n): for every other
/// m' is larger. All bodies are then seen as ellipsoids. `no_relative_velocity` where the velocity error may
/// be as large as the velocity. Cost: 1.4 times that. Proof: docs/explanation/robust-cone.md.
[[nodiscard]] ClearanceCommand clearance_law(const BodyState& a, const BodyState& b,
                                             const ClearanceOptions& options,
                                             const Eigen::Vector3d& acceleration_b = Eigen::Vector3d::Zero());

}  // namespace vericone::guidance
