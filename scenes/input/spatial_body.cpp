// SPDX-License-Identifier: BSD-3-Clause
#include "input/spatial_body.h"

#include <vericone/geometry/quadric.h>
#include <array>
#include <string_view>

#include "input/assembly_body.h"
#include "input/fields.h"
#include "json/json_value.h"

namespace vericone::input {
namespace {

/// As written: not quite orthonormal yet.
Eigen::Matrix3d read_turn(const Json& value, const std::string& path) {
  if (value.is_array() && value.size() == 4 && value[0].is_array())
    throw InputError(path, quoted(value),
                     "a quaternion [w, x, y, z] or a 3x3 matrix (of a 4x4 pose the upper left one; its last "
                     "column is the center)");
  if (value.is_array() && value.size() == 4) return rotation_3d(read_vector<4>(value, path, ""));
  if (value.is_array() && value.size() == 3) return read_matrix<3>(value, path, "");
  throw InputError(path, quoted(value), "a quaternion [w, x, y, z] or a 3x3 matrix");
}

/// The nearest rotation; throws InputError naming "rotation" where that is not near.
Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& rotation) {
  return Ellipsoid::from_axes(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), rotation).factor();
}

int read_sheets(const Json& value, const std::string& path) {
  // From YAML a number comes as a double.
  if (value.is_number() && (value.get<double>() == 1 || value.get<double>() == 2))
    return static_cast<int>(value.get<double>());
  throw InputError(path, quoted(value), "1 (a waist) or 2 (two dents)");
}

Delimiter<3> read_hyperboloid(const Json& value, const std::string& path, const Eigen::Matrix3d& body) {
  require_object(value, path);
  require_known(value, path, {"sheets", "semi_axes", "rotation"});
  const int sheets =
      read_sheets(require_field(value, path, "sheets", "1 (a waist) or 2 (two dents)"), path + ".sheets");
  const Eigen::Vector3d axes =
      read_vector<3>(require_field(value, path, "semi_axes", "[a, b, c] in metres, a along its axis"),
                     path + ".semi_axes", " (metres)");
  return within(path, [&] {
    Eigen::Matrix3d own = Eigen::Matrix3d::Identity();
    if (value.contains("rotation")) own = orthonormal(read_turn(value["rotation"], "rotation"));
    return hyperboloid(sheets, axes, body * own);
  });
}

CombinedEllipsoid read_axes(const Json& value, const std::string& path, const Eigen::Vector3d& center) {
  const Eigen::Vector3d axes = read_vector<3>(value["semi_axes"], path + ".semi_axes", " (metres)");
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  const Ellipsoid ellipsoid = within(path, [&] {
    if (value.contains("rotation")) rotation = read_turn(value["rotation"], "rotation");
    return Ellipsoid::from_axes(center, axes, rotation);
  });
  if (!value.contains("hyperboloids")) return ellipsoid;
  const Json& list = value["hyperboloids"];
  const std::string field = path + ".hyperboloids";
  if (!list.is_array())
    throw InputError(field, quoted(list), "a list of hyperboloids, each with sheets and semi_axes");
  const Eigen::Matrix3d turn = orthonormal(rotation);
  std::vector<Delimiter<3>> delimiters;
  for (std::size_t i = 0; i < list.size(); ++i)
    delimiters.push_back(read_hyperboloid(list[i], at(field, i), turn));
  return within(path, [&] { return CombinedEllipsoid(ellipsoid, std::move(delimiters)); });
}

}  // namespace

Eigen::Matrix3d read_rotation(const Json& body, const std::string& path) {
  if (!body.contains("rotation")) return Eigen::Matrix3d::Identity();
  return within(path, [&] { return orthonormal(read_turn(body["rotation"], "rotation")); });
}

CombinedEllipsoid read_spatial_body(const Json& value, const std::string& path) {
  require_object(value, path);
  const int kinds = value.contains("semi_axes") + value.contains("shape") + value.contains("quadric");
  constexpr std::array<std::string_view, 6> kOwn{"center",       "semi_axes", "rotation",
                                                 "hyperboloids", "shape",     "quadric"};
  if (kinds > 0) {
    require_known(value, path, kOwn);
  } else {  // what says the kind may be the field that is misspelt
    std::vector<std::string> known = pieces_fields();
    known.insert(known.begin(), kOwn.begin(), kOwn.end());
    known.insert(known.end(), {"pieces", "file", "velocity"});
    require_known(value, path, known);
  }
  if (kinds != 1)
    throw InputError(path, kinds == 0 ? "no shape" : "more than one shape",
                     "given by exactly one of semi_axes (with rotation), shape, quadric, " + pieces_kinds());
  for (const char* other : {"center", "rotation"})
    if (value.contains("quadric") && value.contains(other))
      throw InputError(path + "." + other, quoted(value[other]), "left out: the quadric matrix contains it");
  if (value.contains("shape") && value.contains("rotation"))
    throw InputError(path + ".rotation", quoted(value["rotation"]), "left out: the shape matrix contains it");
  if (value.contains("hyperboloids") && !value.contains("semi_axes"))
    throw InputError(
        path + ".hyperboloids", quoted(value["hyperboloids"]),
        "left out, or the body given by semi_axes and rotation, whose axes they are turned against");

  if (value.contains("quadric")) {
    const Eigen::Matrix4d q = read_matrix<4>(value["quadric"], path + ".quadric", "");
    return within(path, [&] { return Ellipsoid::from_quadric(Quadric(q)); });
  }
  const Eigen::Vector3d center = read_vector<3>(require_field(value, path, "center", "[x, y, z] in metres"),
                                                path + ".center", " (metres)");
  if (value.contains("shape")) {
    const Eigen::Matrix3d shape = read_matrix<3>(value["shape"], path + ".shape", " (square metres)");
    return within(path, [&] { return Ellipsoid::from_shape(center, shape); });
  }
  return read_axes(value, path, center);
}

}  // namespace vericone::input
