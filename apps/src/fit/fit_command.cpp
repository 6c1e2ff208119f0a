// SPDX-License-Identifier: BSD-3-Clause
#include "fit/fit_command.h"

#include <vericone/geometry/error.h>
#include <vericone/work/staged_folder.h>
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "fit/cone/cone_json.h"
#include "fit/fit_check.h"
#include "fit/fit_json.h"
#include "fit/fit_picture.h"
#include "fit/fit_text.h"
#include "fit/robot_check.h"
#include "fit/robot_command.h"
#include "fit/robot_shapes.h"
#include "fit/solid_command.h"
#include "fit/write_fit.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/output_file.h"
#include "output/progress.h"
#include "work/interrupt.h"
#include "work/provenance.h"

namespace vericone {
namespace {

namespace fs = std::filesystem;

fitting::Mode mode_of(const std::string& text) {
  for (const auto mode : {fitting::Mode::least_squares, fitting::Mode::robust, fitting::Mode::containing})
    if (fit::to_string(mode) == text) return mode;
  throw InputError("--mode", text, "least-squares, robust or containing");
}

std::optional<fitting::Shape> shape_of(const std::string& text) {
  using enum fitting::Shape;
  if (text == "auto") return std::nullopt;
  for (const auto shape : {ellipse, ellipsoid, biconcave, biconvex, star})
    if (fitting::to_string(shape) == text) return shape;
  throw InputError("--shape", text,
                   "ellipse, ellipsoid, biconcave, biconvex, star, sphere, capsule, cylinder, box or auto");
}

fitting::FitOptions fit_options(const FitCommandOptions& given, Progress& progress) {
  fitting::FitOptions options;
  options.mode = mode_of(given.mode);
  options.shape = shape_of(given.shape);
  options.coverage = given.coverage;
  options.margin = given.margin;
  options.pieces = given.pieces;
  options.seed = given.seed;
  options.progress = [&progress](const std::string& what, double share) {
    return progress.show(what, share);
  };
  return options;
}

/// What is wrong with the points is wrong with the file; what is wrong with an option has its name.
fitting::FitResult fit_or_explain(const fits::Scan& scan, const fitting::FitOptions& options) {
  try {
    return fitting::fit(scan.sample, options);
  } catch (const InputError& e) {
    for (const char* option : {"coverage", "margin", "pieces", "shape"})
      if (e.field() == option) throw InputError(std::string("--") + option, e.value(), e.requirement());
    const auto says = [&](const char* part) { return e.value().find(part) != std::string::npos; };
    if (e.field() == "points")
      throw InputError(
          scan.file, e.value(),
          e.requirement() + (says("in one plane")    ? " (--shape ellipse fits a footprint in the xy plane)"
                             : says("hardly nearer") ? " (--mode containing encloses any points)"
                                                     : ""));
    throw InputError(scan.file, e.field() + ": " + e.value(), e.requirement());
  }
}

/// What was asked for: a proof where something is to be inside, surfaces that the solver arrived at.
bool succeeded(const fitting::FitResult& result, const FitCommandOptions& given) {
  const auto& surfaces = result.surfaces;
  const bool claims = result.mode == fitting::Mode::containing || given.coverage;
  return (result.certified || !claims) &&
         std::all_of(surfaces.begin(), surfaces.end(), [](const auto& s) { return s.converged; });
}

/// The part of a path that the user knows it by.
std::string shown(const fs::path& folder, const fs::path& file) {
  return (folder / file.filename()).string();
}

struct Answer {
  fits::Scan scan;
  fitting::FitResult result;
  std::vector<Json> bodies;
  double seconds = 0;  // the fit with its proof
  Json json;
  std::optional<ConeComparison> cones;
};

Answer answer_of(const FitCommandOptions& given, Progress& progress) {
  const fitting::FitOptions options = fit_options(given, progress);
  std::optional<ConeRequest> request;
  if (!given.cone.empty()) request = read_cone_request(given.cone);
  Answer a;
  progress.show("reading " + given.file, 0);
  a.scan = fits::read_scan(given.file);
  const auto start = Clock::now();
  a.result = fit_or_explain(a.scan, options);
  a.seconds = seconds_since(start);
  a.bodies = fit::bodies_of(a.result, a.scan.sample);
  a.json = fit::fit_json(a.scan, options, a.result, a.bodies);
  if (request) {
    ConeComparisonOptions cones;
    cones.progress = options.progress;
    a.cones = compare_cones(a.scan.sample, a.result, *request, cones);
    a.json["cones"] = cones_json(*a.cones);
  }
  a.json["seconds_read"] = a.scan.seconds;
  a.json["seconds"] = a.seconds;
  return a;
}

void write_files(const Answer& a, const FitCommandOptions& given, work::StagedFolder& folder,
                 Progress& progress) {
  const fs::path& stage = folder.path();
  const std::string title = fit::title_of(a.scan, a.result);
  const std::vector<CombinedSurface> surfaces = fit::hull_surfaces(a.result.pieces);
  fit::write_files(a.json, a.bodies, title, surfaces, stage);
  std::vector<fs::path> inputs{given.file};
  if (fs::is_regular_file(given.cone)) inputs.emplace_back(given.cone);
  write_whole(stage / "provenance.json", provenance(given.command_line, 1, inputs).dump(1) + "\n");
  if (!given.figures) return;
  progress.show("drawing", 0);
  write_whole(stage / "fit_picture.json", fit::fit_picture(a.scan, a.result, surfaces, title).dump() + "\n");
  draw_figures("fit.py", stage);
  if (!a.cones) return;
  write_whole(stage / "fit_cones.json", cones_picture(*a.cones, title).dump() + "\n");
  draw_figures("fit_cones.py", stage);
}

void print(const Answer& a, const FitCommandOptions& given, const std::vector<fs::path>& files,
           std::ostream& out) {
  if (given.json) {
    out << json_text(a.json) << '\n';
    return;
  }
  fit::print_fit(a.scan, a.result, a.seconds, out);
  if (a.cones) print_cones(*a.cones, out);
  print_written(given.out, files, out);
}

}  // namespace

const std::vector<std::string>& names_of_fit_files() {
  static const std::vector<std::string> names{
      "fit.json", "body.yaml", "hull.obj",       "hull.ply",      "provenance.json", "fit_picture.json",
      "fit.png",  "fit.pdf",   "fit_cones.json", "fit_cones.png", "fit_cones.pdf"};
  return names;
}

void print_written(const std::string& folder, const std::vector<fs::path>& files, std::ostream& out) {
  out << "written             " << shown(folder, "fit.json") << ", " << shown(folder, "body.yaml") << ", "
      << shown(folder, "hull.obj") << ", " << shown(folder, "hull.ply") << '\n';
  for (const fs::path& file : pictures_of(files))
    out << "picture             " << shown(folder, file) << '\n';
}

int run_fit(const FitCommandOptions& given, std::ostream& out) {
  if (!given.check.empty() && is_robot_file(given.check)) return check_robot(given, out);
  if (!given.check.empty()) return check_fit(given.file, given.check, given.certificate, given.json, out);
  if (!given.urdf.empty() || !given.sdf.empty()) return run_robot_fit(given, out);
  if (const auto kinds = solid_kinds(given); !kinds.empty()) return run_solid_fit(given, kinds, out);
  work::StagedFolder folder(given.out, "--out");
  try {
    std::vector<fs::path> files;
    Answer a;
    {
      Progress progress(given.quiet);
      a = answer_of(given, progress);
      write_files(a, given, folder, progress);
    }
    files = folder.publish(names_of_fit_files());
    print(a, given, files, out);
    return succeeded(a.result, given) ? 0 : 1;
  } catch (const Interrupted&) {
    return kExitInterrupted;
  }
}

}  // namespace vericone
