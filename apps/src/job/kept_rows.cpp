// SPDX-License-Identifier: BSD-3-Clause
#include "job/kept_rows.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <charconv>
#include <fstream>
#include <queue>
#include <stdexcept>
#include <string_view>

#include "command/catalogue.h"
#include "command/find_program.h"
#include "output/child.h"
#include "output/output_file.h"

namespace vericone {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestSample = 1'000'000;  // 8 MB of hashes

/// A bijection (the finaliser of SplitMix64, Steele, Lea and Flood 2014): no two rows have the same.
std::uint64_t hash(std::uint64_t row) {
  std::uint64_t x = row + 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

/// The largest hash of the sample.
std::uint64_t threshold(std::uint64_t rows, std::uint64_t sample) {
  std::priority_queue<std::uint64_t> least;
  for (std::uint64_t i = 0; i < rows; ++i) {
    if (least.size() == sample && hash(i) >= least.top()) continue;
    if (least.size() == sample) least.pop();
    least.push(hash(i));
  }
  return least.empty() ? 0 : least.top();
}

void write_sample(const fs::path& rows, std::uint64_t count, std::uint64_t sample, const fs::path& to) {
  const std::uint64_t last = threshold(count, sample);
  std::ifstream in(rows, std::ios::binary);
  OutputFile out(to);
  std::string line;
  std::getline(in, line);
  out.write(line + ", a sample of " + std::to_string(std::min(count, sample)) + " rows\n");
  std::getline(in, line);
  out.write(line + "\n");
  for (std::uint64_t i = 0; std::getline(in, line); ++i)
    if (hash(i) <= last) out.write(line + "\n");
  if (in.bad()) throw std::runtime_error(rows.string() + ": could not be read");
  out.close();
}

}  // namespace

std::string sample_of(const std::string& table) { return fs::path(table).stem().string() + ".sample.csv"; }

KeptRows::KeptRows(const std::string& text, std::size_t tables) : none_(text == "none") {
  if (text.empty() || none_) return;
  const auto refuse = [&](const std::string& requirement) { throw InputError("--rows", text, requirement); };
  constexpr std::string_view kSample = "sample:";
  if (text.starts_with(kSample)) {
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data() + kSample.size(), end, sample_);
    if (error != std::errc() || read != end || sample_ < 1 || sample_ > kLargestSample)
      refuse("sample:N, N from 1 to " + std::to_string(kLargestSample));
    return;
  }
  file_ = text;
  const fs::path extension = fs::path(text).extension();
  if (fs::path(text).filename() != text || (extension != ".csv" && extension != ".h5"))
    refuse("none, sample:N, or the name of a file in --out that ends with .csv or .h5");
  if (tables > 1) refuse("none or sample:N: there are " + std::to_string(tables) + " tables");
  if (extension == ".csv") return;
  if (const auto program = find_program("rows")) converter_ = *program;
  if (converter_.empty()) refuse("a name that ends with .csv; HDF5 needs " + find_entry("rows")->needs);
}

std::string KeptRows::file_of(const std::string& table) const {
  if (sample_ > 0) return sample_of(table);
  return none_ || !file_.empty() ? file_ : table;
}

void KeptRows::write(const work::ResumableTable& table, work::StagedFolder& folder) const {
  const fs::path rows = folder.resumable(table.name), file = folder.path() / file_of(table.name);
  if (!file_.empty() && fs::exists(file))
    throw InputError("--rows", file_, "the name of no other file in --out");
  if (sample_ > 0) write_sample(rows, table.count, sample_, file);
  if (converter_.empty()) return;
  const ChildOutput done = run_child(converter_, {rows.string(), "--out", file.string(), "--quiet"});
  if (done.status != 0) throw std::runtime_error(last_line(done.errors));
}

void KeptRows::give_up_others(const std::string& table, const fs::path& folder) const {
  const std::string file = file_of(table);
  if (file == table) return;
  if (file.empty() || sample_ > 0 || !converter_.empty())
    fs::remove(folder / table);
  else
    fs::rename(folder / table, folder / file);
}

}  // namespace vericone
