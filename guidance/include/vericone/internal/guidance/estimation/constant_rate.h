// SPDX-License-Identifier: BSD-3-Clause
//
// A number that changes at a nearly constant rate: the source's filters of y, psi and theta_b (7.1.3, 7.4; it
// does not print their models).
#pragma once

#include <vericone/guidance/estimation/filters.h>

namespace vericone::guidance {

struct ConstantRateOptions {
  /// Of the white noise that changes the rate, (unit of the value)^2 / s^3. Large: follows at once; 0: the
  /// rate is constant.
  double intensity = 1;
  /// Standard deviation of the rate before anything is known of it, unit / s.
  double first_rate = 1;
  /// Largest normalised innovation squared that is taken: 16 refuses one right measurement in 15,000.
  double gate = 16;
};

/// Angles are unwrapped by the caller. No allocation, no throw. Cost: 50 ns a step.
class ConstantRateFilter {
 public:
  explicit ConstantRateFilter(const ConstantRateOptions& options = {})
      : options_(options), gate_(options.gate) {}

  /// A measured value with its variance, at a time, s. Times do not go back.
  Innovation<1> step(double measured, double variance, double time);

  [[nodiscard]] bool started() const { return started_; }
  [[nodiscard]] double value() const { return belief_.mean[0]; }
  [[nodiscard]] double rate() const { return belief_.mean[1]; }
  [[nodiscard]] const Belief<2>& belief() const { return belief_; }

 private:
  void start(double measured, double variance);

  ConstantRateOptions options_;
  Gate gate_;
  Belief<2> belief_;
  double time_ = 0;
  bool started_ = false;
};

}  // namespace vericone::guidance
