// SPDX-License-Identifier: BSD-3-Clause
#include "work/resumable_table.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "output/output_file.h"
#include "work/interrupt.h"

namespace vericone::work {
namespace {

bool has_no_number(const std::string& row) {
  std::istringstream cells(row);
  for (std::string cell; std::getline(cells, cell, ',');)
    if (cell == "nan" || cell == "-nan" || cell == "inf" || cell == "-inf") return true;
  return false;
}

/// Whether a line of an unfinished file is row `i`. One that does not look like a row is computed again.
bool is_row(const std::string& line, std::uint64_t i, const ResumableTable& table) {
  if (!line.starts_with(table.id(i) + ",")) return false;
  const bool plain = std::count(line.begin(), line.end(), ',') ==
                         std::count(table.header.begin(), table.header.end(), ',') &&
                     !has_no_number(line);
  return plain || line == table.row(i);
}

/// The first row that does not stand complete in an unfinished file, which is cut there.
std::uint64_t complete_rows(const std::filesystem::path& partial, const ResumableTable& table,
                            const std::string& field) {
  if (!std::filesystem::exists(partial)) return table.first;
  std::ifstream in(partial, std::ios::binary);
  std::string line;
  if (!std::getline(in, line) || in.eof()) return table.first;  // not even the first line: start anew
  if (line != table.settings)
    throw InputError(field, partial.parent_path().string(),
                     "a folder without the unfinished run of other settings that " +
                         partial.filename().string() + " holds; delete that file to give it up");
  if (!std::getline(in, line) || in.eof() || line != table.header) return table.first;
  std::uint64_t rows = table.first;
  std::uintmax_t length = table.settings.size() + table.header.size() + 2;
  while (rows < table.count && std::getline(in, line) && !in.eof()) {
    if (!is_row(line, rows, table))
      throw InputError(field, partial.parent_path().string(),
                       "a folder whose " + partial.filename().string() + " has row " + table.id(rows) +
                           " in line " + std::to_string(rows - table.first + 3) +
                           "; delete that file to begin anew");
    length += line.size() + 1;
    ++rows;
  }
  in.close();
  std::filesystem::resize_file(partial, length);
  return rows;
}

/// compute_rows() where others compute them.
bool gather_rows(const ResumableTable& table, std::uint64_t first,
                 const std::function<void(std::string_view)>& write) {
  for (std::uint64_t begin = first, end = first; begin < table.count; begin = end) {
    end = begin + std::min(table.block, table.count - begin);
    const std::string rows = table.rows(begin, end);
    checkpoint();
    if (interrupted()) return false;
    const auto lines = std::count(rows.begin(), rows.end(), '\n');
    if (static_cast<std::uint64_t>(lines) != end - begin)
      throw std::runtime_error("got " + std::to_string(lines) + " rows for those from " +
                               std::to_string(begin) + " to " + std::to_string(end));
    write(rows);
    if (table.progress && !table.progress(end)) return end == table.count;
  }
  return true;
}

}  // namespace

bool compute_rows(const ResumableTable& table, std::uint64_t first,
                  const std::function<void(std::string_view)>& write) {
  if (table.rows) return gather_rows(table, first, write);
  std::mutex mutex;
  std::condition_variable ready;
  std::map<std::uint64_t, std::string> blocks;
  std::exception_ptr failure;
  std::atomic<bool> stopped{false};
  std::atomic<std::uint64_t> next{first};
  const auto compute = [&](const Stop* stop) {
    const StopScope scope(stop);
    try {
      while (!interrupted() && !stopped) {
        const std::uint64_t begin = next.fetch_add(table.block);
        if (begin >= table.count) return;
        std::string text;
        for (std::uint64_t i = begin; i < std::min(begin + table.block, table.count); ++i) {
          if (interrupted() || stopped) return;
          text += table.row(i) + "\n";
        }
        const std::lock_guard lock(mutex);
        blocks[begin] = std::move(text);
        ready.notify_one();
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
      ready.notify_one();
    }
  };
  std::vector<std::jthread> threads;
  threads.reserve(static_cast<std::size_t>(table.threads));
  for (int i = 0; i < table.threads; ++i) threads.emplace_back(compute, stop_of_this_thread());
  std::uint64_t written = first;
  try {
    while (written < table.count && !interrupted()) {
      std::map<std::uint64_t, std::string> come;
      {
        std::unique_lock lock(mutex);
        if (!blocks.contains(written) && !failure) ready.wait_for(lock, std::chrono::milliseconds(100));
        if (failure) std::rethrow_exception(failure);
        while (!blocks.empty() && blocks.begin()->first == written + come.size() * table.block)
          come.insert(blocks.extract(blocks.begin()));
      }
      checkpoint();
      for (const auto& [begin, text] : come) {
        write(text);
        written = std::min(begin + table.block, table.count);
        if (table.progress && !table.progress(written)) stopped = true;
        if (stopped) break;
      }
      if (come.empty() && table.progress && !table.progress(written)) stopped = true;
      if (stopped) break;
    }
  } catch (...) {
    stopped = true;
    throw;  // once the threads have ended
  }
  stopped = true;
  return written == table.count;
}

bool run_table(const ResumableTable& table, StagedFolder& folder) {
  const std::filesystem::path partial = folder.resumable(table.name);
  const std::uint64_t done = complete_rows(partial, table, folder.field());
  const bool goes_on = done > table.first;
  OutputFile out(partial, goes_on ? OutputFile::Start::at_end : OutputFile::Start::anew);
  if (!goes_on) out.write(table.settings + "\n" + table.header + "\n");
  if (table.progress && !table.progress(done)) return false;
  const bool finished = compute_rows(table, done, [&](std::string_view rows) { out.write(rows); });
  out.close();
  return finished;
}

}  // namespace vericone::work
