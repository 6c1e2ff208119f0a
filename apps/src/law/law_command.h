// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

namespace vericone {

/// `vericone law`: one state a line in, what a pursuit law says of it a line out
/// (docs/explanation/pursuit.md). Returns the exit status: 0, or 2 if any line was bad.
int run_law(const std::string& path, std::ostream& out);

}  // namespace vericone
