// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "command/default_seed.h"
#include "output/output_options.h"

namespace vericone {

struct SignMapOptions : OutputOptions {
  SignMapOptions() { out = "out/signmap"; }
  int cells = 193;                    // along each axis, 3 to 2001; an even number means one more
  std::uint64_t seed = kDefaultSeed;  // of the engagement
};

/// `vericone signmap`: the answers in, on, out for all doubles around a velocity that grazes exactly, by
/// plain double arithmetic and by the library, and the rung that decided. Writes signmap.csv, signmap.json,
/// provenance.json and the figure to `out`. Throws InputError naming "--cells".
void run_signmap(const SignMapOptions& options, std::ostream& out);

}  // namespace vericone
