// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/accuracy.h"

#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <vericone/internal/files/extensions.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <memory>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "accuracy/cases.h"
#include "accuracy/combined_accuracy.h"
#include "accuracy/distribution.h"
#include "accuracy/engagements.h"
#include "accuracy/measure.h"
#include "accuracy/statistics.h"
#include "accuracy/summary.h"
#include "cone/cone.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/file_hash.h"
#include "output/interrupt.h"
#include "output/output_file.h"
#include "output/provenance.h"
#include "output/resumable_table.h"
#include "output/staged_folder.h"
#include "output/threads.h"

namespace vericone::accuracy {
namespace {

namespace fs = std::filesystem;

/// The pairs whose cones are measured.
struct Engagements {
  std::uint64_t count = 0;
  std::function<std::pair<Ellipsoid, Ellipsoid>(std::uint64_t)> pair;
  std::function<std::string(std::uint64_t)> id;
  std::string settings;  // what pins them down
  std::string drawn;     // how they are called in text and pictures
};

Engagements engagements_of(const Options& o) {
  Engagements e;
  if (!o.cases.empty()) {
    auto cases = std::make_shared<const std::vector<Case>>(read_cases(o.cases));
    e.count = cases->size();
    e.pair = [cases](std::uint64_t i) { return std::pair((*cases)[i].agent, (*cases)[i].obstacle); };
    e.id = [cases](std::uint64_t i) { return (*cases)[i].id; };
    e.settings = "cases " + sha256_of_file(o.cases) + ", " + std::to_string(e.count) + " engagements";
    e.drawn = "engagements of " + fs::path(o.cases).filename().string();
    return e;
  }
  const Distribution from = distribution(o);
  e.count = o.engagements.value_or(10'000);
  e.pair = [seed = o.seed, from](std::uint64_t i) { return random_engagement(seed, i, from); };
  e.id = [](std::uint64_t i) { return std::to_string(i); };
  e.settings = "seed " + std::to_string(o.seed) + ", " + std::to_string(e.count) + " engagements" +
               distribution_settings(o);
  e.drawn = "random engagements, " + distribution_text(from);
  return e;
}

std::vector<std::pair<std::string, Measurement>> read_table(const fs::path& path,
                                                            const std::vector<int>& planes) {
  std::ifstream in(path);
  std::vector<std::pair<std::string, Measurement>> rows;
  std::string line;
  std::getline(in, line);  // settings
  std::getline(in, line);  // header
  for (std::size_t number = 3; std::getline(in, line); ++number) {
    try {
      std::string id;
      Measurement m = parse_row(line, planes, id);
      rows.emplace_back(std::move(id), std::move(m));
    } catch (const std::exception& e) {
      throw std::runtime_error(path.string() + ":" + std::to_string(number) + ": " + e.what());
    }
  }
  return rows;
}

std::vector<fs::path> scan_files(const std::vector<std::string>& given) {
  std::vector<fs::path> files;
  const auto known = files::known_extensions();
  for (const std::string& name : given) {
    if (!fs::is_directory(name)) {
      files.emplace_back(name);
      continue;
    }
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(name))
      if (std::find(known.begin(), known.end(), entry.path().extension().string()) != known.end())
        found.push_back(entry.path());
    if (found.empty()) throw InputError("--scan", name, "a mesh or cloud file, or a folder that has some");
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

struct Scan {
  std::string name;
  std::size_t points = 0;
  Ellipsoid hull;
};

Scan read_scan(const fs::path& path) {
  const files::PointFile file = files::read_points(path);
  std::vector<Eigen::Vector3d> points;
  if (file.faces.empty() || file.unreferenced_points == 0) {
    points = file.points;
  } else {  // points that no face uses are not part of the object
    std::vector<bool> used(file.points.size(), false);
    for (const auto& face : file.faces)
      for (const auto i : face) used[i] = true;
    for (std::size_t i = 0; i < used.size(); ++i)
      if (used[i]) points.push_back(file.points[i]);
  }
  try {
    const auto fit = min_volume_ellipsoid<3>(points);
    if (!fit.converged())
      throw InputError("points", "no convergence", "a cloud whose ellipsoid can be found to 1e-7");
    return {path.stem().string(), points.size(), fit.body};
  } catch (const InputError& e) {
    throw e.within(path.string());
  }
}

ResumableTable base_campaign(const Options& o, StagedFolder& folder, const std::string& name) {
  ResumableTable c{folder, name};
  c.header = csv_header(o.planes);
  c.threads = threads_for(o.threads);
  c.quiet = o.quiet;
  return c;
}

void validate(const Options& o) {
  if (o.planes.size() < 2)
    throw InputError("--planes", planes_text(o.planes),
                     "at least two plane counts, the largest is the reference");
  for (const int n : o.planes)
    if (n < 3 || n > 100'000) throw InputError("--planes", std::to_string(n), "between 3 and 100000");
  auto sorted = o.planes;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    throw InputError("--planes", planes_text(o.planes), "without repetitions");
  for (const auto& [option, range] :
       {std::pair("--semi-axes", &o.semi_axes), std::pair("--distance", &o.distance)})
    if (!range->empty() &&
        !(range->front() >= 1e-9 && range->front() <= range->back() && range->back() <= 1e9))
      throw InputError(option, to_text(range->front()) + " " + to_text(range->back()),
                       "two numbers between 1e-9 and 1e9, the smaller one first (m)");
  const double largest = distribution(o).semi_axes.high;
  if (!o.distance.empty() && !(o.distance.front() > 2 * largest))
    throw InputError("--distance", to_text(o.distance.front()) + " " + to_text(o.distance.back()),
                     "from above " + to_text(2 * largest) +
                         " m, twice the largest semi-axis: the bodies have to be apart");
  if (o.engagements && (*o.engagements < 1 || *o.engagements > 100'000'000))
    throw InputError("--engagements", std::to_string(*o.engagements), "between 1 and 100000000");
  if (o.approaches < 1 || o.approaches > 1'000'000)
    throw InputError("--approaches", std::to_string(o.approaches), "between 1 and 1000000");
  threads_for(o.threads);
}

}  // namespace

int run_accuracy(const Options& given, std::ostream& standard_output) {
  validate(given);
  Options options = given;
  std::ostream silent(nullptr);
  std::ostream& out = given.json ? silent : standard_output;
  std::sort(options.planes.begin(), options.planes.end());
  const ObstacleKind kind = obstacle_kind(options.obstacle);
  if (options.out.empty())
    options.out = kind == ObstacleKind::ellipsoid ? "out/accuracy" : "out/accuracy-" + options.obstacle;
  if (!options.cases.empty())
    for (const auto& [used, option] : {std::pair(options.engagements.has_value(), "--engagements"),
                                       std::pair(!options.semi_axes.empty(), "--semi-axes"),
                                       std::pair(!options.distance.empty(), "--distance"),
                                       std::pair(kind != ObstacleKind::ellipsoid, "--obstacle")})
      if (used) throw InputError("--cases", options.cases, std::string("given without ") + option);
  if (kind != ObstacleKind::ellipsoid) return run_combined_accuracy(options, kind, standard_output);
  if (options.tolerance)
    throw InputError("--tolerance", to_text(*options.tolerance),
                     "left out for ellipsoids, whose cone is exact");
  const Engagements engagements = engagements_of(options);
  std::vector<Scan> scans;
  for (const fs::path& file : scan_files(options.scans)) scans.push_back(read_scan(file));
  StagedFolder folder(options.out, "--out");
  const auto start = Clock::now();
  const auto stopped = [&] {
    out << "interrupted; the same command goes on where it stopped (" << options.out << ")\n";
    return kExitInterrupted;
  };

  ResumableTable random = base_campaign(options, folder, "engagements.csv");
  random.label = options.cases.empty() ? "random engagements" : "engagements       ";
  random.count = engagements.count;
  random.settings =
      "# vericone accuracy, " + engagements.settings + ", planes " + planes_text(options.planes);
  random.id = engagements.id;
  random.row = [&](std::uint64_t i) {
    const auto [a, b] = engagements.pair(i);
    return csv_row(engagements.id(i), measure(a, b, options.planes), a, b);
  };
  if (run_table(random) == TableOutcome::interrupted) return stopped();
  const double random_seconds = seconds_since(start);

  std::vector<Measurement> rows;
  for (auto& [id, m] : read_table(folder.resumable(random.name), options.planes))
    rows.push_back(std::move(m));
  const Summary random_summary = summarise(rows, options.planes);
  Json summary{{"random", to_json(random_summary)}};
  summary["random"]["seconds"] = random_seconds;
  summary["random"]["drawn"] = engagements.drawn;
  out << engagements.count << ' ' << engagements.drawn << ", " << options.planes.size() << " plane counts, "
      << std::fixed << std::setprecision(1) << random_seconds << " s\n";
  print_summary(random_summary, out);

  if (!scans.empty()) {
    ResumableTable approach = base_campaign(options, folder, "scans.csv");
    approach.label = "scanned objects   ";
    approach.count = scans.size() * options.approaches;
    approach.settings = "# vericone accuracy, seed " + std::to_string(options.seed) + ", " +
                        std::to_string(options.approaches) + " approaches, planes " +
                        planes_text(options.planes) + ", scans";
    for (const Scan& s : scans) approach.settings += " " + s.name + ":" + std::to_string(s.points);
    approach.id = [&](std::uint64_t i) {
      return scans[i / options.approaches].name + "#" + std::to_string(i % options.approaches);
    };
    approach.row = [&](std::uint64_t i) {
      const Scan& scan = scans[i / options.approaches];
      const Ellipsoid agent = random_agent(scan.hull, options.seed, i % options.approaches);
      return csv_row(approach.id(i), measure(agent, scan.hull, options.planes), agent, scan.hull);
    };
    if (run_table(approach) == TableOutcome::interrupted) return stopped();
    const auto table = read_table(folder.resumable(approach.name), options.planes);
    out << scans.size() << " scanned objects in their minimum-volume ellipsoids, " << options.approaches
        << " approaches each\n  object                      points   semi-axes a, b, c (unit of the file)   "
           "slice bias mean    worst\n";
    Json objects = Json::array();
    for (std::size_t s = 0; s < scans.size(); ++s) {
      std::vector<Measurement> own;
      for (std::uint64_t k = 0; k < options.approaches; ++k)
        own.push_back(table[s * options.approaches + k].second);
      const Summary own_summary = summarise(own, options.planes);
      Json object = to_json(own_summary);
      const Eigen::Vector3d axes = scans[s].hull.semi_axes();
      object["name"] = scans[s].name;
      object["points"] = scans[s].points;
      object["semi_axes"] = {axes.x(), axes.y(), axes.z()};
      std::ostringstream text;
      text << std::setprecision(4) << axes.x() << ", " << axes.y() << ", " << axes.z();
      out << "  " << std::left << std::setw(24) << scans[s].name << std::right << std::setw(10)
          << scans[s].points << "   " << std::left << std::setw(36) << text.str() << std::right
          << std::setw(10) << percent(own_summary.slice_bias.mean) << std::setw(11)
          << percent(own_summary.slice_bias.worst) << '\n';
      objects.push_back(std::move(object));
    }
    summary["scans"] = objects;
  }

  // One engagement to look at: the first random one whose slice cone misses a fifth.
  std::size_t shown = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (1 - rows[i].slice_areas.back() / rows[i].exact_area > 0.2) {
      shown = i;
      break;
    }
  const auto [a, b] = engagements.pair(shown);
  Json picture = engagement_picture({{Body(a)}, {Body(b)}}, 36, 192);
  picture["engagement"] = shown;
  write_whole(folder.path() / "engagement.json", picture.dump(1) + "\n");
  write_whole(folder.path() / "summary.json", summary.dump(1) + "\n");
  std::vector<fs::path> inputs = scan_files(options.scans);
  if (!options.cases.empty()) inputs.emplace_back(options.cases);
  Json origin = provenance(options.command_line, random.threads, inputs);
  origin["seed"] = options.seed;
  origin["engagements"] = engagements.count;
  origin["planes"] = options.planes;
  origin["scans"] = Json::array();
  for (const auto& file : scan_files(options.scans)) origin["scans"].push_back(file.string());
  origin["seconds"] = seconds_since(start);
  write_whole(folder.path() / "provenance.json", origin.dump(1) + "\n");
  if (options.figures)
    for (const char* script : {"accuracy.py", "engagement.py"}) draw_figures(script, folder.path());
  const auto files = folder.publish({"accuracy.pdf", "accuracy.png", "engagement.pdf", "engagement.png",
                                     "scans.csv", "scans.pdf", "scans.png"});
  if (given.json) standard_output << summary.dump(1) << '\n';
  const fs::path shown_folder = options.out;
  out << "tables    " << (shown_folder / "engagements.csv").string();
  if (!scans.empty()) out << ", " << (shown_folder / "scans.csv").string();
  out << ", " << (shown_folder / "summary.json").string() << ", "
      << (shown_folder / "provenance.json").string() << '\n';
  for (const auto& file : pictures_of(files)) out << "picture   " << file.string() << '\n';
  return 0;
}

}  // namespace vericone::accuracy
