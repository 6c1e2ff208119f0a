// SPDX-License-Identifier: BSD-3-Clause
#include "pieces/pieces_cone.h"

#include <vericone/cones/slices/visible_cone.h>
#include <vericone/geometry/error.h>
#include <optional>
#include <ostream>

#include "cone/answer.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/staged_folder.h"
#include "output/threads.h"
#include "picture/slice_json.h"
#include "pieces/assembly_cone.h"
#include "pieces/pieces_picture.h"
#include "pieces/world_mesh.h"

namespace vericone {
namespace {

void refuse_options(const ConeCommand& options) {
  if (options.samples)
    throw InputError("--samples", std::to_string(*options.samples), "left out for a body of pieces");
  if (options.tangents != "all")
    throw InputError("--tangents", options.tangents, "left out for a body of pieces");
}

/// The source's slices of a mesh that is known as a whole: tangents to the corners of its sections.
Json slices_json(const scenes::Scene& scene, int planes) {
  const Ellipsoid* agent = scene.agent.ellipsoid();
  if (!agent || scene.obstacle.pieces()->kind() != PieceKind::triangle)
    throw InputError("--method", "slice",
                     "left out except for an ellipsoid and a mesh, a scene of ellipsoids, or scan");
  const WorldMesh mesh = world_mesh(*scene.obstacle.pieces(), scene.obstacle.placed.pose);
  const auto start = Clock::now();
  const VisibleCone cone =
      visible_cone(*agent, mesh_section_points(mesh.points, mesh.triangles), scene.obstacle.placed.middle(),
                   planes, {.search = {}, .by_search = false});
  const double seconds = seconds_since(start);
  Json result{{"method", "slice"},
              {"planes", planes},
              {"relation", to_string(*scene.pair().relation())},
              {"axis", {cone.axis.x(), cone.axis.y(), cone.axis.z()}}};
  result.update(polyhedral_json(cone.polyhedral()));
  Json sectors = Json::array();
  for (const VisiblePlane& plane : cone.planes)
    if (plane.slice)
      sectors.push_back(sector_json(*plane.slice, cone.axis, scene.agent.velocity, scene.obstacle.velocity));
  result["sectors"] = sectors;
  result["planes_without_answer"] = cone.planes_without_answer();
  result["inner"] = result["outer"] = result["error_bound"] = nullptr;
  result["seconds"] = seconds;
  return result;
}

void print_slices(const Json& cone, const scenes::Scene& scene, std::ostream& out) {
  out << "method              slice, " << cone["planes"].dump() << " planes\n"
      << "obstacle            " << scene.obstacle.name << '\n'
      << "bodies              " << cone["relation"].get<std::string>() << '\n';
  if (cone["solid_angle"].is_number()) out << "solid angle         " << cone["solid_angle"].dump() << " sr\n";
  if (cone["planes_without_answer"] != 0)
    out << "no tangents         on " << cone["planes_without_answer"].dump() << " planes\n";
  out << "note                slices see only contacts within their planes: they are in the true cone, what "
         "lies "
         "between them need not be\n"
      << "time                " << cone["seconds"].dump() << " s\n";
}

void print_verdict(const scenes::Scene& scene, std::ostream& out) {
  const Json verdict = answer(scene, false);
  out << "verdict             " << verdict["verdict"].get<std::string>()
      << " (of the scene's velocities, exact)\n";
  if (verdict["contact_point"].is_array())
    out << "first contact       after " << verdict["time_to_contact"].dump() << " s at "
        << verdict["contact_point"].dump() << '\n';
  if (verdict["clearance"].is_number() && verdict["verdict"] == "out")
    out << "passes at           " << verdict["clearance"].dump() << " m\n";
}

}  // namespace

void run_pieces_cone(const ConeCommand& options, const scenes::Scene& scene, std::ostream& out) {
  refuse_options(options);
  if (options.method == "slice") {
    if (options.map || !options.picture_folder.empty())
      throw InputError("--method", "slice", "left out where a map or a picture is asked for");
    const Json slices = slices_json(scene, options.planes.value_or(kDefaultPlanes));
    if (options.json) {
      out << slices.dump(1) << '\n';
    } else {
      print_slices(slices, scene, out);
    }
    return;
  }
  std::optional<StagedFolder> folder;
  if (!options.picture_folder.empty()) folder.emplace(options.picture_folder, "--out");
  const AssemblyCone cone = assembly_cone(scene, options.planes.value_or(kDefaultHalfPlanes),
                                          options.tolerance.value_or(kDefaultAngle));
  if (folder && cone.relation != Relation::disjoint)
    throw InputError("--out", options.picture_folder, "asked for disjoint bodies only");
  MapAnswer map;
  if (options.map) map = map_answer(cone.oracle, *options.map, cone.frame.axis, scene.obstacle.name);
  if (options.json) {
    Json result = to_json(cone, scene);
    result["map"] = options.map ? map.summary : Json(nullptr);
    out << result.dump(1) << '\n';
  } else {
    print_text(cone, scene, out);
    if (options.map) print_map(map.summary, out);
    print_verdict(scene, out);
    out << "time                " << to_text(cone.seconds) << " s, after " << to_text(cone.seconds_prepared)
        << " s to prepare\n";
  }
  if (!folder) return;
  const std::string script = write_pieces_picture(cone, scene, folder->path(), threads_for(options.threads));
  publish_cone(options, *folder, map.picture, script, "cone", out);
}

}  // namespace vericone
