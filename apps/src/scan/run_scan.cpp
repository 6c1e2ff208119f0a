// SPDX-License-Identifier: BSD-3-Clause
#include "scan/run_scan.h"

#include <vericone/internal/scanning/picture.h>
#include <vericone/scanning/study.h>
#include <vericone/work/staged_folder.h>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>

#include "json/json_value.h"
#include "output/figures.h"
#include "output/number_text.h"
#include "output/output_file.h"
#include "work/provenance.h"
#include "work/threads.h"

namespace vericone {
namespace {

using namespace scanning;
using Eigen::Vector3d;

void print(const Setup& setup, const Findings& found, std::ostream& out) {
  const Seen& seen = found.seen;
  std::size_t beams = 0;
  for (const lidar::Lidar& l : setup.lidars) beams += l.beams.size();
  const bool fused = setup.position_error > 0 || setup.rotation_error > 0;
  out << "returns             " << seen.points.size() << " of " << beams << " beams\n";
  if (fused && seen.not_fused.empty())
    out << "fusion              points are at most " << at_most_text(seen.fusion_error, 2)
        << " m from where the true poses have them\n";
  if (fused && !seen.not_fused.empty()) out << "fusion              failed: " << seen.not_fused << '\n';
  if (!found.cone) return;
  const std::size_t planes = found.cone->planes.size(), none = found.cone->planes_without_answer();
  const double solid_angle = found.cone->polyhedral().solid_angle;
  out << "sectors             ";
  if (std::isfinite(solid_angle))
    out << number_text(solid_angle) << " sr on " << planes << " planes, none on " << none << '\n';
  else
    out << "no cone: " << planes - none << " of " << planes
        << " planes have tangents, and two must have the line of sight between them\n";
}

}  // namespace

void run_scan(const ScanOptions& options, std::ostream& out) {
  const ScanScene read = read_scan_scene(options.scene);
  work::StagedFolder folder(options.out, "--out");
  Setup setup = read.setup;
  setup.seed = options.seed;
  setup.planes = options.planes;
  setup.levels = options.levels;
  std::function<void(const std::string&)> told;
  if (!options.quiet) told = [](const std::string& line) { std::cerr << line << '\n'; };
  const Findings found = scan_and_study(setup, told);
  const Vector3d &v_agent = read.scene.agent.velocity, &v_obstacle = read.scene.obstacle.velocity;
  const std::filesystem::path& stage = folder.path();
  write_scan(setup, found, v_agent, v_obstacle, options.azimuth, stage);
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
  if (options.json) out << scan_text(setup, found, v_agent, v_obstacle);
  text << "obstacle            " << read.scene.obstacle.name << '\n';
  print(setup, found, text);
  const std::filesystem::path shown = options.out;
  text << "written             " << (shown / "cloud.ply").string() << ", " << (shown / "scan.json").string()
       << '\n';
  for (const auto& file : pictures_of(files)) text << "picture             " << file.string() << '\n';
}

}  // namespace vericone
