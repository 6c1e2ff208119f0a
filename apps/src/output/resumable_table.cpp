// SPDX-License-Identifier: BSD-3-Clause
#include "output/resumable_table.h"

#include <unistd.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <thread>
#include <vector>

#include "output/interrupt.h"
#include "output/output_file.h"

namespace vericone {
namespace {

bool has_no_number(const std::string& row) {
  std::istringstream cells(row);
  for (std::string cell; std::getline(cells, cell, ',');)
    if (cell == "nan" || cell == "-nan" || cell == "inf" || cell == "-inf") return true;
  return false;
}

/// Whether a line of an unfinished file is row `i`. One that does not look like a row is computed again.
bool is_row(const std::string& line, std::uint64_t i, const ResumableTable& work) {
  if (!line.starts_with(work.id(i) + ",")) return false;
  const bool plain =
      std::count(line.begin(), line.end(), ',') == std::count(work.header.begin(), work.header.end(), ',') &&
      !has_no_number(line);
  return plain || line == work.row(i);
}

/// Rows that stand complete in an unfinished file; the file is cut after the last of them.
std::uint64_t complete_rows(const std::filesystem::path& partial, const ResumableTable& work) {
  if (!std::filesystem::exists(partial)) return 0;
  std::ifstream in(partial, std::ios::binary);
  std::string line;
  if (!std::getline(in, line) || in.eof()) return 0;  // not even the first line: start anew
  if (line != work.settings)
    throw InputError("--out", partial.parent_path().string(),
                     "a folder without the unfinished run of other settings that " +
                         partial.filename().string() + " holds; delete that file to give it up");
  if (!std::getline(in, line) || in.eof() || line != work.header) return 0;
  std::uint64_t rows = 0;
  std::uintmax_t length = work.settings.size() + work.header.size() + 2;
  while (rows < work.count && std::getline(in, line) && !in.eof()) {
    if (!is_row(line, rows, work))
      throw InputError("--out", partial.parent_path().string(),
                       "a folder whose " + partial.filename().string() + " has row " + work.id(rows) +
                           " in line " + std::to_string(rows + 3) + "; delete that file to begin anew");
    length += line.size() + 1;
    ++rows;
  }
  in.close();
  std::filesystem::resize_file(partial, length);
  return rows;
}

class RowProgress {
 public:
  RowProgress(const ResumableTable& work, std::uint64_t done)
      : work_(work), first_(done), terminal_(isatty(STDERR_FILENO) != 0) {}

  void show(std::uint64_t done, bool last) {
    if (work_.quiet) return;
    const auto now = std::chrono::steady_clock::now();
    // A log gets a line every ten seconds, a terminal a bar four times a second.
    if (!last && now - shown_ < (terminal_ ? std::chrono::milliseconds(250) : std::chrono::seconds(10)))
      return;
    shown_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double share = work_.count ? static_cast<double>(done) / static_cast<double>(work_.count) : 1;
    const double left =
        done > first_ ? elapsed * static_cast<double>(work_.count - done) / static_cast<double>(done - first_)
                      : 0;
    std::string bar;
    for (int i = 0; i < 30; ++i) bar += i < share * 30 ? '#' : '.';
    std::fprintf(stderr, "%s%s [%s] %llu/%llu  %.0f s, %.0f s left%s", terminal_ ? "\r" : "",
                 work_.label.c_str(), bar.c_str(), static_cast<unsigned long long>(done),
                 static_cast<unsigned long long>(work_.count), elapsed, left,
                 terminal_ && !last ? "   " : "   \n");
    std::fflush(stderr);
  }

 private:
  const ResumableTable& work_;
  std::uint64_t first_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), shown_{};
};

}  // namespace

TableOutcome run_table(const ResumableTable& work) {
  const std::filesystem::path partial = work.folder.resumable(work.name);
  std::uint64_t written = complete_rows(partial, work);
  OutputFile out(partial, written ? OutputFile::Start::at_end : OutputFile::Start::anew);
  if (written == 0) out.write(work.settings + "\n" + work.header + "\n");

  std::mutex mutex;
  std::condition_variable ready;
  std::map<std::uint64_t, std::string> blocks;
  std::exception_ptr failure;
  std::atomic<bool> failed{false};
  std::atomic<std::uint64_t> next{written};
  const auto compute = [&] {
    try {
      while (!interrupted() && !failed) {
        const std::uint64_t first = next.fetch_add(work.block);
        if (first >= work.count) return;
        std::string text;
        for (std::uint64_t i = first; i < std::min(first + work.block, work.count); ++i) {
          if (interrupted() || failed) return;
          text += work.row(i) + "\n";
        }
        const std::lock_guard lock(mutex);
        blocks[first] = std::move(text);
        ready.notify_one();
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
      ready.notify_one();
    }
  };
  std::vector<std::thread> threads;
  threads.reserve(static_cast<std::size_t>(work.threads));
  for (int i = 0; i < work.threads; ++i) threads.emplace_back(compute);
  RowProgress progress(work, written);
  {
    std::unique_lock lock(mutex);
    while (written < work.count && !failure && !interrupted()) {
      ready.wait_for(lock, std::chrono::milliseconds(100));
      while (!blocks.empty() && blocks.begin()->first == written) {
        try {
          out.write(blocks.begin()->second);
        } catch (...) {
          failure = std::current_exception();
          break;
        }
        written = std::min(written + work.block, work.count);
        blocks.erase(blocks.begin());
      }
      progress.show(written, false);
    }
  }
  failed = failure != nullptr;
  next = work.count;
  for (auto& t : threads) t.join();
  if (failure) std::rethrow_exception(failure);
  progress.show(written, true);
  out.close();
  return written < work.count ? TableOutcome::interrupted : TableOutcome::finished;
}

}  // namespace vericone
