// SPDX-License-Identifier: BSD-3-Clause
#include "input/body.h"

#include "input/fields.h"
#include "input/planar_body.h"
#include "input/spatial_body.h"

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
BasicEngagement<D> read_bodies(const Json& value, Velocities velocities) {
  const char* body = D == 2
                         ? "a body: center with semi_axes and rotation, with shape, or with a_c, b_c, k, phi"
                         : "a body: center with semi_axes and rotation, or with shape; or quadric";
  BasicEngagement<D> e;
  e.agent = read_body<D>(require_field(value, "", "agent", body), "agent");
  e.obstacle = read_body<D>(require_field(value, "", "obstacle", body), "obstacle");
  const auto velocity = [&](const char* field) -> typename BasicEngagement<D>::Vector {
    if (velocities == Velocities::optional && !value.contains(field))
      return BasicEngagement<D>::Vector::Zero();
    return read_vector<D>(require_field(value, "", field, D == 2 ? "[x, y] in m/s" : "[x, y, z] in m/s"),
                          field, " (m/s)");
  };
  e.agent_velocity = velocity("agent_velocity");
  e.obstacle_velocity = velocity("obstacle_velocity");
  return e;
}

}  // namespace

std::string quoted(const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  constexpr std::size_t kLongest = 60;
  if (text.size() > kLongest) text = text.substr(0, kLongest - 3) + "...";
  return text;
}

AnyEngagement read_engagement(const Json& value, Velocities velocities,
                              std::initializer_list<const char*> also) {
  if (!value.is_object()) throw InputError("engagement", quoted(value), "a mapping with agent and obstacle");
  std::vector<std::string> known{"agent", "obstacle", "agent_velocity", "obstacle_velocity"};
  known.insert(known.end(), also.begin(), also.end());
  require_known(value, "", known);
  const Dimension agent = dimension(value, "agent"), obstacle = dimension(value, "obstacle");
  if (agent != Dimension::spatial && obstacle != Dimension::spatial &&
      (agent == Dimension::planar || obstacle == Dimension::planar))
    return read_bodies<2>(value, velocities);
  return read_bodies<3>(value, velocities);
}

}  // namespace vericone::input
