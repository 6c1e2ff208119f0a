// SPDX-License-Identifier: BSD-3-Clause
#include "paper/figures_command.h"

#include <vericone/geometry/error.h>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <set>
#include <sstream>

#include "accuracy/accuracy.h"
#include "claims.h"
#include "figure.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/interrupt.h"
#include "output/progress.h"
#include "output/provenance.h"
#include "output/staged_folder.h"
#include "output/threads.h"
#include "paper/papers_folder.h"
#include "report.h"
#include "simulate/run_files.h"

namespace vericone {
namespace {

namespace fs = std::filesystem;
using dhal2022::Figure;

constexpr std::uint64_t kEngagements = 1000;  // of Fig 6.5; `vericone accuracy` makes it of 10,000

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return in ? text.str() : std::string();
}

dhal2022::Changes changes_of(const FiguresOptions& options, const std::vector<Figure>& figures) {
  dhal2022::Changes changes;
  for (const std::string& text : options.set) changes.values.push_back(dhal2022::read_change(text, "--set"));
  changes.file = options.scenario;
  if (!changes.any()) return changes;
  for (const Figure& figure : figures)
    for (const auto& [role, scenario] : figure.runs) changes.scenarios.insert(scenario);
  std::string names;
  for (const std::string& name : changes.scenarios) names.append(names.empty() ? "" : ", ").append(name);
  if (changes.scenarios.empty())
    throw InputError(options.set.empty() ? "--scenario" : "--set",
                     options.set.empty() ? options.scenario : options.set.front(),
                     "left out: these figures show no scenario");
  if (!options.scenario.empty() && changes.scenarios.size() > 1)
    throw InputError("--scenario", options.scenario, "for figures of one scenario; these show " + names);
  return changes;
}

class Maker {
 public:
  Maker(const FiguresOptions& options, const std::vector<Figure>& figures, Progress& progress)
      : options_(options),
        changes_(changes_of(options, figures)),
        progress_(progress),
        out_(options.out),
        show_(
            [&](const std::string& what, double share) { return progress_.show("running " + what, share); }),
        runs_(papers_folder() / "dhal2022" / "scenarios", show_, changes_) {}

  void make(const Figure& figure, double share) {
    for (const auto& [role, scenario] : figure.runs) write_run(scenario);
    if (!progress_.show("figure " + figure.id, share)) throw dhal2022::Interrupted{};
    StagedFolder folder(out_, "--out");
    Json origin{{"figure", figure.id}, {"caption", figure.caption}};
    if (figure.script.empty())
      measure_accuracy(figure, folder.path(), origin);
    else
      draw(figure, folder.path(), origin);
    std::vector<fs::path> inputs;
    for (const auto& [role, scenario] : figure.runs) inputs.push_back(runs_.run(scenario).file);
    // Fig 6.5 alone is computed in parallel.
    if (changes_.any() && !figure.runs.empty()) origin["changed"] = changed();
    origin["provenance"] =
        provenance(options_.command_line, figure.script.empty() ? threads_for(0) : 1, inputs);
    write_whole(folder.path() / (figure.name() + ".json"), origin.dump(1) + "\n");
    folder.publish({});
  }

  /// Claims beside all figures that are there, also those of earlier commands.
  void report() {
    const std::vector<dhal2022::Claim> claims = dhal2022::measure_claims(runs_, show_);
    progress_.show("report", 0);
    std::vector<dhal2022::ReportFigure> shown;
    for (const Figure& figure : dhal2022::all_figures()) {
      dhal2022::ReportFigure entry{figure, content_of(out_ / (figure.name() + ".png")), Json()};
      const std::string origin = content_of(out_ / (figure.name() + ".json"));
      if (!entry.png.empty() && !origin.empty()) entry.provenance = Json::parse(origin, nullptr, false);
      shown.push_back(std::move(entry));
    }
    Json list = Json::array();
    for (const auto& claim : claims) list.push_back(dhal2022::to_json(claim));
    Json origin = provenance(options_.command_line, 1, scenario_files());
    if (changes_.any()) origin["changed"] = changed();
    StagedFolder folder(out_, "--out");
    write_whole(
        folder.path() / "claims.json",
        Json{{"claims", list}, {"verdicts", dhal2022::count_verdicts(claims)}, {"provenance", origin}}.dump(
            1) +
            "\n");
    write_whole(folder.path() / "report.html", dhal2022::report_html(shown, claims, origin));
    folder.publish({});
  }

