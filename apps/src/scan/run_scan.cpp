// SPDX-License-Identifier: BSD-3-Clause
#include "scan/run_scan.h"

#include <vericone/cones/slices/visible_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/lidar/scan.h>
#include <vericone/scanning/read_scan_scene.h>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <sstream>

#include "json/json_value.h"
#include "output/figures.h"
#include "output/number_text.h"
#include "output/output_file.h"
#include "output/provenance.h"
#include "output/staged_folder.h"
#include "output/threads.h"
#include "picture/slice_json.h"
#include "scan/study_json.h"
#include "scan/study_parts.h"

namespace vericone {
namespace {

using namespace scanning;
using Eigen::Vector3d;

std::string ply(const std::vector<Vector3d>& points) {
  std::ostringstream out;
  out << "ply\nformat ascii 1.0\ncomment metres, world frame; made by vericone scan\nelement vertex "
      << points.size() << "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
  for (const Vector3d& x : points)
    out << to_text(x.x()) << ' ' << to_text(x.y()) << ' ' << to_text(x.z()) << '\n';
  return out.str();
}

/// The source's sectors of the fused cloud.
Json sectors_json(const VisibleCone& cone, const scenes::Scene& bodies) {
  Json sectors = Json::array();
  for (const VisiblePlane& plane : cone.planes) {
    Json one{{"azimuth", plane.azimuth}, {"points", plane.points}, {"tried", plane.tried}};
    if (plane.slice) {
      one.update(sector_json(*plane.slice, cone.axis, bodies.agent.velocity, bodies.obstacle.velocity));
    } else {
      one["reason"] = to_string(plane.reason);
    }
    sectors.push_back(one);
  }
  return sectors;
}

Json parsed(const auto& what) {
  std::ostringstream text;
  write_json(what, text);
  return Json::parse(text.str());
}

/// `cone`: null where the scans could not be fused.
void print(const Seen& seen, std::size_t beams, bool fused, const VisibleCone* cone, std::ostream& out) {
  out << "returns             " << seen.points.size() << " of " << beams << " beams\n";
  if (fused && seen.not_fused.empty())
    out << "fusion              points are at most " << at_most_text(seen.fusion_error, 2)
        << " m from where the true poses have them\n";
  if (fused && !seen.not_fused.empty()) out << "fusion              failed: " << seen.not_fused << '\n';
  if (cone)
    out << "sectors             " << number_text(cone->polyhedral().solid_angle) << " sr on "
        << cone->planes.size() << " planes, none on " << cone->planes_without_answer() << '\n';
}

}  // namespace

void run_scan(const ScanOptions& options, std::ostream& out) {
  const ScanScene read = read_scan_scene(options.scene);
  StagedFolder folder(options.out, "--out");
  Setup setup = read.setup;
  setup.seed = options.seed;
  setup.planes = options.planes;
  setup.levels = options.levels;
  std::function<void(const std::string&)> told;
  if (!options.quiet) told = [](const std::string& line) { std::cerr << line << '\n'; };
  const lidar::MeshScene mesh(setup.points, setup.triangles);
  const Seen seen = look(setup, mesh, setup.lidars);
  if (told) told(std::to_string(seen.points.size()) + " returns");
  Json result = parsed(study(setup, told));
  std::size_t beams = 0;
  for (const lidar::Lidar& l : setup.lidars) beams += l.beams.size();
  result["planes"] = options.planes;
  result["seed"] = options.seed;
  result["cloud"] = {
      {"beams", beams}, {"points", seen.points.size()}, {"half_thickness", seen.half_thickness}};
  const bool fused = setup.position_error > 0 || setup.rotation_error > 0;
  result["fusion"] = nullptr;
  if (fused)
    result["fusion"] = {{"failed", seen.not_fused.empty() ? Json(nullptr) : Json(seen.not_fused)},
                        {"error", seen.not_fused.empty() ? Json(seen.fusion_error) : Json(nullptr)}};
  result["sectors"] = nullptr;
  std::optional<VisibleCone> cone;
  if (seen.not_fused.empty()) {
    cone = visible_cone(setup.agent, points_near_plane(seen.points, seen.half_thickness),
                        center_of(seen.points), options.planes);
    Json sectors = polyhedral_json(cone->polyhedral());
    sectors["axis"] = {cone->axis.x(), cone->axis.y(), cone->axis.z()};
    sectors["planes_without_answer"] = cone->planes_without_answer();
    sectors["sectors"] = sectors_json(*cone, read.scene);
    result["sectors"] = sectors;
  }

  const std::filesystem::path& stage = folder.path();
  write_whole(stage / "cloud.ply", ply(seen.points));
  write_whole(stage / "scan.json", result.dump(1) + "\n");
  write_whole(stage / "section.json", parsed(plane_section_picture(setup, options.azimuth)).dump() + "\n");
  // The lidars' rays run on all processors.
  const std::vector<std::filesystem::path> inputs{
      options.scene, std::filesystem::path(options.scene).parent_path() / read.scene.obstacle.file};
  write_whole(stage / "provenance.json",
              provenance(options.command_line, threads_for(0), inputs).dump(1) + "\n");
  if (options.figures)
    for (const char* script : {"visible_section.py", "scan_convergence.py"}) draw_figures(script, stage);
  const auto files = folder.publish(
      {"visible_section.pdf", "visible_section.png", "scan_convergence.pdf", "scan_convergence.png"});
  std::ostream silent(nullptr);
  std::ostream& text = options.json ? silent : out;
  if (options.json) out << result.dump(1) << '\n';
  text << "obstacle            " << read.scene.obstacle.name << '\n';
  print(seen, beams, fused, cone ? &*cone : nullptr, text);
  const std::filesystem::path shown = options.out;
  text << "written             " << (shown / "cloud.ply").string() << ", " << (shown / "scan.json").string()
       << '\n';
  for (const auto& file : pictures_of(files)) text << "picture             " << file.string() << '\n';
}

}  // namespace vericone
