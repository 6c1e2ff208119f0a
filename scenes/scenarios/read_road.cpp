// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/parts.h"

#include <vericone/simulation/curve.h>
#include <memory>
#include <vector>

#include "input/field_table.h"

namespace vericone::scenario {
namespace {

using Eigen::Vector2d;
using input::absent, input::Fields, input::join, input::list, input::mapping, input::not_negative,
    input::number;
using input::positive, input::quoted, input::read_vector, input::require_field, input::require_object;
using input::required, input::vector;
using simulation::LaneChange, simulation::Road;

const Fields<LaneChange>& change_fields() {
  using C = LaneChange;
  static const Fields<C> fields =
      Fields<C>("change")
          .row("at", &C::at, not_negative("s"), "When it begins, since the body appeared.",
               required("a time (s)"))
          .row("seconds", &C::seconds, positive("s"),
               "So long it accelerates to one side, and as long to the other: acceleration seconds² aside.")
          .row("acceleration", &C::acceleration, number("m/s²"), "To the left first; negative to the right.",
               required("a number (m/s^2)"));
  return fields;
}

struct Lanes {
  Vector2d velocity = Vector2d::Zero();
  std::vector<LaneChange> changes;
};

const Fields<Lanes>& lane_fields() {
  static const Fields<Lanes> fields =
      Fields<Lanes>("lanes")
          .kind("kind", "lanes", "A constant velocity, and changes of the lane.")
          .row("velocity", &Lanes::velocity, vector<2>("m/s"), "`[x, y]`.", required("[x, y] in m/s"))
          .row("changes", &Lanes::changes, list("changes", mapping("lane_change", change_fields())),
               "In any order, below; those that overlap add up.", absent("none"));
  return fields;
}

struct Squircle {
  double radius = 0, squareness = 0.9, period = 0;  // m, -, s
};

const Fields<Squircle>& squircle_fields() {
  using S = Squircle;
  static const Fields<S> fields =
      Fields<S>("squircle")
          .kind(
              "kind", "squircle",
              "The closed way of the source's 3.4.2: a square with round corners, counter-clockwise from the "
              "middle of its southern side.")
          .row("radius", &S::radius, positive("m"), "Half the width.", required("metres"))
          .row("squareness", &S::squareness, not_negative(), "0, a circle, to below 1, a square.")
          .row("period", &S::period, positive("s"), "Of one turn.", required("seconds"));
  return fields;
}

std::shared_ptr<const Road> read_lanes(const Json& value, const Vector2d& start) {
  Lanes lanes = lane_fields().read(value, "");
  return simulation::lane_road(start, lanes.velocity, std::move(lanes.changes));
}

std::shared_ptr<const Road> read_squircle(const Json& value, const Vector2d& start) {
  const Squircle s = squircle_fields().read(value, "");
  return simulation::squircle_road(start, s.radius, s.squareness, s.period);
}

}  // namespace

std::shared_ptr<const Road> read_road(const Json& fields, const std::string& path, const Vector2d& start) {
  require_object(fields, path);
  const Json& kind = require_field(fields, path, "kind", "lanes or squircle");
  if (kind != "lanes" && kind != "squircle")
    throw InputError(join(path, "kind"), quoted(kind), "lanes or squircle");
  return input::within(
      path, [&] { return kind == "lanes" ? read_lanes(fields, start) : read_squircle(fields, start); });
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

Json road_schemas() {
  return {{"lanes", lane_fields().schema()},
          {"lane_change", change_fields().schema()},
          {"squircle", squircle_fields().schema()}};
}

}  // namespace vericone::scenario
