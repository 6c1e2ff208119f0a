// SPDX-License-Identifier: BSD-3-Clause
//
// When between two commands something happened: roots on the tracks.
#pragma once

#include <vericone/simulation/run.h>
#include <functional>

namespace vericone::simulation {

/// A time in [from, to] at which `value` changes its sign, to 1e-12 of the interval; it is to differ at the
/// two ends. A value that is not finite counts as that of `to`.
double sign_change(const std::function<double(double)>& value, double from, double to);

/// Whether one body has passed another, looked at time after time.
class Passage {
 public:
  Passage(const Track& a, const Track& b);

  /// Negative until B is passed: c.V, and once that is not negative V_r_hat of the plane chosen, where there
  /// is one: followed from the time asked before. Where V_r_hat is positive on every plane c.V stands for it.
  double rate(const Track& a, const Track& b, const Pilot& pilot, double t);

 private:
  double reach_;  // of both bodies, metres
  guidance::GuideMemory seen_;
};

/// Negative on a collision course as the law sees it: m - required, or -1 and 1.
double margin(const Track& a, const Track& b, const guidance::GuideOptions& options, double t);

}  // namespace vericone::simulation
