// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/files/extensions.h>
#include <vericone/work/staged_folder.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "command/output_line.h"
#include "commands.h"
#include "cone/assembly_cone.h"
#include "cone/map_answer.h"
#include "cone/pieces_picture.h"
#include "input/assembly_body.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/output_file.h"
#include "output/part.h"
#include "work/interrupt.h"
#include "work/provenance.h"
#include "work/threads.h"

namespace vericone {
namespace {

namespace fs = std::filesystem;

struct GalleryOptions : OutputOptions {
  GalleryOptions() { out = "out/gallery"; }
  std::vector<std::string> files;  // or folders: all meshes, clouds and maps in them
  int half_planes = 64;
  double tolerance = 1e-4;   // radians
  double resolution = 0.05;  // of the cone map, radians; 0: none
  double radius = 0.005;     // of a cloud's points, in parts of its largest side
};

bool is_map(const fs::path& file) { return file.extension() == ".bt" || file.extension() == ".ot"; }

std::vector<fs::path> all_files(const std::vector<std::string>& given) {
  std::vector<std::string> known = files::known_extensions();
  known.insert(known.end(), {".bt", ".ot"});
  std::vector<fs::path> all;
  for (const fs::path path : given) {
    if (!fs::is_directory(path)) {
      all.push_back(path);
      continue;
    }
    std::vector<fs::path> inside;
    std::error_code looping;
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.is_regular_file(looping) &&  // a link may lead to itself
          std::find(known.begin(), known.end(), entry.path().extension()) != known.end())
        inside.push_back(entry.path());
    std::sort(inside.begin(), inside.end());
    all.insert(all.end(), inside.begin(), inside.end());
  }
  return all;
}

double largest_side(const Assembly& pieces) { return 2 * pieces.bounds().half_widths().maxCoeff(); }

scenes::Scene before(scenes::SceneBody body) {
  const double size = largest_side(*body.pieces());
  if (!(size > 0)) throw InputError(body.file, "a single point", "a body with an extent");
  const Eigen::Vector3d from = Eigen::Vector3d(-0.8, -0.5, 0.33).normalized();
  const Ellipsoid ball =
      Ellipsoid::from_axes(body.placed.middle() + 1.5 * size * from, Eigen::Vector3d::Constant(0.1 * size));
  return {{Body(ball), "ball", -from}, std::move(body)};
}

/// A ball in free space, the nearest to the middle of the map that a grid of twice its radius finds.
std::optional<scenes::Scene> within(scenes::SceneBody body, double radius) {
  const Eigen::Vector3d middle = body.placed.middle(), half = body.pieces()->bounds().half_widths();
  std::vector<Eigen::Vector3d> places;
  const double step = 2 * radius;
  const Eigen::Vector3i n = (half / step).cast<int>();
  for (int x = -n.x(); x <= n.x(); ++x)
    for (int y = -n.y(); y <= n.y(); ++y)
      for (int z = -n.z(); z <= n.z(); ++z) places.push_back(step * Eigen::Vector3d(x, y, z));
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.squaredNorm() < b.squaredNorm(); });
  for (const Eigen::Vector3d& place : places) {
    const Ellipsoid ball = Ellipsoid::from_axes(middle + place, Eigen::Vector3d::Constant(radius));
    if (AssemblyOracle(ball, *body.pieces(), body.placed.pose).relation() == Relation::disjoint)
      return scenes::Scene{{Body(ball), "ball", Eigen::Vector3d::UnitX()}, std::move(body)};
  }
  return std::nullopt;
}

class Gallery {
 public:
  Gallery(const GalleryOptions& options, const std::vector<fs::path>& files, std::ostream& out)
      : options_(options), out_(out), inputs_(provenance("", 0, files)["inputs"]) {}

  void add(const fs::path& file) {
    add(file, before(input::read_any_body(file, options_.radius, "free")), "");
    if (!is_map(file)) return;
    scenes::SceneBody body = input::read_any_body(file, options_.radius, "occupied");
    const double radius = 4 * body.reading->map->cell;
    if (auto inside = within(std::move(body), radius)) add(file, *inside, "-within");
  }

