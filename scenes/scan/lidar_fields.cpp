// SPDX-License-Identifier: BSD-3-Clause
#include "scan/lidar_fields.h"

#include "input/fields.h"
#include "input/spatial_body.h"
#include "json/json_value.h"

namespace vericone::scanning {
namespace {

using namespace input;

double number_or(const Json& value, const std::string& path, const char* field, double otherwise,
                 const char* unit) {
  return value.contains(field) ? read_number(value[field], path + "." + field, unit) : otherwise;
}

double not_negative(const Json& value, const std::string& path, const char* field, const char* unit) {
  const double x = number_or(value, path, field, 0, unit);
  if (x < 0) throw InputError(path + "." + field, to_text(x), std::string("0 or more") + unit);
  return x;
}

int count(const Json& value, const std::string& path, const char* field) {
  const double n = read_number(require_field(value, path, field, "a whole number"), path + "." + field, "");
  if (!(n >= 1 && n <= 1e4 && n == std::floor(n)))
    throw InputError(path + "." + field, to_text(n), "a whole number from 1 to 10000");
  return static_cast<int>(n);
}

/// The sensor's x axis along `forwards`, its y axis horizontal.
Eigen::Matrix3d turned_towards(const Eigen::Vector3d& forwards) {
  Eigen::Matrix3d r;
  r.col(0) = forwards.normalized();
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(forwards);
  r.col(1) =
      left.norm() > 1e-9 * forwards.norm() ? Eigen::Vector3d(left.normalized()) : Eigen::Vector3d::UnitY();
  r.col(2) = r.col(0).cross(r.col(1));
  return r;
}

lidar::BeamPattern read_beams(const Json& value, const std::string& path) {
  require_object(value, path);
  if (value.contains("elevations")) {
    require_known(value, path, {"elevations", "azimuths"});
    const Json& list = value["elevations"];
    if (!list.is_array()) throw InputError(path + ".elevations", quoted(list), "a list of angles (radians)");
    std::vector<double> elevations;
    for (std::size_t i = 0; i < list.size(); ++i)
      elevations.push_back(read_number(list[i], at(path + ".elevations", i), " (radians)"));
    const int azimuths = count(value, path, "azimuths");
    return within(path, [&] { return lidar::spinning(elevations, azimuths); });
  }
  require_known(value, path, {"rows", "columns", "horizontal", "vertical"});
  const int rows = count(value, path, "rows"), columns = count(value, path, "columns");
  const auto angle = [&](const char* field) {
    return read_number(require_field(value, path, field, "an angle (radians)"), path + "." + field,
                       " (radians)");
  };
  const double horizontal = angle("horizontal"), vertical = angle("vertical");
  return within(path, [&] { return lidar::raster(rows, columns, horizontal, vertical); });
}

lidar::Lidar read_lidar(const Json& value, const std::string& path) {
  require_object(value, path);
  require_known(
      value, path,
      {"position", "rotation", "towards", "beams", "min_range", "max_range", "range_noise", "dropout"});
  lidar::Lidar lidar;
  if (value.contains("position"))
    lidar.pose.translation() = read_vector<3>(value["position"], path + ".position", " (metres)");
  lidar.pose.linear() = read_rotation(value, path);
  if (value.contains("towards")) {
    if (value.contains("rotation"))
      throw InputError(path + ".towards", quoted(value["towards"]), "left out where rotation is given");
    const Eigen::Vector3d forwards = read_vector<3>(value["towards"], path + ".towards", "");
    if (!(forwards.norm() > 0)) throw InputError(path + ".towards", "[0, 0, 0]", "a direction");
    lidar.pose.linear() = turned_towards(forwards);
  }
  lidar.beams = read_beams(
      require_field(value, path, "beams", "rows, columns, horizontal, vertical; or elevations, azimuths"),
      path + ".beams");
  lidar.min_range = number_or(value, path, "min_range", 0, " (metres)");
  lidar.max_range = number_or(value, path, "max_range", lidar.max_range, " (metres)");
  lidar.range_noise = number_or(value, path, "range_noise", 0, " (metres)");
  lidar.dropout = number_or(value, path, "dropout", 0, "");
  try {
    lidar::check(lidar);
  } catch (const InputError& e) {
    const std::string field = e.field().starts_with("lidar.") ? e.field().substr(6) : e.field();
    throw InputError(path + "." + field, e.value(), e.requirement());
  }
  return lidar;
}

}  // namespace

SceneLidars read_lidars(const Json& scene) {
  require_object(scene, "scene");
  const char* requirement = "a list of lidars, each with position and beams";
  const Json& list = require_field(scene, "", "lidars", requirement);
  if (!list.is_array() || list.empty()) throw InputError("lidars", quoted(list), requirement);
  SceneLidars all;
  for (std::size_t i = 0; i < list.size(); ++i) all.lidars.push_back(read_lidar(list[i], at("lidars", i)));
  if (scene.contains("pose_error")) {
    const Json& error = scene["pose_error"];
    require_object(error, "pose_error");
    require_known(error, "pose_error", {"position", "rotation"});
    all.position_error = not_negative(error, "pose_error", "position", " (metres)");
    all.rotation_error = not_negative(error, "pose_error", "rotation", " (radians)");
  }
  return all;
}

}  // namespace vericone::scanning
