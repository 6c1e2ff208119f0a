// SPDX-License-Identifier: BSD-3-Clause
#include "input/motions.h"

#include <array>
#include <string>

#include "input/body_kind.h"
#include "input/field_table.h"

namespace vericone::input {
namespace {

constexpr std::array kBodies{"agent", "obstacle"};
constexpr std::array kFields{"spin", "acceleration", "braking"};

struct MotionFields {
  Eigen::Vector3d spin = Eigen::Vector3d::Zero(), acceleration = Eigen::Vector3d::Zero();
  double braking = 0;
};

Fields<MotionFields> rows(const Value<Eigen::Vector3d>& spin, const Value<Eigen::Vector3d>& acceleration) {
  return Fields<MotionFields>("motion")
      .row("spin", &MotionFields::spin, spin,
           "Constant, about `center` (of a body from a `file`, its own), in the axes of the world; in the "
           "plane a number, counter-clockwise. Of "
           "`vericone query` alone.",
           absent("it does not turn"))
      .row("acceleration", &MotionFields::acceleration, acceleration,
           "Constant, in the world. Of `vericone query` alone.", absent("none"))
      .row("braking", &MotionFields::braking, not_negative("m/s²"),
           "Slows down along its velocity until it stands, and then stays. Not beside `acceleration`. Of "
           "`vericone query` alone.",
           absent("it does not brake"));
}

const Fields<MotionFields>& spatial_rows() {
  static const Json vector_or_number{
      {"title", "[x, y, z], or a number in the plane"},
      {"anyOf", {{{"$ref", "body.schema.json#/$defs/vector3"}}, {{"type", "number"}}}}};
  static const Fields<MotionFields> fields =
      rows(shown_as(vector<3>("rad/s"), vector_or_number), point<3>("m/s²"));
  return fields;
}

const Fields<MotionFields>& planar_rows() {
  static const Fields<MotionFields> fields = [] {
    const auto number_read = number("rad/s").read;
    const auto vector_read = vector<2>("m/s²").read;
    const Value<Eigen::Vector3d> spin{[=](const Json& value, const std::string& path) {
                                        return Eigen::Vector3d(0, 0, number_read(value, path));
                                      },
                                      {},
                                      {}};
    const Value<Eigen::Vector3d> acceleration{[=](const Json& value, const std::string& path) {
                                                Eigen::Vector3d a = Eigen::Vector3d::Zero();
                                                a.head<2>() = vector_read(value, path);
                                                return a;
                                              },
                                              {},
                                              {}};
    return rows(spin, acceleration);
  }();
  return fields;
}

BodyMotion motion_of(const Json& given, const char* name, const scenes::SceneBody& body, bool planar) {
  const MotionFields fields = (planar ? planar_rows() : spatial_rows()).read(given, name);
  if (given.contains("braking") && given.contains("acceleration"))
    throw InputError(join(name, "braking"), quoted(given["braking"]), "left out beside an acceleration");
  BodyMotion motion;
  motion.velocity = body.velocity;
  motion.acceleration = fields.acceleration;
  motion.spin = fields.spin;
  motion.braking = fields.braking;
  return motion;
}

}  // namespace

std::optional<MotionsGiven> take_motions(Json& engagement) {
  if (!engagement.is_object()) return std::nullopt;
  MotionsGiven given{Json::object(), Json::object()};
  for (const char* name : kBodies) {
    if (!engagement.contains(name) || !engagement[name].is_object()) continue;
    Json& body = engagement[name];
    for (const char* field : kFields) {
      if (!body.contains(field)) continue;
      (name == kBodies[0] ? given.agent : given.obstacle)[field] = body[field];
      body.erase(field);
    }
  }
  if (given.agent.empty() && given.obstacle.empty()) return std::nullopt;
  return given;
}

Motions read_motions(const MotionsGiven& given, const scenes::Scene& scene) {
  const bool planar = scene.in_plane;
  return {motion_of(given.agent, "agent", scene.agent, planar),
          motion_of(given.obstacle, "obstacle", scene.obstacle, planar)};
}

void refuse_motions(const Json& engagement) {
  for (const char* name : kBodies) {
    const auto body = engagement.find(name);
    if (body == engagement.end() || !body->is_object()) continue;
    for (const char* field : kFields)
      if (body->contains(field))
        throw InputError(
            join(name, field), quoted((*body)[field]),
            "left out: this answer is of straight motion (vericone query has the first contact of "
            "bodies that turn, accelerate or brake)");
  }
}

Json motion_schema() { return spatial_rows().schema()["properties"]; }

}  // namespace vericone::input
