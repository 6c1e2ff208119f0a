// SPDX-License-Identifier: BSD-3-Clause
//
// What the rows of a campaign say together.
#pragma once

#include <vericone/simulation/montecarlo/row.h>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace vericone::montecarlo {

inline constexpr double kBin = 0.25, kLastBin = 15;  // m

/// Outcomes of one law, or of straight flight.
struct Counts {
  std::uint64_t avoided = 0, infeasible = 0, called_safe_and_met = 0, undecided = 0;
  double median_peak = 0, median_left_cone = 0;  // m/s^2, s; NaN where there is none
  /// Histogram of the proved least distances of those avoided: how many (no unit) in each bin of kBin; the
  /// last has all from kLastBin on.
  std::vector<double> least_distances;

  [[nodiscard]] std::uint64_t met() const { return infeasible + called_safe_and_met; }
};

/// Counts of outcomes, and what was called safe and met all the same.
struct Summary {
  struct OfLaw {
    std::string name;
    double most = 0;             // m/s^2
    bool word_is_proof = false;  // what it calls safe is a theorem about the straight flight that follows
    Counts counts;
    std::uint64_t made_worse = 0;
  };
  std::size_t engagements = 0;
  Counts straight;
  std::uint64_t slice_called_safe_and_met = 0, exact_called_safe_and_met = 0,
                predicate_called_safe_and_met = 0, exact_called_unsafe_and_avoided = 0;  // straight on
  std::vector<OfLaw> laws;
};

/// Of rows with an outcome for each of the laws.
[[nodiscard]] Summary summarise(const std::vector<Row>& rows, const std::vector<Flown>& laws);

/// Runs that a statement proved to be right called safe and that met: there are none.
[[nodiscard]] std::uint64_t violations(const Summary& summary);

}  // namespace vericone::montecarlo
