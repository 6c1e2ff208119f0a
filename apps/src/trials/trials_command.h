// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "output/output_options.h"

namespace vericone::trials {

struct TrialsOptions : OutputOptions {
  TrialsOptions() { out = "out/trials"; }
  std::string scenario;
  std::uint64_t trials = 1000;
  std::vector<std::string> levels, laws;  // none: as complete() says
  std::optional<std::uint64_t> seed;      // otherwise the scenario's
  std::optional<std::uint64_t> trial;     // this one alone: nothing is written
  bool random = false;  // another random engagement each trial in place of the scenario's bodies
};

/// Shares of trials that are proved avoided (and all openings passed), by law and noise. Returns the exit
/// status, 130 interrupted. Throws InputError naming the option or the field.
int run_trials(const TrialsOptions& options, std::ostream& out);

}  // namespace vericone::trials
