// SPDX-License-Identifier: BSD-3-Clause
#include "cone/pieces_cone.h"

#include <vericone/cones/slices/visible_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/slices/visible_sector.h>
#include <vericone/work/staged_folder.h>
#include <cmath>
#include <optional>
#include <ostream>

#include "cone/answer.h"
#include "cone/assembly_cone.h"
#include "cone/pieces_picture.h"
#include "cone/verdict_text.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "output/slice_json.h"
#include "pieces/world_mesh.h"
#include "work/threads.h"

namespace vericone {
namespace {

void refuse_options(const ConeCommand& options) {
  if (options.samples)
    throw InputError("--samples", std::to_string(*options.samples), "left out for a body of pieces");
  if (options.tangents != "all")
    throw InputError("--tangents", options.tangents, "left out for a body of pieces");
}

/// The source's slices of a mesh that is known as a whole: tangents to the corners of its sections.
struct MeshSlices {
  int planes = 0;
  std::optional<Relation> relation;
  VisibleCone cone;
  double seconds = 0;
};

MeshSlices mesh_slices(const scenes::Scene& scene, int planes) {
  const Ellipsoid* agent = scene.agent.ellipsoid();
  if (!agent || scene.obstacle.pieces()->kind() != PieceKind::triangle)
    throw InputError("--method", "slice",
                     "left out except for an ellipsoid and a mesh, a scene of ellipsoids, or scan");
  const WorldMesh mesh = world_mesh(*scene.obstacle.pieces(), scene.obstacle.placed.pose);
  const auto start = Clock::now();
  MeshSlices result{planes, scene.pair().relation(),
                    visible_cone(*agent, mesh_section_points(mesh.points, mesh.triangles),
                                 scene.obstacle.placed.middle(), planes, {.search = {}, .by_search = false})};
  result.seconds = seconds_since(start);
  return result;
}

Json to_json(const MeshSlices& slices, const scenes::Scene& scene) {
  const VisibleCone& cone = slices.cone;
  Json result{{"method", "slice"},
              {"planes", slices.planes},
              {"relation", to_string(*slices.relation)},
              {"axis", {cone.axis.x(), cone.axis.y(), cone.axis.z()}}};
  result.update(polyhedral_json(cone.polyhedral()));
  Json sectors = Json::array();
  for (const VisiblePlane& plane : cone.planes)
    if (plane.slice)
      sectors.push_back(sector_json(*plane.slice, cone.axis, scene.agent.velocity, scene.obstacle.velocity));
  result["sectors"] = sectors;
  result["planes_without_answer"] = cone.planes_without_answer();
  result["inner"] = result["outer"] = result["error_bound"] = nullptr;
  result["seconds"] = slices.seconds;
  return result;
}

void print_text(const MeshSlices& slices, const scenes::Scene& scene, std::ostream& out) {
  const double solid_angle = slices.cone.polyhedral().solid_angle;
  print_verdict(scene, out);
  out << "method              slice, " << slices.planes << " planes\n"
      << "obstacle            " << scene.obstacle.name << '\n'
      << "bodies              " << to_string(*slices.relation) << '\n';
  if (std::isfinite(solid_angle)) out << "solid angle         " << number_text(solid_angle) << " sr\n";
  if (const auto none = slices.cone.planes_without_answer(); none != 0)
    out << "no tangents         on " << none << " planes\n";
  out << "note                slices see only contacts within their planes: they are in the true cone, what "
         "lies between them need not be\n"
      << "time                " << number_text(slices.seconds, 2) << " s\n";
}

}  // namespace

void run_pieces_cone(const ConeCommand& options, const scenes::Scene& scene, std::ostream& out) {
  refuse_options(options);
  if (options.method == "slice") {
    if (options.map || !options.picture_folder.empty())
      throw InputError("--method", "slice", "left out where a map or a picture is asked for");
    const MeshSlices slices = mesh_slices(scene, options.planes.value_or(kDefaultPlanes));
    if (options.json) {
      Json result = to_json(slices, scene);
      result["answer"] = answer(scene, false);
      out << result.dump(1) << '\n';
    } else {
      print_text(slices, scene, out);
    }
    return;
  }
  std::optional<work::StagedFolder> folder;
  if (!options.picture_folder.empty()) folder.emplace(options.picture_folder, "--out");
  const AssemblyCone cone = assembly_cone(scene, options.planes.value_or(kDefaultHalfPlanes),
                                          options.tolerance.value_or(kDefaultAngle));
  const char* no_picture = folder ? why_no_picture(cone.relation) : nullptr;
  MapAnswer map;
  if (options.map) map = map_answer(cone.oracle, *options.map, cone.frame.axis, scene.obstacle.name);
  if (options.json) {
    Json result = to_json(cone, scene);
    result["answer"] = answer(scene, false);
    result["map"] = options.map ? to_json(map) : Json(nullptr);
    out << result.dump(1) << '\n';
  } else {
    print_verdict(scene, out);
    print_text(cone, scene, out);
    if (options.map) print_map(map, out);
    out << "time                " << number_text(cone.seconds, 2) << " s, after "
        << number_text(cone.seconds_prepared, 2) << " s to prepare\n";
    if (no_picture) print_no_picture(no_picture, out);
  }
  if (!folder || no_picture) return;
  const std::string script = write_pieces_picture(cone, scene, folder->path(), threads_for(options.threads));
  publish_cone(options, *folder, map.picture, script, "cone", out);
}

}  // namespace vericone
