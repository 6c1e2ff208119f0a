// SPDX-License-Identifier: BSD-3-Clause
#include "solids/slab_body.h"

#include <vericone/internal/scenes/words.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "input/field_table.h"

namespace vericone::input {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

struct Normal {
  Vector3d direction = Vector3d::Zero();
  bool flat = false;  // [x, y], of the plane
};

struct SlabFields {
  Normal normal;
  double offset = 0;
  std::optional<Vector2d> offsets;  // of a slab
  std::optional<double> extent;
};

Value<Normal> normal() {
  return {[](const Json& value, const std::string& path) {
            Normal n{Vector3d::Zero(), value.is_array() && value.size() == 2};
            if (n.flat)
              n.direction.head<2>() = read_vector<2>(value, path, "");
            else
              n.direction = read_vector<3>(value, path, "");
            if (n.direction.isZero(0)) throw InputError(path, quoted(value), "a direction, not zero");
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

constexpr const char* kExtentSentence =
    "The part that counts, a box: what is within so much of the point of its plane nearest to the body's "
    "origin, along the plane, and of a half-space as deep.";

Fields<SlabFields>& with_extent(Fields<SlabFields>& rows) {
  return rows.row("extent", &SlabFields::extent, positive("m"), kExtentSentence,
                  absent("without end, above"));
}

const Fields<SlabFields>& half_space_fields() {
  static const Fields<SlabFields> fields = [] {
    Fields<SlabFields> rows = with_normal("normal and offset");
    return with_extent(rows.row("offset", &SlabFields::offset, number("m"),
                                "It is where normal.x <= offset: with a normal of length 1 "
                                "how far along it the plane is from the origin.",
                                required("a number, metres")));
  }();
  return fields;
}

const Fields<SlabFields>& slab_fields() {
  static const Fields<SlabFields> fields = [] {
    Fields<SlabFields> rows = with_normal("normal and offsets");
    return with_extent(rows.row("offsets", &SlabFields::offsets, vector<2>("m"),
                                "`[low, high]`: low <= normal.x <= high.", required("[low, high], metres")));
  }();
  return fields;
}

struct SlabWord {
  const char *name, *called, *sentence;
  const Fields<SlabFields>& (*fields)();
};
constexpr SlabWord kSlabWords[] = {
    {"half_space", "half-space", "All that is behind a plane: the ground, a wall.", half_space_fields},
    {"slab", "slab", "What lies between two parallel planes.", slab_fields}};

const SlabWord* slab_word_of(const Json& body) {
  if (body.is_object())
    for (const SlabWord& word : kSlabWords)
      if (body.contains(word.name)) return &word;
  return nullptr;
}

Slab slab_of(const SlabFields& read) {
  if (!read.offsets) return {read.normal.direction, -std::numeric_limits<double>::infinity(), read.offset};
  const Vector2d& ends = *read.offsets;
  if (!(ends.x() <= ends.y()))
    throw InputError("offsets", "[" + to_text(ends.x()) + ", " + to_text(ends.y()) + "]",
                     "[low, high], low no more than high");
  return {read.normal.direction, ends.x(), ends.y()};
}

/// In its own frame.
SceneBody part_of(const SlabWord& word, const SlabFields& read) {
  if (!read.extent)
    throw InputError("extent", "nothing",
                     "given, metres: the part that counts; without end it is the obstacle of vericone query "
                     "and cone, or a body of a scenario whose other bodies have a greatest speed");
  return {Placed(clipped(slab_of(read), Vector3d::Zero(), *read.extent)),
          std::string(word.called) + " within " + scenes::brief(*read.extent) + " m"};
}

struct PartFields : PlaceFields {
  SlabFields slab;
};

BodyKind slab_kind(const SlabWord& word) {
  Fields<PartFields> rows("body");
  with_place(rows.row(word.name, &PartFields::slab, mapping(word.name, word.fields()), word.sentence,
                      alternative()));
  return body_kind(rows, [&word](const PartFields& read, const std::filesystem::path&) {
    return within(word.name, [&] {
      if (read.slab.normal.flat) throw InputError("normal", "two numbers", "[x, y, z]: a body in space");
      SceneBody body = part_of(word, read.slab);
      body.placed.pose = read.pose;
      return body;
    });
  });
}

}  // namespace

bool is_endless(const Json& body) {
  const SlabWord* word = slab_word_of(body);
  return word && body[word->name].is_object() && !body[word->name].contains("extent");
}

Slab read_endless(const Json& body, const std::string& path) {
  const SlabWord& word = *slab_word_of(body);
  const std::string field = join(path, word.name);
  return within(field, [&] { return slab_of(word.fields().read(body[word.name], "")); });
}

bool is_flat_slab(const Json& body) {
  const SlabWord* word = slab_word_of(body);
  if (!word || !body[word->name].is_object() || !body[word->name].contains("normal")) return false;
  const Json& normal = body[word->name]["normal"];
  return normal.is_array() && normal.size() == 2;
}

SceneBody read_flat_slab(const Json& body, const std::string& path) {
  const SlabWord& word = *slab_word_of(body);
  require_known(body, path, {word.name});
  SceneBody part =
      within(join(path, word.name), [&] { return part_of(word, word.fields().read(body[word.name], "")); });
  // Around the middle, as a prism's corners are.
  std::vector<Vector3d> corners = part.hull()->points();
  const Vector3d middle = part.placed.middle();
  std::ranges::sort(corners, {},
                    [&](const Vector3d& x) { return std::atan2(x.y() - middle.y(), x.x() - middle.x()); });
  part.placed.body = HullBody(std::move(corners));
  return part;
}

std::optional<Slab> take_slab(Json& engagement) {
  if (!engagement.is_object() || !engagement.contains("obstacle") || !is_endless(engagement["obstacle"]))
    return std::nullopt;
  Json& obstacle = engagement["obstacle"];
  const char* word = slab_word_of(obstacle)->name;
  require_known(obstacle, "obstacle", {word, "velocity"});
  const Slab slab = read_endless(obstacle, "obstacle");
  const std::size_t size = is_flat_slab(obstacle) ? 2 : 3;
  obstacle.erase(word);
  obstacle["center"] = std::vector<double>(size, 0);
  obstacle["semi_axes"] = std::vector<double>(size, 1);
  return slab;
}

std::vector<BodyKind> slab_kinds() {
  std::vector<BodyKind> kinds;
  for (const SlabWord& word : kSlabWords) kinds.push_back(slab_kind(word));
  return kinds;
}

Json slab_schemas() {
  Json schemas = Json::object();
  for (const SlabWord& word : kSlabWords) schemas[word.name] = word.fields().schema();
  return schemas;
}

}  // namespace vericone::input
