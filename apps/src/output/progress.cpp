// SPDX-License-Identifier: BSD-3-Clause
#include "output/progress.h"

#include <unistd.h>

#include <cstdio>
#include <optional>
#include <ostream>

#include "output/part.h"
#include "work/interrupt.h"

namespace vericone {
namespace {

class Bar {
 public:
  Bar(std::string label, std::uint64_t count, bool quiet)
      : label_(std::move(label)), count_(count), quiet_(quiet) {}

  void show(std::uint64_t done, bool last) {
    const bool begun = first_.has_value();
    if (!begun) first_ = done;
    if (quiet_ || (!begun && !last)) return;
    const auto now = std::chrono::steady_clock::now();
    // A log gets a line every ten seconds, a terminal a bar four times a second.
    if (!last && now - shown_ < (terminal_ ? std::chrono::milliseconds(250) : std::chrono::seconds(10)))
      return;
    shown_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double share = count_ ? static_cast<double>(done) / static_cast<double>(count_) : 1;
    const double left =
        done > *first_ ? elapsed * static_cast<double>(count_ - done) / static_cast<double>(done - *first_)
                       : 0;
    std::string bar;
    for (int i = 0; i < 30; ++i) bar += i < share * 30 ? '#' : '.';
    std::fprintf(stderr, "%s%s [%s] %llu/%llu  %.0f s, %.0f s left%s", terminal_ ? "\r" : "", label_.c_str(),
                 bar.c_str(), static_cast<unsigned long long>(done), static_cast<unsigned long long>(count_),
                 elapsed, left, terminal_ && !last ? "   " : "   \n");
    std::fflush(stderr);
  }

 private:
  std::string label_;
  std::uint64_t count_;
  bool quiet_, terminal_ = isatty(STDERR_FILENO) != 0;
  std::optional<std::uint64_t> first_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), shown_{};
};

std::function<bool(work::ResumableTable&)> shared;

}  // namespace

void share_rows(std::function<bool(work::ResumableTable&)> with) { shared = std::move(with); }

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

bool run_with_bar(work::ResumableTable table, work::StagedFolder& folder, const std::string& label,
                  const OutputOptions& options, std::ostream& out) {
  if (const auto part = part_of(options.part)) {
    require_no_other_result(options, folder, *part);
    table = rows_of_part(std::move(table), *part);
  }
  if (shared && !shared(table)) return true;
  Bar bar(label, table.count - table.first, options.quiet);
  std::uint64_t done = 0;
  table.progress = [&](std::uint64_t next) {
    bar.show(done = next - table.first, false);
    return !interrupted();
  };
  const bool finished = run_table(table, folder);
  bar.show(done, true);
  if (!finished) out << "interrupted; the same command goes on where it stopped (" << options.out << ")\n";
  return finished;
}

}  // namespace vericone
