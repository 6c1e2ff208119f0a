// SPDX-License-Identifier: BSD-3-Clause
#include "solids/flat_body.h"

#include <vericone/files/files.h>
#include <vericone/internal/scenes/words.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "input/body_kind.h"
#include "input/planar_body.h"
#include "solids/slab_body.h"

namespace vericone::input {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

struct Stadium {
  double radius = 0, length = 0;
};

const Fields<Stadium>& stadium_fields() {
  static const Fields<Stadium> fields =
      Fields<Stadium>("radius and length")
          .row("radius", &Stadium::radius, positive("m"), "Of its round ends.",
               required("the radius, metres"))
          .row("length", &Stadium::length, not_negative("m"),
               "Between the centres of its ends, along x; of a disc 0.",
               required("the length between the centres of its ends, metres"));
  return fields;
}

struct FlatFields {
  Vector2d center = Vector2d::Zero();
  double rotation = 0, margin = 0;
  files::Polygon polygon;
  std::optional<Stadium> stadium;
};

const Fields<FlatFields>& flat_fields() {
  using F = FlatFields;
  static const Fields<F> fields = [] {
    Fields<F> rows("body");
    return rows
        .row("polygon", within_part(&F::polygon, &files::Polygon::outline),
             list("corners [x, y] (metres)", vector<2>("m"), 3),
             "In the plane: what this outline holds, dented or not, either way round. It must not meet "
             "itself.",
             alternative())
        .row("holes", within_part(&F::polygon, &files::Polygon::holes),
             list("polygons", list("corners [x, y] (metres)", vector<2>("m"), 3)),
             "Of the polygon, each apart from its outline and from the others.", absent("none"))
        .row("stadium", &F::stadium, mapping("stadium", stadium_fields()),
             "In the plane: what is within `radius` of a segment along x.", alternative())
        .row("center", &F::center, point<2>(), kCenterSentence, alternative())
        .row("rotation", &F::rotation, number("radians"), kRotationSentence, absent("not turned"))
        .row("margin", &F::margin, not_negative("m"), kMarginSentence, absent("none"));
  }();
  return fields;
}

/// The convex parts of a raised body, in the world.
std::vector<Convex> parts_of(const Placed& raised) {
  const Body& body = raised.body;
  std::vector<Convex> parts;
  if (const Assembly* pieces = body.assembly())
    for (std::size_t i = 0; i < pieces->size(); ++i) parts.push_back(pieces->convex_piece(i));
  else if (body.hull())
    parts.push_back(Convex::rounded(*body.hull(), 0));
  else if (body.convex())
    parts.push_back(*body.convex());
  else
    parts.push_back(Convex::rounded(body.quadric()->ellipsoid(), 0));
  for (Convex& part : parts) part = in_world(part, raised.pose);
  return parts;
}

/// Polygons alone are hulls, which are faster.
Body union_of(const std::vector<Convex>& parts) {
  if (!std::ranges::all_of(parts, &Convex::is_hull)) return Assembly::convexes(parts);
  std::vector<HullBody> hulls;
  for (const Convex& part : parts) hulls.emplace_back(part.corners());
  return Assembly::polyhedra(std::move(hulls));
}

/// Before its height is known.
struct Flat {
  FlatFields read;
  std::vector<Flat> pieces;              // of a union
  std::optional<SceneBody> slab;         // the part of one
  std::optional<CombinedEllipse> conic;  // else a polygon or a stadium
  double size = 0;                       // m, no less than that of its bounds

  SceneBody raised_to(double height, const std::string& path) const {
    return within(path, [&] {
      if (!pieces.empty()) return joined(height);
      if (slab) return SceneBody{Placed(swollen(slab->placed.body, read.margin)), named(slab->name)};
      if (conic) {
        const Body body = swollen(Body(raised(*conic, height)), read.margin);
        return SceneBody{body, named(conic->is_ellipsoid() ? "ellipse" : "combined conic")};
      }
      Pose pose{{read.center.x(), read.center.y(), 0}, Eigen::Matrix3d::Identity()};
      pose.rotation.topLeftCorner<2, 2>() = rotation_2d(read.rotation);
      if (read.stadium) {
        const double half = 0.5 * read.stadium->length;
        const HullBody wall({{-half, 0, -height}, {half, 0, -height}, {-half, 0, height}, {half, 0, height}});
        return SceneBody{Placed(swollen(swollen(wall, read.stadium->radius), read.margin), pose),
                         named("stadium")};
      }
      const std::size_t holes = read.polygon.holes.size();
      return SceneBody{Placed(swollen(prisms(height), read.margin), pose),
                       named("polygon of " + std::to_string(read.polygon.outline.size()) + " corners" +
                             (holes == 0   ? ""
                              : holes == 1 ? " with a hole"
                                           : " with " + std::to_string(holes) + " holes"))};
    });
  }

 private:
  Body prisms(double height) const {
    try {
      return files::raised(read.polygon, height);
    } catch (const InputError& e) {
      const std::string& field = e.field();
      if (!field.starts_with("outline")) throw;
      std::string value = e.value();
      if (const auto named = value.find("outline["); named != std::string::npos)
        value.replace(named, 7, "polygon");
      throw InputError("polygon" + field.substr(7), value, e.requirement());
    }
  }

