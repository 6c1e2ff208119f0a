// SPDX-License-Identifier: BSD-3-Clause
#include "input/body.h"

#include "input/assembly_body.h"
#include "input/body_kind.h"
#include "input/file_body.h"
#include "input/motions.h"
#include "input/planar_body.h"
#include "json/json_value.h"
#include "solids/convex_body.h"
#include "solids/flat_body.h"
#include "units/geographic.h"

namespace vericone::input {
namespace {

/// What the body's fields say: it is planar, spatial, or neither yet.
enum class Dimension { unknown, planar, spatial };

Dimension dimension(const Json& body) {
  if (!body.is_object()) return Dimension::unknown;
  if (body.contains("quadric")) return Dimension::spatial;
  const auto center = body.find("center");
  if (center == body.end() || !center->is_array()) return Dimension::unknown;
  if (center->size() == 2) return Dimension::planar;
  return center->size() == 3 ? Dimension::spatial : Dimension::unknown;
}

std::size_t pieces_of(const Placed& body) {
  const auto* quadrics = body.body.quadrics();
  const auto* hulls = body.body.assembly();
  return quadrics ? quadrics->size() : hulls ? hulls->size() : 1;
}

template <int D>
Eigen::Vector3d read_velocity(const Json& value, const char* field, Velocities velocities) {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  if (velocities == Velocities::required || value.contains(field))
    velocity.head<D>() = read_vector<D>(
        require_field(value, "", field, D == 2 ? "[x, y] in m/s" : "[x, y, z] in m/s"), field, " (m/s)");
  return velocity;
}

template <int D>
void read_velocities(const Json& value, Velocities velocities, Scene& scene) {
  scene.agent.velocity = read_velocity<D>(value, "agent_velocity", velocities);
  scene.obstacle.velocity = read_velocity<D>(value, "obstacle_velocity", velocities);
}

constexpr const char* kPlanarBody =
    "a body: center with semi_axes and rotation, with shape, or with a_c, b_c, k, phi; or polygon or stadium";
constexpr const char* kSpatialBody =
    "a body: center with semi_axes and rotation, or with shape; or quadric, or one made of pieces; or a word "
    "(cylinder, ...) with its sizes; or file";

SceneBody quadric_body(const CombinedEllipsoid& body) {
  return {Body(body), body.is_ellipsoid() ? "ellipsoid" : "combined quadric"};
}

Scene planar_scene(const Json& value, Velocities velocities) {
  const CombinedEllipse a = read_planar_body(require_field(value, "", "agent", kPlanarBody), "agent"),
                        b = read_planar_body(require_field(value, "", "obstacle", kPlanarBody), "obstacle");
  const double height = std::max(a.ellipsoid().semi_axes().maxCoeff(), b.ellipsoid().semi_axes().maxCoeff());
  const auto body = [&](const CombinedEllipse& flat) {
    return SceneBody{Body(raised(flat, height)), flat.is_ellipsoid() ? "ellipse" : "combined conic"};
  };
  Scene scene{body(a), body(b), true, scenes::PlanarBodies{a, b}};
  read_velocities<2>(value, velocities, scene);
  return scene;
}

/// Whether the agent is a convex hull before a body of pieces: it is then read as one.
bool is_hull_agent(const Json& agent, const Json& obstacle) {
  return (agent.contains("hull") || agent.contains("points")) && is_pieces_body(agent) &&
         is_pieces_body(obstacle) && !is_union(agent) && !agent.contains("margin") &&
         !obstacle.contains("margin");
}

Scene quadric_scene(const Json& value, Velocities velocities) {
  Scene scene;
  scene.agent = quadric_body(read_spatial_body(require_field(value, "", "agent", kSpatialBody), "agent"));
  scene.obstacle =
      quadric_body(read_spatial_body(require_field(value, "", "obstacle", kSpatialBody), "obstacle"));
  read_velocities<3>(value, velocities, scene);
  return scene;
}

/// Pieces are in space, and so is then the other body.
void require_space(const Json& scene) {
  const auto has = [&](const char* body) { return scene.contains(body) && scene[body].is_object(); };
  for (const char* body : {"agent", "obstacle"}) {
    if (!has(body) || !scene[body].contains("points")) continue;
    const Json& points = scene[body]["points"];
    if (points.is_array() && !points.empty() && points[0].is_array() && points[0].size() == 2)
      throw InputError(std::string(body) + ".points", quoted(points),
                       "points [x, y, z]; of a body in the plane polygon: [[x, y], ...]");
  }
  for (const char* body : {"agent", "obstacle"})
    if (has(body) && dimension(scene[body]) == Dimension::planar)
      throw InputError(
          std::string(body) + ".center", quoted(scene[body]["center"]),
          "[x, y, z]: a body of pieces or a solid of the words (cylinder, ...) is in space, and so is what "
          "it may meet");
}

/// Whether both bodies are of the plane, and flat_scene() reads them: one is a polygon or a stadium, or has a
/// margin there.
bool is_flat(const Json& agent, const Json& obstacle) {
  const auto in_space = [](const Json& body) {
    return dimension(body) == Dimension::spatial ||
           (!is_flat_word(body) && (is_pieces_body(body) || is_union(body)));
  };
  const auto own = [](const Json& body) {
    return is_flat_word(body) || (dimension(body) == Dimension::planar && body.contains("margin"));
  };
  return (own(agent) || own(obstacle)) && !in_space(agent) && !in_space(obstacle);
}

Scene flat_engagement(const Json& value, Velocities velocities) {
  Scene scene = flat_scene(require_field(value, "", "agent", kPlanarBody),
                           require_field(value, "", "obstacle", kPlanarBody));
  read_velocities<2>(value, velocities, scene);
  return scene;
}

/// Whether a body is one of those that pieces_scene() reads.
bool is_of_pieces(const Json& body) {
  return is_pieces_body(body) || is_union(body) || (body.is_object() && body.contains("margin"));
}

/// At least one body is made of pieces, is a union, or has a margin.
Scene pieces_scene(const Json& value, Velocities velocities, const std::filesystem::path& folder) {
  const Json& agent = require_field(value, "", "agent", kSpatialBody);
  const Json& obstacle = require_field(value, "", "obstacle", kSpatialBody);
  require_space(value);
  Scene scene;
  scene.agent = is_hull_agent(agent, obstacle) ? read_hull_agent(agent, "agent", folder)
                                               : read_body(agent, "agent", folder);
  scene.obstacle = read_body(obstacle, "obstacle", folder);
  read_velocities<3>(value, velocities, scene);
  return scene;
}

/// Whether nothing but a body's own fields is there.
bool is_plain(const Json& body) {
  return !body.is_object() || (!body.contains("file") && !body.contains("velocity"));
}

/// The engagement with the fields of files in place of their names, and with the velocities beside the
/// bodies.
Json plain(const Json& engagement, const std::filesystem::path& folder) {
  Json result = engagement;
  for (const std::string name : {"agent", "obstacle"}) {
    if (!result.contains(name) || is_plain(result[name])) continue;
    Json& body = result[name];
    if (body.contains("velocity")) {
      const std::string field = name + "_velocity";
      if (result.contains(field))
        throw InputError(field, quoted(result[field]), "left out beside " + name + ".velocity");
      Json velocity = body["velocity"];
      body.erase("velocity");
      result[field] = std::move(velocity);
    }
    result[name] = body_fields(result[name], name, folder);
  }
  return result;
}

}  // namespace

SceneBody read_body(const Json& given, const std::string& path, const std::filesystem::path& folder) {
  Json value = body_fields(given, path, folder);
  refuse_words_of_scenes(value, path);
  if (value.is_object() && value.contains("margin")) {
    const double margin = not_negative("m").read(value["margin"], join(path, "margin"));
    value.erase("margin");
    SceneBody body = read_body(value, path, folder);
    return within(path, [&] { return with_margin(std::move(body), margin); });
  }
  if (is_pieces_body(value) && !is_union(value)) return read_pieces_body(value, path, folder);
  if (!is_union(value)) return quadric_body(read_spatial_body(value, path));
  Placed body = read_union(value, path, folder);
  const std::size_t count = pieces_of(body);
  return {std::move(body), "union of " + std::to_string(count) + (count == 1 ? " piece" : " pieces")};
}

const Fields<Scene>& engagement_fields() {
  const Json body{{"$ref", "body.schema.json#/$defs/body"}};
  static const Fields<Scene> fields =
      Fields<Scene>("engagement")
          .special("agent", body, {}, "What moves.", required("a body"))
          .special("obstacle", body, {}, "What it may meet.", required("a body"))
          .special("agent_velocity", point<3>("m/s").schema, {}, "`[x, y, z]`, in the plane `[x, y]`.",
                   absent("zero"))
          .special("obstacle_velocity", point<3>("m/s").schema, {}, "The same of the obstacle.",
                   absent("zero"))
          .special("origin", origin_schema(), {}, kOriginSentence, absent("nowhere"));
  return fields;
}

Scene read_engagement(const Json& value, Velocities velocities, const std::vector<std::string_view>& also,
                      const std::filesystem::path& folder) {
  if (!value.is_object()) throw InputError("engagement", quoted(value), "a mapping with agent and obstacle");
  refuse_motions(value);
  Json kept;
  if (value.contains("origin")) return read_engagement(localized(value, kept), velocities, also, folder);
  std::vector<std::string_view> known = engagement_fields().names();
  known.insert(known.end(), also.begin(), also.end());
  require_known(value, "", std::span<const std::string_view>(known));
  const Json none;
  const auto field = [&](const char* name) -> const Json& {
    const auto found = value.find(name);
    return found == value.end() ? none : *found;
  };
  const Json &a = field("agent"), &b = field("obstacle");
  if (!is_plain(a) || !is_plain(b)) return read_engagement(plain(value, folder), velocities, also, folder);
  if (is_flat(a, b)) return flat_engagement(value, velocities);
  if (is_of_pieces(a) || is_of_pieces(b)) return pieces_scene(value, velocities, folder);
  const Dimension agent = dimension(a), obstacle = dimension(b);
  const bool planar = agent != Dimension::spatial && obstacle != Dimension::spatial &&
                      (agent == Dimension::planar || obstacle == Dimension::planar);
  return planar ? planar_scene(value, velocities) : quadric_scene(value, velocities);
}

}  // namespace vericone::input
