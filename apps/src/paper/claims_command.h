// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

namespace vericone {

struct ClaimsOptions {
  std::string out;  // empty: no files
  bool json = false;
  bool given = false;  // the table shows the values that go into runs, too
  bool quiet = false;
  std::string command_line;
};

/// `vericone claims`: what the source prints beside what we measure (docs/papers.md). Returns the exit
/// status: 0 whatever the verdicts are, 130 interrupted. Throws InputError.
int run_claims(const ClaimsOptions& options, std::ostream& out);

}  // namespace vericone
