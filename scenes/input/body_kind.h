// SPDX-License-Identifier: BSD-3-Clause
//
// A kind of body in space is told by one field, "mesh: FILE": a struct of its fields, their rows, and a
// function that makes the body of them. A new kind is one line more in body_kinds() (assembly_body.cpp).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "input/body.h"
#include "input/field_table.h"
#include "input/spatial_body.h"

namespace vericone::input {

/// Where a body stands; the fields of every kind are a PlaceFields.
struct PlaceFields {
  Pose pose;
};

inline constexpr const char* kCenterSentence =
    "Where the body stands; of a body from a file where the file's own origin stands, `[0, 0, 0]` if left "
    "out. Bodies are never moved to their middle.";
inline constexpr const char* kRotationSentence =
    "About the centre, or the file's origin: unit quaternion `[w, x, y, z]`, or 3x3 matrix (list of rows) "
    "with determinant +1; in the plane an angle, counter-clockwise, radians.";

/// [x, y] or [x, y, z], as schemas have it of either.
inline constexpr const char* kMarginSentence =
    "The body and all that is within this distance of it, exactly: each of its parts. Of a body from a file, "
    "in addition to the file's own. Not of bodies with hyperboloids or hyperbolas.";

template <int D>
Value<Eigen::Matrix<double, D, 1>> point(const char* unit = "m") {
  return shown_as(vector<D>(unit), {{"$ref", "body.schema.json#/$defs/point"}});
}

/// Adds the row `margin`, which read_body() reads before it reads the body.
template <typename S>
Fields<S>& with_margin_row(Fields<S>& fields) {
  return fields.special("margin", not_negative("m").schema, {}, kMarginSentence, absent("none"));
}
/// For readers of bodies that are asked for one without.
inline void refuse_margin(const Json& body, const std::string& path) {
  if (body.contains("margin"))
    throw InputError(join(path, "margin"), quoted(body["margin"]), "left out of this body");
}

/// Adds the rows `center`, `rotation` and `margin`.
template <typename S>
Fields<S>& with_place(Fields<S>& fields) {
  return with_margin_row(
      fields.row("center", within_part(&S::pose, &Pose::position), point<3>(), kCenterSentence, alternative())
          .row("rotation", within_part(&S::pose, &Pose::rotation), rotation(), kRotationSentence,
               absent("not turned")));
}

struct BodyKind {
  std::string name;
  std::vector<std::string_view> fields;
  Json properties;  // of the schema
  std::function<SceneBody(const Json& value, const std::string& path, const std::filesystem::path& folder)>
      read;
};

/// `make(fields, folder)` throws InputError naming the field within the body.
template <typename S, typename Make>
BodyKind body_kind(const Fields<S>& fields, Make make) {
  return {std::string(fields.names().front()), fields.names(), fields.schema()["properties"],
          [=](const Json& value, const std::string& path, const std::filesystem::path& folder) -> SceneBody {
            const S read = fields.read(value, path);
            return within(path, [&] { return make(read, folder); });
          }};
}

/// Those that no ellipsoid is.
const std::vector<BodyKind>& body_kinds();

// What an ellipsoid and an ellipse have in common.

template <int D, typename Turn>
struct DelimiterFields {
  int sheets = 2;
  Eigen::Matrix<double, D, 1> semi_axes;
  std::optional<Turn> rotation;
};

template <int D, typename Turn>
struct QuadricFields {
  std::optional<Eigen::Matrix<double, D, 1>> center, semi_axes;
  std::optional<Turn> rotation;
  std::vector<DelimiterFields<D, Turn>> delimiters;
  std::optional<Eigen::Matrix<double, D, D>> shape;
};

/// [a, b] or [a, b, c], as schemas have it of either; the body that is made refuses what is not positive.
template <int D>
Value<Eigen::Matrix<double, D, 1>> axes() {
  return shown_as(vector<D>("m"), {{"$ref", "body.schema.json#/$defs/axes"}});
}

template <int N>
Value<Eigen::Matrix<double, N, N>> matrix(const char* words, Json schema) {
  return {[words](const Json& value, const std::string& path) { return read_matrix<N>(value, path, words); },
          std::move(schema),
          {}};
}

/// Adds the rows of QuadricFields to those of an S that is one.
template <int D, typename S, typename Turn>
Fields<S>& with_quadric(Fields<S>& fields, const Value<Turn>& turn, const char* delimiters,
                        const Value<std::vector<DelimiterFields<D, Turn>>>& list, const char* sentence) {
  return fields.row("center", &S::center, point<D>(), kCenterSentence)
      .row("semi_axes", &S::semi_axes, axes<D>(),
           "Half-lengths along the columns of `rotation`; in the plane `[a, b]` along the body's x and y.")
      .row("rotation", &S::rotation, turn, kRotationSentence, absent("not turned"))
      .row(delimiters, &S::delimiters, list, sentence, absent("none"))
      .row("shape", &S::shape,
           matrix<D>(" (square metres)", {{"type", "array"}, {"title", "matrix"}, {"unit", "m²"}}),
           "In place of `semi_axes`: symmetric positive definite matrix S, 3x3 or in the plane 2x2, body { x "
           ": "
           "(x-p)ᵀ S⁻¹ (x-p) <= 1 }.");
}

}  // namespace vericone::input