  SceneBody joined(double height) const {
    std::vector<Convex> parts;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (Convex& part : parts_of(pieces[i].raised_to(height, at("pieces", i)).placed))
        parts.push_back(std::move(part));
    return SceneBody{Placed(swollen(union_of(parts), read.margin)),
                     named("union of " + std::to_string(pieces.size()) + " pieces")};
  }

  std::string named(const std::string& name) const {
    return read.margin > 0 ? name + " with a margin of " + scenes::brief(read.margin) + " m" : name;
  }
};

/// Whether a piece is one of the plane, by its word or by the numbers of its center.
bool is_flat_union(const Json& body) {
  if (!body.contains("pieces") || !body["pieces"].is_array()) return false;
  return std::ranges::any_of(body["pieces"], [](const Json& piece) {
    if (is_flat_word(piece)) return true;
    if (!piece.is_object() || !piece.contains("center")) return false;
    return piece["center"].is_array() && piece["center"].size() == 2;
  });
}

Flat read_flat(const Json& value, const std::string& path) {
  require_object(value, path);
  Flat flat;
  if (value.contains("polygon") || value.contains("stadium")) {
    flat.read = flat_fields().read(value, path);
    if (value.contains("polygon") && value.contains("stadium"))
      throw InputError(join(path, "stadium"), quoted(value["stadium"]), "left out beside a polygon");
    if (value.contains("holes") && !value.contains("polygon"))
      throw InputError(join(path, "holes"), quoted(value["holes"]), "left out, or beside a polygon");
    double far = 0;
    for (const Vector2d& x : flat.read.polygon.outline) far = std::max(far, x.norm());
    if (flat.read.stadium) far = flat.read.stadium->length / 2 + flat.read.stadium->radius;
    flat.size = 2 * (far + flat.read.margin);
    return flat;
  }
  Json bare = value;
  if (value.contains("margin")) {
    flat.read.margin = not_negative("m").read(value["margin"], join(path, "margin"));
    bare.erase("margin");
  }
  if (is_flat_union(bare)) {
    require_known(bare, path, {"pieces"});
    for (std::size_t i = 0; i < bare["pieces"].size(); ++i) {
      const std::string field = at(join(path, "pieces"), i);
      flat.pieces.push_back(read_flat(bare["pieces"][i], field));
      const Flat& piece = flat.pieces.back();
      if (piece.conic && !piece.conic->is_ellipsoid())
        throw InputError(field, "an ellipse with hyperbolas", "a convex body of the plane, or a polygon");
      const double off = (piece.conic ? piece.conic->center() : piece.read.center).norm();
      flat.size = std::max(flat.size, piece.size + 2 * (off + flat.read.margin));
    }
    return flat;
  }
  if (is_flat_slab(bare)) {
    flat.slab = read_flat_slab(bare, path);
    const Box bounds = flat.slab->placed.body.bounds();
    flat.size = 2 * (bounds.low.cwiseAbs().cwiseMax(bounds.high.cwiseAbs()).maxCoeff() + flat.read.margin);
    return flat;
  }
  flat.conic = read_planar_body(bare, path);
  flat.size = 2 * (flat.conic->ellipsoid().semi_axes().maxCoeff() + flat.read.margin);
  return flat;
}

/// The corners above the plane, in their order, of a prism; else, of a round one, many points around it.
std::vector<Vector2d> outline_of(const Convex& raised) {
  std::vector<Vector2d> outline;
  if (raised.margin() == 0 && raised.is_hull()) {
    for (const Convex::Piece& piece : raised.pieces())
      if (piece.center.z() > 0) outline.emplace_back(piece.center.head<2>());
    return outline;
  }
  constexpr int kDirections = 360;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    outline.emplace_back(raised.support_point({std::cos(angle), std::sin(angle), 0}).head<2>());
  }
  return outline;
}

}  // namespace

bool is_flat_word(const Json& body) {
  return body.is_object() &&
         (body.contains("polygon") || body.contains("stadium") || is_flat_slab(body) || is_flat_union(body));
}

bool is_word_of_scenes(const std::string& field) {
  return field == "polygon" || field == "holes" || field == "stadium";
}

void refuse_words_of_scenes(const Json& body, const std::string& path) {
  for (const char* word : {"polygon", "stadium"})
    if (body.is_object() && body.contains(word))
      throw InputError(join(path, word), quoted(body[word]),
                       "a body in space, of a union a part of one: polygons and stadiums are bodies of "
                       "scenes and cases in the plane");
}

Scene flat_scene(const Json& agent, const Json& obstacle) {
  const Flat a = read_flat(agent, "agent"), b = read_flat(obstacle, "obstacle");
  const double height = std::max(a.size, b.size);
  Scene scene;
  scene.agent = a.raised_to(height, "agent");
  scene.obstacle = b.raised_to(height, "obstacle");
  scene.in_plane = true;
  return scene;
}

SceneBody read_flat_body(const Json& value, const std::string& path) {
  const Flat flat = read_flat(value, path);
  return flat.raised_to(flat.size, path);
}

Json flat_schema() { return flat_fields().schema(); }
Json stadium_schema() { return stadium_fields().schema(); }

std::vector<std::vector<Vector2d>> flat_outlines(const Placed& raised) {
  std::vector<std::vector<Vector2d>> outlines;
  for (const Convex& part : parts_of(raised)) outlines.push_back(outline_of(part));
  return outlines;
}

}  // namespace vericone::input
