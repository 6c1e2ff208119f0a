// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <algorithm>
#include <chrono>
#include <future>
#include <semaphore>
#include <sstream>

#include "input/fields.h"
#include "input/scene.h"
#include "input/stopwatch.h"
#include "measures/sources.h"
#include "output/child.h"
#include "output/output_file.h"
#include "output/shared_folder.h"
#include "output/temporary_folder.h"
#include "scenarios/read_scenario.h"
#include "work/interrupt.h"

namespace vericone::paper {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

}  // namespace

struct Sources::Carried {
  TemporaryFolder folder;
  Json answer;

  [[nodiscard]] fs::path files() const { return folder.path() / "out"; }
};

Sources::~Sources() = default;

Sources::Sources(fs::path folder, Show show, Changes changes)
    : folder_(std::move(folder)), show_(std::move(show)), changes_(std::move(changes)) {}

const PaperRun& Sources::run(const std::string& name, const std::string& path) {
  std::unique_ptr<PaperRun>& run = runs_[name];
  if (run) return *run;
  auto made = std::make_unique<PaperRun>();
  const bool changed = changes_.scenarios.contains(name);
  const bool own = !changed || changes_.file.empty();
  made->file = own ? folder_ / "scenarios" / (name + ".yaml") : changes_.file;
  if (own && !fs::exists(made->file))
    throw InputError(path, name, "a scenario: there is no scenarios/" + name + ".yaml");
  made->text = input::read_scene_text(made->file.string());
  made->fields = input::scene_fields(made->text, made->file.string());
  if (changed && !changes_.values.empty()) {
    for (const auto& [field, value] : changes_.values) set_field(made->fields, field, value);
    made->text = made->fields.dump(1) + "\n";  // JSON is YAML
  }
  made->scenario =
      scenario::read_scenario(made->fields, made->file.stem().string(), made->file.parent_path());
  simulation::RunOptions options;
  options.progress = [&](double t) { return show_(name, t / made->scenario.duration); };
  const auto start = Clock::now();
  made->run = simulation::simulate(made->scenario, options);
  made->seconds = seconds_since(start);
  if (made->run.interrupted) throw Interrupted{};
  run = std::move(made);
  return *run;
}

namespace {

/// Whether the command leaves files behind that nobody asked for; `cone` does not.
bool always_writes(const std::string& words) {
  constexpr const char* kWriters[] = {"accuracy", "campaign", "fit",      "gallery", "pursue", "scan",
                                      "shapes",   "signmap",  "simulate", "track",   "trials"};
  const std::string command = words.substr(0, words.find(' '));
  return std::find(std::begin(kWriters), std::end(kWriters), command) != std::end(kWriters);
}

}  // namespace

std::unique_ptr<Sources::Carried> Sources::carry_out(const std::string& words, bool files,
                                                     const std::string& path) const {
  auto carried = std::make_unique<Carried>();
  std::vector<std::string> arguments = words_of(words);
  arguments.emplace_back("--json");
  if (files) arguments.insert(arguments.end(), {"--quiet", "--out", carried->files().string()});
  const ChildOutput child = run_child(own_program(), arguments, folder_);
  if (interrupted()) throw Interrupted{};
  if (child.status == 0) {
    carried->answer = Json::parse(child.output, nullptr, false);
    return carried;
  }
  const std::string line = last_line(child.errors), said = line.substr(line.find(": ") + 2);
  // What failed outside of the program is no mistake of the paper.
  if (child.status != 2) throw std::runtime_error("vericone " + words + ": " + said);
  throw InputError(path, words, "a command that ends well; it says: " + said);
}

const Sources::Carried& Sources::carried(const std::string& words, bool files, const std::string& path) {
  std::unique_ptr<Carried>& known = carried_[words];
  files = files || always_writes(words);
  if (!known || (files && !fs::exists(known->files()))) {
    if (!show_(words, 0)) throw Interrupted{};
    known = carry_out(words, files, path);
  }
  return *known;
}

void Sources::prepare(const std::vector<std::string>& commands, int threads, const std::string& path) {
  struct Work {
    std::string words;
    std::future<std::unique_ptr<Carried>> done;
  };
  std::vector<Work> list;
  for (const std::string& words : commands)
    if (!carried_.contains(words) &&
        std::none_of(list.begin(), list.end(), [&](const Work& work) { return work.words == words; }))
      list.push_back({words, {}});
  std::counting_semaphore<> free(threads);
  for (Work& work : list)
    work.done = std::async(std::launch::async, [&free, &work, &path, this] {
      free.acquire();
      struct Release {
        std::counting_semaphore<>& semaphore;
        ~Release() { semaphore.release(); }
      } const release{free};
      if (interrupted()) throw Interrupted{};
      return carry_out(work.words, true, path);
    });
  std::size_t done = 0;
  bool stop = false;
  for (Work& work : list) {
    while (work.done.wait_for(std::chrono::milliseconds(200)) != std::future_status::ready)
      stop = !show_(work.words, double(done) / double(list.size())) || stop;
    ++done;
  }
  if (stop || interrupted()) throw Interrupted{};
  for (Work& work : list) carried_[work.words] = work.done.get();
}

fs::path Sources::files(const std::string& words, const std::string& path) {
  return carried(words, true, path).files();
}

const Table& Sources::table(const std::string& words, const std::string& file, const std::string& path) {
  if (const auto it = tables_.find({words, file}); it != tables_.end()) return it->second;
  const fs::path source = files(words, path) / file;
  if (source.extension() != ".csv" || !fs::exists(source))
    throw InputError(path, file, "a table that vericone " + words + " writes, such as engagements.csv");
  return tables_[{words, file}] = table_of(simulation::table_of_csv(content_of(source), file));
}

const Json& Sources::answer(const std::string& words, const std::string& path) {
  return carried(words, false, path).answer;
}

}  // namespace vericone::paper
