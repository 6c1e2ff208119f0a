// SPDX-License-Identifier: BSD-3-Clause
#include "fit/solid_command.h"

#include <vericone/geometry/error.h>
#include <vericone/work/staged_folder.h>
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "fit/fit_body.h"
#include "fit/fit_picture.h"
#include "fit/hull_files.h"
#include "fit/solid_json.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/number_text.h"
#include "output/output_file.h"
#include "output/progress.h"
#include "work/interrupt.h"
#include "work/provenance.h"

namespace vericone {
namespace {

namespace fs = std::filesystem;
using fitting::SolidKind;

/// Of a list with commas.
std::vector<SolidKind> kinds_of(const std::string& text) {
  std::vector<SolidKind> kinds;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(',', from), text.size());
    const std::string word = text.substr(from, end - from);
    const auto found = std::find_if(fitting::kSolidKinds.begin(), fitting::kSolidKinds.end(),
                                    [&](SolidKind kind) { return fitting::to_string(kind) == word; });
    if (found == fitting::kSolidKinds.end() || std::find(kinds.begin(), kinds.end(), *found) != kinds.end())
      throw InputError("--kinds", text,
                       "some of sphere, capsule, cylinder, box, ellipsoid, with commas, each once");
    kinds.push_back(*found);
    from = end + 1;
  }
  return kinds;
}

/// What only quadrics have.
void require_of_solids(const FitCommandOptions& given) {
  const char* const option = given.kinds.empty() ? "--shape" : "--kinds";
  const std::string& value = given.kinds.empty() ? given.shape : given.kinds;
  const auto refuse = [&](const std::string& beside) {
    throw InputError(option, value, "given without " + beside);
  };
  if (given.mode != "containing") refuse("--mode " + given.mode + ": such bodies contain");
  if (given.coverage && *given.coverage != 1) refuse("--coverage: such bodies contain all points");
  if (!given.cone.empty()) refuse("--cone: vericone cone takes body.yaml");
}

/// What is wrong with the points is wrong with the file; what is wrong with an option has its name.
fitting::SolidFit solids_or_explain(const fits::Scan& scan, const fitting::SolidOptions& options) {
  try {
    return fitting::fit_solids(scan.sample, options);
  } catch (const InputError& e) {
    for (const char* option : {"margin", "pieces"})
      if (e.field() == option) throw InputError(std::string("--") + option, e.value(), e.requirement());
    throw InputError(scan.file, e.field() == "points" ? e.value() : e.field() + ": " + e.value(),
                     e.requirement());
  }
}

void solid_row(std::ostream& out, std::string label, const std::string& text) {
  label.resize(20, ' ');
  out << label << text << '\n';
}

void print_solids(const fits::Scan& scan, const fitting::SolidFit& fit, const Json& json, std::ostream& out) {
  const auto row = [&](const char* label, const std::string& text) { solid_row(out, label, text); };
  const auto range = [](const fitting::DistanceStatistics& d) {
    return "mean " + number_text(d.mean, 4) + " m, at most " + at_most_text(d.max, 4) + " m";
  };
  row("certified", (fit.certified ? "yes: " : "no: ") + fit::solid_statement(fit, scan));
  row("scan", fits::describe(scan) + " (" + fs::path(scan.file).filename().string() +
                  "), whose unit is taken as the metre");
  row("hull",
      fit::counts_of(fit.pieces) + ", containing" +
          (fit.pieces.size() > 1 ? ", union of " + std::to_string(fit.pieces.size()) + " pieces" : ""));
  std::string volume = number_within(fit.volume.value, fit.volume.error) + " m^3";
  for (const auto& [of, what] :
       {std::pair(fit.scan_volume, "the scan's"), std::pair(fit.convex_hull_volume, "the convex hull's"),
        std::pair(fit.ellipsoid_volume, "the least ellipsoid's")})
    if (of && *of > 0) volume += ", " + number_text(fit.volume.value / *of, 4) + " x " + what;
  row("volume", volume);
  if (fit.certified) row("coverage", "1, proved: no gap");
  row("protrusion", range(fit.protrusion) + ", of the union's boundary from the scan");
  row("scan to hull", range(fit.scan_to_hull));
  for (const Json& note : json["notes"]) row("note", note.get<std::string>());
  row("time", number_text(json["seconds"].get<double>(), 3) + " s");
}

