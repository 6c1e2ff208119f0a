// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/accuracy.h"

#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <vericone/internal/files/extensions.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <iostream>
#include <memory>
#include <ostream>
#include <sstream>

#include "accuracy/cases.h"
#include "accuracy/combined_accuracy.h"
#include "accuracy/distribution.h"
#include "accuracy/measure.h"
#include "accuracy/statistics.h"
#include "accuracy/summary.h"
#include "command/output_line.h"
#include "commands.h"
#include "job/job.h"
#include "json/json_value.h"
#include "output/output_file.h"
#include "picture/engagements.h"
#include "work/file_hash.h"

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
}

/// With what is left to choose chosen.
Options complete(Options o, ObstacleKind kind) {
  std::sort(o.planes.begin(), o.planes.end());
  if (o.out.empty()) o.out = kind == ObstacleKind::ellipsoid ? "out/accuracy" : "out/accuracy-" + o.obstacle;
  if (o.cases.empty()) return o;
  for (const auto& [used, option] :
       {std::pair(o.engagements.has_value(), "--engagements"), std::pair(!o.semi_axes.empty(), "--semi-axes"),
        std::pair(!o.distance.empty(), "--distance"),
        std::pair(kind != ObstacleKind::ellipsoid, "--obstacle")})
    if (used) throw InputError("--cases", o.cases, std::string("given without ") + option);
  return o;
}

work::ResumableTable table_of_pairs(const Options& o, const Engagements& engagements) {
  work::ResumableTable table{"engagements.csv"};
  table.header = csv_header(o.planes);
  table.count = engagements.count;
  table.settings = "# vericone accuracy, " + engagements.settings + ", planes " + planes_text(o.planes);
  table.id = engagements.id;
  table.row = [&](std::uint64_t i) {
    const auto [a, b] = engagements.pair(i);
    return csv_row(engagements.id(i), measure(a, b, o.planes), a, b);
  };
  return table;
}

work::ResumableTable table_of_scans(const Options& o, const std::vector<Scan>& scans) {
  work::ResumableTable table{"scans.csv"};
  table.header = csv_header(o.planes);
  table.count = scans.size() * o.approaches;
  table.settings = "# vericone accuracy, seed " + std::to_string(o.seed) + ", " +
                   std::to_string(o.approaches) + " approaches, planes " + planes_text(o.planes) + ", scans";
  for (const Scan& s : scans) table.settings += " " + s.name + ":" + std::to_string(s.points);
  table.id = [&](std::uint64_t i) {
    return scans[i / o.approaches].name + "#" + std::to_string(i % o.approaches);
  };
  table.row = [&, id = table.id](std::uint64_t i) {
    const Scan& scan = scans[i / o.approaches];
    const Ellipsoid agent = random_agent(scan.hull, o.seed, i % o.approaches);
    return csv_row(id(i), measure(agent, scan.hull, o.planes), agent, scan.hull);
  };
  return table;
}

/// What slices miss of each scanned object, as JSON and as text.
Json tell_scans(const Options& o, const std::vector<Scan>& scans, const std::vector<Measurement>& rows,
                std::ostream& out) {
  out << scans.size() << " scanned objects in their minimum-volume ellipsoids, " << o.approaches
      << " approaches each\n  object                      points   semi-axes a, b, c (unit of the file)   "
         "slice bias mean    worst\n";
  Json objects = Json::array();
  auto first = rows.begin();
  for (const Scan& scan : scans) {
    const auto last = first + static_cast<std::ptrdiff_t>(o.approaches);
    const Summary found = summarise({first, last}, o.planes);
    first = last;
    Json object = to_json(found);
    const Eigen::Vector3d axes = scan.hull.semi_axes();
    object["name"] = scan.name;
    object["points"] = scan.points;
    object["semi_axes"] = {axes.x(), axes.y(), axes.z()};
    std::ostringstream text;
    text << std::setprecision(4) << axes.x() << ", " << axes.y() << ", " << axes.z();
    out << "  " << std::left << std::setw(24) << scan.name << std::right << std::setw(10) << scan.points
        << "   " << std::left << std::setw(36) << text.str() << std::right << std::setw(10)
        << percent(found.slice_bias.mean) << std::setw(11) << percent(found.slice_bias.worst) << '\n';
    objects.push_back(std::move(object));
  }
  return objects;
}

