// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <iosfwd>
#include <string>

#include "output/output_options.h"
#include "work/resumable_table.h"

namespace vericone {

/// One line on standard error, rewritten on a terminal; elsewhere printed once a step, and again with the
/// share that is done while a step takes long.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `share` of the step `what` is done. False when the work is to stop: work/interrupt.h.
  bool show(const std::string& what, double share);

 private:
  void finish();

  bool quiet_, terminal_;
  std::string step_;
  std::chrono::steady_clock::time_point last_;
};

/// From here on `with` is asked of every table that run_with_bar() is to fill, and may give it `rows` that
/// other processes compute (mpi/ranks.h). False where this process has helped another one with the table and
/// has no more to do with it.
void share_rows(std::function<bool(work::ResumableTable&)> with);

/// Fills a table, or the part of it that was asked for, with a bar on standard error, called `label`. False
/// where an interruption came first; a line on `out` then says how to go on.
bool run_with_bar(work::ResumableTable table, work::StagedFolder& folder, const std::string& label,
                  const OutputOptions& options, std::ostream& out);

}  // namespace vericone
