// SPDX-License-Identifier: BSD-3-Clause
#include "output/progress.h"

#include <unistd.h>

#include <cstdio>

#include "work/interrupt.h"

namespace vericone {

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() { finish(); }

bool Progress::show(const std::string& what, double share) {
  if (quiet_) return !interrupted();
  const auto now = std::chrono::steady_clock::now();
  const bool next = what != step_;
  if (next || now - last_ > std::chrono::milliseconds(terminal_ ? 200 : 10'000)) {
    if (next) finish();
    last_ = now;
    step_ = what;
    if (terminal_) {
      std::fprintf(stderr, "\r%-60s %3.0f %%", what.c_str(), 100 * share);
    } else if (next) {
      std::fprintf(stderr, "%s\n", what.c_str());
    } else {
      std::fprintf(stderr, "%s: %.0f %%\n", what.c_str(), 100 * share);
    }
    std::fflush(stderr);
  }
  return !interrupted();
}

void Progress::finish() {
  if (terminal_ && !step_.empty()) std::fputc('\n', stderr);
  step_.clear();
}

}  // namespace vericone
