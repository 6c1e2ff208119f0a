// SPDX-License-Identifier: BSD-3-Clause
#include "cone/cone.h"

#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/geometry/lengths.h>
#include <vericone/work/staged_folder.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <ostream>
#include <sstream>

#include "command/cases.h"
#include "commands.h"
#include "cone/answer.h"
#include "cone/assembly_cone.h"
#include "cone/pair_cone.h"
#include "cone/pieces_cone.h"
#include "cone/planar_cone.h"
#include "cone/quadric_cone.h"
#include "cone/scene_certificate.h"
#include "cone/slab_cone.h"
#include "cone/verdict_text.h"
#include "glb/scene_glb.h"
#include "input/body.h"
#include "input/scene.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/number_text.h"
#include "output/output_file.h"
#include "output/slice_json.h"
#include "picture/engagements.h"
#include "solids/slab_body.h"
#include "work/provenance.h"
#include "work/threads.h"

namespace vericone {
namespace {

SliceSector sectors_of(const ConeCommand& options) {
  if (options.tangents == "all") return SliceSector::all_candidates;
  if (options.tangents == "by-sides") return SliceSector::source_by_sides;
  if (options.tangents == "printed") return SliceSector::source_printed;
  throw InputError("--tangents", options.tangents, "all, by-sides or printed");
}

QuadricCone cone_of(const ConeCommand& options, const scenes::Scene& scene) {
  if (options.samples && options.tolerance)
    throw InputError("--samples", std::to_string(*options.samples), "left out where --tolerance is given");
  const SliceSector sectors = sectors_of(options);
  if (options.method == "slice") return sliced_cone(scene, options.planes.value_or(kDefaultPlanes), sectors);
  if (sectors != SliceSector::all_candidates)
    throw InputError("--tangents", options.tangents, "left out where --method is not slice");
  if (options.tolerance || !ellipsoids(scene)) {
    if (options.samples)
      throw InputError("--samples", std::to_string(*options.samples),
                       "left out for combined quadrics, whose cone is refined to --tolerance");
    return certified_cone(*scene.agent.quadric(), *scene.obstacle.quadric(),
                          options.tolerance.value_or(kDefaultTolerance));
  }
  return exact_cone(*scene.agent.ellipsoid(), *scene.obstacle.ellipsoid(),
                    options.samples.value_or(kDefaultSamples));
}

void run_planar_cone(const ConeCommand& options, const scenes::Scene& scene, std::ostream& out) {
  if (options.method != "exact")
    throw InputError("--method", options.method, "left out for a planar scene, whose cone is one sector");
  if (options.tangents != "all")
    throw InputError("--tangents", options.tangents, "left out for a planar scene");
  if (options.tolerance)
    throw InputError("--tolerance", to_text(*options.tolerance), "left out for a planar scene");
  if (options.map) throw InputError("--map", to_text(options.map->resolution), "asked for in space only");
  std::optional<work::StagedFolder> folder;
  if (!options.picture_folder.empty()) folder.emplace(options.picture_folder, "--out");
  const PlanarCone cone = planar_cone(scene);
  if (folder && !std::isfinite(cone.found.sector.theta_b))
    throw InputError("--out", options.picture_folder,
                     scene.planar ? "asked for a scene whose squared lengths are doubles"
                                  : "asked for bodies that are apart: these have no cone to draw");
  if (options.json) {
    Json result = to_json(cone);
    result["answer"] = answer(scene, false);
    out << result.dump(1) << '\n';
  } else {
    print_text(cone, scene, out);
  }
  if (!folder) return;
  write_whole(folder->path() / "engagement.json", planar_picture(to_json(cone), scene).dump(1) + "\n");
  publish_cone(options, *folder, nullptr, "planar_engagement.py", "engagement", out);
}

struct ConePicture {
  Json data;
  const char* script = nullptr;
  const char* none = nullptr;  // why there is none
};

/// What --out asks for.
ConePicture cone_picture(const ConeCommand& options, const scenes::Scene& scene, const QuadricCone& cone) {
  if (const char* none = why_no_picture(cone.relation)) return {nullptr, nullptr, none};
  if (ellipsoids(scene))
    return {engagement_picture(scene, options.planes.value_or(kDefaultPlanes),
                               options.samples.value_or(kDefaultSamples)),
            "engagement.py"};
  ConePicture picture{scene_figure(scene, options.tolerance.value_or(kDefaultTolerance),
                                   options.planes.value_or(kDefaultPlanes)),
                      "combined_engagement.py"};
  if (picture.data.is_null()) picture.none = "the cone reaches 90 degrees from the line of centres";
  return picture;
}

}  // namespace

const char* why_no_picture(const std::optional<Relation>& relation) {
  if (!relation) return "whether the bodies are apart is not decided";
  if (*relation == Relation::disjoint) return nullptr;
  return "the bodies are not apart, so that there is no cone to draw";
}

void print_no_picture(const char* why, std::ostream& out) {
  out << "picture             none: " << why << '\n';
}

void publish_cone(const ConeCommand& options, work::StagedFolder& folder, const Json& map,
                  const std::string& script, const std::string& picture, std::ostream& out) {
  if (options.map) write_whole(folder.path() / "cone_map.json", map.dump() + "\n");
  if (options.figures) {
    if (!script.empty()) draw_figures(script, folder.path());
    if (options.map) draw_figures("cone_map.py", folder.path());
  }
  const auto files =
      folder.publish({"cone_map.json", "cone_map.pdf", "cone_map.png", picture + ".pdf", picture + ".png"});
  if (options.json) return;
  for (const auto& file : pictures_of(files)) out << "picture             " << file.string() << '\n';
}

namespace {

/// Verdicts are exact at any distance; a cone's numbers need squared lengths. The plane's may lack digits,
/// too.
void require_measurable(const scenes::Scene& scene) {
  const Eigen::Vector3d c = scene.obstacle.quadric()->center() - scene.agent.quadric()->center();
  if (std::isfinite(c.squaredNorm())) return;
  throw InputError("obstacle.center", to_text(detail::length(c)) + " m from the agent's",
                   "at most 1e154 m from it: a cone's numbers need squared lengths (query has the verdict)");
}

void cone_of_scene(const ConeCommand& options, const scenes::Scene& scene, std::ostream& out) {
  if (scene.in_plane && !scene.planar) return run_planar_cone(options, scene, out);
  if (has_assembly_cone(scene)) return run_pieces_cone(options, scene, out);
  if (!scene.agent.quadric() || !scene.obstacle.quadric()) return run_pair_cone(options, scene, out);
  require_measurable(scene);
  if (scene.planar) return run_planar_cone(options, scene, out);
  std::optional<work::StagedFolder> folder;
  if (!options.picture_folder.empty()) folder.emplace(options.picture_folder, "--out");
  const QuadricCone cone = cone_of(options, scene);
  const ConePicture picture = folder ? cone_picture(options, scene, cone) : ConePicture{};
  MapAnswer map;
  if (options.map)
    map = map_answer(scene, *options.map, options.tolerance.value_or(kDefaultTolerance), options.scene);
  if (options.json) {
    Json result = cone.json;
    result["answer"] = answer(scene, false);
    if (options.map) result["map"] = to_json(map);
    out << result.dump(1) << '\n';
  } else {
    print_verdict(scene, out);
    out << cone.text;
    if (options.map) print_map(map, out);
    out << "time                " << number_text(cone.seconds, 2) << " s\n";
    if (picture.none) print_no_picture(picture.none, out);
  }
  if (!folder || picture.none) return;
  write_whole(folder->path() / "engagement.json", picture.data.dump(1) + "\n");
  write_whole(folder->path() / "shapes.json", Json{{"figures", {"engagement"}}}.dump(1) + "\n");
  publish_cone(options, *folder, map.picture, picture.script, "engagement", out);
}

/// The answer as JSON, and what proves the verdict if that is wanted.
Json with_certificate(const ConeCommand& options, const scenes::Scene& scene, const Json& id) {
  std::ostringstream text;
  cone_of_scene(options, scene, text);
  Json result = Json::parse(text.str());
  const bool named = id.is_string() || id.is_number();
  if (options.certificate) add_scene_certificate(result, scene, named ? id.dump() : std::string());
  return result;
}

void write_glb(const ConeCommand& options, const scenes::Scene& scene, std::ostream& out) {
  write_whole(options.glb, glb::scene_glb(scene, answer(scene, false)));
  if (!options.json) out << "glb                 " << options.glb << '\n';
}

}  // namespace

int run_cone(const ConeCommand& options, std::ostream& out) {
  if (options.method != "exact" && options.method != "slice")
    throw InputError("--method", options.method, "slice or exact");
  if (options.certificate && !options.json && !options.cases)
    throw InputError("--certificate", "given alone",
                     "given with --json or --cases: it is a part of the JSON");
  if (!options.cases) {
    Json fields = input::read_scene_fields(options.scene);
    const auto slab = input::take_slab(fields);
    const scenes::Scene scene = input::scene_of(fields, options.scene);
    if (slab) return run_slab_cone(options, scene, *slab, out), 0;
    if (options.certificate)
      out << with_certificate(options, scene, {}).dump(1) << '\n';
    else
      cone_of_scene(options, scene, out);
    if (!options.glb.empty()) write_glb(options, scene, out);
    return 0;
  }
  if (!options.glb.empty())
    throw InputError("--glb", options.glb, "left out with --cases: the file is of one scene");
  if (!options.picture_folder.empty())
    throw InputError("--out", options.picture_folder, "left out with --cases: pictures are of one scene");
  ConeCommand each = options;
  each.json = true;
  const std::filesystem::path folder =
      options.scene == "-" ? "" : std::filesystem::path(options.scene).parent_path();
  const auto answer = [&](const Json& given) {
    Json value = given;
    const auto slab = input::take_slab(value);
    const scenes::Scene scene = input::read_engagement(value, input::Velocities::optional, {"id"}, folder);
    if (!slab) return with_certificate(each, scene, value.contains("id") ? value["id"] : Json());
    std::ostringstream text;
    run_slab_cone(each, scene, *slab, text);
    return Json::parse(text.str());
  };
  return answer_cases(options.scene, answer, out);
}

int cone_command(CommandLine& line) {
  ConeCommand cone;
  line.option("scene", cone.scene, "Scene file, YAML (docs/reference/formats.md); - for standard input")
      .required();
  line.flag("--cases", cone.cases, "The file has a scene on every line, as JSON; prints an answer a line");
  line.option("--method", cone.method,
              "exact: the true cone with its error bound; slice: the source's, too small");
  line.option("--planes", cone.planes,
              "Planes of the slice cone (36); half-planes of the cone of a body of pieces (64)");
  line.option("--tangents", cone.tangents,
              "Slices of combined quadrics: all candidates compared, or the source's choice, by-sides "
              "(6.3.2) or printed (5.2.2)");
  line.option("--samples", cone.samples, "Boundary samples of the exact cone of ellipsoids")
      .shown_default(std::to_string(kDefaultSamples));
  line.option("--tolerance", cone.tolerance,
              "Certified cone: solid angle between inner and outer, relative (0.01), combined quadrics "
              "always; bodies of pieces: width of each extreme angle, radians (0.0001)");
  std::vector<double> resolution, around;
  const auto map = line.option("--map", resolution,
                               "Map of all directions: colliding, safe, undecided cells, down to this size")
                       .shown_type("[RADIANS]")
                       .words(0, 1)
                       .shown_default(to_text(kDefaultResolution));
  line.option("--around", around, "x,y,z: the map's region that holds this direction")
      .commas()
      .words(3, 3)
      .needs(map);
  line.flag("--json", cone.json, "Print JSON");
  line.flag(
      "--certificate", cone.certificate,
      "Of JSON: add what proves the verdict, for programs that check it (docs/reference/certificates.md)");
  line.option("--glb", cone.glb,
              "File for bodies and cone as binary glTF, for viewers (docs/reference/formats.md)");
  line.option("--out,--picture", cone.picture_folder, "Folder for a picture of bodies and cones");
  line.negative_flag("--no-figures", cone.figures, "Of the picture, its data only");
  line.option("--threads", cone.threads, "Threads of map and picture, 0: one per processor");
  line.quiet();
  line.read();
  if (map.given()) {
    cone.map.emplace();
    cone.map->threads = threads_for(cone.threads);
    if (!resolution.empty()) cone.map->resolution = resolution.front();
    if (!around.empty()) cone.map->around = Eigen::Vector3d(around[0], around[1], around[2]);
  }
  return run_cone(cone, std::cout);
}

}  // namespace vericone