/// One engagement to look at: the first random one whose slice cone misses a fifth.
Json picture_of(const Engagements& engagements, const std::vector<Measurement>& rows) {
  const auto shown = std::find_if(rows.begin(), rows.end(), [](const Measurement& m) {
    return 1 - m.slice_areas.back() / m.exact_area > 0.2;
  });
  const std::size_t index = shown == rows.end() ? 0 : std::size_t(shown - rows.begin());
  const auto [a, b] = engagements.pair(index);
  Json picture = engagement_picture({{Body(a)}, {Body(b)}}, 36, 192);
  picture["engagement"] = index;
  return picture;
}

}  // namespace

int run_accuracy(const Options& given, std::ostream& out) {
  validate(given);
  const ObstacleKind kind = obstacle_kind(given.obstacle);
  const Options options = complete(given, kind);
  if (kind != ObstacleKind::ellipsoid) return run_combined_accuracy(options, kind, out);
  if (options.tolerance)
    throw InputError("--tolerance", to_text(*options.tolerance),
                     "left out for ellipsoids, whose cone is exact");
  const Engagements engagements = engagements_of(options);
  const std::vector<fs::path> files = scan_files(options.scans);
  std::vector<Scan> scans;
  for (const fs::path& file : files) scans.push_back(read_scan(file));
  Job job{options,
          files,
          {{table_of_pairs(options, engagements),
            options.cases.empty() ? "random engagements" : "engagements       "}}};
  if (!options.cases.empty()) job.inputs.emplace_back(options.cases);
  if (!scans.empty()) job.tables.push_back({table_of_scans(options, scans), "scanned objects   "});
  const auto tell = [&](Results& found, work::StagedFolder& folder) {
    const auto rows_of = [&](const char* table) {
      return read_table(folder.resumable(table), options.planes.size());
    };
    const auto rows = rows_of("engagements.csv");
    const Summary random = summarise(rows, options.planes);
    found.summary["random"] = to_json(random);
    found.summary["random"]["drawn"] = engagements.drawn;
    found.scripts = {"accuracy.py", "engagement.py"};
    found.files = {"engagements.csv"};
    found.old = {"accuracy.pdf", "accuracy.png", "engagement.pdf", "engagement.png",
                 "scans.csv",    "scans.pdf",    "scans.png"};
    found.text << engagements.count << ' ' << engagements.drawn << ", " << options.planes.size()
               << " plane counts, " << std::fixed << std::setprecision(1)
               << found.origin["seconds"].get<double>() << " s\n";
    print_summary(random, found.text);
    if (!scans.empty()) {
      found.summary["scans"] = tell_scans(options, scans, rows_of("scans.csv"), found.text);
      found.files.emplace_back("scans.csv");
    }
    write_whole(folder.path() / "engagement.json", picture_of(engagements, rows).dump(1) + "\n");
    found.files.insert(found.files.end(), {"summary.json", "provenance.json"});
    found.origin.update({{"seed", options.seed},
                         {"engagements", engagements.count},
                         {"planes", options.planes},
                         {"scans", Json::array()}});
    for (const fs::path& file : files) found.origin["scans"].push_back(file.string());
  };
  return run_job(std::move(job), tell, out);
}

}  // namespace vericone::accuracy

namespace vericone {

int accuracy_command(CommandLine& line) {
  accuracy::Options options;
  line.option("--obstacle", options.obstacle,
              "Obstacles of the random engagements: ellipsoid, biconcave, biconvex or star");
  line.option("-N,--engagements", options.engagements,
              "Random engagements; by default 10000, or 1000 with other obstacles than ellipsoids")
      .shown_default("10000");
  line.option("--tolerance", options.tolerance,
              "Of the certified cone that slices are held against, with other obstacles than ellipsoids")
      .shown_default(to_text(accuracy::kReferenceTolerance));
  line.option("--semi-axes", options.semi_axes, "Of the random bodies, metres")
      .words(2, 2)
      .shown_type("LOW HIGH")
      .shown_default("1 10");
  line.option("--distance", options.distance,
              "Of their centres, metres; if not given, 1.5 to 3 times what just separates the bodies")
      .words(2, 2)
      .shown_type("LOW HIGH");
  line.option("--cases", options.cases,
              "Pairs of ellipsoids instead of random ones: a file of cases as of query, velocities left out "
              "or ignored");
  line.option("--scan", options.scans, "Mesh or cloud files, or folders of them").words(1, -1);
  line.option("--approaches", options.approaches, "Engagements per scanned object");
  line.option("--planes", options.planes, "Plane counts; the largest is the reference of the others")
      .words(1, -1)
      .commas();
  line.option("--seed", options.seed, "Seed of all random numbers");
  read_job_line(line, options, "out/accuracy");
  return accuracy::run_accuracy(options, std::cout);
}

}  // namespace vericone
