// SPDX-License-Identifier: BSD-3-Clause
//
// A law of our own: it steers the miss distance m(w) (clearance.h) to a distance in metres. No plane is
// chosen, and what is controlled is what matters.
#pragma once

#include <vericone/cones/uncertain/error_set.h>
#include <vericone/guidance/body_state.h>
#include <vericone/guidance/laws.h>
#include <limits>

namespace vericone::guidance {

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

/// m(w) of the bodies as the law sees them, without errors; of planar ones in the plane.
[[nodiscard]] double law_clearance(const BodyState& a, const BodyState& b);

}  // namespace vericone::guidance
