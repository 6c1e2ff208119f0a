// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/read_shape.h"

#include "input/assembly_body.h"
#include "input/planar_body.h"
#include "input/scene.h"
#include "input/spatial_body.h"
#include "json/json_value.h"
#include "simulate/scenario_fields.h"

namespace vericone::scenario {
namespace {

using input::at, input::quoted, input::read_number, input::read_vector, input::require_field,
    input::require_known, input::require_object;

std::string shape_kinds() {
  return "given by exactly one of semi_axes (2 or 3 numbers), a_c (with b_c, k), dented (with k), pieces, " +
         input::pieces_kinds();
}

/// k: a number, or how it changes in time.
simulation::Oscillation read_oscillation(const Json& value, const std::string& path) {
  simulation::Oscillation k;
  if (value.is_number()) {
    k.offset = read_number(value, path, "");
    return k;
  }
  if (!value.is_object())
    throw InputError(path, quoted(value),
                     "a number, or offset, amplitude, rate, phase, absolute of a changing one");
  require_known(value, path, {"offset", "amplitude", "rate", "phase", "absolute"});
  const auto number = [&](const char* field, const char* unit, double& to) {
    if_given(value, path, field, [&](const Json& v, const std::string& p) { to = read_number(v, p, unit); });
  };
  number("offset", "", k.offset);
  number("amplitude", "", k.amplitude);
  number("rate", " (rad/s)", k.rate);
  number("phase", " (rad)", k.phase);
  if_given(value, path, "absolute",
           [&](const Json& v, const std::string& p) { k.absolute = read_flag(v, p); });
  return k;
}

simulation::Oscillation require_oscillation(const Json& value, const std::string& path) {
  const char* requirement = "a number, 0 <= k <= 1, or how it changes";
  return read_oscillation(require_field(value, path, "k", requirement), path + ".k");
}

simulation::RigidShape read_axes(const Json& value, const std::string& path) {
  const Json& axes = value["semi_axes"];
  if (!axes.is_array() || (axes.size() != 2 && axes.size() != 3))
    throw InputError(path + ".semi_axes", quoted(axes),
                     "2 numbers, of an ellipse, or 3, of an ellipsoid (metres)");
  Json body = value;
  if (axes.size() == 2) {
    if (value.contains("hyperboloids"))
      throw InputError(path + ".hyperboloids", quoted(value["hyperboloids"]),
                       "left out in the plane; a_c, b_c, k give an ellipse with dents");
    body["center"] = {0, 0};
    return {input::read_planar_body(body, path)};
  }
  body["center"] = {0, 0, 0};
  return {input::read_spatial_body(body, path)};
}

simulation::RigidShape read_points(const Json& list, const std::string& path) {
  if (!list.is_array() || list.empty())
    throw InputError(path, quoted(list), "a list of points [x, y, z] (metres)");
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < list.size(); ++i)
    points.push_back(read_vector<3>(list[i], at(path, i), " (metres)"));
  return {HullBody(std::move(points))};
}

/// A mesh, cloud or map as it stands in the body's frame; the hull of a file's points.
simulation::RigidShape read_file_body(const Json& value, const std::string& path,
                                      const std::filesystem::path& folder) {
  if (value.contains("hull")) return {input::read_hull_agent(value, path, folder)};
  const input::PiecesBody body = input::read_pieces_body(value, path, folder);
  return {Placed(body.pieces, body.pose)};
}

/// The list of a file that `vericone fit` wrote: its pieces, or its one obstacle.
Json pieces_of_file(const std::string& name, const std::string& path, const std::filesystem::path& folder) {
  Json fields;
  try {
    fields = input::read_scene_fields((folder / name).string());
  } catch (const InputError& e) {
    throw InputError(path, name + ": " + e.value(), e.requirement());
  }
  if (fields.is_object() && fields.contains("pieces")) return fields["pieces"];
  if (fields.is_object() && fields.contains("obstacle")) return Json::array({fields["obstacle"]});
  throw InputError(path, name, "a file with a list of pieces, as vericone fit --pieces writes it");
}

/// The union of ellipsoids and delimited ones, or of convex hulls.
simulation::RigidShape read_union(const Json& value, const std::string& path,
                                  const std::filesystem::path& folder) {
  require_known(value, path, {"pieces"});
  const std::string field = path + ".pieces";
  const Json list = value["pieces"].is_string()
                        ? pieces_of_file(value["pieces"].get<std::string>(), field, folder)
                        : value["pieces"];
  if (!list.is_array() || list.empty())
    throw InputError(field, quoted(list), "a list of bodies, or the name of a file that has one");
  std::vector<CombinedEllipsoid> quadrics;
  std::vector<HullBody> hulls;
  for (std::size_t i = 0; i < list.size(); ++i) {
    require_object(list[i], at(field, i));
    if (input::is_pieces_body(list[i]))
      hulls.push_back(input::read_hull_agent(list[i], at(field, i), folder));
    else
      quadrics.push_back(input::read_spatial_body(list[i], at(field, i)));
    if (!hulls.empty() && !quadrics.empty())
      throw InputError(at(field, i), quoted(list[i]), "like the pieces before it: hulls, or none");
  }
  if (!hulls.empty()) return {Placed(Assembly::polyhedra(std::move(hulls)))};
  return {Placed(Body::pieces(std::move(quadrics)))};
}

}  // namespace

simulation::ShapeInTime read_shape(const Json& value, const std::string& path,
                                   const std::filesystem::path& folder) {
  require_object(value, path);
  const bool from_file = input::is_pieces_body(value) && !value.contains("points");
  if (!from_file && !value.contains("pieces"))
    require_known(value, path, {"semi_axes", "hyperboloids", "a_c", "b_c", "dented", "k", "points"});
  const int kinds = value.contains("semi_axes") + (value.contains("a_c") || value.contains("b_c")) +
                    value.contains("dented") + value.contains("points") + value.contains("pieces") +
                    from_file;
  if (kinds != 1) throw InputError(path, kinds == 0 ? "no shape" : "more than one shape", shape_kinds());
  if (from_file) return read_file_body(value, path, folder);
  if (value.contains("pieces")) return read_union(value, path, folder);
  if (value.contains("k") && (value.contains("semi_axes") || value.contains("points")))
    throw InputError(path + ".k", quoted(value["k"]), "left out, or the body given by a_c or dented");
  if (value.contains("hyperboloids") && !value.contains("semi_axes"))
    throw InputError(path + ".hyperboloids", quoted(value["hyperboloids"]),
                     "left out, or the body given by semi_axes");
  if (value.contains("semi_axes")) return read_axes(value, path);
  if (value.contains("points")) return read_points(value["points"], path + ".points");
  if (value.contains("dented")) {
    simulation::DentedQuadric shape;
    shape.semi_axes = read_vector<3>(value["dented"], path + ".dented", " (metres)");
    for (int i = 0; i < 3; ++i) read_positive(value["dented"][i], at(path + ".dented", i), " (metres)");
    shape.k = require_oscillation(value, path);
    return shape;
  }
  simulation::DentedConic shape;
  const char* length = "a length in metres";
  shape.a_c = read_positive(require_field(value, path, "a_c", length), path + ".a_c", " (metres)");
  shape.b_c = read_positive(require_field(value, path, "b_c", length), path + ".b_c", " (metres)");
  shape.k = require_oscillation(value, path);
  return shape;
}

}  // namespace vericone::scenario
