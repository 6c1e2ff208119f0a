// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/parts.h"

#include <vericone/files/files.h>
#include <vericone/internal/geometry/lengths.h>
#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "input/field_table.h"
#include "input/spatial_body.h"

namespace vericone::scenario {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using input::absent, input::alternative, input::at, input::Fields, input::not_negative, input::positive,
    input::quoted, input::read_number, input::read_vector, input::require_field, input::required,
    input::vector;

/// What an opening may be given by.
struct OpeningFile {
  double radius = 0;  // m
  Vector2d semi_axes = Vector2d::Zero();
  std::vector<Vector2d> polygon;
  std::string mesh;
  int loop = 0;
  double scale = 1;
};

const Fields<OpeningFile>& opening_fields() {
  using O = OpeningFile;
  auto polygon = input::list("[x, y]", vector<2>("m"));
  polygon.schema["items"].erase("unit");
  polygon.schema["unit"] = "m";
  polygon.schema["minItems"] = 3;  // as Opening refuses
  static const Fields<O> fields =
      Fields<O>("opening")
          .row("radius", &O::radius, positive("m"), "A circle.", alternative())
          .row("semi_axes", &O::semi_axes, vector<2>("m"), "An ellipse, along x and y.", alternative())
          .row("polygon", &O::polygon, polygon,
               "A simple polygon: no edge meets another but at their common corner.", alternative())
          .row("mesh", &O::mesh, input::text("the name of a mesh file"),
               "A mesh file: the opening is a window in it, the mesh is its wall. Of such an orifice "
               "`normal` and "
               "`wall` are left out, `rotation` is none if left out.",
               alternative())
          .row("loop", &O::loop, input::count(0, 1'000'000),
               "Which boundary loop of the mesh: 0 the longest.")
          .row("scale", &O::scale, positive(), "Of the mesh's coordinates, to metres.");
  return fields;
}

/// A window of a mesh, and the flat opening that stands for it.
void read_window(const OpeningFile& given, const std::string& path, const std::filesystem::path& folder,
                 simulation::MovingOrifice& orifice) {
  files::PointFile file;
  try {
    file = files::read_points(folder / given.mesh);
  } catch (const std::exception& e) {
    throw InputError(path + ".mesh", given.mesh, std::string("a mesh that can be read: ") + e.what());
  }
  for (Vector3d& x : file.points) x *= given.scale;
  input::within(path, [&] {
    auto triangles = files::triangles_of(file.points, file.faces);
    orifice.window = std::make_shared<const MeshWindow>(std::move(file.points), std::move(triangles),
                                                        std::size_t(given.loop));
  });
  const PlacedOpening flat = orifice.window->flat();
  orifice.opening = flat.opening;
  orifice.flat_center = flat.center;
  orifice.flat_axes = flat.axes;
}

void read_opening(const Json& value, const std::string& path, const std::filesystem::path& folder,
                  simulation::MovingOrifice& orifice) {
  const OpeningFile given = opening_fields().read(value, path);
  const bool window = value.contains("mesh");
  if (value.size() != 1u + (window && value.contains("loop")) + (window && value.contains("scale")))
    throw InputError(path, quoted(value), "exactly one of radius, semi_axes, polygon, mesh (with its loop)");
  if (window) return read_window(given, path, folder, orifice);
  orifice.opening = input::within(path, [&] {
    if (value.contains("radius")) return Opening::circle(given.radius);
    return value.contains("polygon") ? Opening::polygon(given.polygon) : Opening::ellipse(given.semi_axes);
  });
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

/// An orifice while it is read.
struct OrificeFile : simulation::MovingOrifice {
  std::filesystem::path folder;
};

const Fields<OrificeFile>& orifice_fields() {
  using O = OrificeFile;
  const auto opening = [](const Json& v, const std::string& p, O& o) { read_opening(v, p, o.folder, o); };
  static const Fields<O> fields =
      Fields<O>("orifice")
          .row("name", &O::name, input::text("a name"), "No other orifice and no body has it.",
               required("a name, as text"))
          .special("opening", {{"$ref", "#/$defs/opening"}}, opening,
                   "Its outline, below, in the x-y plane of its own frame; z is its normal.",
                   required("a mapping, such as {radius: 0.5}"))
          .row("position", &O::position, vector<3>("m"), "Of the origin of its frame, when it appears.",
               required("[x, y, z] in metres"))
          .special("velocity", vector<3>("m/s").schema, {}, "Constant, in the world.", absent("at rest"))
          .special("speed", not_negative("m/s").schema, {},
                   "In place of `velocity`, with `heading` or `heading_deg`.")
          .special("heading", vector<2>("rad").schema, {}, "`[azimuth, elevation]`.")
          .special("heading_deg", vector<2>("degrees").schema, {}, "The same in degrees.")
          .special(
              "normal", vector<3>().schema, {},
              "Where it faces when it appears, of any length, either sense; y is then as upright as it can "
              "be, x level (a vertical normal: y is the world's). This or `rotation` is required.")
          .special("rotation", {{"$ref", "body.schema.json#/$defs/rotation"}}, {},
                   "Its attitude when it appears, in place of `normal`, written as in a scene.")
          .row("spin", &O::spin, vector<3>("rad/s"),
               "Constant angular velocity about its position, in the world.", absent("it does not turn"))
          .row("appears", &O::appears, not_negative("s"),
               "Before this it is neither seen, passed nor touched.")
          .row("wall", &O::wall, input::flag(),
               "True: an infinite thin wall around the opening. False: its rim alone, a ring.");
  return fields;
}

}  // namespace

simulation::MovingOrifice read_orifice(const Json& value, const std::string& path,
                                       const std::filesystem::path& folder) {
  OrificeFile orifice;
  orifice.folder = folder;
  orifice_fields().read(value, path, orifice);
  orifice.velocity = read_going(value, path, false).velocity;
  orifice.rotation = read_attitude(value, path, orifice.window != nullptr);
  return orifice;
}

Json orifice_schemas() {
  return {{"orifice", orifice_fields().schema()}, {"opening", opening_fields().schema()}};
}

}  // namespace vericone::scenario
