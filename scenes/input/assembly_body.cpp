// SPDX-License-Identifier: BSD-3-Clause
#include "input/assembly_body.h"

#include <sys/stat.h>
#include <vericone/files/files.h>
#include <algorithm>
#include <cstdint>
#include <list>
#include <mutex>
#include <string_view>

#include "input/body_kind.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "robot/robot_body.h"
#include "solids/convex_body.h"
#include "solids/slab_body.h"

namespace vericone::input {
namespace {

struct PiecesFields : PlaceFields {
  std::string file;
  std::vector<Eigen::Vector3d> points;
  double scale = 1, radius = 0;
  OctreeFields map;
};

/// The field that says what the body is; exactly one, and no shape of an ellipsoid beside it.
const BodyKind& kind_of(const Json& value, const std::string& path) {
  const BodyKind* found = nullptr;
  int shapes = 0;
  for (const BodyKind& kind : body_kinds())
    if (value.contains(kind.name)) {
      found = &kind;
      ++shapes;
    }
  for (const char* k : {"semi_axes", "shape", "quadric"}) shapes += value.contains(k);
  if (shapes != 1)
    throw InputError(path, "more than one shape",
                     "given by exactly one of semi_axes (with rotation), shape, quadric, " + pieces_kinds());
  return *found;
}

struct Pieces {
  Assembly assembly;
  scenes::Reading reading;
};

/// `make` a body of what is in a file.
template <typename Make>
Pieces from_points(const std::filesystem::path& path, double scale, Make make) {
  const auto start = Clock::now();
  files::PointFile read = files::read_points(path);
  scenes::Reading reading{read.format, read.dropped_points, read.dropped_faces};
  if (!read.faces.empty()) reading.unreferenced_points = read.unreferenced_points;
  reading.trailing_bytes = read.trailing_bytes;
  reading.seconds_read = seconds_since(start);
  if (scale != 1)
    for (Eigen::Vector3d& x : read.points) x *= scale;
  const auto built = Clock::now();
  Assembly pieces = make(read);
  reading.seconds_built = seconds_since(built);
  return {std::move(pieces), std::move(reading)};
}

Assembly mesh_of(files::PointFile& file) {
  auto triangles = files::triangles_of(file.points, file.faces);
  return Assembly::mesh(std::move(file.points), std::move(triangles));
}

Pieces read_mesh_or_points(const std::string& kind, const PiecesFields& fields,
                           const std::filesystem::path& file) {
  return from_points(file, fields.scale, [&](files::PointFile& read) {
    if (kind == "cloud") return Assembly::cloud(std::move(read.points), fields.radius);
    if (kind == "hull") return Assembly::polyhedra({HullBody(std::move(read.points))});
    if (read.faces.empty())
      throw InputError(kind, std::to_string(read.points.size()) + " points and no face",
                       "a mesh; points are given by cloud, with a radius");
    return mesh_of(read);
  });
}

double largest_side(const std::vector<Eigen::Vector3d>& points) {
  Box bounds{points.front(), points.front()};
  for (const Eigen::Vector3d& x : points) bounds.include({x, x});
  return 2 * bounds.half_widths().maxCoeff();
}

/// The bodies read last; whoever asks again gets a share of the same pieces. Others wait while one is read.
class Cache {
 public:
  template <typename Read>
  Pieces get(const std::string& key, Read read) {
    const std::lock_guard lock(mutex_);
    for (auto it = kept_.begin(); it != kept_.end(); ++it)
      if (it->first == key) {
        kept_.splice(kept_.begin(), kept_, it);
        return kept_.front().second;
      }
    kept_.emplace_front(key, read());
    if (kept_.size() > kMost) kept_.pop_back();
    return kept_.front().second;
  }

