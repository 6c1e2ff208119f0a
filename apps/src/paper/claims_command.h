// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "output/output_options.h"

namespace vericone::paper {

/// `out` empty: no files.
struct ClaimsOptions : OutputOptions {
  std::vector<std::string> ids;   // of claims or sections; empty: all
  std::uint64_t shuffle = 0;      // so many draws of the chosen numbers; 0: as they were chosen
  std::vector<std::string> only;  // of these fits alone; empty: of all
  std::uint64_t seed = 1;         // of the draws
  std::string paper;              // its folder, or the name of one of ours; empty: papers/dhal2022
  bool given = false;             // the table shows the values that go into runs, too
};

/// `vericone claims`: what the paper prints beside what we measure (docs/reference/papers.md). Returns the
/// exit status: 0 whatever the verdicts are, 130 interrupted. Throws InputError.
int run_claims(const ClaimsOptions& options, std::ostream& out);

}  // namespace vericone::paper