  void fail(const fs::path& file, const std::string& why) {
    std::cerr << (why.starts_with(file.string()) ? "" : file.string() + ": ") << why << '\n';
    failed_ = true;
    work::StagedFolder folder(options_.out, "--out");
    publish(folder, {{"file", file.string()}, {"error", why}}, {});
  }

  void print() const {
    if (options_.json) out_ << json_text({{"rows", rows_}}) << '\n';
  }

  bool failed() const { return failed_; }

 private:
  void add(const fs::path& file, const scenes::Scene& scene, const std::string& suffix) {
    const AssemblyCone cone = assembly_cone(scene, options_.half_planes, options_.tolerance);
    if (cone.relation != Relation::disjoint)
      throw std::runtime_error("agent and body are " + std::string(to_string(cone.relation)));
    work::StagedFolder folder(options_.out, "--out");
    const std::string name = folder_name(file, suffix);
    const fs::path own = folder.path() / name;
    fs::create_directory(own);
    Json row{{"file", file.string()},
             {"what", scene.obstacle.name},
             {"agent", suffix.empty() ? "before it" : "within it"}};
    Json whole = to_json(cone, scene);
    if (options_.resolution > 0)
      whole["map"] = to_json(
          map_answer(cone.oracle, {options_.resolution, std::nullopt, threads_}, cone.frame.axis, ""));
    write_whole(own / "cone.json", json_text(whole) + "\n");
    row["cone"] = summary(whole, cone);
    Json pictures = Json::array();
    if (options_.figures) {
      draw_figures(write_pieces_picture(cone, scene, own, threads_), own);
      for (const char* picture : {"cone.pdf", "cone.png"})
        if (fs::exists(own / picture)) pictures.push_back(folder.published(own / picture).string());
    }
    row["pictures"] = pictures;
    publish(folder, row, {name + "/pieces.json", name + "/cone.pdf", name + "/cone.png"});
    if (!options_.json) out_ << line(row) << '\n' << std::flush;
  }

  /// What a body has appears with the tables of all bodies so far: an interruption leaves what was done by
  /// then.
  void publish(work::StagedFolder& folder, const Json& row, const std::vector<std::string>& names) {
    Json rows = rows_;
    rows.push_back(row);
    write_whole(folder.path() / "gallery.json", json_text({{"rows", rows}}) + "\n");
    write_whole(folder.path() / "gallery.md", table(rows));
    Json origin = provenance(options_.command_line, threads_, {});
    origin["inputs"] = inputs_;
    origin["radius"] = options_.radius;
    write_whole(folder.path() / "provenance.json", origin.dump(1) + "\n");
    folder.publish(names);
    rows_ = std::move(rows);
  }

  /// A name of its own for each file, also where files of several folders have the same one.
  std::string folder_name(const fs::path& file, const std::string& suffix) const {
    std::string name = file.filename().string();
    std::replace(name.begin(), name.end(), '.', '-');
    name += suffix;
    int same = 0;
    for (const Json& row : rows_)
      same += row.contains("what") &&
              fs::path(row["file"].get<std::string>()).filename() == file.filename() &&
              row["file"] != file.string();
    return same ? name + "-" + std::to_string(same + 1) : name;
  }

  static Json summary(const Json& whole, const AssemblyCone& cone) {
    const double nodes = static_cast<double>(cone.effort.nodes) / static_cast<double>(cone.extremes.size());
    Json result{{"pieces", whole["obstacle"]["pieces"]},
                {"seconds_read", whole["obstacle"].value("seconds_read", 0.0)},
                {"seconds_built", whole["obstacle"].value("seconds_built", 0.0)},
                {"seconds_half_planes", cone.seconds},
                {"widest_degrees", cone.widest() * 180 / std::numbers::pi},
                {"envelope_solid_angle", cone.envelope},
                {"nodes_a_half_plane", nodes / whole["effort"]["hierarchy_nodes"].get<double>()}};
    if (whole.contains("map")) result["map"] = whole["map"];
    return result;
  }

