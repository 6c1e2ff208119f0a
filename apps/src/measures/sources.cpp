// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/stop.h>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <future>
#include <semaphore>
#include <sstream>

#include "input/fields.h"
#include "input/scene.h"
#include "input/stopwatch.h"
#include "measures/sources.h"
#include "output/child.h"
#include "output/interrupt.h"
#include "scenarios/read_scenario.h"

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

class Sources::TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "vericone-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder " + name);
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
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

std::vector<std::string> out_words(const fs::path& out) {
  return {"--quiet", "--out", fs::absolute(out).string()};
}

/// Whether the command leaves files behind that nobody asked for; `cone` does not.
bool always_writes(const std::string& words) {
  constexpr const char* kWriters[] = {"accuracy", "campaign", "fit",      "gallery", "pursue", "scan",
                                      "shapes",   "signmap",  "simulate", "track",   "trials"};
  const std::string command = words.substr(0, words.find(' '));
  return std::find(std::begin(kWriters), std::end(kWriters), command) != std::end(kWriters);
}

}  // namespace

std::string Sources::output_of(const std::string& words, const std::vector<std::string>& more,
                               const std::string& path) {
  if (!show_(words, 0)) throw Interrupted{};
  return child_output(words, more, path);
}

std::string Sources::child_output(const std::string& words, const std::vector<std::string>& more,
                                  const std::string& path) const {
  std::vector<std::string> arguments = words_of(words);
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ChildOutput child = run_child(fs::read_symlink("/proc/self/exe"), arguments, folder_);
  if (interrupted()) throw Interrupted{};
  if (child.status == 0) return child.output;
  const std::string line = last_line(child.errors), said = line.substr(line.find(": ") + 2);
  // What failed outside of the program is no mistake of the paper.
  if (child.status != 2) throw std::runtime_error("vericone " + words + ": " + said);
  throw InputError(path, words, "a command that ends well; it says: " + said);
}

void Sources::prepare(const std::vector<std::string>& commands, int threads, const std::string& path) {
  struct Work {
    std::string words;
    std::unique_ptr<TemporaryFolder> folder;
    std::future<void> done;
  };
  std::vector<Work> list;
  for (const std::string& words : commands)
    if (!folders_.contains(words) &&
        std::none_of(list.begin(), list.end(), [&](const Work& work) { return work.words == words; }))
      list.push_back({words, std::make_unique<TemporaryFolder>(), {}});
  std::counting_semaphore<> free(threads);
  for (Work& work : list)
    work.done = std::async(std::launch::async, [&free, &work, &path, this] {
      free.acquire();
      struct Release {
        std::counting_semaphore<>& semaphore;
        ~Release() { semaphore.release(); }
      } const release{free};
      if (interrupted()) return;
      child_output(work.words, out_words(work.folder->path() / "out"), path);
    });
  std::size_t done = 0;
  bool stop = false;
  for (Work& work : list) {
    while (work.done.wait_for(std::chrono::milliseconds(200)) != std::future_status::ready)
      stop = !show_(work.words, double(done) / double(list.size())) || stop;
    ++done;
  }
  if (stop || interrupted()) throw Interrupted{};
  for (Work& work : list) {
    work.done.get();
    folders_[work.words] = std::move(work.folder);
  }
}

fs::path Sources::files(const std::string& words, const std::string& path) {
  std::unique_ptr<TemporaryFolder>& folder = folders_[words];
  if (!folder) {
    auto made = std::make_unique<TemporaryFolder>();
    carry_out(words, made->path() / "out", path);
    folder = std::move(made);
  }
  return folder->path() / "out";
}

const Table& Sources::table(const std::string& words, const std::string& file, const std::string& path) {
  if (const auto it = tables_.find({words, file}); it != tables_.end()) return it->second;
  const fs::path source = files(words, path) / file;
  if (source.extension() != ".csv" || !fs::exists(source))
    throw InputError(path, file, "a table that vericone " + words + " writes, such as engagements.csv");
  std::ifstream in(source, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return tables_[{words, file}] = table_of_csv(text.str());
}

const Json& Sources::answer(const std::string& words, const std::string& path) {
  const auto [it, fresh] = answers_.try_emplace(words);
  if (!fresh) return it->second;
  const TemporaryFolder folder;
  std::vector<std::string> more{"--json"};
  if (always_writes(words)) more.insert(more.end(), {"--quiet", "--out", (folder.path() / "out").string()});
  it->second = Json::parse(output_of(words, more, path), nullptr, false);
  return it->second;
}

void Sources::carry_out(const std::string& words, const fs::path& out, const std::string& path) {
  output_of(words, out_words(out), path);
}

}  // namespace vericone::paper
