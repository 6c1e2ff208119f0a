// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/scanning/study.h>

#include "input/scene.h"
#include "input/spatial_body.h"
#include "json/json_value.h"
#include "pieces/world_mesh.h"
#include "scan/lidar_fields.h"

namespace vericone::scanning {

ScanScene read_scan_scene(const std::filesystem::path& file) {
  const Json fields = input::read_scene_fields(file.string());
  input::require_kind(fields, input::FileKind::scene, file.string());
  SceneLidars lidars = read_lidars(fields);
  scenes::Scene bodies = input::scene_of(fields, file.string());
  if (bodies.obstacle.field != "mesh" || !(bodies.agent.ellipsoid() || bodies.agent.hull()))
    throw InputError("obstacle", "no mesh", "a mesh for the lidars to see");
  if (!bodies.agent.ellipsoid()) throw InputError("agent", "a hull", "an ellipsoid");
  Setup setup;
  setup.agent = *bodies.agent.ellipsoid();
  setup.agent_pose.translation() = setup.agent.center();
  setup.agent_pose.linear() = input::read_rotation(fields["agent"], "agent");
  WorldMesh mesh = world_mesh(*bodies.obstacle.pieces(), bodies.obstacle.placed.pose);
  setup.points = std::move(mesh.points);
  setup.triangles = std::move(mesh.triangles);
  setup.lidars = std::move(lidars.lidars);
  setup.position_error = lidars.position_error;
  setup.rotation_error = lidars.rotation_error;
  return {std::move(bodies), std::move(setup)};
}

}  // namespace vericone::scanning
