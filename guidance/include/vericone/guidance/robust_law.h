// SPDX-License-Identifier: BSD-3-Clause
//
// What errors of measurement make of the avoidance law: the error of y, and the error dynamics z' = -K a z +
// v that the inner loop leaves, (7.1)-(7.13) as corrected (docs/explanation/robust-law.md). V_r, V_theta,
// theta, theta_b, psi, psi' and theta_b' are measured; the agent's own heading is known. Metres, seconds,
// radians.
#pragma once

#include <vericone/guidance/laws.h>
#include <vericone/internal/guidance/estimation/constant_rate.h>
#include <cstdint>

namespace vericone::guidance {

/// One number for each quantity that is measured: an error, a standard deviation, or a derivative to it.
struct Measured {
  double v_r = 0, v_theta = 0;             // m/s
  double theta = 0, theta_b = 0, psi = 0;  // rad
  double psi_rate = 0, theta_b_rate = 0;   // rad/s
};

/// The state that a law sees: the true one with errors.
struct MeasuredState {
  PlanarState state;
  PlaneCone cone;
};
[[nodiscard]] MeasuredState measured(const PlanarState& state, const PlaneCone& cone, const Measured& errors);

/// The noise of the error dynamics, exactly, of one measurement. Where the measured state has no effect (D_1
/// or D_2 is 0) `a` and `v` are infinite or NaN.
struct NoiseTerms {
  double delta_y = 0;  // y as measured less y
  double a = 1;        // multiplies K, (7.4): negative where the sign of D_1 D_2 is measured wrong
  double v = 0;        // adds to z', 1/s, (7.5) as corrected
};
/// `gain`: K, 1/s. Exact: with the law (6.17) of the measured state, z' = -K a z + v.
[[nodiscard]] NoiseTerms noise_terms(const PlanarState& state, const PlaneCone& cone, const Measured& errors,
                                     double gain);

/// First derivatives of y, a and v to each measured quantity at the true state, in closed form.
struct NoiseGradients {
  Measured y, a, v;
};
[[nodiscard]] NoiseGradients noise_gradients(const PlanarState& state, const PlaneCone& cone, double gain);

/// Standard deviation to first order of a quantity with that gradient: (7.7), (7.8), (7.13) with independent
/// errors. These linearise. Of a they are no more than that: a quotient whose denominator can be 0 has
/// neither mean nor variance, and three of these deviations need not hold most of it.
[[nodiscard]] double deviation(const Measured& gradient, const Measured& deviations);
/// The same where one random number drives all errors, the literal reading of 7.2's m(t).
[[nodiscard]] double common_deviation(const Measured& gradient, const Measured& deviations);

/// What is known of a and b for robust_law.h from the linearisation: a in 1 -+ 3 deviations, |b| from what
/// errors of three deviations leave of it to its most.
struct NoiseRange {
  double a_low = 1, a_high = 1;  // dimensionless
  double b = 0;                  // of the true state, (7.16), 1/m
  double b_low = 0, b_high = 0;  // of |b|, 1/m
};
[[nodiscard]] NoiseRange noise_range(const PlanarState& state, const PlaneCone& cone,
                                     const Measured& deviations);

// The outer loop of the source's chapter 7: a correction of the avoidance law that keeps the influence of
// noise on z = y - w within a bound, (7.14)-(7.24). The source solves six linear matrix inequalities with a
// semidefinite solver; for one scalar state they reduce to a search over the gain alone
// (docs/explanation/robust-law.md has the proof), which takes about a microsecond and tells which limit has
// no solution.

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

// How an agent sees an engagement on a plane: errors of what is measured, the source's filters of y, psi and
// theta_b, and the outer loop of its chapter 7.

/// One number for each quantity that a sensor of the engagement measures, (7.2): parts of the true value, or
/// radians.
struct EngagementParts {
  double r = 0, v_r = 0, v_theta = 0;      // parts
  double theta = 0, theta_b = 0, psi = 0;  // rad
};

/// One measurement: errors on the plane that are made now, and how large they usually are. Sensors of
/// position and velocity have made theirs in the bodies already; of them only the size is known here.
struct Sight {
  bool measured = false;  // otherwise all is known, and the rest is 0
  EngagementParts errors, deviations;
  double position_deviation = 0;  // m, of the relative position, along any direction
  double velocity_deviation = 0;  // m/s
};

/// What is filtered, by constant_rate.h. The source filters y for its outer loop and the rates psi', theta_b'
/// (7.4); its models and intensities are not printed.
struct PlaneFilterOptions {
  bool y = false, rates = false;
  double intensity_y = 0.01;     // 1/s^3
  double intensity_angle = 0.1;  // rad^2/s^3
  double gate = 16;              // standard deviations, squared

  [[nodiscard]] bool any() const { return y || rates; }
};

/// The filters of one engagement.
class PlaneFilters {
 public:
  explicit PlaneFilters(const PlaneFilterOptions& options);

  /// A measured state and cone, the turning of the line of sight since the last, rad, and the standard
  /// deviations. Rates of `cone` are replaced where they are filtered. Returns y as it is to be used.
  /// Of the rates it writes the deviations too, those of the filters.
  double step(const PlanarState& state, PlaneCone& cone, double turned, Measured& deviations, double time);

 private:
  PlaneFilterOptions options_;
  ConstantRateFilter y_, psi_, theta_b_;
  double turned_ = 0, last_theta_b_ = 0;
};

/// The outer loop of (7.14)-(7.24) beside the inversion: z = y - w of the y used, limits as the actuator
/// leaves them.
struct OuterLoopOptions {
  RobustModel model;  // its gain and sign_b are those of the law
  RobustOptions options;
  /// a and |b| from the noise of the moment (noise_range) in place of those of `model`.
  bool from_noise = false;
};

}  // namespace vericone::guidance
