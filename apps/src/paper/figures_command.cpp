// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/scenarios/scenario_files.h>
#include <vericone/work/staged_folder.h>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "commands.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/output_file.h"
#include "output/output_options.h"
#include "output/progress.h"
#include "paper/paper.h"
#include "paper/papers_folder.h"
#include "work/interrupt.h"
#include "work/provenance.h"
#include "work/threads.h"

namespace vericone::paper {
namespace {

namespace fs = std::filesystem;

/// `out` empty: out/ and the paper's name.
struct FiguresOptions : OutputOptions {
  std::vector<std::string> ids;  // empty: all
  std::string paper;             // its folder, or the name of one of ours; empty: papers/dhal2022
  std::string scenario;  // file in place of the one scenario that the figures show; empty: the paper's
  std::vector<std::string> set;  // PATH=VALUE, in the scenarios that the figures show
  bool list = false;
};

/// The scenarios that a figure shows, each once.
std::vector<std::string> scenarios_of(const Figure& figure) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const auto& [role, scenario] : figure.runs) add(scenario);
  for (const Panel& panel : figure.panels)
    for (const Line& line : panel.lines) add(line.series.run);
  return names;
}

Changes changes_of(const FiguresOptions& options, const std::vector<Figure>& figures) {
  Changes changes;
  for (const std::string& text : options.set) changes.values.push_back(read_change(text, "--set"));
  changes.file = options.scenario;
  if (!changes.any()) return changes;
  for (const Figure& figure : figures)
    for (const std::string& scenario : scenarios_of(figure)) changes.scenarios.insert(scenario);
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
  Maker(const FiguresOptions& options, const fs::path& out, Paper& paper, const std::vector<Figure>& figures,
        Progress& progress)
      : options_(options),
        paper_(paper),
        changes_(changes_of(options, figures)),
        progress_(progress),
        out_(out),
        sources_(
            paper.folder,
            [&](const std::string& what, double share) { return progress_.show("running " + what, share); },
            changes_),
        measures_(sources_) {}

  /// What figures read of other commands, those that use one processor at the same time.
  void prepare(const std::vector<Figure>& figures) {
    std::vector<std::string> commands;
    const auto add = [&](const std::string& words) {
      if (words.starts_with("pursue ") && words.find(" --starts ") == std::string::npos)
        commands.push_back(words);
    };
    for (const Figure& figure : figures) {
      for (const auto& [role, words] : figure.data) add(words);
      for (const Panel& panel : figure.panels)
        for (const Line& line : panel.lines) add(line.series.command);
    }
    sources_.prepare(commands, threads_for(0), "figures.yaml: command");
  }

  void make(const Figure& figure, double share) {
    const std::vector<std::string> scenarios = scenarios_of(figure);
    for (const std::string& scenario : scenarios) write_run(scenario);
    if (!progress_.show("figure " + figure.id, share)) throw Interrupted{};
    work::StagedFolder folder(out_, "--out");
    Json origin{{"figure", figure.id}, {"caption", figure.caption}};
    if (!figure.command.empty())
      carry_out(figure, folder.path(), origin);
    else
      draw(figure, folder.path(), origin);
    std::vector<fs::path> inputs;
    for (const std::string& scenario : scenarios) inputs.push_back(sources_.run(scenario, "").file);
    if (changes_.any() && !scenarios.empty()) origin["changed"] = changed();
    // Other commands compute in parallel.
    origin["provenance"] =
        provenance(options_.command_line, figure.command.empty() ? 1 : threads_for(0), inputs);
    write_whole(folder.path() / (figure.name() + ".json"), origin.dump(1) + "\n");
    folder.publish({});
  }

  /// Claims beside all figures that are there, also those of earlier commands.
  void report() {
    const Which which = [&](const Claim& claim) {
      return std::any_of(claim.figures.begin(), claim.figures.end(),
                         [&](const std::string& id) { return fs::exists(out_ / ("fig-" + id + ".json")); });
    };
    const std::vector<Claim> claims = paper_.measured_claims(sources_, which);
    progress_.show("report", 0);
    const Json json =
        claims_json(claims, paper_, which, options_.command_line, changes_.any() ? changed() : Json());
    work::StagedFolder folder(out_, "--out");
    write_whole(folder.path() / "claims.json", json.dump(1) + "\n");
    Json page{{"paper", paper_.name()}, {"title", paper_.title}, {"references", paper_.references}};
    page.update(json);
    page["figures"] = Json::array();
    for (const Figure& figure : paper_.figures) {
      const std::string origin = content_of(out_ / (figure.name() + ".json"));
      page["figures"].push_back(
          {{"id", figure.id},
           {"name", figure.name()},
           {"caption", figure.caption},
           {"picture", "../" + figure.name() + ".png"},  // the stage stands in the folder
           {"origin", origin.empty() ? Json() : Json::parse(origin, nullptr, false)}});
    }
    write_whole(folder.path() / "report.json", page.dump(1) + "\n");
    draw_figures("report.py", folder.path());
    fs::remove(folder.path() / "report.json");
    folder.publish({"report.html"});
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
    const PaperRun& run = sources_.run(name, "figures.yaml: runs");
    work::StagedFolder folder(out_ / "runs" / name, "--out");
    scenario::write_run(
        run.scenario, run.run,
        {run.file, provenance(options_.command_line, 1, {run.file}).dump(), run.seconds, run.text},
        folder.path());
    folder.publish({"planes.csv"});
  }

  /// The points of a line; null where a formula has no value, which is a gap.
  Json points(const Line& line, Rows rows, const std::string& name, const std::string& body) {
    Json xs = Json::array(), ys = Json::array();
    bool any = false;
    const std::vector<double> x = measures_.column(line.x, rows, paper_.figure_values),
                              y = measures_.column(line.y, rows, paper_.figure_values);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!rows.counts[i]) continue;
      xs.push_back(number_or_null(x[i]));
      ys.push_back(number_or_null(y[i]));
      any = any || std::isfinite(x[i] + y[i]);
    }
    if (!any) return nullptr;
    return {{"name", name},          {"body", body}, {"dashed", line.dashed},
            {"filled", line.filled}, {"x", xs},      {"y", ys}};
  }

  Json lines_of(const Line& line) {
    Json lines = Json::array();
    const auto add = [&](const Series& series, const std::string& word) {
      const std::string body = !word.empty()                  ? word
                               : !series.word("body").empty() ? series.word("body")
                                                              : series.word("obstacle");
      const std::string name = !line.name.empty() ? line.name + (word.empty() ? "" : " " + word)
                               : !word.empty()    ? word
                               : !body.empty()    ? body
                                                  : line.y.path();
      Json points = this->points(line, measures_.rows(series, paper_.figure_values), name, body);
      if (!points.is_null()) lines.push_back(std::move(points));
    };
    if (line.each.empty()) {
      add(line.series, "");
      return lines;
    }
    for (const std::string& word : measures_.words(line.series, line.each, paper_.figure_values)) {
      Series one = line.series;
      one.words.emplace_back(line.each, word);
      add(one, word);
    }
    return lines;
  }

  void draw(const Figure& figure, const fs::path& stage, Json& origin) {
    Json task = figure.parameters.is_null() ? Json::object() : figure.parameters;
    task["name"] = figure.name();
    task["runs"] = Json::object();
    if (figure.columns > 0) task["columns"] = figure.columns;
    // The stage stands in the folder.
    for (const auto& [role, scenario] : figure.runs) {
      task["runs"][role] = (fs::path("..") / "runs" / scenario).string();
      origin["runs"][role] = "runs/" + scenario;
    }
    for (const auto& [role, words] : figure.data) {
      task["data"][role] = sources_.files(words, "figures.yaml: data").string();
      origin["data"][role] = "vericone " + words;
    }
    for (const Panel& panel : figure.panels) {
      Json drawn = panel.look;
      drawn["lines"] = Json::array();
      for (const Line& line : panel.lines)
        for (Json& points : naming("figures.yaml", [&] { return lines_of(line); }))
          drawn["lines"].push_back(std::move(points));
      task["panels"].push_back(std::move(drawn));
    }
    write_whole(stage / "figure.json", task.dump(1) + "\n");
    const std::string script =
        !figure.script.empty() ? fs::absolute(paper_.folder / "figures" / figure.script).string()
                               : "drawings/" + (figure.drawing.empty() ? "panels" : figure.drawing) + ".py";
    draw_figures(script, stage);
    fs::remove(stage / "figure.json");
    origin["script"] = figure.script.empty() ? script : "figures/" + figure.script;
    if (!figure.parameters.is_null()) origin["parameters"] = figure.parameters;
  }

  void carry_out(const Figure& figure, const fs::path& stage, Json& origin) {
    const fs::path made = sources_.files(figure.command, "figures.yaml: command");
    for (const char* extension : {".png", ".pdf"})
      if (fs::exists(made / (figure.picture + extension)))
        fs::copy(made / (figure.picture + extension), stage / (figure.name() + extension));
    if (!figure.table.empty() && !fs::exists(made / figure.table))
      throw InputError("figures.yaml: table", figure.table,
                       "a file that vericone " + figure.command + " writes");
    if (!figure.table.empty()) fs::copy(made / figure.table, stage / (figure.name() + ".csv"));
    origin["made_by"] = "vericone " + figure.command;
  }

  const FiguresOptions& options_;
  Paper& paper_;
  Changes changes_;
  Progress& progress_;
  fs::path out_;
  Sources sources_;
  Measures measures_;
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

