// SPDX-License-Identifier: BSD-3-Clause
#include "input/spatial_body.h"

#include <vericone/geometry/quadric.h>

#include "input/assembly_body.h"
#include "input/body_kind.h"
#include "json/json_value.h"
#include "solids/flat_body.h"

namespace vericone::input {
namespace {

Eigen::Matrix3d read_turn(const Json& value, const std::string& path) {
  if (value.is_array() && value.size() == 4 && value[0].is_array())
    throw InputError(path, quoted(value),
                     "a quaternion [w, x, y, z] or a 3x3 matrix (of a 4x4 pose the upper left one; its last "
                     "column is the center)");
  if (value.is_array() && value.size() == 3) return read_matrix<3>(value, path, "");
  if (!value.is_array() || value.size() != 4)
    throw InputError(path, quoted(value), "a quaternion [w, x, y, z] or a 3x3 matrix");
  const Eigen::Vector4d wxyz = read_vector<4>(value, path, "");
  try {
    return rotation_3d(wxyz);
  } catch (const InputError& e) {
    throw InputError(path, e.value(), e.requirement());
  }
}

/// As written: not quite orthonormal yet.
Value<Eigen::Matrix3d> turn() { return {read_turn, Json{{"$ref", "body.schema.json#/$defs/rotation"}}, {}}; }

/// The nearest rotation; throws InputError naming "rotation" where that is not near.
Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& rotation) {
  return Ellipsoid::from_axes(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), rotation).factor();
}

using Hyperboloid = DelimiterFields<3, Eigen::Matrix3d>;

int read_sheets(const Json& value, const std::string& path) {
  // From YAML a number comes as a double.
  if (value.is_number() && (value.get<double>() == 1 || value.get<double>() == 2))
    return static_cast<int>(value.get<double>());
  throw InputError(path, quoted(value), "1 (a waist) or 2 (two dents)");
}

const Fields<Hyperboloid>& hyperboloid_fields() {
  static const Fields<Hyperboloid> fields =
      Fields<Hyperboloid>("hyperboloids")
          .row("sheets", &Hyperboloid::sheets, Value<int>{read_sheets, Json{{"enum", {1, 2}}}, {}},
               "2: x²/a² - y²/b² - z²/c² = 1 cuts two dents. 1: -x²/a² + y²/b² + z²/c² = 1 cuts a waist.",
               required("1 (a waist) or 2 (two dents)"))
          .row("semi_axes", &Hyperboloid::semi_axes, axes<3>(),
               "`[a, b, c]`, positive. Its axis is its local x.",
               required("[a, b, c] in metres, a along its axis"))
          .row("rotation", &Hyperboloid::rotation, turn(),
               "Written as the body's, relative to the body's frame: R = R_body R_hyperboloid.",
               absent("not turned"));
  return fields;
}

struct SpatialFields : QuadricFields<3, Eigen::Matrix3d> {
  std::optional<Eigen::Matrix4d> quadric;
};

const Fields<SpatialFields>& spatial_fields() {
  using S = SpatialFields;
  static const Fields<S> fields = [] {
    Fields<S> rows("body");
    with_quadric<3>(
        rows, turn(), "hyperboloids",
        list("hyperboloids, each with sheets and semi_axes", mapping("hyperboloid", hyperboloid_fields())),
        "With `semi_axes` in space: what delimits the ellipsoid.")
        .row("quadric", &S::quadric,
             matrix<4>("", {{"type", "array"},
                            {"items", {{"$ref", "#/$defs/vector4"}}},
                            {"minItems", 4},
                            {"maxItems", 4},
                            {"title", "4x4 matrix"}}),
             "In place of all others: symmetric 4x4 matrix Q of the surface x̃ᵀQx̃ = 0, an ellipsoid, "
             "either sign.");
    return with_margin_row(rows);
  }();
  return fields;
}

/// What holds of several fields together.
void check_spatial(const Json& value, const std::string& path) {
  refuse_words_of_scenes(value, path);
  const int kinds = value.contains("semi_axes") + value.contains("shape") + value.contains("quadric");
  if (kinds > 0) {
    spatial_fields().require_known(value, path);
  } else {  // what says the kind may be the field that is misspelt
    std::vector<std::string_view> known = spatial_fields().names();
    for (const std::string_view field : pieces_fields()) known.push_back(field);
    known.insert(known.end(), {"pieces", "file", "velocity"});
    require_known(value, path, std::span<const std::string_view>(known));
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
  if (!value.contains("quadric")) require_field(value, path, "center", "[x, y, z] in metres");
}

CombinedEllipsoid ellipsoid_of(const SpatialFields& read) {
  if (read.quadric) return Ellipsoid::from_quadric(Quadric(*read.quadric));
  if (read.shape) return Ellipsoid::from_shape(*read.center, *read.shape);
  const Eigen::Matrix3d rotation = read.rotation.value_or(Eigen::Matrix3d::Identity());
  const Ellipsoid ellipsoid = Ellipsoid::from_axes(*read.center, *read.semi_axes, rotation);
  if (read.delimiters.empty()) return ellipsoid;
  const Eigen::Matrix3d turned = orthonormal(rotation);
  std::vector<Delimiter<3>> delimiters;
  for (const Hyperboloid& one : read.delimiters)
    delimiters.push_back(within(at("hyperboloids", delimiters.size()), [&] {
      const Eigen::Matrix3d own = one.rotation ? orthonormal(*one.rotation) : Eigen::Matrix3d::Identity();
      return hyperboloid(one.sheets, one.semi_axes, turned * own);
    }));
  return CombinedEllipsoid(ellipsoid, std::move(delimiters));
}

}  // namespace

Value<Eigen::Matrix3d> rotation() {
  return {[](const Json& value, const std::string& path) -> Eigen::Matrix3d {
            const Eigen::Matrix3d turn = read_turn(value, path);
            try {
              return orthonormal(turn);
            } catch (const InputError& e) {
              throw InputError(path, e.value(), e.requirement());
            }
          },
          turn().schema,
          {}};
}

Eigen::Matrix3d read_rotation(const Json& body, const std::string& path) {
  if (!body.contains("rotation")) return Eigen::Matrix3d::Identity();
  return rotation().read(body["rotation"], path.empty() ? "rotation" : path + ".rotation");
}

CombinedEllipsoid read_spatial_body(const Json& value, const std::string& path) {
  require_object(value, path);
  check_spatial(value, path);
  refuse_margin(value, path);
  SpatialFields read;
  spatial_fields().read_known(value, path, read);
  return within(path, [&] { return ellipsoid_of(read); });
}

Json spatial_schema() { return spatial_fields().schema(); }
Json hyperboloid_schema() { return hyperboloid_fields().schema(); }

}  // namespace vericone::input
