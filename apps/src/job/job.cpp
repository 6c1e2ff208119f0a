// SPDX-License-Identifier: BSD-3-Clause
#include "job/job.h"

#include <unistd.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <ostream>
#include <tuple>

#include "input/stopwatch.h"
#include "job/kept_rows.h"
#include "output/figures.h"
#include "output/output_file.h"
#include "output/part.h"
#include "work/file_hash.h"
#include "work/interrupt.h"
#include "work/provenance.h"
#include "work/threads.h"

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

/// The words that say what the rows are: not where they go, or how.
std::vector<std::string> that_matter(const std::vector<std::string>& words) {
  return words_without(words, {"--out", "--part", "--threads"}, {"--quiet", "--json", "--no-figures"});
}

/// The rows of the part, with settings that say so.
work::ResumableTable rows_of_part(work::ResumableTable table, const Part& part) {
  table.settings += ", part " + part.text() + " of " + std::to_string(table.count) + " rows";
  std::tie(table.first, table.count) = share_of(table.count, part);
  return table;
}

/// Throws InputError naming --out where the folder holds another finished result than this part.
void require_no_other_result(const OutputOptions& options, const work::StagedFolder& folder,
                             const Part& part) {
  const std::filesystem::path file = folder.published(folder.path() / "provenance.json");
  if (!std::filesystem::exists(file)) return;
  const Json origin = Json::parse(content_of(file), nullptr, false);
  const Json* const there = origin.is_object() && origin.contains("part") ? &origin["part"] : nullptr;
  if (there && there->is_object() && there->value("number", 0U) == part.number &&
      there->value("of", 0U) == part.of && there->value("words", Json()) == that_matter(options.words))
    return;
  throw InputError(
      "--out", options.out,
      "a folder without another result, whose provenance.json is there; delete it to give that up");
}

/// False where an interruption came first.
bool fill(const Job::Table& job, work::StagedFolder& folder, const OutputOptions& options) {
  work::ResumableTable table = job.rows;
  if (shared && !shared(table)) return true;
  Bar bar(job.label, table.count - table.first, options.quiet);
  std::uint64_t done = 0;
  table.progress = [&](std::uint64_t next) {
    bar.show(done = next - table.first, false);
    return !interrupted();
  };
  const bool finished = run_table(table, folder);
  bar.show(done, true);
  return finished;
}

/// Publishes the tables of a part with what `merge` asks of them.
void publish_part(const Job& job, const Part& part, work::StagedFolder& folder, Json origin,
                  std::ostream& out) {
  Json& kept = origin["part"] = {{"number", part.number},
                                 {"of", part.of},
                                 {"words", that_matter(job.options.words)},
                                 {"tables", Json::array()}};
  for (const Job::Table& table : job.tables)
    kept["tables"].push_back({{"file", table.rows.name},
                              {"settings", table.rows.settings},
                              {"sha256", sha256_of_file(folder.resumable(table.rows.name))}});
  write_whole(folder.path() / "provenance.json", origin.dump(1) + "\n");
  folder.publish();
  if (job.options.json)
    out << kept.dump(1) << '\n';
  else
    out << "part " << part.text() << " is in " << job.options.out
        << "; vericone merge puts all parts together\n";
}

}  // namespace

void share_rows(std::function<bool(work::ResumableTable&)> with) { shared = std::move(with); }

int publish(const Results& found, const OutputOptions& options, work::StagedFolder& folder,
            std::ostream& out) {
  write_whole(folder.path() / found.summary_file, found.summary.dump(1) + "\n");
  write_whole(folder.path() / "provenance.json", found.origin.dump(1) + "\n");
  if (options.figures)
    for (const char* script : found.scripts) draw_figures(script, folder.path());
  const std::vector<std::filesystem::path> files = folder.publish(found.old);
  if (options.json) {
    out << found.summary.dump(1) << '\n';
    return found.status;
  }
  out << found.text.str() << "tables    ";
  const std::filesystem::path shown = options.out;
  for (std::size_t i = 0; i < found.files.size(); ++i)
    out << (i ? ", " : "") << (shown / found.files[i]).string();
  out << '\n';
  for (const auto& picture : pictures_of(files)) out << "picture   " << picture.string() << '\n';
  return found.status;
}

int run_job(Job job, const std::function<void(Results&, work::StagedFolder&)>& tell, std::ostream& out) {
  const auto part = part_of(job.options.part);
  const int threads = threads_for(job.options.threads);
  const KeptRows kept(job.options.rows, job.tables.size());
  work::StagedFolder folder(job.options.out, "--out");
  const auto start = Clock::now();
  if (part) require_no_other_result(job.options, folder, *part);
  for (Job::Table& table : job.tables) {
    table.rows.threads = threads;
    if (part) table.rows = rows_of_part(std::move(table.rows), *part);
    if (fill(table, folder, job.options)) continue;
    if (!job.options.json)
      out << "interrupted; the same command goes on where it stopped (" << job.options.out << ")\n";
    return kExitInterrupted;
  }
  Results found;
  found.origin = provenance(job.options.command_line, threads, job.inputs);
  found.origin["seconds"] = seconds_since(start);
  if (part) {
    publish_part(job, *part, folder, std::move(found.origin), out);
    return 0;
  }
  tell(found, folder);
  for (const Job::Table& table : job.tables) {
    const std::string& name = table.rows.name;
    kept.write(table.rows, folder);
    found.old.push_back(sample_of(name));
    std::replace(found.files.begin(), found.files.end(), name, kept.file_of(name));
  }
  std::erase(found.files, "");
  const int status = publish(found, job.options, folder, out);
  for (const Job::Table& table : job.tables) kept.give_up_others(table.rows.name, job.options.out);
  return status;
}

}  // namespace vericone
