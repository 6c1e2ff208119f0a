// SPDX-License-Identifier: BSD-3-Clause
#include "solids/slab_body.h"

#include <limits>

#include "input/body_kind.h"
#include "input/field_table.h"

namespace vericone::input {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

struct SlabFields {
  Vector3d normal = Vector3d::Zero();
  double offset = 0;
  Vector2d offsets = Vector2d::Zero();
};

/// [x, y, z], in the plane [x, y].
Value<Vector3d> normal() {
  return {[](const Json& value, const std::string& path) {
            Vector3d n = Vector3d::Zero();
            if (value.is_array() && value.size() == 2)
              n.head<2>() = read_vector<2>(value, path, "");
            else
              n = read_vector<3>(value, path, "");
            if (n.isZero(0)) throw InputError(path, quoted(value), "a direction, not zero");
            return n;
          },
          point<3>("").schema,
          {}};
}

Fields<SlabFields> with_normal(const char* title) {
  Fields<SlabFields> rows(title);
  rows.row("normal", &SlabFields::normal, normal(), "Out of it, of length 1; in the plane `[x, y]`.",
           required("[x, y, z], in the plane [x, y]"));
  return rows;
}

const Fields<SlabFields>& half_space_fields() {
  static const Fields<SlabFields> fields =
      with_normal("normal and offset")
          .row("offset", &SlabFields::offset, number("m"),
               "It is where normal.x <= offset: with a normal of length 1 "
               "how far along it the plane is from the origin.",
               required("a number, metres"));
  return fields;
}

const Fields<SlabFields>& slab_fields() {
  static const Fields<SlabFields> fields =
      with_normal("normal and offsets")
          .row("offsets", &SlabFields::offsets, vector<2>("m"), "`[low, high]`: low <= normal.x <= high.",
               required("[low, high], metres"));
  return fields;
}

constexpr const char* kWords[] = {"half_space", "slab"};

}  // namespace

std::optional<Slab> take_slab(Json& engagement) {
  if (!engagement.is_object()) return std::nullopt;
  const auto found = engagement.find("obstacle");
  if (found == engagement.end() || !found->is_object()) return std::nullopt;
  Json& obstacle = *found;
  const bool half = obstacle.contains("half_space");
  if (!half && !obstacle.contains("slab")) return std::nullopt;
  const char* word = kWords[half ? 0 : 1];
  const std::string path = std::string("obstacle.") + word;
  require_known(obstacle, "obstacle", {word, "velocity"});
  const Json given = obstacle[word];
  const SlabFields read = (half ? half_space_fields() : slab_fields()).read(given, path);
  Slab slab{read.normal, -std::numeric_limits<double>::infinity(), read.offset};
  if (!half) {
    slab.low = read.offsets.x();
    slab.high = read.offsets.y();
    if (!(slab.low <= slab.high))
      throw InputError(path + ".offsets", quoted(given["offsets"]), "[low, high], low no more than high");
  }
  obstacle.erase(word);
  const std::size_t size = given["normal"].size();
  obstacle["center"] = std::vector<double>(size, 0);
  obstacle["semi_axes"] = std::vector<double>(size, 1);
  return slab;
}

void refuse_slab(const Json& body, const std::string& path) {
  for (const char* word : kWords)
    if (body.is_object() && body.contains(word))
      throw InputError(join(path, word), quoted(body[word]),
                       "the obstacle of vericone query, which alone asks what has no end; a box of the "
                       "ground that counts is a body");
}

Json slab_schema() {
  Json properties;
  properties[kWords[0]] = {{"$ref", "#/$defs/half_space"},
                           {"description",
                            "All that is behind a plane: the ground, a wall. The obstacle of "
                            "`vericone query` alone."}};
  properties[kWords[1]] = {
      {"$ref", "#/$defs/slab"},
      {"description", "What lies between two parallel planes. The obstacle of `vericone query` alone."}};
  return properties;
}

Json slab_schemas() {
  return {{kWords[0], half_space_fields().schema()}, {kWords[1], slab_fields().schema()}};
}

}  // namespace vericone::input
