// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

namespace vericone {

struct ReachOptions {
  std::string scenario;
  bool current = false;  // also what current the passages endure
  int directions = 4;    // of currents in which it is flown again
  int runs = 6;          // each
  bool quiet = false;
  bool json = false;
};

/// When the openings of a scenario can be reached at the earliest, by what its agents' limits prove, and by
/// when its own run passes them, proved. Returns the exit status: 0 whatever the answers are, 130
/// interrupted. Throws InputError.
int run_reach(const ReachOptions& options, std::ostream& out);

}  // namespace vericone
