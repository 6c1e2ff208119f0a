// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "command/default_seed.h"

namespace vericone {

struct VerifyOptions {
  std::uint64_t cases = 200'000;  // of each predicate; 0: none
  std::uint64_t pairs = 30;       // of each family of the sectors and cones; 0: none
  std::uint64_t seed = kDefaultSeed;
  unsigned threads = 0;  // 0: one per processor
  std::string part;      // K/N: of the reports every N-th alone
  bool quiet = false;
  bool json = false;
};

/// `vericone verify`: holds the library against exact constructions with CGAL (docs/explanation/verify.md).
/// Returns the exit status: 0, 1 if any answer was wrong, 130 when interrupted; what was done by then is
/// printed.
int run_verify(const VerifyOptions& options, std::ostream& out);

}  // namespace vericone
