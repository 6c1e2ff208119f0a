// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/read_orifice.h"

#include <vericone/files/files.h>
#include <vericone/internal/geometry/lengths.h>
#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "input/fields.h"
#include "input/spatial_body.h"
#include "json/json_value.h"
#include "scenarios/read_motion.h"
#include "scenarios/scenario_fields.h"

namespace vericone::scenario {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using input::at, input::quoted, input::read_number, input::read_vector, input::require_field,
    input::require_known, input::require_object;

/// A window of a mesh, and the flat opening that stands for it.
void read_window(const Json& value, const std::string& path, const std::filesystem::path& folder,
                 simulation::MovingOrifice& orifice) {
  require_known(value, path, {"mesh", "loop", "scale"});
  const std::string name = read_text(value["mesh"], path + ".mesh", "the name of a mesh file");
  int loop = 0;
  double scale = 1;
  if_given(value, path, "loop",
           [&](const Json& v, const std::string& p) { loop = read_count(v, p, 0, 1'000'000); });
  if_given(value, path, "scale",
           [&](const Json& v, const std::string& p) { scale = read_positive(v, p, ""); });
  files::PointFile file;
  try {
    file = files::read_points(folder / name);
  } catch (const std::exception& e) {
    throw InputError(path + ".mesh", name, std::string("a mesh that can be read: ") + e.what());
  }
  for (Vector3d& x : file.points) x *= scale;
  try {
    auto triangles = files::triangles_of(file.points, file.faces);
    orifice.window =
        std::make_shared<const MeshWindow>(std::move(file.points), std::move(triangles), std::size_t(loop));
    const PlacedOpening flat = orifice.window->flat();
    orifice.opening = flat.opening;
    orifice.flat_center = flat.center;
    orifice.flat_axes = flat.axes;
  } catch (const InputError& e) {
    throw e.within(path);
  }
}

Opening flat_opening(const Json& value) {
  if (value.contains("radius")) return Opening::circle(read_number(value["radius"], "radius", " (metres)"));
  if (value.contains("semi_axes"))
    return Opening::ellipse(read_vector<2>(value["semi_axes"], "semi_axes", " (metres)"));
  const Json& list = value["polygon"];
  if (!list.is_array()) throw InputError("polygon", quoted(list), "a list of [x, y] in metres");
  std::vector<Vector2d> vertices;
  for (std::size_t i = 0; i < list.size(); ++i)
    vertices.push_back(read_vector<2>(list[i], at("polygon", i), " (metres)"));
  return Opening::polygon(std::move(vertices));
}

void read_opening(const Json& value, const std::string& path, const std::filesystem::path& folder,
                  simulation::MovingOrifice& orifice) {
  require_object(value, path);
  if (value.contains("mesh")) return read_window(value, path, folder, orifice);
  require_known(value, path, {"radius", "semi_axes", "polygon", "mesh", "loop", "scale"});
  if (value.size() != 1 || value.contains("loop") || value.contains("scale"))
    throw InputError(path, quoted(value), "exactly one of radius, semi_axes, polygon, mesh (with its loop)");
  try {
    orifice.opening = flat_opening(value);
  } catch (const InputError& e) {
    throw e.within(path);
  }
}

/// z along the normal; y as upright as it can be, along the world's y where the normal is vertical.
Eigen::Matrix3d facing(const Vector3d& normal) {
  Eigen::Matrix3d axes;
  axes.col(2) = normal.normalized();
  const bool vertical = axes.col(2).head<2>().norm() < 1e-12;
  const Vector3d up = vertical ? Vector3d::UnitY() : Vector3d::UnitZ();
  axes.col(0) = up.cross(axes.col(2)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Eigen::Matrix3d read_attitude(const Json& value, const std::string& path, bool window) {
  if (value.contains("rotation")) {
    if (value.contains("normal"))
      throw InputError(path + ".normal", quoted(value["normal"]), "left out beside rotation");
    return input::read_rotation(value, path);
  }
  // A mesh lies in its file as it is meant.
  if (window) {
    if (value.contains("normal"))
      throw InputError(path + ".normal", quoted(value["normal"]), "left out of a mesh, or rotation");
    return Eigen::Matrix3d::Identity();
  }
  const Vector3d normal =
      read_vector<3>(require_field(value, path, "normal", "[x, y, z], or rotation"), path + ".normal", "");
  if (!(detail::length(normal) > 0))
    throw InputError(path + ".normal", quoted(value["normal"]), "a direction, not 0");
  return facing(normal / normal.cwiseAbs().maxCoeff());
}

}  // namespace

simulation::MovingOrifice read_orifice(const Json& value, const std::string& path,
                                       const std::filesystem::path& folder) {
  require_object(value, path);
  require_known(value, path,
                {"name", "opening", "position", "velocity", "speed", "heading", "heading_deg", "normal",
                 "rotation", "spin", "appears", "wall"});
  simulation::MovingOrifice orifice;
  orifice.name = read_text(require_field(value, path, "name", "a name, as text"), path + ".name", "a name");
  read_opening(require_field(value, path, "opening", "a mapping, such as {radius: 0.5}"), path + ".opening",
               folder, orifice);
  orifice.position = read_vector<3>(require_field(value, path, "position", "[x, y, z] in metres"),
                                    path + ".position", " (metres)");
  orifice.velocity = read_going(value, path, false).velocity;
  orifice.rotation = read_attitude(value, path, orifice.window != nullptr);
  if_given(value, path, "spin",
           [&](const Json& v, const std::string& p) { orifice.spin = read_vector<3>(v, p, " (rad/s)"); });
  if_given(value, path, "appears",
           [&](const Json& v, const std::string& p) { orifice.appears = read_not_negative(v, p, " (s)"); });
  if_given(value, path, "wall", [&](const Json& v, const std::string& p) { orifice.wall = read_flag(v, p); });
  return orifice;
}

simulation::Through read_through(const Json& value, const std::string& path, simulation::Through::Law law) {
  simulation::Through through;
  through.law = law;
  const Json& names = require_field(value, path, "through", "a list of names of orifices");
  if (!names.is_array() || names.empty())
    throw InputError(path + ".through", quoted(names), "a list of names of orifices");
  for (std::size_t i = 0; i < names.size(); ++i)
    through.orifices.push_back(read_text(names[i], at(path + ".through", i), "the name of an orifice"));
  const auto metres = [&](const char* field, double& to) {
    if_given(value, path, field,
             [&](const Json& v, const std::string& p) { to = read_not_negative(v, p, " (metres)"); });
  };
  if_given(value, path, "gain", [&](const Json& v, const std::string& p) {
    through.source.gain = through.passage.gain = read_positive(v, p, " (1/s)");
  });
  if_given(value, path, "most", [&](const Json& v, const std::string& p) {
    through.source.most = through.passage.most = read_positive(v, p, " (m/s^2)");
  });
  if (law == simulation::Through::Law::orifice)
    through.source.reference = read_number(require_field(value, path, "reference", "w in m^2, below 0"),
                                           path + ".reference", " (m^2)");
  if_given(value, path, "speed", [&](const Json& v, const std::string& p) {
    if (!v.is_array()) through.speeds = {read_positive(v, p, " (m/s)")};
    for (std::size_t i = 0; v.is_array() && i < v.size(); ++i)
      through.speeds.push_back(read_positive(v[i], at(p, i), " (m/s)"));
  });
  if_given(value, path, "gain_speed",
           [&](const Json& v, const std::string& p) { through.gain_speed = read_positive(v, p, " (1/s)"); });
  metres("margin", through.passage.margin);
  metres("beyond", through.passage.beyond);
  if_given(value, path, "longitudinal",
           [&](const Json& v, const std::string& p) { through.passage.longitudinal = read_flag(v, p); });
  if (value.contains("direction") && value.contains("direction_deg"))
    throw InputError(path + ".direction_deg", quoted(value["direction_deg"]), "left out beside direction");
  for (const bool degrees : {false, true})
    if_given(value, path, degrees ? "direction_deg" : "direction", [&](const Json& v, const std::string& p) {
      through.source.direction = read_heading(v, p, false, degrees);
    });
  return through;
}

}  // namespace vericone::scenario
