// SPDX-License-Identifier: BSD-3-Clause
#include "glb/scene_glb.h"

#include <vericone/cones/plane_sector.h>
#include <vericone/internal/scenes/words.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "glb/body_surface.h"
#include "glb/glb_file.h"
#include "json/json_value.h"
#include "solids/flat_body.h"

namespace vericone::glb {
namespace {

using Eigen::Vector3d;

constexpr int kPlanes = 36;

struct DrawnCone {
  Drawn surface;
  double error = 0;  // rad, the largest of an edge
};

Vector3d on_plane(const PlaneSector& sector, double angle) {
  return std::cos(angle) * sector.line_of_sight + std::sin(angle) * sector.across;
}

/// From the apex, `length` long; nothing where the bodies are not apart.
std::optional<DrawnCone> drawn_cone(const Pair& pair, const Vector3d& from, const Vector3d& to,
                                    double length) {
  const Vector3d sight = (to - from).normalized(), e = sight.unitOrthogonal(), f = sight.cross(e);
  DrawnCone cone;
  cone.surface.points.assign(1 + 2 * kPlanes, Vector3d::Zero());
  for (int k = 0; k < kPlanes; ++k) {
    const double turn = std::numbers::pi * k / kPlanes;
    const auto sector = pair.sector(from, to, std::cos(turn) * e + std::sin(turn) * f);
    if (!sector) return std::nullopt;
    cone.surface.points[std::size_t(1 + k)] = length * on_plane(*sector, sector->left.angle);
    cone.surface.points[std::size_t(1 + kPlanes + k)] = length * on_plane(*sector, -sector->right.angle);
    cone.error = std::max({cone.error, sector->left.error, sector->right.error});
  }
  for (std::uint32_t i = 0; i < 2 * kPlanes; ++i)
    cone.surface.triangles.push_back({0, 1 + i, 1 + (i + 1) % (2 * kPlanes)});
  return cone;
}

/// The sector of bodies in the plane.
std::optional<DrawnCone> drawn_sector(const Pair& pair, const Vector3d& from, const Vector3d& to,
                                      double length) {
  const auto sector = pair.sector(from, to, Vector3d::UnitZ().cross(to - from));
  if (!sector) return std::nullopt;
  DrawnCone cone{{}, std::max(sector->left.error, sector->right.error)};
  cone.surface.points.emplace_back(0, 0, 0);
  for (int i = 0; i <= kPlanes; ++i)
    cone.surface.points.push_back(length *
                                  on_plane(*sector, -sector->right.angle + sector->psi() * i / kPlanes));
  for (std::uint32_t i = 1; i <= kPlanes; ++i) cone.surface.triangles.push_back({0, i, i + 1});
  return cone;
}

void add_cone(GlbFile& file, const scenes::Scene& scene) {
  const Pair pair = scene.pair();
  const Vector3d from = pair.agent().middle(), to = pair.obstacle().middle();
  const double length = (to - from).norm();
  const Vector3d w = scene.relative_velocity();
  if (!(length > 0) || !std::isfinite(length)) return;
  if (w.any())
    file.node("relative velocity",
              file.mesh("relative velocity", {{Vector3d::Zero(), length * w.stableNormalized()}, {}, true},
                        color_of(7)),
              {from, Eigen::Matrix3d::Identity()}, Json{{"w", vector_json(w)}});
  const auto cone =
      scene.in_plane ? drawn_sector(pair, from, to, length) : drawn_cone(pair, from, to, length);
  if (!cone) return;
  Json says{{"is",
             "directions of w = v_agent - v_obstacle: beyond an edge and its error no direction of its "
             "plane collides"},
            {"planes", scene.in_plane ? 1 : kPlanes},
            {"edge_error", cone->error}};
  file.node("cone", file.mesh("cone", cone->surface, {0.7, 0.02, 0.02, 0.25}),
            {from, Eigen::Matrix3d::Identity()}, says);
}

/// Where a body's mesh has its origin: numbers near 0 keep their digits as floats.
Pose about_middle(const Placed& body) { return {body.pose.to_world(body.body.middle()), body.pose.rotation}; }

void add_body(GlbFile& file, const Shown& shown, std::size_t number) {
  Color color = color_of(number);
  color.alpha = shown.alpha;
  file.node(shown.name, file.mesh(shown.name, body_surface(shown.body.body, shown.body.body.middle()), color),
            about_middle(shown.body), shown.extras);
}

}  // namespace

std::string scene_glb(const scenes::Scene& scene, const Json& answer) {
  GlbFile file(Json{{"what", "scene"}, {"answer", answer}});
  const auto add = [&](const char* name, const scenes::SceneBody& body, const CombinedEllipse* flat,
                       std::size_t number) {
    Json says{{"is", flat ? scenes::body_words(*flat) : scenes::body_words(body.placed)},
              {"velocity", vector_json(body.velocity)}};
    if (scene.in_plane && !flat) {
      const Vector3d middle = body.placed.middle();
      file.node(name,
                file.mesh(name, flat_surface(input::flat_outlines(body.placed), middle), color_of(number)),
                {middle, Eigen::Matrix3d::Identity()}, says);
      return;
    }
    if (!flat) return add_body(file, {name, body.placed, 1, says}, number);
    const Eigen::Vector2d center = flat->center();
    file.node(name, file.mesh(name, flat_surface(*flat), color_of(number)),
              {{center.x(), center.y(), 0}, Eigen::Matrix3d::Identity()}, says);
  };
  add("agent", scene.agent, scene.planar ? &scene.planar->agent : nullptr, 0);
  add("obstacle", scene.obstacle, scene.planar ? &scene.planar->obstacle : nullptr, 1);
  add_cone(file, scene);
  return file.bytes();
}

std::string bodies_glb(const std::vector<Shown>& bodies, const Json& extras) {
  GlbFile file(extras);
  for (std::size_t i = 0; i < bodies.size(); ++i) add_body(file, bodies[i], i);
  return file.bytes();
}

}  // namespace vericone::glb
