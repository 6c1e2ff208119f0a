// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/pictures/run_glb.h"

#include <vericone/internal/simulation/shape_in_time.h>
#include <algorithm>
#include <vector>

#include "glb/body_surface.h"
#include "glb/glb_file.h"
#include "json/json_value.h"
#include "scenarios/run_json.h"

namespace vericone::scenario {
namespace {

constexpr std::size_t kMostPoses = 400;

/// Where the body is, from when it appears to its end.
struct Sampled {
  std::vector<double> times;
  std::vector<Pose> poses;
};

Sampled sampled(const simulation::Track& track) {
  const std::size_t legs = track.legs().size();
  const std::size_t pieces = std::clamp<std::size_t>(4 * legs, 1, kMostPoses - 1);
  Sampled found;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double share = double(i) / double(pieces);
    const double t = i == pieces ? track.end() : track.appears() + share * (track.end() - track.appears());
    const simulation::Motion motion = track.motion(t);
    found.times.push_back(t);
    found.poses.push_back({motion.position, motion.rotation});
  }
  return found;
}

}  // namespace

std::string run_glb(const simulation::Scenario& scenario, const simulation::Run& run) {
  glb::GlbFile file(Json{{"what", "run"}, {"scenario", scenario.name}, {"proof", proof_json(scenario, run)}});
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const simulation::Body& body = scenario.bodies[i];
    const Sampled way = sampled(run.tracks[i]);
    const WorldBody own =
        simulation::shape_at(body.shape, body.appears, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity());
    Json says{{"appears", body.appears}, {"agent", body.pilot.has_value()}};
    if (!body.shape.rigid()) says["shape_changes"] = true;
    const int mesh = file.mesh(body.name, glb::world_surface(own, Eigen::Vector3d::Zero()), glb::color_of(i));
    const int node = file.node(body.name, mesh, way.poses.front(), says);
    const Eigen::Vector3d start = way.poses.front().position;
    glb::Drawn line{{}, {}, true};
    for (const Pose& pose : way.poses) line.points.push_back(pose.position - start);
    const bool moves = std::any_of(way.poses.begin(), way.poses.end(), [&](const Pose& pose) {
      return pose.position != start || pose.rotation != way.poses.front().rotation;
    });
    if (!moves) continue;
    file.animate(node, way.times, way.poses);
    if (std::any_of(line.points.begin(), line.points.end(), [](const auto& x) { return !x.isZero(0); }))
      file.node("way of " + body.name, file.mesh("way of " + body.name, line, glb::color_of(i)),
                {start, Eigen::Matrix3d::Identity()});
  }
  return file.bytes();
}

}  // namespace vericone::scenario
