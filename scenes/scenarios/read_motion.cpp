// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/guidance/directions.h>
#include "scenarios/parts.h"

#include <Eigen/Geometry>
#include <numbers>

#include "input/field_table.h"
#include "input/spatial_body.h"
#include "json/json_value.h"

namespace vericone::scenario {
namespace {

using guidance::Direction;
using input::at, input::if_given, input::quoted, input::read_number, input::read_vector, input::require_field;
using simulation::Orientation;

Eigen::Vector3d read_point(const Json& value, const std::string& path, bool planar, const char* unit) {
  if (!planar) return read_vector<3>(value, path, unit);
  const Eigen::Vector2d p = read_vector<2>(value, path, unit);
  return {p.x(), p.y(), 0};
}

}  // namespace

Direction read_heading(const Json& value, const std::string& path, bool planar, bool degrees) {
  const double unit = degrees ? std::numbers::pi / 180 : 1;
  const char* name = degrees ? " (degrees)" : " (radians)";
  if (planar) return {unit * read_number(value, path, name), 0};
  if (!value.is_array() || value.size() != 2)
    throw InputError(path, quoted(value), std::string("[azimuth, elevation]") + name);
  const Eigen::Vector2d angles = read_vector<2>(value, path, name);
  if (std::abs(unit * angles.y()) > std::numbers::pi / 2)
    throw InputError(
        at(path, 1), to_text(angles.y()),
        degrees ? "an elevation between -90 and 90 degrees" : "an elevation between -pi/2 and pi/2 radians");
  return {unit * angles.x(), unit * angles.y()};
}

Going read_going(const Json& value, const std::string& path, bool planar) {
  const bool by_speed = value.contains("speed");
  const bool radians = value.contains("heading"), degrees = value.contains("heading_deg");
  if (by_speed && value.contains("velocity"))
    throw InputError(path + ".speed", quoted(value["speed"]), "left out beside velocity");
  if (radians && degrees)
    throw InputError(path + ".heading_deg", quoted(value["heading_deg"]), "left out beside heading");
  const char* heading = radians ? "heading" : "heading_deg";
  if (!by_speed) {
    if (radians || degrees)
      throw InputError(path + "." + heading, quoted(value[heading]),
                       "given with speed, not alone or beside velocity");
    Going going;  // at rest
    if (value.contains("velocity"))
      going.velocity = read_point(value["velocity"], path + ".velocity", planar, " (m/s)");
    going.ahead = guidance::direction_of(going.velocity);
    return going;
  }
  const double speed = input::not_negative("m/s").read(value["speed"], path + ".speed");
  if (!radians && !degrees)
    throw InputError(
        path + ".heading", "nothing",
        planar ? "an angle (radians), or heading_deg" : "[azimuth, elevation] (radians), or heading_deg");
  Going going;
  going.ahead = read_heading(value[heading], path + "." + heading, planar, degrees);
  going.velocity = speed * guidance::unit_vector(going.ahead);
  if (planar) going.velocity.z() = 0;
  return going;
}

namespace {

/// x ahead, y level.
Eigen::Matrix3d along(const Direction& ahead) {
  Eigen::Matrix3d axes;
  axes.col(0) = guidance::unit_vector(ahead);
  axes.col(1) = Eigen::Vector3d(-std::sin(ahead.azimuth), std::cos(ahead.azimuth), 0);
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

Eigen::Matrix3d read_attitude(const Json& value, const std::string& path, bool planar) {
  if (!planar) return input::read_rotation(value, path);
  const double angle = read_number(value["rotation"], path + ".rotation", " (radians)");
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

}  // namespace

void read_motion(const Json& value, const std::string& path, bool planar, simulation::Body& body) {
  const char* place = planar ? "[x, y] in metres" : "[x, y, z] in metres";
  body.start.position =
      read_point(require_field(value, path, "position", place), path + ".position", planar, " (metres)");
  const Going going = read_going(value, path, planar);
  body.start.velocity = going.velocity;
  if_given(value, path, "orientation", [&](const Json& v, const std::string& p) {
    body.orientation =
        input::choice<Orientation>(
            {{"heading", Orientation::heading}, {"level", Orientation::level}, {"fixed", Orientation::fixed}})
            .read(v, p);
  });
  if (!value.contains("rotation")) {
    body.start.rotation = along(going.ahead);
    return;
  }
  if (body.orientation == Orientation::level)
    throw InputError(path + ".rotation", quoted(value["rotation"]),
                     "left out with orientation level, which the velocity decides");
  body.start.rotation = read_attitude(value, path, planar);
}

}  // namespace vericone::scenario
