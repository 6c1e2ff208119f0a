// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "output/output_options.h"

namespace vericone::populations {

/// Shares of a population that collide, without flying: a table of sums, a row for each block of encounters,
/// so that memory, parts and interruptions cost the same for any number. Returns the exit status, 130
/// interrupted. Throws InputError naming the option, the file or its field.
int run_verdict_campaign(const std::string& file, std::uint64_t encounters, std::uint64_t seed,
                         const OutputOptions& options, std::ostream& out);

}  // namespace vericone::populations