 private:
  Json changed() const {
    Json result{{"scenarios", changes_.scenarios}};
    if (!changes_.file.empty()) result["file"] = changes_.file.string();
    for (const auto& [path, value] : changes_.values) result["set"][path] = value;
    return result;
  }

  void write_run(const std::string& name) {
    if (!written_.insert(name).second) return;
    const dhal2022::PaperRun& run = runs_.run(name);
    StagedFolder folder(out_ / "runs" / name, "--out");
    scenario::write_run(run.scenario, run.run, {run.file, options_.command_line, run.seconds, run.text},
                        folder.path());
    folder.publish({"planes.csv"});
  }

  void draw(const Figure& figure, const fs::path& stage, Json& origin) {
    Json task = figure.parameters.is_null() ? Json::object() : figure.parameters;
    task["name"] = figure.name();
    task["runs"] = Json::object();
    // The stage stands in the folder.
    for (const auto& [role, scenario] : figure.runs)
      task["runs"][role] = (fs::path("..") / "runs" / scenario).string();
    write_whole(stage / "figure.json", task.dump(1) + "\n");
    draw_figures((papers_folder() / "dhal2022" / "figures" / figure.script).string(), stage);
    fs::remove(stage / "figure.json");
    origin["script"] = "papers/dhal2022/figures/" + figure.script;
    for (const auto& [role, scenario] : figure.runs) origin["runs"][role] = "runs/" + scenario;
    if (!figure.parameters.is_null()) origin["parameters"] = figure.parameters;
  }

  void measure_accuracy(const Figure& figure, const fs::path& stage, Json& origin) {
    accuracy::Options accuracy;
    accuracy.engagements = kEngagements;
    accuracy.out = (stage / "accuracy").string();
    accuracy.quiet = true;
    accuracy.command_line = options_.command_line;
    std::ostringstream unused;
    if (accuracy::run_accuracy(accuracy, unused) == kExitInterrupted) throw dhal2022::Interrupted{};
    for (const char* extension : {".png", ".pdf"}) {
      const fs::path picture = stage / "accuracy" / (std::string("accuracy") + extension);
      if (fs::exists(picture)) fs::rename(picture, stage / (figure.name() + extension));
    }
    fs::rename(stage / "accuracy" / "engagements.csv", stage / (figure.name() + ".csv"));
    fs::remove_all(stage / "accuracy");
    origin["script"] = "apps/figures/accuracy.py";
    origin["engagements"] = kEngagements;
    origin["seed"] = accuracy.seed;
  }

  const FiguresOptions& options_;
  dhal2022::Changes changes_;
  Progress& progress_;
  fs::path out_;
  dhal2022::RunProgress show_;
  dhal2022::PaperRuns runs_;
  std::set<std::string> written_;
};

Json list_json(const std::vector<Figure>& figures) {
  Json list = Json::array();
  for (const Figure& figure : figures) list.push_back({{"figure", figure.id}, {"caption", figure.caption}});
  return list;
}

void print_list(const std::vector<Figure>& figures, bool json, std::ostream& out) {
  if (json) {
    out << list_json(figures).dump(1) << '\n';
    return;
  }
  for (const Figure& figure : figures) out << figure.id << "\t" << figure.caption << '\n';
}

}  // namespace

int run_figures(const FiguresOptions& options, std::ostream& out) {
  const std::vector<Figure> figures = dhal2022::choose_figures(options.ids);
  if (options.list) {
    print_list(figures, options.json, out);
    return 0;
  }
  const OutputFolder whole(options.out, "--out");
  const auto start = Clock::now();
  try {
    Progress progress(options.quiet);
    Maker maker(options, figures, progress);
    double made = 0;
    for (const Figure& figure : figures) maker.make(figure, made++ / double(figures.size()));
    maker.report();
  } catch (const dhal2022::Interrupted&) {
    return kExitInterrupted;
  }
  const double seconds = seconds_since(start);
  const fs::path folder = options.out;
  if (options.json) {
    out << Json{{"figures", list_json(figures)},
                {"folder", folder.string()},
                {"claims", (folder / "claims.json").string()},
                {"report", (folder / "report.html").string()},
                {"seconds", seconds}}
               .dump(1)
        << '\n';
    return 0;
  }
  out << "figures             " << figures.size() << ", as PDF, PNG, CSV and JSON, in " << folder.string()
      << '\n'
      << "claims              " << (folder / "claims.json").string() << '\n'
      << "report              " << (folder / "report.html").string() << '\n'
      << "time                " << dhal2022::short_text(seconds, 3) << " s\n";
  return 0;
}

}  // namespace vericone
