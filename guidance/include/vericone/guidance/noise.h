// SPDX-License-Identifier: BSD-3-Clause
//
// What errors of measurement make of the avoidance law: the error of y, and the error dynamics z' = -K a z +
// v that the inner loop leaves, (7.1)-(7.13) as corrected (docs/explanation/robust-law.md). V_r, V_theta,
// theta, theta_b, psi, psi' and theta_b' are measured; the agent's own heading is known. Metres, seconds,
// radians.
#pragma once

#include <vericone/guidance/laws.h>

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

}  // namespace vericone::guidance
