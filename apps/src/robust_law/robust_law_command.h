// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

namespace vericone {

/// `vericone robust-law`: one instance of (7.20)-(7.24) a line in, its correction a line out
/// (docs/explanation/robust-law.md). Returns the exit status: 0, or 2 if any line was bad.
int run_robust_law(const std::string& path, std::ostream& out);

}  // namespace vericone
