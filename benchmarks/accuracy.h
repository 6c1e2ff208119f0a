// SPDX-License-Identifier: BSD-3-Clause
//
// How far the constructions of a cone are from its cross-section area, over many pairs.
#pragma once

#include <benchmarks/pairs.h>
#include <map>
#include <string>
#include <vector>

namespace vericone::benchmarks {

/// Of a relative error of the cross-section area, over the pairs.
struct Spread {
  double median = 0, worst = 0;

  explicit Spread(std::vector<double> errors);
};

class Accuracy {
 public:
  explicit Accuracy(const std::vector<Engagement>& pairs);

  const Spread& exact(int samples) const;

  /// Of a slice cone against the true one: what its approximation leaves out.
  Spread slice(int planes) const;

  /// Of a slice cone against the limit of infinitely many planes: its own discretisation, extrapolated from
  /// the error's law 1 / planes^2.
  Spread slice_discretisation(int planes) const;

  /// Fewest samples, even, from which on the median (or worst) error stays below `target`.
  int fewest(double target, double Spread::*measure) const;

 private:
  const std::vector<Engagement>& pairs_;
  std::vector<double> areas_;
  mutable std::map<int, Spread> exact_;  // by samples
};

/// "n = 48, error 1.0e-14 (worst 2.0e-10)"
std::string label(const char* what, int count, const Spread& error);

}  // namespace vericone::benchmarks
