// SPDX-License-Identifier: BSD-3-Clause
#include "output/schemas.h"

#include "input/body_kind.h"
#include "input/file_body.h"
#include "input/motions.h"
#include "input/planar_body.h"
#include "input/scene.h"
#include "solids/convex_body.h"
#include "solids/flat_body.h"
#include "solids/slab_body.h"
#include "units/geographic.h"

namespace vericone::input {
namespace {

Json list_of(int count, Json items, const char* title) {
  return {{"title", title},
          {"type", "array"},
          {"items", std::move(items)},
          {"minItems", count},
          {"maxItems", count}};
}

Json any_of(const char* title, std::initializer_list<Json> forms, const char* description) {
  Json list = Json::array();
  for (const Json& form : forms) list.push_back(form);
  return {{"title", title}, {"anyOf", std::move(list)}, {"description", description}};
}

Json defined(const char* name) { return {{"$ref", std::string("#/$defs/") + name}}; }

/// What the values of fields are, by name.
Json values() {
  const Json number{{"type", "number"}}, quantity = with_unit(number, "m");
  const Json positive{{"title", "positive number"}, {"type", "number"}, {"exclusiveMinimum", 0}};
  const Json length{{"title", "positive number"}, {"type", quantity["type"]}, {"exclusiveMinimum", 0}};
  const Json items{{"type", quantity["type"]}};
  return {
      {"positive", positive},
      {"positive_quantity", length},
      {"vector2", list_of(2, number, "[x, y]")},
      {"vector3", list_of(3, number, "[x, y, z]")},
      {"quantities2", list_of(2, items, "[x, y]")},
      {"quantities3", list_of(3, items, "[x, y, z]")},
      {"vector4", list_of(4, number, "four numbers")},
      {"matrix3", list_of(3, defined("vector3"), "3x3 matrix")},
      {"point",
       any_of("[x, y] or [x, y, z]", {defined("quantities2"), defined("quantities3"), defined("place")},
              "Two numbers in the plane, three in space; or a place on the Earth.")},
      {"place", place_schema()},
      {"rotation", any_of("quaternion, matrix or angle", {defined("vector4"), defined("matrix3"), items},
                          "Unit quaternion [w, x, y, z] or 3x3 matrix; in the plane an angle.")},
      {"axes", any_of("[a, b] or [a, b, c]", {list_of(2, length, "[a, b]"), list_of(3, length, "[a, b, c]")},
                      "Half-lengths, m, along the columns of rotation.")}};
}

std::string lines_of(const Json& node, std::size_t indent, bool named) {
  if (!named && !node.contains("properties") && !node.contains("$defs")) return node.dump();
  std::string lines;
  for (const auto& [key, one] : node.items())
    lines += (lines.empty() ? "" : ",\n") + std::string(indent + 1, ' ') + Json(key).dump() + ": " +
             lines_of(one, indent + 1, !named && (key == "properties" || key == "$defs"));
  return "{\n" + lines + "\n" + std::string(indent, ' ') + "}";
}

}  // namespace

std::string schema_text(const Json& schema) { return lines_of(schema, 0, false) + "\n"; }

Json schema_of(const std::string& title, const std::string& description, Json fields) {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "vericone: " + title},
              {"description", description}};
  fields.erase("title");
  schema.update(fields);
  return schema;
}

Json body_schema() {
  std::vector<Json> tables{spatial_schema()["properties"], planar_schema()["properties"],
                           flat_schema()["properties"]};
  std::string kinds = "semi_axes, shape, quadric, a_c, polygon, stadium";
  for (const BodyKind& kind : body_kinds()) {
    tables.push_back(kind.properties);
    kinds += ", " + kind.name;
  }
  tables.push_back(union_schema()["properties"]);
  tables.push_back(file_body_schema()["properties"]);
  Json fields = Json::object();
  for (const Json& table : tables)
    for (const auto& [name, field] : table.items())
      if (!fields.contains(name)) fields[name] = field;
  fields["velocity"] = point<3>("m/s").schema;
  fields["velocity"]["description"] =
      "In scenes and cases another way to write `agent_velocity` or `obstacle_velocity`.";
  fields.update(motion_schema());
  Json names = values();
  names["hyperboloid"] = hyperboloid_schema();
  names["hyperbola"] = hyperbola_schema();
  names["stadium"] = stadium_schema();
  names.update(slab_schemas());
  names.update(convex_schemas());
  names["body"] = {
      {"title", "body"}, {"type", "object"}, {"properties", fields}, {"additionalProperties", false}};
  return schema_of("a body", "Metres, radians. Exactly one of the kinds: " + kinds + ", pieces, file.",
                   {{"$ref", "#/$defs/body"}, {"$defs", std::move(names)}});
}

Json scene_schema() {
  Json fields = engagement_fields().schema();
  fields["properties"].update(scene_file_fields().schema()["properties"]);
  return schema_of("a scene", "vericone cone SCENE.yaml, docs/reference/formats.md. Metres, m/s, radians.",
                   std::move(fields));
}

}  // namespace vericone::input
