// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/read_road.h"

#include <vericone/simulation/curve.h>
#include <memory>
#include <vector>

#include "json/json_value.h"
#include "scenarios/scenario_fields.h"

namespace vericone::scenario {
namespace {

using Eigen::Vector2d;
using input::at, input::quoted, input::read_number, input::read_vector, input::require_field;
using input::require_known, input::require_object;
using simulation::LaneChange, simulation::Road;

LaneChange read_change(const Json& value, const std::string& path) {
  require_object(value, path);
  require_known(value, path, {"at", "seconds", "acceleration"});
  LaneChange change;
  change.at = read_not_negative(require_field(value, path, "at", "a time (s)"), join(path, "at"), " (s)");
  change.acceleration = read_number(require_field(value, path, "acceleration", "a number (m/s^2)"),
                                    join(path, "acceleration"), " (m/s^2)");
  if_given(value, path, "seconds",
           [&](const Json& v, const std::string& p) { change.seconds = read_positive(v, p, " (s)"); });
  return change;
}

std::shared_ptr<const Road> read_lanes(const Json& value, const std::string& path, const Vector2d& start) {
  require_known(value, path, {"kind", "velocity", "changes"});
  const Vector2d velocity = read_vector<2>(require_field(value, path, "velocity", "[x, y] in m/s"),
                                           join(path, "velocity"), " (m/s)");
  std::vector<LaneChange> changes;
  if_given(value, path, "changes", [&](const Json& v, const std::string& p) {
    if (!v.is_array()) throw InputError(p, quoted(v), "a list of changes");
    for (std::size_t i = 0; i < v.size(); ++i) changes.push_back(read_change(v[i], at(p, i)));
  });
  return simulation::lane_road(start, velocity, std::move(changes));
}

std::shared_ptr<const Road> read_squircle(const Json& value, const std::string& path, const Vector2d& start) {
  require_known(value, path, {"kind", "radius", "squareness", "period"});
  const double radius =
      read_positive(require_field(value, path, "radius", "metres"), join(path, "radius"), " (m)");
  const double period =
      read_positive(require_field(value, path, "period", "seconds"), join(path, "period"), " (s)");
  double squareness = 0.9;
  if_given(value, path, "squareness",
           [&](const Json& v, const std::string& p) { squareness = read_number(v, p, ""); });
  return simulation::squircle_road(start, radius, squareness, period);
}

}  // namespace

std::shared_ptr<const Road> read_road(const Json& fields, const std::string& path, const Vector2d& start) {
  require_object(fields, path);
  const Json& kind = require_field(fields, path, "kind", "lanes or squircle");
  if (kind != "lanes" && kind != "squircle")
    throw InputError(join(path, "kind"), quoted(kind), "lanes or squircle");
  return input::within(path, [&] {
    return kind == "lanes" ? read_lanes(fields, "", start) : read_squircle(fields, "", start);
  });
}

void read_road(const Json& value, const std::string& path, bool planar, simulation::Body& body) {
  for (const char* other :
       {"velocity", "speed", "heading", "heading_deg", "orientation", "rotation", "pilot", "vehicle"})
    if (value.contains(other))
      throw InputError(join(path, other), quoted(value[other]), "left out beside a road, which says it");
  const std::string where = join(path, "position"), road = join(path, "road");
  const Json& position = require_field(value, path, "position", "where the road begins (metres)");
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  if (planar)
    start.head<2>() = read_vector<2>(position, where, " (metres)");
  else
    start = read_vector<3>(position, where, " (metres)");
  body.road = read_road(value["road"], road, start.head<2>());
  body.start = simulation::start_of(*body.road, start.z());
  body.orientation = simulation::Orientation::fixed;
}

}  // namespace vericone::scenario