/// `vericone figures`: makes the figures of a paper, each as PDF, PNG, CSV and JSON of its provenance, the
/// runs they show, claims.json and report.html. Returns the exit status, 130 interrupted. Throws InputError.
int run_figures(const FiguresOptions& options, std::ostream& out) {
  Paper paper(options.paper);
  const std::vector<Figure> figures = paper.chosen(options.ids);
  if (options.list) {
    print_list(figures, options.json, out);
    return 0;
  }
  const fs::path folder = options.out.empty() ? fs::path("out") / paper.name() : fs::path(options.out);
  const work::StagedFolder whole(folder, "--out");
  const auto start = Clock::now();
  try {
    Progress progress(options.quiet);
    Maker maker(options, folder, paper, figures, progress);
    maker.prepare(figures);
    double made = 0;
    for (const Figure& figure : figures) maker.make(figure, made++ / double(figures.size()));
    maker.report();
  } catch (const Interrupted&) {
    return kExitInterrupted;
  }
  const double seconds = seconds_since(start);
  const fs::path report = folder / "report.html";  // not there without Python
  if (options.json) {
    out << Json{{"figures", list_json(figures)},
                {"folder", folder.string()},
                {"claims", (folder / "claims.json").string()},
                {"report", fs::exists(report) ? Json(report.string()) : Json()},
                {"seconds", seconds}}
               .dump(1)
        << '\n';
    return 0;
  }
  out << "figures             " << figures.size() << ", as PDF, PNG, CSV and JSON, in " << folder.string()
      << '\n'
      << "claims              " << (folder / "claims.json").string() << '\n';
  if (fs::exists(report)) out << "report              " << report.string() << '\n';
  out << "time                " << short_text(seconds, 3) << " s\n";
  return 0;
}

}  // namespace

}  // namespace vericone::paper

namespace vericone {

int figures_command(CommandLine& line) {
  paper::FiguresOptions figures;
  line.option("figures", figures.ids, "Their numbers (docs/reference/papers.md); all if not given");
  line.option("--paper", figures.paper,
              "Its folder, or the name of one of ours; papers/dhal2022 if not given");
  line.option("--out", figures.out,
              "Folder for pictures, tables and report; out/ and the paper's name if not given");
  line.option("--scenario", figures.scenario, "Scenario file in place of the one that these figures show");
  line.option("--set", figures.set, "PATH=VALUE changes a field of their scenarios: bodies.F1.pilot.gain=8")
      .one_each();
  line.flag("--list", figures.list, "Print numbers and captions, make nothing");
  line.flag("--quiet", figures.quiet, "No progress");
  line.flag("--json", figures.json, "Print JSON: figures and the files of the report");
  line.read();
  figures.command_line = line.text();
  return paper::run_figures(figures, std::cout);
}

}  // namespace vericone
