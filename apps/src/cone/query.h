// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

#include "json/json_forward.h"

namespace vericone {

/// `vericone query`: one engagement a line in, one answer a line out, in the same order
/// (docs/reference/formats.md). Returns the exit status: 0, or 2 if any line was bad. Blank lines have no
/// answer.
int run_query(const std::string& path, bool with_rung, std::ostream& out);

/// One line of a file of cases. Throws InputError naming the line.
Json parse_case(const std::string& line, std::size_t number);

}  // namespace vericone
