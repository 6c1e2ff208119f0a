// SPDX-License-Identifier: BSD-3-Clause
//
// Long work in parallel that can be interrupted at any moment and goes on where it was.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "output/staged_folder.h"

namespace vericone {

struct ResumableTable {
  StagedFolder& folder;
  std::string name;  // of the CSV, a resumable file of the folder
  std::string
      settings{};  // one line that pins down every row; unfinished work with other settings is refused
  std::string header{};
  std::uint64_t count = 0;
  std::function<std::string(std::uint64_t)> row{};  // called from several threads
  /// The first cell of a row: a row that stands anywhere else is refused.
  std::function<std::string(std::uint64_t)> id = [](std::uint64_t i) { return std::to_string(i); };
  int threads = 1;
  std::uint64_t block = 50;  // rows that are written together
  bool quiet = false;
  std::string label{};  // for the progress line
};

enum class TableOutcome { finished, interrupted };

/// Computes the rows in order of their index, and appends them to the resumable file as blocks get ready.
/// The result does not depend on the number of threads or of interruptions. Progress
/// goes to standard error. Throws InputError naming "--out" for unfinished work of other settings, or with
/// rows that are not these.
TableOutcome run_table(const ResumableTable& work);

}  // namespace vericone
