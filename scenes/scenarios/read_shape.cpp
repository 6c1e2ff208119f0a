// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/parts.h"

#include <utility>

#include "input/assembly_body.h"
#include "input/body.h"
#include "input/field_table.h"
#include "input/fields.h"
#include "input/file_body.h"
#include "input/motions.h"
#include "input/planar_body.h"
#include "input/spatial_body.h"
#include "json/json_value.h"
#include "output/schemas.h"
#include "solids/flat_body.h"

namespace vericone::scenario {
namespace {

using input::at, input::Fields, input::number, input::quoted, input::read_vector, input::require_field,
    input::require_known, input::require_object, input::vector;

/// A field that bodies of scenes have too.
Json of_body(const std::string& name) {
  return {{"$ref", "body.schema.json#/$defs/body/properties/" + name}};
}

std::string shape_kinds() {
  return "given by exactly one of semi_axes (2 or 3 numbers), shape, quadric, a_c (with b_c, k), dented "
         "(with k), "
         "pieces, file, " +
         input::pieces_kinds();
}

const Fields<simulation::Oscillation>& oscillation_fields() {
  using K = simulation::Oscillation;
  static const Fields<K> fields =
      Fields<K>("oscillation")
          .row("offset", &K::offset, number(), "In the middle.")
          .row("amplitude", &K::amplitude, number(), "offset + amplitude sin(rate t + phase).")
          .row("rate", &K::rate, number("rad/s"), "Of the sine.")
          .row("phase", &K::phase, number("rad"), "At the start.")
          .row("absolute", &K::absolute, input::flag(), "Of its absolute value.");
  return fields;
}

/// k: a number, or how it changes in time.
simulation::Oscillation read_oscillation(const Json& value, const std::string& path) {
  if (value.is_number()) return {.offset = number().read(value, path)};
  if (!value.is_object())
    throw InputError(path, quoted(value),
                     "a number, or offset, amplitude, rate, phase, absolute of a changing one");
  return oscillation_fields().read(value, path);
}

/// The fields of a shape that no file and no union gives; what each means, the body's schema or the reader of
/// the kind says.
const Fields<simulation::RigidShape>& shape_fields() {
  static const Fields<simulation::RigidShape> fields = [] {
    Fields<simulation::RigidShape> rows("shape");
    for (const char* name : {"center", "rotation", "semi_axes", "hyperboloids", "hyperbolas", "shape",
                             "quadric", "a_c", "b_c", "phi"})
      rows.special(name, of_body(name), {}, nullptr);
    rows.special("dented", vector<3>("m").schema, {}, "Half-lengths of an ellipsoid with dents, with `k`.")
        .special("k", {{"$ref", "#/$defs/oscillation"}}, {}, "Of a_c or dented.");
    for (const char* name : {"points", "scale"}) rows.special(name, of_body(name), {}, nullptr);
    return rows;
  }();
  return fields;
}

simulation::Oscillation require_oscillation(const Json& value, const std::string& path) {
  const char* requirement = "a number, 0 <= k <= 1, or how it changes";
  return read_oscillation(require_field(value, path, "k", requirement), path + ".k");
}

/// Whether a body's own fields say that it is planar.
bool is_planar(const Json& value) {
  if (value.contains("semi_axes")) return value["semi_axes"].is_array() && value["semi_axes"].size() == 2;
  return value.contains("shape") && value["shape"].is_array() && value["shape"].size() == 2;
}

/// A planar body as of a scene, rigid; the centre may be left out.
simulation::RigidShape read_flat(const Json& value, const std::string& path) {
  Json body = value;
  if (!value.contains("center")) body["center"] = {0, 0};
  const CombinedEllipse flat = input::read_planar_body(body, path);
  if (!flat.center().isZero(0))
    throw InputError(path + ".center", quoted(value["center"]),
                     "[0, 0] or left out: a planar body turns about its centre; its place is position");
  return {flat};
}

/// As of a scene; the centre may be left out, and is that of the body's own frame.
simulation::RigidShape read_quadric(const Json& value, const std::string& path) {
  if (value.contains("semi_axes") &&
      (!value["semi_axes"].is_array() || (value["semi_axes"].size() != 2 && value["semi_axes"].size() != 3)))
    throw InputError(path + ".semi_axes", quoted(value["semi_axes"]),
                     "2 numbers, of an ellipse, or 3, of an ellipsoid (metres)");
  Json body = value;
  if (is_planar(value)) {
    if (value.contains("hyperboloids"))
      throw InputError(path + ".hyperboloids", quoted(value["hyperboloids"]),
                       "left out in the plane; hyperbolas, or a_c, b_c, k, give an ellipse with dents");
    return read_flat(value, path);
  }
  if (!value.contains("center") && !value.contains("quadric")) body["center"] = {0, 0, 0};
  const CombinedEllipsoid solid = input::read_spatial_body(body, path);
  // One whose centre is not the reference point is placed, as meshes are.
  if (!solid.center().isZero(0)) return {Placed(solid)};
  return {solid};
}

/// The convex hull of points as they stand in the body's frame.
simulation::RigidShape read_hull(const Json& value, const std::string& path,
                                 const std::filesystem::path& folder,
                                 std::optional<scenes::Reading>& reading) {
  const scenes::SceneBody body = input::read_hull_agent(value, path, folder);
  reading = body.reading;
  return {input::within(path, [&] { return in_world(*body.hull(), body.placed.pose); })};
}

/// A body with a margin; the centre may be left out.
simulation::RigidShape read_swollen(const Json& value, const std::string& path,
                                    const std::filesystem::path& folder,
                                    std::optional<scenes::Reading>& reading) {
  const char* requirement = "left out: bodies in the plane and bodies that change have none";
  for (const char* changing : {"k", "a_c", "dented", "hyperbolas"})
    if (value.contains(changing)) throw InputError(path + ".margin", quoted(value["margin"]), requirement);
  if (is_planar(value)) throw InputError(path + ".margin", quoted(value["margin"]), requirement);
  Json body = value;
  if ((value.contains("semi_axes") || value.contains("shape")) && !value.contains("center"))
    body["center"] = {0, 0, 0};
  scenes::SceneBody read = input::read_body(body, path, folder);
  reading = std::move(read.reading);
  return {std::move(read.placed)};
}

/// A mesh, cloud or map as it stands in the body's frame; the hull of a file's points.
simulation::RigidShape read_file_body(const Json& value, const std::string& path,
                                      const std::filesystem::path& folder,
                                      std::optional<scenes::Reading>& reading) {
  if (value.contains("hull")) return read_hull(value, path, folder, reading);
  scenes::SceneBody body = input::read_pieces_body(value, path, folder);
  reading = std::move(body.reading);
  if (const HullBody* hull = body.hull()) {
    const HullBody there = input::within(path, [&] { return in_world(*hull, body.placed.pose); });
    // Of a hull pilots look at the reference point; that of the ground says nothing, its middle does.
    if (value.contains("box")) return {there};
    return {Placed(Assembly::polyhedra({there}))};
  }
  return {std::move(body.placed)};
}

}  // namespace

simulation::ShapeInTime read_shape(const Json& given, const std::string& path,
                                   const std::filesystem::path& folder,
                                   std::optional<scenes::Reading>& reading) {
  require_object(given, path);
  const Json value = input::body_fields(given, path, folder);
  input::refuse_words_of_scenes(value, path);
  if (value.contains("margin")) return read_swollen(value, path, folder, reading);
  const bool from_file = input::is_pieces_body(value) && !value.contains("points");
  if (!from_file && !input::is_union(value)) shape_fields().require_known(value, path);
  const int kinds = value.contains("semi_axes") + value.contains("shape") + value.contains("quadric") +
                    (value.contains("a_c") || value.contains("b_c")) + value.contains("dented") +
                    value.contains("points") + input::is_union(value) + from_file;
  if (kinds != 1) throw InputError(path, kinds == 0 ? "no shape" : "more than one shape", shape_kinds());
  if (from_file) return read_file_body(value, path, folder, reading);
  if (input::is_union(value)) return simulation::RigidShape{input::read_union(value, path, folder)};
  if (value.contains("k") && (value.contains("semi_axes") || value.contains("points")))
    throw InputError(path + ".k", quoted(value["k"]), "left out, or the body given by a_c or dented");
  if (value.contains("hyperboloids") && !value.contains("semi_axes"))
    throw InputError(path + ".hyperboloids", quoted(value["hyperboloids"]),
                     "left out, or the body given by semi_axes");
  if (value.contains("semi_axes") || value.contains("shape") || value.contains("quadric"))
    return read_quadric(value, path);
  if (value.contains("points")) return read_hull(value, path, folder, reading);
  if (value.contains("dented")) {
    simulation::DentedQuadric shape;
    require_known(value, path, {"dented", "k"});
    shape.semi_axes = read_vector<3>(value["dented"], path + ".dented", " (metres)");
    for (int i = 0; i < 3; ++i) input::positive("m").read(value["dented"][i], at(path + ".dented", i));
    shape.k = require_oscillation(value, path);
    return shape;
  }
  if (value.contains("phi") || value.contains("center")) return read_flat(value, path);
  simulation::DentedConic shape;
  const char* length = "a length in metres";
  shape.a_c = input::positive("m").read(require_field(value, path, "a_c", length), path + ".a_c");
  shape.b_c = input::positive("m").read(require_field(value, path, "b_c", length), path + ".b_c");
  shape.k = require_oscillation(value, path);
  return shape;
}

Json shape_schemas() {
  Json shape = shape_fields().schema();
  const Json body = input::body_schema()["$defs"]["body"]["properties"];
  const Json moving = input::motion_schema();
  for (const auto& [name, field] : body.items())
    if (name != "velocity" && !moving.contains(name) && !input::is_word_of_scenes(name) &&
        !shape["properties"].contains(name))
      shape["properties"][name] = of_body(name);
  const Json number{{"type", "number"}};
  return {{"shape", std::move(shape)},
          {"oscillation",
           {{"title", "number, or object"},
            {"anyOf", {number, oscillation_fields().schema()}},
            {"description", "A number, or offset + amplitude sin(rate t + phase)."}}}};
}

}  // namespace vericone::scenario
