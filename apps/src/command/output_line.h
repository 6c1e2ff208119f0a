// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command/command_line.h"
#include "output/output_options.h"

namespace vericone {

/// Declares --part.
inline void part_option(CommandLine& line, std::string& part,
                        const std::string& what = "rows alone; vericone merge puts all N together") {
  line.option("--part", part, "The K-th of N parts of the " + what).shown_type("K/N");
}

/// What provenance and parts keep of the words that were read.
inline void keep_words(const CommandLine& line, OutputOptions& options) {
  options.command_line = line.text();
  options.words = line.words();
}

}  // namespace vericone
