// SPDX-License-Identifier: BSD-3-Clause
#include "input/body.h"

#include "input/assembly_body.h"
#include "input/fields.h"
#include "input/file_body.h"
#include "input/planar_body.h"
#include "input/spatial_body.h"
#include "json/json_value.h"

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

std::size_t pieces_of(const Placed& body) {
  const auto* quadrics = std::get_if<std::vector<CombinedEllipsoid>>(&body.body.shape());
  const auto* hulls = std::get_if<Assembly>(&body.body.shape());
  return quadrics ? quadrics->size() : hulls ? hulls->size() : 1;
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
    "a body: center with semi_axes and rotation, or with shape; or quadric, or one made of pieces; or file";

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

/// At least one body is made of pieces, or is a union.
AnyEngagement read_pieces_engagement(const Json& value, Velocities velocities,
                                     const std::filesystem::path& folder) {
  const Json& agent = require_field(value, "", "agent", kSpatialBody);
  const Json& obstacle = require_field(value, "", "obstacle", kSpatialBody);
  const auto v_a = [&] { return read_velocity<3>(value, "agent_velocity", velocities); };
  const auto v_b = [&] { return read_velocity<3>(value, "obstacle_velocity", velocities); };
  const auto pieces_before = [&](std::variant<Ellipsoid, HullBody> body) {
    const Eigen::Vector3d velocity = v_a(), of_obstacle = v_b();
    return AssemblyEngagement{std::move(body), read_pieces_body(obstacle, "obstacle", folder), velocity,
                              of_obstacle};
  };
  if (is_pieces_body(obstacle) && !is_union(agent)) {
    if (is_pieces_body(agent)) {
      if (agent.contains("hull") || agent.contains("points"))
        return pieces_before(read_hull_agent(agent, "agent", folder));
    } else if (const CombinedEllipsoid body = read_spatial_body(agent, "agent"); body.is_ellipsoid()) {
      return pieces_before(body.ellipsoid());
    }
  }
  auto [first, first_name] = read_placed(agent, "agent", folder);
  auto [second, second_name] = read_placed(obstacle, "obstacle", folder);
  return PlacedEngagement{
      std::move(first), std::move(second), std::move(first_name), std::move(second_name), v_a(), v_b()};
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

std::string quoted(const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  constexpr std::size_t kLongest = 60;
  if (text.size() > kLongest) text = text.substr(0, kLongest - 3) + "...";
  return text;
}

std::pair<Placed, std::string> read_placed(const Json& given, const std::string& path,
                                           const std::filesystem::path& folder) {
  const Json value = body_fields(given, path, folder);
  if (is_union(value)) {
    Placed body = read_union(value, path, folder);
    const std::size_t count = pieces_of(body);
    return {std::move(body), "union of " + std::to_string(count) + (count == 1 ? " piece" : " pieces")};
  }
  if (!is_pieces_body(value)) {
    const CombinedEllipsoid body = read_spatial_body(value, path);
    return {Placed(body), body.is_ellipsoid() ? "ellipsoid" : "combined quadric"};
  }
  PiecesBody body = read_pieces_body(value, path, folder);
  std::string name = describe(body);
  return {Placed(std::move(body.pieces), body.pose), std::move(name)};
}

AnyEngagement read_engagement(const Json& value, Velocities velocities,
                              std::initializer_list<const char*> also, const std::filesystem::path& folder) {
  if (!value.is_object()) throw InputError("engagement", quoted(value), "a mapping with agent and obstacle");
  std::vector<std::string> known{"agent", "obstacle", "agent_velocity", "obstacle_velocity"};
  known.insert(known.end(), also.begin(), also.end());
  require_known(value, "", known);
  for (const char* body : {"agent", "obstacle"})
    if (value.contains(body) && !is_plain(value[body]))
      return read_engagement(plain(value, folder), velocities, also, folder);
  for (const char* body : {"agent", "obstacle"})
    if (value.contains(body) && (is_pieces_body(value[body]) || is_union(value[body])))
      return read_pieces_engagement(value, velocities, folder);
  const Dimension agent = dimension(value, "agent"), obstacle = dimension(value, "obstacle");
  if (agent != Dimension::spatial && obstacle != Dimension::spatial &&
      (agent == Dimension::planar || obstacle == Dimension::planar))
    return read_bodies<2>(value, velocities);
  return read_bodies<3>(value, velocities);
}

Pair pair_of(const AnyEngagement& engagement) {
  struct Prepare {
    Pair operator()(const Engagement& e) const { return {Placed(e.agent), Placed(e.obstacle)}; }
    Pair operator()(const PlanarEngagement& e) const { return {e.agent, e.obstacle}; }
    Pair operator()(const AssemblyEngagement& e) const {
      const Placed obstacle(e.obstacle.pieces, e.obstacle.pose);
      return std::visit([&](const auto& agent) { return Pair(Placed(agent), obstacle); }, e.agent);
    }
    Pair operator()(const PlacedEngagement& e) const { return {e.agent, e.obstacle}; }
  };
  return std::visit(Prepare{}, engagement);
}

AssemblyOracle oracle_of(const AssemblyEngagement& e) {
  return std::visit(
      [&](const auto& agent) { return AssemblyOracle(agent, e.obstacle.pieces, e.obstacle.pose); }, e.agent);
}

std::array<Eigen::Vector3d, 2> velocities_of(const AnyEngagement& engagement) {
  const auto in_space = [](const auto& v) {
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    velocity.head(v.size()) = v;
    return velocity;
  };
  return std::visit(
      [&](const auto& e) {
        return std::array<Eigen::Vector3d, 2>{in_space(e.agent_velocity), in_space(e.obstacle_velocity)};
      },
      engagement);
}

Json left_out(const AnyEngagement& engagement) {
  Json notes = Json::object();
  if (const auto* e = std::get_if<AssemblyEngagement>(&engagement))
    for (const char* what : {"dropped_points", "dropped_faces"})
      if (e->obstacle.notes.contains(what)) notes[what] = e->obstacle.notes[what];
  return notes;
}

}  // namespace vericone::input
