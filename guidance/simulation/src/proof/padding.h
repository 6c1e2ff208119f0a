// SPDX-License-Identifier: BSD-3-Clause
//
// What proofs ask of their options and of the time.
#pragma once

#include <vericone/simulation/proof.h>

namespace vericone::simulation {

/// How far a body may be from its track.
class Padding {
 public:
  /// `start`: when the body, or the first of several, sets out.
  Padding(const ProofOptions& options, double start)
      : least_(options.padding), drift_(options.drift), start_(start) {}

  [[nodiscard]] double least() const { return least_; }
  /// At all times up to t, metres.
  [[nodiscard]] double until(double t) const { return least_ + drifted(t); }
  /// What a current may have carried it by then.
  [[nodiscard]] double drifted(double t) const { return drift_ * (t - start_); }

 private:
  double least_, drift_, start_;
};

/// Throws InputError naming "padding", "resolution" or "drift".
void check(const ProofOptions& options);

/// Throws InputError naming "from" or "to" unless first <= from <= to <= last.
void require_time(double first, double last, double from, double to);

}  // namespace vericone::simulation
