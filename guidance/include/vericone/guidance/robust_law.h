// SPDX-License-Identifier: BSD-3-Clause
//
// The outer loop of the source's chapter 7: a correction of the avoidance law that keeps the influence of
// noise on z = y - w within a bound, (7.14)-(7.24). The source solves six linear matrix inequalities with a
// semidefinite solver; for one scalar state they reduce to a search over the gain alone
// (docs/explanation/robust-law.md has the proof), which takes about a microsecond and tells which limit has
// no solution.
#pragma once

#include <cstdint>

namespace vericone::guidance {

/// What the noise and the step leave open: the error follows z' = -K a z + b u + v, (7.15), with a in
/// [a_low, a_high], |b| in [b_low, b_high] (1/m) and a known sign of b.
struct RobustModel {
  double gain = 1;                // K of the inner loop, 1/s
  double a_low = -1, a_high = 1;  // printed: -nu, nu; what noise leaves of 1: 1 - 3 sigma, 1 + 3 sigma
  double b_low = 0, b_high = 1;   // 1/m; printed: only b_high, called lambda
  double sign_b = -1;             // -1 or 1: of -D_1 D_2, (7.16)
  double dt = 0.01;               // s
};

/// Which corners the inequalities hold at.
enum class Polytope : std::uint8_t {
  printed,     // two: a at its ends, |b| = b_high. Says nothing about smaller |b| and values of a between
  containing,  // eight, whose convex hull has every (A, B, D) of the model
};

/// What keeps the H-infinity norm of v -> z below the bound.
enum class Attenuation : std::uint8_t {
  printed,  // (7.23) as it stands: the norm is at most sqrt(mu)
  stated,   // with mu^2 in its place: at most mu, as the text says
};

struct RobustOptions {
  double mu = 1;            // bound of the influence of noise, s
  double state_weight = 1;  // dimensionless, Q^ of (7.18), > 0
  double input_weight = 0;  // s^4/m^2, R^ of (7.18), >= 0
  Polytope polytope = Polytope::containing;
  Attenuation attenuation = Attenuation::stated;
};

enum class RobustStatus : std::uint8_t {
  solved,
  // No gain satisfies the inequalities; named is the first that takes the last gain away:
  decay,        // (7.22): none keeps z from growing at every corner
  attenuation,  // (7.23): none keeps the influence of noise below the bound
  saturation,   // (7.24): those that do would command more than is left
  weights,      // (7.22) and (7.23) together: the cost of one breaks the bound of the other
};
[[nodiscard]] const char* to_string(RobustStatus status);

struct RobustCorrection {
  RobustStatus status = RobustStatus::solved;
  double gain = 0;   // of u = gain z, m/s^2: Y / Q of (7.19)
  double delta = 0;  // u, m/s^2, between the limits: what is added to the inner loop's command
  double gamma = 0;  // least upper bound of the cost (7.18), in its unit
  double norm = 0;   // largest H-infinity norm of v -> z over the corners, s
};

/// The gain of least gamma. Where there is none, `gain`, `delta` and `gamma` are 0: the inner loop's command
/// stands alone, saturated (which is right where it is saturated towards the way out). `z` = 0: nothing is to
/// be corrected, delta = 0. `low`, `high`: what is left for u, m/s^2 (limits of the actuator less the inner
/// loop's command); where 0 is not between them the inner loop alone commands too much.
///
/// Exact to rounding: gamma and gain agree with an interior-point solver of (7.20)-(7.24) to its tolerance
/// (tests/guidance/robust_law_test.cpp). No allocation, no throw. Cost: 1 us with
/// two corners, 2 us with eight.
[[nodiscard]] RobustCorrection robust_correction(double z, double low, double high, const RobustModel& model,
                                                 const RobustOptions& options);

/// Throws InputError naming "K", "a", "b_min", "lambda", "sign_b", "dt", "mu", "Q" or "R".
void check(const RobustModel& model, const RobustOptions& options);

}  // namespace vericone::guidance
