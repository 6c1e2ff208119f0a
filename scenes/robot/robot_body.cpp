// SPDX-License-Identifier: BSD-3-Clause
#include "robot/robot_body.h"

#include <vericone/cones/slab.h>
#include <vericone/files/files.h>
#include <algorithm>
#include <map>

#include "json/json_value.h"
#include "robot/robot.h"

namespace vericone::input {
namespace {

using Eigen::Vector3d;
using robot::Robot, robot::Shown;

struct RobotFields : PlaceFields {
  std::string file;
  std::map<std::string, double> joints;
  std::map<std::string, std::string> packages;
  std::vector<std::string> links;
  std::optional<double> extent;
  Shown shown = Shown::collision;
};

/// A mapping of names.
template <typename T>
Value<std::map<std::string, T>> by_name(const char* what, const Value<T>& one) {
  return {[what, read = one.read](const Json& value, const std::string& path) {
            if (!value.is_object()) throw InputError(path, quoted(value), what);
            std::map<std::string, T> all;
            for (const auto& [name, given] : value.items()) all[name] = read(given, join(path, name.c_str()));
            return all;
          },
          Json{{"type", "object"}, {"additionalProperties", one.schema}, {"title", what}},
          {}};
}

/// Triangles of one mesh file, read once.
using Mesh = std::vector<std::array<Vector3d, 3>>;

class RobotPieces {
 public:
  RobotPieces(const RobotFields& fields, const std::filesystem::path& folder)
      : fields_(fields), folder_(folder), file_(folder / fields.file) {}

  Assembly read(std::size_t& links) {
    const auto include = [this](const std::string& uri, int line) { return included(uri, line); };
    const Robot read = robot::read_robot(robot::read_xml(file_), fields_.shown, include);
    const std::vector<Pose> places = robot::link_places(read, fields_.joints);
    for (const std::string& name : fields_.links)
      if (std::none_of(read.links.begin(), read.links.end(),
                       [&](const auto& link) { return link.name == name; }))
        throw InputError("links", name, "names of links of the robot");
    for (std::size_t i = 0; i < read.links.size(); ++i) {
      const robot::Link& link = read.links[i];
      const bool wanted = fields_.links.empty() || std::find(fields_.links.begin(), fields_.links.end(),
                                                             link.name) != fields_.links.end();
      if (!wanted || link.geometries.empty()) continue;
      ++links;
      for (const robot::Geometry& one : link.geometries) add(one, places[i]);
    }
    return whole();
  }

 private:
  static constexpr std::size_t kMostTriangles = 200'000;

  void add(const robot::Geometry& one, const Pose& link) {
    const Pose pose = composed(link, one.pose);
    if (one.body) {
      convexes_.push_back(in_world(*one.body, pose));
      return;
    }
    if (one.plane) {
      if (!fields_.extent)
        throw InputError(
            "extent", "nothing",
            "given beside a <plane>, metres: how far from its origin the ground behind it counts");
      const HullBody ground = clipped({*one.plane}, Vector3d::Zero(), *fields_.extent);
      convexes_.push_back(in_world(Convex::rounded(ground, 0), pose));
      return;
    }
    // What is mirrored is gone round the other way, so that it still looks outwards.
    const bool mirrors = one.mesh.scale.prod() < 0;
    for (const auto& triangle : mesh(one.mesh)) {
      auto& corners = triangles_.emplace_back();
      for (std::size_t k = 0; k < 3; ++k)
        corners[mirrors ? 2 - k : k] = pose.to_world(triangle[k].cwiseProduct(one.mesh.scale));
    }
    if (triangles_.size() > kMostTriangles)
      robot::refuse(one.mesh.line, "more triangles", "at most " + std::to_string(kMostTriangles) + " in all");
  }

  const Mesh& mesh(const robot::MeshFile& named) {
    const std::filesystem::path path =
        path_of(named.name, named.line, named.folder.empty() ? file_.parent_path() : named.folder);
    const auto [found, is_new] = meshes_.try_emplace(path);
    if (!is_new) return found->second;
    try {
      const files::PointFile read = files::read_points(path);
      if (read.faces.empty()) robot::refuse(named.line, named.name + ", a cloud", "a mesh");
      for (const auto& triangle : files::triangles_of(read.points, read.faces))
        found->second.push_back(
            {read.points[triangle[0]], read.points[triangle[1]], read.points[triangle[2]]});
    } catch (const InputError& e) {
      if (e.field().starts_with("line ")) throw;
      robot::refuse(named.line, named.name + ": " + e.value(), e.requirement());
    }
    return found->second;
  }