 private:
  static constexpr std::size_t kMost = 16;
  std::mutex mutex_;
  std::list<std::pair<std::string, Pieces>> kept_;
};

/// Another one when the file was written again, under the same name.
std::string version_of(const std::filesystem::path& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) return "";
  std::string text;
  for (const auto part :
       {std::uint64_t(about.st_ino), std::uint64_t(about.st_size), std::uint64_t(about.st_mtim.tv_sec),
        std::uint64_t(about.st_mtim.tv_nsec), std::uint64_t(about.st_ctim.tv_nsec)})
    text += std::to_string(part) + " ";
  return text;
}

/// Everything that decides what is read, the place apart.
std::string key_of(const std::string& kind, const PiecesFields& fields, const std::filesystem::path& file) {
  const OctreeFields& map = fields.map;
  std::vector<double> numbers{fields.scale, fields.radius, double(map.unknown_occupied),
                              double(map.free_occupied), map.occupied_above};
  if (map.region)
    for (const Eigen::Vector3d& corner : {map.region->low, map.region->high})
      numbers.insert(numbers.end(), corner.begin(), corner.end());
  std::string key = kind + " " + version_of(file);
  for (const double x : numbers) key += to_text(x) + " ";
  return key + std::filesystem::absolute(file).lexically_normal().string();
}

Pieces read_pieces(const std::string& kind, const PiecesFields& fields, const std::filesystem::path& folder) {
  static Cache cache;
  const std::filesystem::path file = folder / fields.file;
  return cache.get(key_of(kind, fields, file), [&]() -> Pieces {
    if (kind == "octree") {
      OctreePieces octree = read_octree_pieces(fields.map, fields.file, file, fields.scale);
      return {std::move(octree.boxes), std::move(octree.reading)};
    }
    try {
      return read_mesh_or_points(kind, fields, file);
    } catch (const InputError& e) {
      throw InputError(kind, fields.file + ": " + e.value(), e.requirement());
    }
  });
}

const char* plural(PieceKind kind) {
  switch (kind) {
    case PieceKind::triangle:
      return "triangles";
    case PieceKind::ball:
      return "balls";
    case PieceKind::box:
      return "boxes";
    case PieceKind::hull:
      return "hull";
    case PieceKind::convex:
      return "convex bodies";
  }
  return "";
}

std::string described(const std::string& field, const std::string& file, const Assembly& pieces) {
  std::string text = field == "points" ? "hull" : field;
  if (pieces.kind() == PieceKind::hull) {
    text += " of " + std::to_string(pieces.by_slot().hulls.front().size()) + " points";
  } else {
    text += " of " + std::to_string(pieces.size()) + " " + plural(pieces.kind());
  }
  return file.empty() ? text : text + " (" + std::filesystem::path(file).filename().string() + ")";
}

SceneBody body_of(const std::string& field, const std::string& file, Pieces pieces, const Pose& pose) {
  SceneBody body{Placed(pieces.assembly, pose), described(field, file, pieces.assembly)};
  body.field = field;
  body.file = file;
  body.reading = std::move(pieces.reading);
  return body;
}

/// The kind NAME, whose pieces stand in a file.
BodyKind of_file(const char* name, const Fields<PiecesFields>& fields) {
  return body_kind(fields, [name](const PiecesFields& read, const std::filesystem::path& folder) {
    return body_of(name, read.file, read_pieces(name, read, folder), read.pose);
  });
}

Value<double> scale() {
  return shown_as(checked<double>(number(), "positive", [](const double& x) { return x > 0; }),
                  positive().schema);
}

Fields<PiecesFields> file_rows(const char* name, const char* sentence) {
  Fields<PiecesFields> rows("body");
  return with_place(rows.row(name, &PiecesFields::file, file_name(), sentence, alternative()))
      .row("scale", &PiecesFields::scale, scale(),
           "Multiplies the file's coordinates (0.001 for millimetres), rounded once.");
}

BodyKind cloud() {
  const char* what = "the radius of the points' balls, metres, 0 or more";
  return of_file("cloud",
                 file_rows("cloud", "File of points (a mesh counts by its points): a ball about each.")
                     .row("radius", &PiecesFields::radius,
                          shown_as(checked<double>(number("m"), what, [](const double& x) { return x >= 0; }),
                                   not_negative().schema),
                          "Of a cloud's balls; 0 means the points alone. Required with `cloud`, and only "
                          "there. `scale` does not change it.",
                          required(what)));
}

Value<bool> occupied() {
  return {[](const Json& value, const std::string& path) {
            if (value != "occupied" && value != "free")
              throw InputError(path, quoted(value), "\"occupied\" or \"free\"");
            return value == "occupied";
          },
          Json{{"enum", {"occupied", "free"}}},
          [](const bool& occupied) { return Json(occupied ? "occupied" : "free"); }};
}

Box read_region(const Json& value, const std::string& path) {
  if (!value.is_array() || value.size() != 2)
    throw InputError(path, quoted(value),
                     "two opposite corners [[x, y, z], [x, y, z]] (metres, of the file)");
  const Box region{read_vector<3>(value[0], at(path, 0), " (metres)"),
                   read_vector<3>(value[1], at(path, 1), " (metres)")};
  if (!(region.low.array() < region.high.array()).all())
    throw InputError(path, quoted(value), "the lower corner, then the upper one, each coordinate larger");
  return region;
}

BodyKind octree() {
  const auto of = [](auto OctreeFields::*member) { return within_part(&PiecesFields::map, member); };
  const auto above = checked<double>(number(), "a probability between 0 and 1, both excluded",
                                     [](const double& p) { return p > 0 && p < 1; });
  return of_file("octree",
                 file_rows("octree", "OctoMap's .bt or .ot: solid cells.")
                     .row("unknown", of(&OctreeFields::unknown_occupied), occupied(),
                          "What space is that was never seen.")
                     .row("free", of(&OctreeFields::free_occupied), occupied(),
                          "What space is that was seen to be free.")
                     .row("occupied_above", of(&OctreeFields::occupied_above),
                          shown_as(above, {{"type", "number"}, {"minimum", 0}, {"maximum", 1}}),
                          "A cell is occupied from this probability on. A .bt file has no probabilities: its "
                          "writer decided.")
                     .row("region", of(&OctreeFields::region),
                          Value<Box>{read_region,
                                     Json{{"type", "array"},
                                          {"items", {{"$ref", "body.schema.json#/$defs/quantities3"}}},
                                          {"minItems", 2},
                                          {"maxItems", 2},
                                          {"title", "two [x, y, z]"},
                                          {"unit", "m"}},
                                     {}},
                          "Lower and upper corner, in the file's coordinates: the box in which unknown space "
                          "counts. **Beyond it nothing is an obstacle.**",
                          absent("the box around all known cells")));
}

BodyKind hull_of_points() {
  Fields<PiecesFields> rows("body");
  rows.row("points", &PiecesFields::points, list("points [x, y, z] (metres)", vector<3>("m"), 1),
           "The solid convex hull of these points.", alternative());
  with_place(rows).row("scale", &PiecesFields::scale, scale(), "Multiplies the coordinates.");
  return body_kind(rows, [](const PiecesFields& read, const std::filesystem::path&) {
    std::vector<Eigen::Vector3d> points = read.points;
    for (Eigen::Vector3d& x : points) x *= read.scale;
    SceneBody body =
        body_of("points", "", {Assembly::polyhedra({HullBody(std::move(points))}), {}}, read.pose);
    body.reading.reset();
    return body;
  });
}

}  // namespace

