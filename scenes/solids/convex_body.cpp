// SPDX-License-Identifier: BSD-3-Clause
#include "solids/convex_body.h"

#include <vericone/internal/scenes/words.h>
#include <cmath>
#include <optional>

#include "json/json_value.h"

namespace vericone::input {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

/// The sizes of all words; each reads its own.
struct Sizes {
  std::optional<double> radius;
  std::optional<Vector2d> semi_axes;
  double height = 0, length = 0;
  Vector2d radii = Vector2d::Zero();
  Vector3d half_widths = Vector3d::Zero();
};

Value<double> size() { return not_negative("m"); }

/// Sizes of 0 are no mistake: a cylinder without height is a disc.
template <int N>
Value<Eigen::Matrix<double, N, 1>> sizes() {
  using Vector = Eigen::Matrix<double, N, 1>;
  return checked<Vector>(vector<N>("m"), "numbers, 0 or more (metres)",
                         [](const Vector& x) { return (x.array() >= 0).all(); });
}

void height(Fields<Sizes>& rows) {
  rows.row("height", &Sizes::height, size(), "The whole height, along z.",
           required("the whole height, metres"));
}

void radius(Fields<Sizes>& rows) {
  rows.row("radius", &Sizes::radius, size(), "About z.", required("the radius, metres"));
}

/// One of the two.
void round_or_elliptic(Fields<Sizes>& rows) {
  rows.row("radius", &Sizes::radius, size(), "About z; or `semi_axes`.", alternative())
      .row("semi_axes", &Sizes::semi_axes, sizes<2>(), "In place of `radius`: along x and y.", alternative());
}

Vector2d axes_of(const Sizes& read) {
  if (read.radius.has_value() == read.semi_axes.has_value())
    throw InputError("radius", read.radius ? "semi_axes beside it" : "nothing",
                     "given, metres, or semi_axes: [a, b], one of the two");
  return read.radius ? Vector2d::Constant(*read.radius) : *read.semi_axes;
}

/// The word of a body and its sizes.
struct Word {
  const char* name;
  const char* elliptic;  // what Convex calls one of two semi-axes; else the name again
  const char* title;     // of the mapping: "radius and height"
  const char* sentence;
  void (*rows)(Fields<Sizes>& fields);
  Convex (*make)(const Sizes& sizes);
  Json (*sizes)(const Convex& body);  // back again, as far as they can be told
};

double height_of(const Convex& body) { return 2 * std::abs(body.pieces().front().center.z()); }

Json elliptic_sizes(const Convex& body) {
  const Eigen::Matrix3d& factor = body.pieces().front().factor;
  const double a = factor(0, 0), b = factor(1, 1);
  return a == b ? Json{{"radius", a}} : Json{{"semi_axes", {a, b}}};
}

const std::vector<Word>& words() {
  static const std::vector<Word> all{
      {"cylinder", "elliptic cylinder", "radius and height",
       "Solid, its axis z, about the middle of its height.",
       [](Fields<Sizes>& rows) {
         round_or_elliptic(rows);
         height(rows);
       },
       [](const Sizes& s) {
         const Vector2d axes = axes_of(s);
         return s.radius ? Convex::cylinder(*s.radius, s.height)
                         : Convex::elliptic_cylinder(axes.x(), axes.y(), s.height);
       },
       [](const Convex& body) {
         Json sizes = elliptic_sizes(body);
         sizes["height"] = height_of(body);
         return sizes;
       }},
      {"capsule", "capsule", "radius and length",
       "What is within `radius` of a segment along z: a cylinder with half balls as ends.",
       [](Fields<Sizes>& rows) {
         radius(rows);
         rows.row("length", &Sizes::length, size(),
                  "Between the centres of its two ends: from tip to tip it is length + 2 radius.",
                  required("the length between the centres of its ends, metres"));
       },
       [](const Sizes& s) { return Convex::capsule(*s.radius, s.length); },
       [](const Convex& body) {
         return Json{{"radius", body.margin()}, {"length", height_of(body)}};
       }},
      {"cone", "cone", "radius and height", "Solid, its apex up z; about the middle of its height.",
       [](Fields<Sizes>& rows) {
         radius(rows);
         height(rows);
       },
       [](const Sizes& s) { return Convex::cone(*s.radius, s.height); },
       [](const Convex& body) {
         return Json{{"radius", body.pieces().front().factor(0, 0)}, {"height", height_of(body)}};
       }},
      {"frustum", "frustum", "radii and height",
       "A cone cut off: between two discs, about the middle of its height.",
       [](Fields<Sizes>& rows) {
         rows.row("radii", &Sizes::radii, sizes<2>(), "`[bottom, top]`, at z = -height/2 and height/2.",
                  required("[bottom, top] in metres"));
         height(rows);
       },
       [](const Sizes& s) { return Convex::frustum(s.radii.x(), s.radii.y(), s.height); },
       [](const Convex& body) {
         return Json{{"radii", {body.pieces().front().factor(0, 0), body.pieces().back().factor(0, 0)}},
                     {"height", height_of(body)}};
       }},
      {"box", "box", "half_widths", "Solid, about its middle.",
       [](Fields<Sizes>& rows) {
         rows.row("half_widths", &Sizes::half_widths, sizes<3>(), "Half of its edges, along x, y and z.",
                  required("[x, y, z] in metres, half of its edges"));
       },
       [](const Sizes& s) { return Convex::box(s.half_widths); },
       [](const Convex& body) {
         const Vector3d corner = body.pieces().front().center.cwiseAbs();
         return Json{{"half_widths", vector_json(corner)}};
       }},
      {"disc", "ellipse", "radius", "Flat, across z.", round_or_elliptic,
       [](const Sizes& s) {
         const Vector2d axes = axes_of(s);
         return s.radius ? Convex::disc(*s.radius) : Convex::ellipse(axes.x(), axes.y());
       },
       elliptic_sizes}};
  return all;
}

const Fields<Sizes>& size_fields(const Word& word) {
  static const std::vector<Fields<Sizes>> all = [] {
    std::vector<Fields<Sizes>> each;
    for (const Word& one : words()) one.rows(each.emplace_back(one.title));
    return each;
  }();
  return all[std::size_t(&word - words().data())];
}

struct WordFields : PlaceFields {
  Sizes sizes;
};

BodyKind kind_of(const Word& word) {
  Fields<WordFields> rows("body");
  with_place(rows.row(word.name, &WordFields::sizes, mapping(word.name, size_fields(word)), word.sentence,
                      alternative()));
  return body_kind(rows, [&word](const WordFields& read, const std::filesystem::path&) {
    const Convex body = within(word.name, [&] { return word.make(read.sizes); });
    // What is no more than the hull of its points is one: the oracles of hulls are faster.
    Body shape = body.is_hull() ? Body(HullBody(body.corners())) : Body(body);
    return SceneBody{Placed(std::move(shape), read.pose), word.name};
  });
}

/// A hull alone, which files give as an assembly of one.
Body without_assembly(const Body& body) {
  const Assembly* pieces = body.assembly();
  const bool alone = pieces && pieces->kind() == PieceKind::hull && pieces->size() == 1;
  return alone ? Body(pieces->by_slot().hulls.front()) : body;
}

}  // namespace