  /// Beside the folder, or in a package of `packages`.
  std::filesystem::path path_of(const std::string& name, int line,
                                const std::filesystem::path& beside) const {
    const std::size_t at = name.find("://");
    if (at == std::string::npos) return beside / name;
    const std::string scheme = name.substr(0, at), rest = name.substr(at + 3);
    if (scheme == "file") return rest;
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const auto package = fields_.packages.find(rest.substr(0, slash));
    if ((scheme != "package" && scheme != "model") || slash == 0)
      robot::refuse(line, name, "a file's name, or package://NAME/..., model://NAME/... or file://...");
    if (package == fields_.packages.end())
      robot::refuse(line, name,
                    "of a package whose folder `packages` names: {" + rest.substr(0, slash) + ": FOLDER}");
    const auto within =
        std::filesystem::path(rest.substr(std::min(slash + 1, rest.size()))).lexically_normal();
    if (within.is_absolute() || (!within.empty() && *within.begin() == ".."))
      robot::refuse(line, name, "a file within its package");
    return folder_ / package->second / within;
  }

  /// A model's file, or the model.sdf of its folder.
  robot::IncludedFile included(const std::string& uri, int line) const {
    std::filesystem::path path = path_of(uri, line, file_.parent_path());
    if (std::filesystem::is_directory(path)) path /= "model.sdf";
    try {
      return {robot::read_xml(path), path.parent_path()};
    } catch (const InputError& e) {
      const bool in_file = e.field().starts_with("line ");
      robot::refuse(line, uri + (in_file ? ", " + e.field() + ": " : ": ") + e.value(), e.requirement());
    }
  }

  /// A surface alone is a mesh; beside convex bodies each triangle is one.
  Assembly whole() {
    if (convexes_.empty() && triangles_.empty())
      throw InputError("geometry", "no shape of any link",
                       "visual or collision, whichever the links have; and links that have some");
    if (convexes_.empty()) {
      std::vector<Vector3d> points;
      std::vector<Assembly::Triangle> faces;
      for (const auto& corners : triangles_) {
        const auto first = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(), corners.begin(), corners.end());
        faces.push_back({first, first + 1, first + 2});
      }
      return Assembly::mesh(std::move(points), std::move(faces));
    }
    for (const auto& corners : triangles_)
      convexes_.push_back(Convex::rounded(HullBody({corners.begin(), corners.end()}), 0));
    return Assembly::convexes(std::move(convexes_));
  }

  const RobotFields& fields_;
  std::filesystem::path folder_, file_;
  std::map<std::filesystem::path, Mesh> meshes_;
  std::vector<Convex> convexes_;
  Mesh triangles_;
};

SceneBody robot_of(const RobotFields& fields, const std::filesystem::path& folder) {
  std::size_t links = 0;
  try {
    const Assembly pieces = RobotPieces(fields, folder).read(links);
    const std::string count = std::to_string(links) + (links == 1 ? " link" : " links");
    return {Placed(pieces, fields.pose), "robot of " + count + ", " + std::to_string(pieces.size()) +
                                             " pieces (" +
                                             std::filesystem::path(fields.file).filename().string() + ")"};
  } catch (const InputError& e) {
    for (const char* own : {"joints", "links", "geometry", "extent"})
      if (e.field().starts_with(own)) throw;
    const bool line = e.field().starts_with("line ");
    throw InputError("robot", fields.file + (line ? ", " + e.field() : "") + ": " + e.value(),
                     e.requirement());
  }
}

}  // namespace

BodyKind robot_kind() {
  using R = RobotFields;
  Fields<R> rows("body");
  rows.row("robot", &R::file, file_name(),
           "URDF or SDF: all its links as one body, their shapes placed by its joints "
           "([files](files.md#robots)).",
           alternative())
      .row("joints", &R::joints, by_name<double>("values of joints by their names", number("rad, m")),
           "Of joints that turn, radians; of those that slide, metres.", absent("each 0"))
      .row("geometry", &R::shown, choice<Shown>({{"collision", Shown::collision}, {"visual", Shown::visual}}),
           "Which shapes of the links.")
      .row("links", &R::links, list("names of links", text("the name of a link")), "These alone.",
           absent("all"))
      .row("extent", &R::extent, positive("m"),
           "Of SDF's planes, which are half-spaces: the part that counts, as of a `half_space`.",
           absent("a plane is refused"))
      .row("packages", &R::packages, by_name<std::string>("folders by the names of packages", file_name()),
           "Where `package://NAME/...` and `model://NAME/...` are, relative to the file that says so.",
           absent("none"));
  with_place(rows);
  return body_kind(rows, robot_of);
}

}  // namespace vericone::input
