// SPDX-License-Identifier: BSD-3-Clause
#include "input/body.h"

#include "input/assembly_body.h"
#include "input/fields.h"
#include "input/planar_body.h"
#include "input/spatial_body.h"
#include "json_value.h"

namespace vericone::input {
namespace {

/// What the body's fields say: it is planar, spatial, or neither yet.
enum class Dimension { unknown, planar, spatial };

Dimension dimension(const Json& engagement, const char* body) {
  if (!engagement.contains(body) || !engagement[body].is_object()) return Dimension::unknown;
  const Json& value = engagement[body];
  if (value.contains("quadric")) return Dimension::spatial;
  if (!value.contains("center") || !value["center"].is_array()) return Dimension::unknown;
  if (value["center"].size() == 2) return Dimension::planar;
  return value["center"].size() == 3 ? Dimension::spatial : Dimension::unknown;
}

template <int D>
BasicCombined<D> read_body(const Json& value, const char* path) {
  if constexpr (D == 2) {
    return read_planar_body(value, path);
  } else {
    return read_spatial_body(value, path);
  }
}

template <int D>
Eigen::Matrix<double, D, 1> read_velocity(const Json& value, const char* field, Velocities velocities) {
  if (velocities == Velocities::optional && !value.contains(field))
    return Eigen::Matrix<double, D, 1>::Zero();
  return read_vector<D>(require_field(value, "", field, D == 2 ? "[x, y] in m/s" : "[x, y, z] in m/s"), field,
                        " (m/s)");
}

constexpr const char* kSpatialBody =
    "a body: center with semi_axes and rotation, or with shape; or quadric, or one made of pieces";

template <int D>
BasicEngagement<D> read_bodies(const Json& value, Velocities velocities) {
  const char* body = D == 2
                         ? "a body: center with semi_axes and rotation, with shape, or with a_c, b_c, k, phi"
                         : kSpatialBody;
  BasicEngagement<D> e;
  e.agent = read_body<D>(require_field(value, "", "agent", body), "agent");
  e.obstacle = read_body<D>(require_field(value, "", "obstacle", body), "obstacle");
  e.agent_velocity = read_velocity<D>(value, "agent_velocity", velocities);
  e.obstacle_velocity = read_velocity<D>(value, "obstacle_velocity", velocities);
  return e;
}

AssemblyEngagement read_assembly_engagement(const Json& value, Velocities velocities,
                                            const std::filesystem::path& folder) {
  const Json& agent = require_field(value, "", "agent", kSpatialBody);
  const Json& obstacle = require_field(value, "", "obstacle", kSpatialBody);
  const auto read_agent = [&]() -> std::variant<Ellipsoid, HullBody> {
    if (is_pieces_body(agent)) return read_hull_agent(agent, "agent", folder);
    const CombinedEllipsoid body = read_spatial_body(agent, "agent");
    if (!body.is_ellipsoid())
      throw InputError("agent.hyperboloids", quoted(agent["hyperboloids"]),
                       "left out: bodies of pieces meet ellipsoids and convex hulls");
    return body.ellipsoid();
  };
  auto body = read_agent();
  if (!is_pieces_body(obstacle))
    throw InputError("obstacle", quoted(obstacle),
                     "made of pieces where the agent is (" + pieces_kinds() +
                         "); exchange the bodies and their velocities");
  const Eigen::Vector3d v_a = read_velocity<3>(value, "agent_velocity", velocities),
                        v_b = read_velocity<3>(value, "obstacle_velocity", velocities);
  return {std::move(body), read_pieces_body(obstacle, "obstacle", folder), v_a, v_b};
}

}  // namespace

std::string quoted(const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  constexpr std::size_t kLongest = 60;
  if (text.size() > kLongest) text = text.substr(0, kLongest - 3) + "...";
  return text;
}

AnyEngagement read_engagement(const Json& value, Velocities velocities,
                              std::initializer_list<const char*> also, const std::filesystem::path& folder) {
  if (!value.is_object()) throw InputError("engagement", quoted(value), "a mapping with agent and obstacle");
  std::vector<std::string> known{"agent", "obstacle", "agent_velocity", "obstacle_velocity"};
  known.insert(known.end(), also.begin(), also.end());
  require_known(value, "", known);
  for (const char* body : {"agent", "obstacle"})
    if (value.contains(body) && is_pieces_body(value[body]))
      return read_assembly_engagement(value, velocities, folder);
  const Dimension agent = dimension(value, "agent"), obstacle = dimension(value, "obstacle");
  if (agent != Dimension::spatial && obstacle != Dimension::spatial &&
      (agent == Dimension::planar || obstacle == Dimension::planar))
    return read_bodies<2>(value, velocities);
  return read_bodies<3>(value, velocities);
}

}  // namespace vericone::input
