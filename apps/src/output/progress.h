// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

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

}  // namespace vericone