std::vector<BodyKind> convex_kinds() {
  std::vector<BodyKind> kinds;
  for (const Word& word : words()) kinds.push_back(kind_of(word));
  return kinds;
}

Json convex_schemas() {
  Json schemas = Json::object();
  for (const Word& word : words()) schemas[word.name] = size_fields(word).schema();
  return schemas;
}

SceneBody with_margin(SceneBody body, double margin) {
  Body shape = swollen(without_assembly(body.placed.body), margin);
  if (const Convex* convex = shape.convex(); convex && convex->word() == "convex" && body.field.empty())
    shape = convex->called(body.name);
  if (shape.kind() != body.placed.body.kind()) body.field.clear();
  body.placed.body = std::move(shape);
  body.name += " with a margin of " + scenes::brief(margin) + " m";
  return body;
}

Json word_fields(const Convex& body) {
  for (const Word& word : words()) {
    if (body.word() != word.name && body.word() != word.elliptic) continue;
    Json fields{{word.name, word.sizes(body)}};
    try {
      const Convex bare = word.make(size_fields(word).read(fields[word.name], word.name));
      const double margin = body.margin() - bare.margin();
      if (margin != 0) fields["margin"] = margin;
      const Convex again = bare.swollen(margin);
      if (again.pieces() == body.pieces() && again.margin() == body.margin()) return fields;
    } catch (const InputError&) {  // turned or moved: the word is kept, its sizes are not there
    }
  }
  return nullptr;
}

}  // namespace vericone::input