const std::vector<BodyKind>& body_kinds() {
  static const std::vector<BodyKind> kinds = [] {
    std::vector<BodyKind> all{
        of_file(
            "mesh",
            file_rows(
                "mesh",
                "File with faces. The body is its **surface**, closed or open: an agent within a closed mesh "
                "is "
                "`disjoint` from it, as in a room. Polygons are cut into triangles, dented ones by their "
                "ears "
                "([files](files.md)). Points that belong to no face are left out.")),
        cloud(), octree(), of_file("hull", file_rows("hull", "File of points: their solid convex hull.")),
        hull_of_points()};
    for (BodyKind& kind : convex_kinds()) all.push_back(std::move(kind));
    for (BodyKind& kind : slab_kinds()) all.push_back(std::move(kind));
    all.push_back(robot_kind());
    return all;
  }();
  return kinds;
}

std::string pieces_kinds() {
  std::string list;
  for (const BodyKind& kind : body_kinds())
    if (kind.name != "octree" || have_octrees()) list.append(list.empty() ? "" : ", ").append(kind.name);
  return list;
}

std::vector<std::string_view> pieces_fields() {
  std::vector<std::string_view> fields;
  for (const BodyKind& kind : body_kinds()) fields.emplace_back(kind.name);
  for (const BodyKind& kind : body_kinds())
    for (const std::string_view field : kind.fields)
      if (field != "center" && field != "rotation" && field != "margin" &&
          std::find(fields.begin(), fields.end(), field) == fields.end())
        fields.push_back(field);
  return fields;
}

bool is_pieces_body(const Json& value) {
  return value.is_object() && std::any_of(body_kinds().begin(), body_kinds().end(),
                                          [&](const BodyKind& kind) { return value.contains(kind.name); });
}

SceneBody read_pieces_body(const Json& value, const std::string& path, const std::filesystem::path& folder) {
  const BodyKind& kind = kind_of(value, path);
  refuse_margin(value, path);
  return kind.read(value, path, folder);
}

SceneBody read_any_body(const std::filesystem::path& file, double radius, const std::string& unknown) {
  const std::string name = file.filename().string(), extension = file.extension().string();
  if (extension == ".bt" || extension == ".ot") {
    OctreePieces octree = [&] {
      try {
        return read_octree_pieces({unknown == "occupied", false, 0.5, {}}, name, file, 1);
      } catch (const InputError& e) {
        throw InputError(file.string(), e.value(), e.requirement());
      }
    }();
    return body_of("octree", name, {std::move(octree.boxes), std::move(octree.reading)}, {});
  }
  std::string kind = "mesh";
  Pieces pieces = from_points(file, 1, [&](files::PointFile& read) {
    if (!read.faces.empty()) return mesh_of(read);
    kind = "cloud";
    const double size = largest_side(read.points);
    return Assembly::cloud(std::move(read.points), radius * size);
  });
  return body_of(kind, name, std::move(pieces), {});
}

SceneBody read_hull_agent(const Json& value, const std::string& path, const std::filesystem::path& folder) {
  const std::string& kind = kind_of(value, path).name;
  if (kind != "hull" && kind != "points")
    throw InputError(path + "." + kind, quoted(value[kind]),
                     "left to the obstacle; an agent may be the convex hull of a file's points, hull");
  SceneBody body = read_pieces_body(value, path, folder);
  body.placed = Placed(body.pieces()->by_slot().hulls.front(), body.placed.pose);
  return body;
}

}  // namespace vericone::input