  static std::string table(const Json& rows) {
    std::string text =
        "| file | body | agent | read (s) | hierarchy (s) | half-planes (ms) | boxes a half-plane | farthest "
        "(deg) | "
        "within extremes (sr) | colliding (sr) | undecided (sr) | map (s) "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const Json& row : rows) text += line(row) + "\n";
    return text;
  }

  static std::string number(double x, const char* format) {
    char text[32];
    std::snprintf(text, sizeof text, format, x);
    return text;
  }

  static std::string line(const Json& row) {
    const std::string name = fs::path(row["file"].get<std::string>()).filename().string();
    if (row.contains("error")) return "| " + name + " | " + row["error"].get<std::string>() + " |";
    const Json& c = row["cone"];
    const auto of = [&](const char* field) { return c[field].get<double>(); };
    std::string text =
        "| " + name + " | " + row["what"].get<std::string>() + " | " + row["agent"].get<std::string>() +
        " | " + number(of("seconds_read"), "%.3f") + " | " + number(of("seconds_built"), "%.3f") + " | " +
        number(1e3 * of("seconds_half_planes"), "%.1f") + " | " +
        number(100 * of("nodes_a_half_plane"), "%.2g %%") + " | " + number(of("widest_degrees"), "%.2f") +
        " | " + number(of("envelope_solid_angle"), "%.4f") + " | ";
    if (!c.contains("map")) return text + "| | |";
    return text + number(c["map"]["colliding"], "%.4f") + " | " + number(c["map"]["undecided"], "%.4f") +
           " | " + number(c["map"]["seconds"], "%.2f") + " |";
  }

  const GalleryOptions& options_;
  std::ostream& out_;
  Json inputs_;
  int threads_ = threads_for(options_.threads);
  Json rows_ = Json::array();
  bool failed_ = false;
};

/// `vericone gallery`: the cone of each file's body before a ball of a tenth of its largest side, which
/// stands off its middle by one and a half of that side; of octree maps also around a ball of four cells
/// within known free space. Writes a folder a cone, gallery.json, gallery.md (a table) and provenance.json. A
/// file that cannot be read is named and passed over. Returns the exit status: 0; 2 if there was one; 130
/// interrupted.
int run_gallery(const GalleryOptions& options, std::ostream& out) {
  if (!(options.radius >= 0 && options.radius <= 1))
    throw InputError("--radius", to_text(options.radius),
                     "between 0 and 1, parts of the cloud's largest side");
  std::vector<fs::path> files = all_files(options.files);
  if (files.empty()) throw InputError("files", "none", "meshes, clouds or octree maps, or folders of them");
  if (const auto part = part_of(options.part)) {
    const auto [begin, end] = share_of(files.size(), *part);
    files.erase(files.begin() + std::ptrdiff_t(end), files.end());
    files.erase(files.begin(), files.begin() + std::ptrdiff_t(begin));
  }
  const work::StagedFolder folder(options.out, "--out");
  Gallery gallery(options, files, out);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!options.quiet) std::cerr << "[" << i + 1 << "/" << files.size() << "] " << files[i].string() << '\n';
    try {
      gallery.add(files[i]);
    } catch (const InputError& e) {
      gallery.fail(files[i], e.what());
    } catch (const std::exception& e) {
      if (interrupted()) throw;
      gallery.fail(files[i], e.what());
    }
  }
  gallery.print();
  return gallery.failed() ? 2 : 0;
}

}  // namespace

int gallery_command(CommandLine& line) {
  GalleryOptions gallery;
  line.option("files", gallery.files, "Files, or folders of them").required().words(1, -1);
  line.option("--planes", gallery.half_planes, "Half-planes of each cone");
  line.option("--tolerance", gallery.tolerance, "Of their angles, radians");
  line.option("--map", gallery.resolution, "Resolution of the cone maps, radians; 0: none");
  line.option("--radius", gallery.radius, "Of the points of clouds, in parts of the cloud's largest side");
  part_option(line, gallery.part, "files alone; each part has a folder of its own");
  read_output_line(line, gallery);
  return run_gallery(gallery, std::cout);
}

}  // namespace vericone
