// SPDX-License-Identifier: BSD-3-Clause
#include "input/file_body.h"

#include <algorithm>

#include "input/assembly_body.h"
#include "input/body_kind.h"
#include "input/scene.h"
#include "json/json_value.h"
#include "solids/flat_body.h"

namespace vericone::input {
namespace {

using Path = std::filesystem::path;

constexpr int kMostFiles = 8;  // each naming the next
constexpr const char* kBodyFile =
    "a file with a body, or with the pieces or the obstacle that vericone fit writes";

/// A body that a file has; what stands beside the name is read where the file's body is known.
const Fields<std::string>& file_fields() {
  const auto itself = [](std::string& name) -> std::string& { return name; };
  static const Fields<std::string> fields =
      Fields<std::string>("body")
          .row("file", itself, file_name(),
               "A file with a body, for example `body.yaml` or `fit.json` of `vericone fit`. Names are "
               "relative to the file that they stand in. `center` and `rotation` beside it place the file's "
               "own origin.",
               alternative())
          .special("center", {}, {}, kCenterSentence)
          .special("rotation", {}, {}, kRotationSentence)
          .special("margin", {}, {}, kMarginSentence);
  return fields;
}

const Fields<PlaceFields>& union_fields() {
  static const Fields<PlaceFields> fields = [] {
    Fields<PlaceFields> rows("body");
    rows.special(
        "pieces",
        {{"anyOf",
          {{{"type", "string"}},
           {{"type", "array"}, {"items", {{"$ref", "#/$defs/body"}}}, {"minItems", 1}}}},
         {"title", "list of bodies, or file"}},
        {},
        "A union of bodies: ellipsoids, with hyperboloids too; or convex bodies of any kinds, each with its "
        "own margin; or the name of a file that has the list, as `vericone fit --pieces` writes it.");
    return with_place(rows);
  }();
  return fields;
}

/// What a file has of a body.
Json body_of_file(const std::string& name, const std::string& path, const Path& folder) {
  Json fields;
  try {
    fields = read_scene_fields((folder / name).string());
  } catch (const InputError& e) {
    throw InputError(path, name + ": " + e.value(), e.requirement());
  }
  if (!fields.is_object()) throw InputError(path, name, kBodyFile);
  if (fields.contains("pieces")) {
    Json body = {{"pieces", fields["pieces"]}};
    for (const char* field : {"center", "rotation", "margin"})
      if (fields.contains(field)) body[field] = fields[field];
    return body;
  }
  for (const char* body : {"obstacle", "body"})
    if (fields.contains(body) && fields[body].is_object()) return fields[body];
  if (const FileKind kind = kind_of_file(fields); kind != FileKind::unknown && kind != FileKind::body)
    throw InputError(path, name + ", " + name_of(kind), kBodyFile);
  return fields;
}

/// Names of files as seen from the folder that the body's own file is named from.
void follow_names(Json& body, const Path& to) {
  if (to.empty() || !body.is_object()) return;
  for (const char* field : {"mesh", "cloud", "octree", "hull", "robot", "file"})
    if (body.contains(field) && body[field].is_string())
      body[field] = (to / body[field].get<std::string>()).string();
  if (body.contains("packages") && body["packages"].is_object())
    for (Json& package : body["packages"])
      if (package.is_string()) package = (to / package.get<std::string>()).string();
  if (!body.contains("pieces")) return;
  Json& pieces = body["pieces"];
  if (pieces.is_string()) pieces = (to / pieces.get<std::string>()).string();
  if (pieces.is_array())
    for (Json& piece : pieces) follow_names(piece, to);
}

Json vector_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Json matrix_of(const Eigen::Matrix3d& m) {
  return {vector_of(m.row(0)), vector_of(m.row(1)), vector_of(m.row(2))};
}

/// The body moved as a whole: its own place and turn, and those of its file on top.
Json moved(Json body, const Json& by, const std::string& path) {
  const bool in_space = !is_flat_word(body) && (!body.contains("center") || body["center"].size() == 3);
  for (const char* field : {"center", "rotation"})
    if (by.contains(field) && (body.contains("quadric") || !in_space))
      throw InputError(path + "." + field, quoted(by[field]),
                       in_space ? "left out: the file's quadric matrix says where the body is"
                                : "left out: a planar body stands where its file says");
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  if (by.contains("center")) place = read_vector<3>(by["center"], path + ".center", " (metres)");
  const Eigen::Matrix3d turn = read_rotation(by, path);
  Eigen::Vector3d own = Eigen::Vector3d::Zero();
  if (body.contains("center")) own = read_vector<3>(body["center"], path + ".center", " (metres)");
  if (by.contains("rotation")) {
    own = turn * own;
    if (body.contains("shape")) {
      const Eigen::Matrix3d shape =
          turn * read_matrix<3>(body["shape"], path + ".shape", " (square metres)") * turn.transpose();
      body["shape"] = matrix_of(0.5 * (shape + shape.transpose()));
    } else {
      body["rotation"] = matrix_of(turn * read_rotation(body, path));
    }
  }
  body["center"] = vector_of(place + own);
  return body;
}

/// The body with the margin beside its file's name, in addition to its own.
Json swollen(Json body, Json& by, const std::string& path) {
  if (!by.contains("margin")) return body;
  double margin = not_negative("m").read(by["margin"], join(path, "margin"));
  if (body.contains("margin")) margin += not_negative("m").read(body["margin"], join(path, "margin"));
  body["margin"] = margin;
  by.erase("margin");
  return body;
}

/// `files`: how many have been followed to come here.
Json without_files(Json body, const std::string& path, const Path& folder, int files) {
  if (!body.is_object() || !body.contains("file")) return body;
  const std::string name = file_fields().read(body, path), field = path.empty() ? "file" : path + ".file";
  if (files == kMostFiles)
    throw InputError(field, name, "a file that names " + std::to_string(kMostFiles) + " others at most");
  Json found = body_of_file(name, field, folder);
  follow_names(found, Path(name).parent_path());
  found = without_files(std::move(found), path, folder, files + 1);
  body.erase("file");
  found = swollen(std::move(found), body, path);
  return body.empty() ? found : moved(std::move(found), body, path);
}

}  // namespace

Json body_fields(const Json& value, const std::string& path, const Path& folder) {
  return without_files(value, path, folder, 0);
}

std::string remembered_fields(const Json& value, const std::string& path, const Path& folder) {
  Json fields = value;
  fields.erase("velocity");
  fields = body_fields(fields, path, folder);
  std::error_code gone;  // the current folder
  follow_names(fields, (std::filesystem::current_path(gone) / folder).lexically_normal());
  return fields.dump();
}

namespace {

/// One of the pieces of a union, in their common frame.
Body convex_part(const Json& piece, const std::string& path, const Path& folder) {
  if (!piece.contains("margin") && !is_pieces_body(piece)) return read_spatial_body(piece, path);
  if (!piece.contains("margin") && (piece.contains("hull") || piece.contains("points"))) {
    const SceneBody body = read_hull_agent(piece, path, folder);
    return within(path, [&] { return in_world(*body.hull(), body.placed.pose); });
  }
  const SceneBody body = read_body(piece, path, folder);
  const Pose& pose = body.placed.pose;
  if (body.hull()) return within(path, [&] { return in_world(*body.hull(), pose); });
  if (const Convex* convex = body.placed.body.convex())
    return within(path, [&] { return in_world(*convex, pose); });
  throw InputError(path, body.name, "a convex body: of a union each piece is one");
}

bool all_quadrics(const std::vector<Body>& parts) {
  return std::all_of(parts.begin(), parts.end(), [](const Body& part) { return part.quadric(); });
}

/// Ellipsoids and hulls alone stay what they are, which is faster.
Body union_of(const std::vector<Body>& parts) {
  std::vector<CombinedEllipsoid> quadrics;
  std::vector<HullBody> hulls;
  std::vector<Convex> convexes;
  for (const Body& part : parts) {
    if (part.quadric()) quadrics.push_back(*part.quadric());
    if (part.hull()) hulls.push_back(*part.hull());
    convexes.push_back(part.convex() ? *part.convex()
                       : part.hull() ? Convex::rounded(*part.hull(), 0)
                                     : Convex::rounded(part.quadric()->ellipsoid(), 0));
  }
  if (quadrics.size() == parts.size()) return Body::pieces(std::move(quadrics));
  if (hulls.size() == parts.size()) return Assembly::polyhedra(std::move(hulls));
  return Assembly::convexes(std::move(convexes));
}

}  // namespace

bool is_union(const Json& value) { return value.is_object() && value.contains("pieces"); }

Placed read_union(const Json& value, const std::string& path, const Path& folder) {
  union_fields().require_known(value, path);
  refuse_margin(value, path);
  const std::string field = path + ".pieces";
  Json list = value["pieces"];
  if (list.is_string()) {
    const std::string name = list.get<std::string>();
    Json found = body_of_file(name, field, folder);
    follow_names(found, Path(name).parent_path());
    list = found.contains("pieces") && found.size() == 1 ? found["pieces"] : Json::array({found});
  }
  if (!list.is_array() || list.empty())
    throw InputError(field, quoted(list), "a list of bodies, or the name of a file that has one");
  std::vector<Body> parts;
  for (std::size_t i = 0; i < list.size(); ++i) {
    require_object(list[i], at(field, i));
    // fit.json has what it knows of a piece around the body.
    const bool around = list[i].contains("body") && list[i]["body"].is_object();
    const Json piece = body_fields(around ? list[i]["body"] : list[i], at(field, i), folder);
    parts.push_back(convex_part(piece, at(field, i), folder));
  }
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!all_quadrics(parts) && parts[i].quadric() && !parts[i].quadric()->is_ellipsoid())
      throw InputError(at(field, i), quoted(list[i]),
                       "without hyperboloids: not all of the pieces are ellipsoids or have them");
  return {union_of(parts), union_fields().read(value, path).pose};
}

Json file_body_schema() { return file_fields().schema(); }
Json union_schema() { return union_fields().schema(); }

}  // namespace vericone::input
