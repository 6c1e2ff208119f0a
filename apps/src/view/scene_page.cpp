// SPDX-License-Identifier: BSD-3-Clause
#include "view/scene_page.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/body_numbers.h>
#include <vericone/internal/scenes/words.h>

#include "cone/answer.h"
#include "glb/body_surface.h"
#include "json/json_value.h"
#include "picture/surface_json.h"
#include "solids/flat_body.h"

namespace vericone {
namespace {

using Eigen::Vector3d;

std::size_t pieces_of(const Body& body) {
  if (const Assembly* assembly = body.assembly()) return assembly->size();
  if (const HullBody* hull = body.hull()) return hull->size();
  return body.quadrics() ? body.quadrics()->size() : 1;
}

/// About the body's middle, in the axes of the world for bodies in the plane, else its own.
glb::Drawn surface_of(const scenes::Scene& scene, const scenes::SceneBody& body,
                      const CombinedEllipse* flat) {
  if (!scene.in_plane) return glb::body_surface(body.placed.body, body.placed.body.middle());
  if (flat) return glb::flat_surface(*flat);
  return glb::flat_surface(input::flat_outlines(body.placed), body.placed.middle());
}

Json body_json(const char* name, const scenes::Scene& scene, const scenes::SceneBody& body,
               const CombinedEllipse* flat) {
  if (const std::size_t pieces = pieces_of(body.placed.body); pieces > kMostPagePieces)
    throw InputError(name, std::to_string(pieces) + " pieces",
                     "one of at most " + std::to_string(kMostPagePieces) +
                         " in a page (vericone cone and query take more)");
  const Pose& pose = body.placed.pose;
  const Eigen::Matrix3d by_columns = pose.rotation.transpose();  // whose columns are the rows
  return {{"name", name},
          {"is", flat ? scenes::body_words(*flat) : scenes::body_words(body.placed)},
          {"numbers", body_numbers(body.placed.body)},
          {"position", vector_json(pose.position)},
          {"rotation", vector_json(by_columns.reshaped())},
          {"velocity", vector_json(body.velocity)},
          {"middle", vector_json(body.placed.middle())},
          {"surface", surface_json(surface_of(scene, body, flat))}};
}

}  // namespace

Json scene_page(const scenes::Scene& scene, const std::string& title) {
  const Guarantee guarantee = scene.pair().guarantee();
  return {{"what", "scene"},
          {"title", title},
          {"planar", scene.in_plane},
          {"guarantee",
           {{"exact", guarantee.exact}, {"family", guarantee.family}, {"tolerance", guarantee.tolerance}}},
          {"answer", answer(scene, true)},
          {"bodies",
           {body_json("agent", scene, scene.agent, scene.planar ? &scene.planar->agent : nullptr),
            body_json("obstacle", scene, scene.obstacle, scene.planar ? &scene.planar->obstacle : nullptr)}}};
}

}  // namespace vericone
