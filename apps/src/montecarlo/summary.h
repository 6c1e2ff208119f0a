// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "json/json_forward.h"
#include "montecarlo/table.h"

namespace vericone::montecarlo {

/// Counts of outcomes, and what was called safe and met all the same.
Json summarise(const std::vector<Row>& rows, const std::vector<Flown>& laws);

/// One row a law, the counts of `summarise`.
std::string summary_csv(const Json& summary);
void print_summary(const Json& summary, std::ostream& out);

/// Runs that a statement proved to be right called safe and that met: there are none.
std::uint64_t violations(const Json& summary);

}  // namespace vericone::montecarlo
