// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace vericone {

/// What every command that writes files is told.
struct OutputOptions {
  std::string out;  // folder
  int threads = 0;  // 0: one per processor
  bool figures = true, quiet = false, json = false;
  std::string command_line;        // for provenance
  std::vector<std::string> words;  // of it, from the command's name on
  std::string part;                // K/N: of each table these rows alone; output/part.h
  std::string rows;                // what becomes of the rows; job/kept_rows.h
};

}  // namespace vericone
