// SPDX-License-Identifier: BSD-3-Clause
//
// Long work in parallel that can be interrupted at any moment and goes on where it was.
#pragma once

#include <vericone/work/staged_folder.h>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace vericone::work {

struct ResumableTable {
  std::string name;  // of the CSV, a resumable file of the folder
  /// One line that pins down every row; unfinished work with other settings is refused.
  std::string settings{};
  std::string header{};
  std::uint64_t first = 0, count = 0;               // rows from `first` to `count`, which is none of them
  std::function<std::string(std::uint64_t)> row{};  // called from several threads
  /// Where it is set, what gives the rows from `begin` to before `end`, each with a line break: other
  /// processes compute them. Called from this thread alone, for one block after the other.
  std::function<std::string(std::uint64_t begin, std::uint64_t end)> rows{};
  /// The first cell of a row: a row that stands anywhere else is refused.
  std::function<std::string(std::uint64_t)> id = [](std::uint64_t i) { return std::to_string(i); };
  int threads = 1;
  std::uint64_t block = 50;  // rows that are written together
  /// Told ten times a second, and when a block is ready, the row that comes next; false stops.
  std::function<bool(std::uint64_t rows)> progress{};
};

/// Computes the rows from `first` on, and gives them to `write` in order of their index, each with a line
/// break, as blocks get ready. The result does not depend on the number of threads. False where an
/// interruption came first, or `progress` stopped it. Throws what `row`, `write` and `progress` throw, and
/// Interrupted where this thread was asked to stop.
bool compute_rows(const ResumableTable& table, std::uint64_t first,
                  const std::function<void(std::string_view)>& write);

/// The same to the resumable file of `folder`, after the rows that stand there: the result does not depend on
/// the number of interruptions. Throws InputError naming the folder for unfinished work of other settings, or
/// with rows that are not these.
bool run_table(const ResumableTable& table, StagedFolder& folder);

}  // namespace vericone::work