struct SolidAnswer {
  fits::Scan scan;
  fitting::SolidFit result;
  std::string shape;
  Json json;
};

SolidAnswer solid_answer(const FitCommandOptions& given, const std::vector<SolidKind>& kinds,
                         Progress& progress) {
  SolidAnswer a;
  fitting::SolidOptions options;
  options.kinds = kinds;
  options.margin = given.margin;
  options.pieces = given.pieces;
  options.progress = [&](const std::string& what, double share) { return progress.show(what, share); };
  for (const SolidKind kind : kinds) a.shape += (a.shape.empty() ? "" : ",") + fitting::to_string(kind);
  progress.show("reading " + given.file, 0);
  a.scan = fits::read_scan(given.file);
  const auto start = Clock::now();
  a.result = solids_or_explain(a.scan, options);
  const double seconds = seconds_since(start);
  a.json = fit::solid_fit_json(a.scan, options, a.shape, a.result);
  a.json["seconds_read"] = a.scan.seconds;
  a.json["seconds"] = seconds;
  return a;
}

void write_solids(const SolidAnswer& a, const FitCommandOptions& given, const fs::path& stage,
                  Progress& progress) {
  const std::string title =
      fs::path(a.scan.file).filename().string() + ": containing, " + fit::counts_of(a.result.pieces);
  std::vector<CombinedSurface> surfaces;
  std::vector<Json> bodies;
  for (const fitting::Solid& solid : a.result.pieces) {
    surfaces.push_back(fitting::surface(solid));
    bodies.push_back(fit::solid_fields(solid));
  }
  write_whole(stage / "fit.json", json_text(a.json) + "\n");
  write_whole(stage / "body.yaml", fit::body_yaml(bodies, "Fitted to " + title));
  write_whole(stage / "hull.obj", fit::hull_obj(surfaces));
  write_whole(stage / "hull.ply", fit::hull_ply(surfaces));
  write_whole(stage / "provenance.json", provenance(given.command_line, 1, {given.file}).dump(1) + "\n");
  if (!given.figures) return;
  progress.show("drawing", 0);
  std::vector<Eigen::Vector3d> touching;
  for (const std::size_t i : a.result.certificate.touching) touching.push_back(a.scan.sample.points[i]);
  write_whole(stage / "fit_picture.json",
              fit::solid_picture(a.scan, surfaces, touching, title).dump() + "\n");
  draw_figures("fit.py", stage);
}

}  // namespace

std::vector<SolidKind> solid_kinds(const FitCommandOptions& given) {
  std::vector<SolidKind> kinds;
  if (!given.kinds.empty()) {
    kinds = kinds_of(given.kinds);
    if (given.shape != "auto") throw InputError("--kinds", given.kinds, "given without --shape");
  } else {
    for (const SolidKind kind : fitting::kSolidKinds)
      if (kind != SolidKind::ellipsoid && fitting::to_string(kind) == given.shape) kinds.push_back(kind);
  }
  if (!kinds.empty()) require_of_solids(given);
  return kinds;
}

int run_solid_fit(const FitCommandOptions& given, const std::vector<SolidKind>& kinds, std::ostream& out) {
  work::StagedFolder folder(given.out, "--out");
  try {
    SolidAnswer a;
    {
      Progress progress(given.quiet);
      a = solid_answer(given, kinds, progress);
      write_solids(a, given, folder.path(), progress);
    }
    const std::vector<fs::path> files = folder.publish(names_of_fit_files());
    if (given.json) {
      out << json_text(a.json) << '\n';
    } else {
      print_solids(a.scan, a.result, a.json, out);
      print_written(given.out, files, out);
    }
    return a.result.certified ? 0 : 1;
  } catch (const Interrupted&) {
    return kExitInterrupted;
  }
}

}  // namespace vericone
