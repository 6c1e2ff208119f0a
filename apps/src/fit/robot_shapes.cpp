// SPDX-License-Identifier: BSD-3-Clause
#include "fit/robot_shapes.h"

#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <utility>

#include "input/text_source.h"

namespace vericone {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

std::map<std::string, fs::path> packages_of(const std::vector<std::string>& given) {
  std::map<std::string, fs::path> packages;
  for (const std::string& one : given) {
    const std::size_t equals = one.find('=');
    if (equals == 0 || equals == std::string::npos) throw InputError("--package", one, "NAME=FOLDER");
    packages[one.substr(0, equals)] = one.substr(equals + 1);
  }
  return packages;
}

/// What is wrong in a line is wrong with the file.
template <typename Function>
auto of_file(const std::string& file, const Function& read) {
  try {
    return read();
  } catch (const InputError& e) {
    if (!e.field().starts_with("line ")) throw;
    throw InputError(file, e.field() + ": " + e.value(), e.requirement());
  }
}

}  // namespace

RobotShapes::RobotShapes(const std::string& file, const std::vector<std::string>& packages)
    : file_(file), packages_(packages_of(packages)) {
  text_ = input::TextSource(file, "a robot, URDF or SDF").whole();
  robot_ = of_file(file, [&] {
    const robot::Element root = robot::read_xml(file);
    is_urdf_ = root.name == "robot";
    const auto no_include = [](const std::string& uri, int line) -> robot::IncludedFile {
      robot::refuse(line, "<include> of " + uri,
                    "models that stand in the file: only those are written again");
    };
    return robot::read_robot(root, robot::Shown::collision, no_include);
  });
}

namespace {

/// What an attribute says that is written so.
std::string said(std::string written) {
  for (const auto& [entity, meant] :
       {std::pair("&lt;", "<"), std::pair("&gt;", ">"), std::pair("&quot;", "\""), std::pair("&apos;", "'"),
        std::pair("&amp;", "&")}) {
    const std::string from = entity;
    for (std::size_t at = 0; (at = written.find(from, at)) != std::string::npos; ++at)
      written.replace(at, from.size(), meant);
  }
  return written;
}

}  // namespace

std::vector<RobotShapes::Link> RobotShapes::links() const {
  std::vector<Link> links;
  for (fit::LinkText& text : fit::links_of(text_)) {
    // The reader leaves out the name of a model that is alone.
    const std::string name = said(text.name);
    const std::size_t colons = name.find("::");
    const std::string alone = colons == std::string::npos ? name : name.substr(colons + 2);
    const robot::Link* found = nullptr;
    for (const robot::Link& one : robot_.links)
      if (one.name == name || (one.name == alone && !found)) found = &one;
    if (!found || found->geometries.size() != text.collisions.size())
      throw InputError(file_, "a link " + text.name, "one that the reader of robots knows by that name");
    links.push_back({std::move(text), &found->geometries});
  }
  return links;
}

void RobotShapes::add_mesh(const robot::Geometry& one, fitting::Sample& meshes) const {
  of_file(file_, [&] {
    if (one.plane) robot::refuse(one.mesh.line, "<plane>", "left out: a fit is of what ends somewhere");
    try {
      const files::PointFile read = files::read_points(path_of(one.mesh));
      if (read.faces.empty()) robot::refuse(one.mesh.line, one.mesh.name + ", a cloud", "a mesh");
      const auto first = std::uint32_t(meshes.points.size());
      for (const Vector3d& x : read.points)
        meshes.points.push_back(one.pose.to_world(x.cwiseProduct(one.mesh.scale)));
      // What is mirrored is gone round the other way, so that it still looks outwards.
      const bool mirrors = one.mesh.scale.prod() < 0;
      for (auto t : files::triangles_of(read.points, read.faces)) {
        if (mirrors) std::swap(t[1], t[2]);
        meshes.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
      }
    } catch (const InputError& e) {
      if (e.field().starts_with("line ")) throw;
      robot::refuse(one.mesh.line, one.mesh.name + ": " + e.value(), e.requirement());
    }
  });
}

fs::path RobotShapes::path_of(const robot::MeshFile& mesh) const {
  const std::size_t at = mesh.name.find("://");
  if (at == std::string::npos)
    return (mesh.folder.empty() ? fs::path(file_).parent_path() : mesh.folder) / mesh.name;
  const std::string scheme = mesh.name.substr(0, at), rest = mesh.name.substr(at + 3);
  if (scheme == "file") return rest;
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  const auto package = packages_.find(rest.substr(0, slash));
  const fs::path within = fs::path(rest.substr(std::min(slash + 1, rest.size()))).lexically_normal();
  if (package == packages_.end())
    robot::refuse(mesh.line, mesh.name,
                  "of a package whose folder --package " + rest.substr(0, slash) + "=FOLDER says");
  if (within.empty() || within.is_absolute() || *within.begin() == "..")
    robot::refuse(mesh.line, mesh.name, "a file within its package");
  return package->second / within;
}

fitting::Sample merged(fitting::Sample mesh) {
  files::PointFile joined;
  joined.points = std::move(mesh.points);
  for (const auto& t : mesh.triangles) joined.faces.push_back({t[0], t[1], t[2]});
  files::TriangleMesh once =
      files::triangle_mesh(std::move(joined), {.merge_equal_points = true, .drop_duplicates = true});
  return {std::move(once.points), std::move(once.triangles)};
}

std::optional<fitting::Solid> solid_of(const robot::Geometry& one) {
  using fitting::SolidKind;
  if (!one.body) return std::nullopt;
  const Convex& body = *one.body;
  const Convex::Piece& first = body.pieces().front();
  const double length = 2 * std::abs(first.center.z());
  fitting::Solid solid{SolidKind::sphere, one.pose.position, one.pose.rotation, {body.margin(), 0, 0}};
  if (body.word() == "ball") return solid;
  if (body.word() == "capsule") {
    solid.kind = SolidKind::capsule;
    solid.sizes = {body.margin(), length, 0};
  } else if (body.word() == "cylinder") {
    solid.kind = SolidKind::cylinder;
    solid.sizes = {first.factor(0, 0), length, 0};
  } else if (body.word() == "box") {
    solid.kind = SolidKind::box;
    solid.sizes = first.center.cwiseAbs();
  } else if (body.word() == "ellipsoid" && body.margin() == 0) {
    solid.kind = SolidKind::ellipsoid;
    solid.sizes = first.factor.diagonal().cwiseAbs();
  } else {
    return std::nullopt;
  }
  return solid;
}

fitting::Sample corners_around(const robot::Geometry& one) {
  fitting::Sample points;
  const double r = one.body->margin();
  for (const Vector3d& x : one.body->corners())
    for (int corner = 0; corner < (r > 0 ? 8 : 1); ++corner)
      points.points.push_back(
          one.pose.to_world(x + r * Vector3d(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1)));
  return points;
}

bool is_robot_file(const std::string& file) {
  const std::string extension = fs::path(file).extension().string();
  return extension == ".urdf" || extension == ".sdf" || extension == ".world" || extension == ".xml";
}

}  // namespace vericone
