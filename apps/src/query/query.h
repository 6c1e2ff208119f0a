// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

namespace vericone {

/// `vericone query`: one engagement a line in, one answer a line out, in the same order
/// (docs/reference/formats.md). Returns the exit status: 0, or 2 if any line was bad.
int run_query(const std::string& path, bool with_rung, int threads, std::ostream& out);

}  // namespace vericone
