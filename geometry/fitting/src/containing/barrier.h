// SPDX-License-Identifier: BSD-3-Clause
//
// Local minima of the volume of containing bodies: an interior-point method, then Newton's method on the
// first-order conditions.
#pragma once

#include "containing/hull_problem.h"

namespace vericone::fitting {

struct Minimum {
  StarBody body;
  double log_volume = 0;
  /// First-order conditions: largest component of the gradient of the Lagrangian, and of the violations.
  double stationarity = 0;
  bool converged = false;  // stationarity <= 1e-8, multipliers nonnegative
  int iterations = 0;      // Newton steps
};

enum class Descent {
  rough,     // to about 1e-3 of the volume, for comparing starts
  thorough,  // to the last digit
  last,      // the same from nearby: stays in the minimum that it starts in
};

/// Follows log volume + mu sum log(1 - 1/c) from a body that need not be feasible, over a working set of
/// constraints that takes in what is violated, round by round, until nothing is.
Minimum minimise(HullProblem problem, StarBody start, Descent descent);

}  // namespace vericone::fitting
