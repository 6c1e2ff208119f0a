// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "command/default_seed.h"
#include "output/output_options.h"

namespace vericone::accuracy {

/// `out` empty: out/accuracy, or out/accuracy-OBSTACLE.
struct Options : OutputOptions {
  std::string obstacle = "ellipsoid";        // or biconcave, biconvex, star
  std::optional<std::uint64_t> engagements;  // 10,000; 1000 with other obstacles
  std::optional<double> tolerance;           // of the certified reference of other obstacles
  std::uint64_t approaches = 200;            // per scanned object
  std::vector<double> semi_axes;             // least and greatest, m; empty: 1 and 10
  std::vector<double> distance;              // of the centres, m; empty: by what just separates them
  std::string cases;                         // a file of pairs, instead of random ones
  std::uint64_t seed = kDefaultSeed;
  std::vector<int> planes{3, 4, 6, 8, 12, 18, 24, 36, 60, 90, 180, 360};
  std::vector<std::string> scans;  // files, or folders of files
};

/// `vericone accuracy`: how good a 3-D cone is for a number of planes or samples, on random engagements and
/// on scanned objects. Writes tables, a summary, provenance and figures to `out`. Returns the exit status;
/// 130 when interrupted, after which the same command resumes.
int run_accuracy(const Options& options, std::ostream& out);

}  // namespace vericone::accuracy
