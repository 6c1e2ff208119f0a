// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace vericone {

struct EstimateOptions {
  std::string track;                           // CSV: t, x, y, and r where given; - for standard input
  double alpha = 0.1;                          // 1/s
  std::vector<double> variance = {0.1, 0.05};  // m^2/s^4, along x and y
  double noise = 1;                            // m, where the track has no r
  std::string hidden = "skip";                 // or "source"
  std::optional<std::string> out;
  bool json = false;
  std::string command_line;
};

/// `vericone estimate`: Singer's filter over a measured track (docs/explanation/pursuit.md). Prints the table
/// of estimates, or writes estimate.csv, estimate.json and provenance.json to `out`. Throws InputError naming
/// the line and column, or the option.
void run_estimate(const EstimateOptions& options, std::ostream& out);

}  // namespace vericone
