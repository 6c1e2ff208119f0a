// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

#include "command/command_line.h"
#include "output/output_options.h"

namespace vericone::pursuit {

struct PursueOptions : OutputOptions {
  PursueOptions() { out = "out/pursuit"; }
  std::string scenario;
  std::string camera, tracker, law;  // empty: perspective, ours, ours
  std::optional<double> duration;    // s
  std::optional<std::uint64_t> seed;
  std::string video, frames;  // file, folder; empty: none
  std::uint64_t starts = 0, random = 0;
  double within = 0.001;  // m
};

/// `vericone pursue`. Returns the exit status. Throws InputError.
int run_pursue(const PursueOptions& options, std::ostream& out);

/// `vericone check` of a pursuit: what its file means, in plain words or as JSON. Throws InputError.
int check_pursuit(const std::string& file, bool json, std::ostream& out);

}  // namespace vericone::pursuit

namespace vericone {

int pursue_command(CommandLine& line);

}  // namespace vericone
