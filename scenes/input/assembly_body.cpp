// SPDX-License-Identifier: BSD-3-Clause
#include "input/assembly_body.h"

#include <sys/stat.h>
#include <vericone/files/files.h>
#include <cstdint>
#include <list>
#include <mutex>
#include <string_view>

#include "input/fields.h"
#include "input/octree_body.h"
#include "input/spatial_body.h"
#include "input/stopwatch.h"
#include "json/json_value.h"

namespace vericone::input {
namespace {

constexpr std::string_view kKinds[] = {"mesh", "cloud", "octree", "hull", "points"};
constexpr std::string_view kOctreeFields[] = {"unknown", "free", "occupied_above", "region"};

/// The field that says what the body is; exactly one, and no shape of an ellipsoid beside it.
std::string kind_of(const Json& value, const std::string& path) {
  std::string kind;
  int shapes = 0;
  for (const std::string_view k : kKinds)
    if (value.contains(k)) {
      kind = k;
      ++shapes;
    }
  for (const char* k : {"semi_axes", "shape", "quadric"}) shapes += value.contains(k);
  if (shapes != 1)
    throw InputError(path, "more than one shape",
                     "given by exactly one of semi_axes (with rotation), shape, quadric, " + pieces_kinds());
  return kind;
}

void require_fields_of(const std::string& kind, const Json& value, const std::string& path) {
  std::vector<std::string> known{kind, "center", "rotation", "scale"};
  if (kind == "cloud") known.emplace_back("radius");
  if (kind == "octree") known.insert(known.end(), std::begin(kOctreeFields), std::end(kOctreeFields));
  require_known(value, path, known);
}

Pose read_pose(const Json& value, const std::string& path) {
  Pose pose;
  if (value.contains("center"))
    pose.position = read_vector<3>(value["center"], path + ".center", " (metres)");
  pose.rotation = read_rotation(value, path);
  return pose;
}

double read_scale(const Json& value, const std::string& path) {
  if (!value.contains("scale")) return 1;
  const double scale = read_number(value["scale"], path + ".scale", "");
  if (!(scale > 0)) throw InputError(path + ".scale", to_text(scale), "positive");
  return scale;
}

double read_radius(const Json& value, const std::string& path) {
  const char* requirement = "the radius of the points' balls, metres, 0 or more";
  const double radius =
      read_number(require_field(value, path, "radius", requirement), path + ".radius", " (metres)");
  if (radius < 0) throw InputError(path + ".radius", to_text(radius), requirement);
  return radius;
}

struct File {
  std::string as_given;
  std::filesystem::path path;
};

File read_file_name(const Json& value, const std::string& path, const std::filesystem::path& folder) {
  if (!value.is_string() || value.get<std::string>().empty())
    throw InputError(path, quoted(value), "the name of a file, relative to the file that names it");
  const auto name = value.get<std::string>();
  return {name, folder / name};
}

/// `read()` with the field in front of an error about the file.
template <typename Read>
auto from_file(const std::string& field, const std::string& file, Read read) -> decltype(read()) {
  try {
    return read();
  } catch (const InputError& e) {
    throw InputError(field, file + ": " + e.value(), e.requirement());
  }
}

std::vector<Eigen::Vector3d> scaled(std::vector<Eigen::Vector3d> points, double scale) {
  if (scale != 1)
    for (Eigen::Vector3d& x : points) x *= scale;
  return points;
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

Pieces read_mesh_or_points(const std::string& kind, const File& file, const std::string& field, double scale,
                           double radius) {
  return from_points(file.path, scale, [&](files::PointFile& read) {
    if (kind == "cloud") return Assembly::cloud(std::move(read.points), radius);
    if (kind == "hull") return Assembly::polyhedra({HullBody(std::move(read.points))});
    if (read.faces.empty())
      throw InputError(field, std::to_string(read.points.size()) + " points and no face",
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

Pieces read_pieces(const std::string& kind, const Json& value, const std::string& path,
                   const std::filesystem::path& folder, std::string& file_name) {
  static Cache cache;
  const File file = read_file_name(value[kind], path + "." + kind, folder);
  file_name = file.as_given;
  const double scale = read_scale(value, path);
  const double radius = kind == "cloud" ? read_radius(value, path) : 0;
  // Everything that decides what is read, the place apart.
  Json options = value;
  options.erase("center");
  options.erase("rotation");
  options[kind] = std::filesystem::absolute(file.path).lexically_normal().string();
  options["version"] = version_of(file.path);
  const std::string field = path + "." + kind;
  return cache.get(options.dump(), [&]() -> Pieces {
    if (kind == "octree") {
      OctreePieces octree = read_octree_pieces(value, path, file.path, scale);
      return {std::move(octree.boxes), std::move(octree.reading)};
    }
    return from_file(field, file.as_given,
                     [&] { return read_mesh_or_points(kind, file, field, scale, radius); });
  });
}

std::vector<Eigen::Vector3d> read_point_list(const Json& value, const std::string& path) {
  if (!value.is_array() || value.empty())
    throw InputError(path, quoted(value), "a list of points [x, y, z] (metres)");
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < value.size(); ++i)
    points.push_back(read_vector<3>(value[i], at(path, i), " (metres)"));
  return points;
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

}  // namespace

std::string pieces_kinds() {
  std::string list;
  for (const std::string_view kind : kKinds)
    if (kind != "octree" || have_octrees()) list.append(list.empty() ? "" : ", ").append(kind);
  return list;
}

std::vector<std::string> pieces_fields() {
  std::vector<std::string> fields{std::begin(kKinds), std::end(kKinds)};
  fields.insert(fields.end(), {"radius", "scale"});
  fields.insert(fields.end(), std::begin(kOctreeFields), std::end(kOctreeFields));
  return fields;
}

bool is_pieces_body(const Json& value) {
  return value.is_object() && std::any_of(std::begin(kKinds), std::end(kKinds),
                                          [&](std::string_view kind) { return value.contains(kind); });
}

SceneBody read_pieces_body(const Json& value, const std::string& path, const std::filesystem::path& folder) {
  const std::string kind = kind_of(value, path);
  require_fields_of(kind, value, path);
  const Pose pose = read_pose(value, path);
  if (kind == "points") {
    auto points = scaled(read_point_list(value[kind], path + "." + kind), read_scale(value, path));
    return within(path, [&] {
      SceneBody body = body_of(kind, "", {Assembly::polyhedra({HullBody(std::move(points))}), {}}, pose);
      body.reading.reset();
      return body;
    });
  }
  std::string file;
  Pieces pieces = read_pieces(kind, value, path, folder, file);
  return body_of(kind, file, std::move(pieces), pose);
}

SceneBody read_any_body(const std::filesystem::path& file, double radius, const std::string& unknown) {
  const std::string name = file.filename().string(), extension = file.extension().string();
  if (extension == ".bt" || extension == ".ot") {
    OctreePieces octree = [&] {
      try {
        return read_octree_pieces({{"octree", name}, {"unknown", unknown}}, "", file, 1);
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
  const std::string kind = kind_of(value, path);
  if (kind != "hull" && kind != "points")
    throw InputError(path + "." + kind, quoted(value[kind]),
                     "left to the obstacle; an agent may be the convex hull of a file's points, hull");
  SceneBody body = read_pieces_body(value, path, folder);
  body.placed = Placed(body.pieces()->by_slot().hulls.front(), body.placed.pose);
  return body;
}

}  // namespace vericone::input
