// SPDX-License-Identifier: BSD-3-Clause
#include "scan/lidar_fields.h"

#include "input/field_table.h"
#include "input/spatial_body.h"
#include "json/json_value.h"
#include "output/schemas.h"

namespace vericone::scanning {
namespace {

using namespace input;
using lidar::Lidar;

Value<int> beam_count() {
  constexpr int kMost = 10'000;
  const auto whole = checked<double>(number(), "a whole number from 1 to 10000", [](const double& n) {
    return n >= 1 && n <= kMost && n == std::floor(n);
  });
  return {[read = whole.read](const Json& value, const std::string& path) { return int(read(value, path)); },
          Json{{"type", "integer"}, {"minimum", 1}, {"maximum", kMost}},
          {}};
}

struct Raster {
  int rows = 0, columns = 0;
  double horizontal = 0, vertical = 0;
};

const Fields<Raster>& raster_fields() {
  using R = Raster;
  static const Fields<R> fields =
      Fields<R>("raster")
          .row("rows", &R::rows, beam_count(), "One above the other.", required("a whole number"))
          .row("columns", &R::columns, beam_count(), "Side by side.", required("a whole number"))
          .row("horizontal", &R::horizontal, number("radians"), "Whole angle of all columns.",
               required("an angle (radians)"))
          .row("vertical", &R::vertical, number("radians"), "Whole angle of all rows.",
               required("an angle (radians)"));
  return fields;
}

struct Spinning {
  std::vector<double> elevations;
  int azimuths = 0;
};

const Fields<Spinning>& spinning_fields() {
  using S = Spinning;
  static const Fields<S> fields =
      Fields<S>("spinning")
          .row("elevations", &S::elevations, list("angles (radians)", number("radians")), "Of the beams.",
               alternative())
          .row("azimuths", &S::azimuths, beam_count(), "How many in a full turn.",
               required("a whole number"));
  return fields;
}

lidar::BeamPattern read_beams(const Json& value, const std::string& path) {
  require_object(value, path);
  if (value.contains("elevations")) {
    const Spinning read = spinning_fields().read(value, path);
    return within(path, [&] { return lidar::spinning(read.elevations, read.azimuths); });
  }
  const Raster read = raster_fields().read(value, path);
  return within(path, [&] { return lidar::raster(read.rows, read.columns, read.horizontal, read.vertical); });
}

/// The sensor's x axis along what is given, its y axis horizontal.
void turn_towards(const Json& value, const std::string& path, Lidar& lidar) {
  const Eigen::Vector3d forwards = vector<3>().read(value, path);
  if (!(forwards.norm() > 0)) throw InputError(path, "[0, 0, 0]", "a direction");
  auto r = lidar.pose.linear();
  r.col(0) = forwards.normalized();
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(forwards);
  r.col(1) =
      left.norm() > 1e-9 * forwards.norm() ? Eigen::Vector3d(left.normalized()) : Eigen::Vector3d::UnitY();
  r.col(2) = r.col(0).cross(r.col(1));
}

const Fields<Lidar>& lidar_fields() {
  using L = Lidar;
  const auto length = shown_as(number("m"), not_negative().schema);
  const Value<lidar::BeamPattern> beams{
      read_beams,
      {{"title", "raster or spinning"}, {"anyOf", {raster_fields().schema(), spinning_fields().schema()}}},
      {}};
  static const Fields<L> fields =
      Fields<L>("lidar")
          .row(
              "position", [](L& lidar) { return lidar.pose.translation(); }, vector<3>("m"),
              "In the agent's own frame.", absent("the agent's centre"))
          .row(
              "rotation", [](L& lidar) { return lidar.pose.linear(); }, rotation(),
              "From the sensor's axes (x forwards, y left, z up) to the agent's, written as of a body.",
              absent("the agent's axes"))
          .special("towards", vector<3>().schema, turn_towards,
                   "In place of `rotation`: a direction for its x axis. Its y axis is level.")
          .row("beams", &L::beams, beams,
               "`rows` and `columns` over `horizontal` and `vertical` (whole angles, radians); or "
               "`elevations` (list, radians) and `azimuths` (how many in a full turn).",
               required("rows, columns, horizontal, vertical; or elevations, azimuths"))
          .row("min_range", &L::min_range, length, "Nearer things are not seen.")
          .row("max_range", &L::max_range, shown_as(number("m"), positive().schema), "Nor farther ones.")
          .row("range_noise", &L::range_noise, length, "Standard deviation along the beam.")
          .row("dropout", &L::dropout,
               shown_as(number(), {{"type", "number"}, {"minimum", 0}, {"maximum", 1}}),
               "Probability that a return is lost.");
  return fields;
}

Lidar read_lidar(const Json& value, const std::string& path) {
  require_object(value, path);
  if (value.contains("towards") && value.contains("rotation"))
    throw InputError(path + ".towards", quoted(value["towards"]), "left out where rotation is given");
  const Lidar lidar = lidar_fields().read(value, path);
  try {
    lidar::check(lidar);
  } catch (const InputError& e) {
    const std::string field = e.field().starts_with("lidar.") ? e.field().substr(6) : e.field();
    throw InputError(path + "." + field, e.value(), e.requirement());
  }
  return lidar;
}

const Fields<SceneLidars>& error_fields() {
  using S = SceneLidars;
  const auto holds = [](const double& x) { return x >= 0; };
  static const Fields<S> fields =
      Fields<S>("pose_error")
          .row("position", &S::position_error,
               shown_as(checked<double>(number("m"), "0 or more (metres)", holds), not_negative().schema),
               "Standard deviation along each axis.")
          .row("rotation", &S::rotation_error,
               shown_as(checked<double>(number("radians"), "0 or more (radians)", holds),
                        not_negative().schema),
               "Standard deviation about each axis.");
  return fields;
}

/// What a scene has of them.
const Fields<SceneLidars>& scan_fields() {
  using S = SceneLidars;
  const char* what = "lidars, each with position and beams";
  const auto errors = [](const Json& v, const std::string& p, S& all) { error_fields().read(v, p, all); };
  static const Fields<S> fields =
      Fields<S>("scan")
          .row("lidars", &S::lidars,
               shown_as(list(what, Value<Lidar>{read_lidar, {}, {}}, 1),
                        {{"title", "list of LiDARs"},
                         {"type", "array"},
                         {"items", {{"$ref", "#/$defs/lidar"}}},
                         {"minItems", 1}}),
               "Sensors on the agent, for `vericone scan`.",
               required("a list of lidars, each with position and beams"))
          .special("pose_error", {{"title", "object"}, {"$ref", "#/$defs/pose_error"}}, errors,
                   "How well the poses of all LiDARs but the first are known. The scans are then fused by "
                   "ICP.");
  return fields;
}

}  // namespace

SceneLidars read_lidars(const Json& scene) {
  require_object(scene, "scene");
  Json own = Json::object();
  for (const std::string_view name : scan_fields().names())
    if_given(scene, "", name.data(),
             [&](const Json& value, const std::string& field) { own[field] = value; });
  return scan_fields().read(own, "");
}

Json scan_schema() {
  Json schema = scan_fields().schema();
  schema["$defs"] = {{"lidar", lidar_fields().schema()}, {"pose_error", error_fields().schema()}};
  return schema_of("the LiDARs of a scene", "vericone scan SCENE.yaml, docs/reference/formats.md.",
                   std::move(schema));
}

}  // namespace vericone::scanning
