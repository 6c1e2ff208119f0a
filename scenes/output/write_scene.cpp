// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/files/extensions.h>
#include <vericone/scenes/scene.h>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "input/body.h"
#include "input/planar_body.h"
#include "input/scene.h"
#include "json/json_value.h"
#include "output/output_file.h"
#include "solids/convex_body.h"

namespace vericone::scenes {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

/// Bit for bit, as far as a body tells: -0 is 0 in every formula.
template <int D>
bool same(const BasicCombined<D>& a, const BasicCombined<D>& b) {
  const BasicEllipsoid<D>&e = a.ellipsoid(), &f = b.ellipsoid();
  if (e.center() != f.center() || e.defined_by_factor() != f.defined_by_factor() ||
      e.factor() != f.factor() || e.shape() != f.shape() || a.delimiters().size() != b.delimiters().size())
    return false;
  for (std::size_t i = 0; i < a.delimiters().size(); ++i)
    if (a.delimiters()[i].matrix != b.delimiters()[i].matrix ||
        a.delimiters()[i].level != b.delimiters()[i].level)
      return false;
  return true;
}

bool same(const Convex& a, const Convex& b) { return a.pieces() == b.pieces() && a.margin() == b.margin(); }

bool same(const Assembly& a, const Assembly& b) {
  const Assembly::Storage &x = a.by_slot(), &y = b.by_slot();
  const auto equal = [](const auto& p, const auto& q, const auto& one) {
    return std::equal(p.begin(), p.end(), q.begin(), q.end(), one);
  };
  return a.kind() == b.kind() && a.radius() == b.radius() && x.triangles == y.triangles &&
         x.balls == y.balls &&
         equal(x.boxes, y.boxes,
               [](const Box& p, const Box& q) { return p.low == q.low && p.high == q.high; }) &&
         equal(x.hulls, y.hulls,
               [](const HullBody& p, const HullBody& q) { return p.points() == q.points(); }) &&
         equal(x.convexes, y.convexes, [](const Convex& p, const Convex& q) { return same(p, q); });
}

/// A hull alone, which files give as an assembly of one; null for other bodies.
const HullBody* hull_of(const Body& body) {
  if (body.hull()) return body.hull();
  const Assembly* pieces = body.assembly();
  const bool alone = pieces && pieces->kind() == PieceKind::hull && pieces->size() == 1;
  return alone ? &pieces->by_slot().hulls.front() : nullptr;
}

bool same(const Placed& a, const Placed& b) {
  if (a.pose.position != b.pose.position || a.pose.rotation != b.pose.rotation) return false;
  if (const HullBody* p = hull_of(a.body), *q = hull_of(b.body); p && q) return p->points() == q->points();
  if (a.body.kind() != b.body.kind()) return false;
  if (a.body.quadric()) return same(*a.body.quadric(), *b.body.quadric());
  if (a.body.assembly()) return same(*a.body.assembly(), *b.body.assembly());
  if (a.body.convex()) return same(*a.body.convex(), *b.body.convex());
  const auto &p = *a.body.quadrics(), &q = *b.body.quadrics();
  return std::equal(p.begin(), p.end(), q.begin(), q.end(),
                    [](const CombinedEllipsoid& x, const CombinedEllipsoid& y) { return same(x, y); });
}

/// `f` as a unit vector times a length, whose products round to it; nothing where none near does.
template <int D>
std::optional<std::pair<Eigen::Matrix<double, D, 1>, double>> divided(const Eigen::Matrix<double, D, 1>& f) {
  constexpr int kLengths = 400;
  double shorter = f.norm(), longer = shorter;
  for (int k = 0; k < kLengths; ++k) {
    for (const double length : {shorter, longer}) {
      Eigen::Matrix<double, D, 1> unit;
      bool found = true;
      for (int i = 0; i < D && found; ++i) {
        const double near = f(i) / length;
        found = false;
        for (const double x : {near, std::nextafter(near, 2.0), std::nextafter(near, -2.0)})
          if (!found && x * length == f(i)) unit(i) = x, found = true;
      }
      if (found) return std::pair(unit, length);
    }
    shorter = std::nextafter(shorter, 0.0);
    longer = std::nextafter(longer, std::numeric_limits<double>::infinity());
  }
  return std::nullopt;
}

/// The fields of an ellipsoid; those of its axes where it is defined by them.
std::optional<Json> ellipsoid_fields(const Ellipsoid& body) {
  Json fields{{"center", vector_json(body.center())}};
  if (!body.defined_by_factor()) {
    fields["shape"] = matrix_json(body.shape());
    return fields;
  }
  Vector3d axes;
  Eigen::Matrix3d rotation;
  for (int j = 0; j < 3; ++j) {
    const auto column = divided<3>(body.factor().col(j));
    if (!column) return std::nullopt;
    rotation.col(j) = column->first;
    axes(j) = column->second;
  }
  fields["semi_axes"] = vector_json(axes);
  if (!rotation.isIdentity(0)) fields["rotation"] = matrix_json(rotation);
  return fields;
}

Json points_json(const std::vector<Vector3d>& points) {
  Json list = Json::array();
  for (const Vector3d& x : points) list.push_back(vector_json(x));
  return list;
}

void add_pose(Json& fields, const Pose& pose) {
  if (!pose.position.isZero(0)) fields["center"] = vector_json(pose.position);
  if (!pose.rotation.isIdentity(0)) fields["rotation"] = matrix_json(pose.rotation);
}

/// A file of points that stands beside a scene.
struct Beside {
  fs::path path;
  std::vector<Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The points of a mesh or a cloud in the order in which they came.
Beside beside(const Assembly& body, const fs::path& path) {
  Beside file{path, {}, {}};
  const auto& order = body.hierarchy().order();
  const Assembly::Storage& storage = body.by_slot();
  if (body.kind() == PieceKind::ball) {
    file.points.resize(order.size());
    for (std::size_t slot = 0; slot < order.size(); ++slot) file.points[order[slot]] = storage.balls[slot];
    return file;
  }
  file.points.resize(3 * order.size());
  for (std::size_t slot = 0; slot < order.size(); ++slot)
    for (std::size_t k = 0; k < 3; ++k) file.points[3 * order[slot] + k] = storage.triangles[slot][k];
  for (std::uint32_t i = 0; i < order.size(); ++i) file.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  return file;
}

/// Fields of a body by its numbers; nothing where there are none.
std::optional<Json> numbers_of(const Placed& placed, const fs::path& name, std::vector<Beside>& files) {
  const Body& body = placed.body;
  Json fields;
  if (body.quadric()) {
    if (!body.quadric()->is_ellipsoid()) return std::nullopt;
    return ellipsoid_fields(body.quadric()->ellipsoid());
  }
  if (body.quadrics()) {
    fields["pieces"] = Json::array();
    for (const CombinedEllipsoid& piece : *body.quadrics()) {
      const auto one = piece.is_ellipsoid() ? ellipsoid_fields(piece.ellipsoid()) : std::nullopt;
      if (!one) return std::nullopt;
      fields["pieces"].push_back(*one);
    }
  } else if (const Assembly* assembly = body.assembly()) {
    switch (assembly->kind()) {
      case PieceKind::box:
      case PieceKind::convex:
        return std::nullopt;
      case PieceKind::hull: {
        fields["pieces"] = Json::array();
        for (std::size_t i = 0; i < assembly->size(); ++i)
          fields["pieces"].push_back({{"points", points_json(assembly->piece(i).points())}});
        break;
      }
      case PieceKind::ball:
      case PieceKind::triangle:
        files.push_back(beside(*assembly, name));
        fields[assembly->kind() == PieceKind::ball ? "cloud" : "mesh"] = name.string();
        if (assembly->kind() == PieceKind::ball) fields["radius"] = assembly->radius();
    }
  } else if (const Convex* convex = body.convex()) {
    fields = input::word_fields(*convex);
    if (fields.is_null()) return std::nullopt;
  } else {
    fields["points"] = points_json(body.hull()->points());
  }
  add_pose(fields, placed.pose);
  return fields;
}

/// Names of files, as SceneBody::fields has them, as seen from a folder.
void name_from(Json& fields, const fs::path& folder) {
  const auto rename = [&](Json& name) {
    name = fs::path(name.get<std::string>()).lexically_proximate(folder).string();
  };
  for (const char* field : {"mesh", "cloud", "octree", "hull", "robot", "file", "pieces"})
    if (fields.contains(field) && fields[field].is_string()) rename(fields[field]);
  if (fields.contains("packages") && fields["packages"].is_object())
    for (Json& package : fields["packages"])
      if (package.is_string()) rename(package);
  if (fields.contains("pieces") && fields["pieces"].is_array())
    for (Json& piece : fields["pieces"])
      if (piece.is_object()) name_from(piece, folder);
}

std::optional<Json> remembered(const SceneBody& body, const fs::path& folder) {
  if (body.fields.empty()) return std::nullopt;
  Json fields = Json::parse(body.fields, nullptr, false);
  if (!fields.is_object()) return std::nullopt;
  name_from(fields, folder);
  return fields;
}

/// Whether reading gives this; what reading refuses does not.
template <typename Gives>
bool gives(const Gives& read) {
  try {
    return read();
  } catch (const InputError&) {
    return false;
  }
}

[[noreturn]] void refuse(const SceneBody& body, const std::string& name) {
  throw InputError(
      name, body.name.empty() ? to_string(body.placed.body.kind()) : body.name,
      "a body that a file gave, an ellipsoid without a pose (in_world() makes one), a hull, a mesh, a cloud, "
      "a union of ellipsoids or of hulls, or a cylinder, capsule, cone, frustum or disc of its own frame");
}

void write_all(const std::vector<Beside>& files, const fs::path& file, const Json& fields) {
  const fs::path partial = files::partial_path(file);
  std::error_code ignored;
  try {
    write_whole(partial, fields.dump(1) + "\n");
    for (const Beside& one : files)
      files::write_points(file.parent_path() / one.path, one.points, one.triangles);
    fs::rename(partial, file);
  } catch (...) {
    fs::remove(partial, ignored);
    throw;
  }
}

fs::path require_file(const fs::path& file) {
  if (file.filename().empty() || fs::is_directory(file))
    throw InputError("file", file.string(), "the path of a file");
  return fs::absolute(file).lexically_normal();
}

/// What a text of fields means to the reader, without the files that are still to be written.
Json with_points(Json fields, const std::vector<Beside>& files) {
  for (const Beside& file : files)
    for (const char* kind : {"mesh", "cloud"})
      if (fields.contains(kind) && fields[kind] == file.path.string()) {
        fields.erase(kind);
        fields.erase("radius");
        fields["points"] = Json::array({{0, 0, 0}});
      }
  return fields;
}

/// Of a body in space.
Json spatial_fields(const SceneBody& body, const std::string& name, const fs::path& file,
                    std::vector<Beside>& files) {
  const fs::path folder = file.parent_path();
  if (const auto fields = remembered(body, folder);
      fields && gives([&] { return same(input::read_body(*fields, name, folder).placed, body.placed); }))
    return *fields;
  std::vector<Beside> own;
  const auto fields = numbers_of(body.placed, file.stem().string() + "-" + name + ".ply", own);
  // The numbers of points are written as they are; the pose is what might be rounded.
  const auto is_same = [&] {
    const Placed read = input::read_body(with_points(*fields, own), name, folder).placed;
    return own.empty() ? same(read, body.placed)
                       : read.pose.position == body.placed.pose.position &&
                             read.pose.rotation == body.placed.pose.rotation;
  };
  if (!fields || !gives(is_same)) refuse(body, name);
  files.insert(files.end(), own.begin(), own.end());
  return *fields;
}

/// Of a polygon, a stadium or one with a margin: only a file's own fields give it.
Json flat_fields(const SceneBody& body, const std::string& name, const fs::path& file) {
  const auto fields = remembered(body, file.parent_path());
  if (!fields) refuse(body, name);
  return *fields;
}

/// Of a body in the plane.
Json planar_fields(const SceneBody& body, const CombinedEllipse& flat, const std::string& name,
                   const fs::path& file) {
  std::vector<Json> tried;
  if (const auto fields = remembered(body, file.parent_path())) tried.push_back(*fields);
  const Ellipse& ellipse = flat.ellipsoid();
  Json fields{{"center", vector_json(ellipse.center())}};
  if (ellipse.defined_by_factor()) {
    const Eigen::Matrix2d& f = ellipse.factor();
    fields["semi_axes"] = {f.col(0).norm(), f.col(1).norm()};
    if (f(1, 0) != 0) fields["rotation"] = std::atan2(f(1, 0), f(0, 0));
  } else {
    fields["shape"] = matrix_json(ellipse.shape());
  }
  tried.push_back(fields);
  for (const Json& one : tried)
    if (gives([&] { return same(input::read_planar_body(one, name), flat); })) return one;
  refuse(body, name);
}

}  // namespace

void write_scene(const Scene& scene, const fs::path& given) {
  const fs::path file = require_file(given);
  std::vector<Beside> files;
  Json fields;
  if (scene.planar) {
    fields["agent"] = planar_fields(scene.agent, scene.planar->agent, "agent", file);
    fields["obstacle"] = planar_fields(scene.obstacle, scene.planar->obstacle, "obstacle", file);
  } else if (scene.in_plane) {
    fields["agent"] = flat_fields(scene.agent, "agent", file);
    fields["obstacle"] = flat_fields(scene.obstacle, "obstacle", file);
  } else {
    fields["agent"] = spatial_fields(scene.agent, "agent", file, files);
    fields["obstacle"] = spatial_fields(scene.obstacle, "obstacle", file, files);
  }
  if (scene.in_plane) {
    fields["agent_velocity"] = vector_json(scene.agent.velocity.head<2>());
    fields["obstacle_velocity"] = vector_json(scene.obstacle.velocity.head<2>());
  } else {
    fields["agent_velocity"] = vector_json(scene.agent.velocity);
    fields["obstacle_velocity"] = vector_json(scene.obstacle.velocity);
  }
  if (files.empty()) {
    // As a whole: a hull before pieces is taken into the world.
    const Scene read = scene_of_text(fields.dump(1), file);
    if (!same(read.agent.placed, scene.agent.placed)) refuse(scene.agent, "agent");
    if (!same(read.obstacle.placed, scene.obstacle.placed)) refuse(scene.obstacle, "obstacle");
  }
  write_all(files, file, fields);
}

void write_body(const SceneBody& body, const fs::path& given) {
  const fs::path file = require_file(given);
  std::vector<Beside> files;
  const Json fields = spatial_fields(body, "body", file, files);
  write_all(files, file, fields);
}

}  // namespace vericone::scenes
