// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes from files: two bodies of any kinds, their velocities, and the pair they make
// (docs/reference/formats.md).
#pragma once

#include <vericone/cones/pair.h>
#include <vericone/geometry/body.h>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace vericone::scenes {

/// What reading a mesh, a cloud, a hull or a map found besides the body.
struct Reading {
  std::string format;  // "PLY, binary little endian"
  std::size_t dropped_points = 0, dropped_faces = 0;
  std::size_t unreferenced_points = 0;  // of a mesh
  std::size_t trailing_bytes = 0;       // after what the header claims (files.h)
  struct Map {
    double cell = 0;  // metres
    std::size_t nodes = 0;
    bool unknown_occupied = true;
    bool has_free = true;  // whether it says of any space that it is free
  };
  std::optional<Map> map = {};                 // of an octree map
  double seconds_read = 0, seconds_built = 0;  // s: the file; the tree of boxes
};

/// A body as a file gives it.
struct SceneBody {
  Placed placed{Body()};  // metres, world; of a planar scene raised (body.h)
  std::string name = {};  // "ellipsoid", "mesh of 69451 triangles (bunny.obj)", "union of 4 pieces"
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s
  /// Of meshes, clouds, maps and hulls: the field that gave it ("mesh", "cloud", "octree", "hull", "points")
  /// and the file's name as written, empty for points. Empty for others.
  std::string field = {}, file = {};
  std::optional<Reading> reading = {};  // of those from a file
  /// What its file says of it, as JSON with absolute names of files, for write_scene(); empty for a body that
  /// a program made.
  std::string fields = {};

  /// What it is, in its own frame: of each of these one is there, unless it is a union of quadrics. A
  /// combined quadric alone stands in the world already, without a pose.
  [[nodiscard]] const CombinedEllipsoid* quadric() const;
  [[nodiscard]] const Ellipsoid* ellipsoid() const;  // a quadric that nothing delimits
  [[nodiscard]] const HullBody* hull() const;
  [[nodiscard]] const Assembly* pieces() const;  // of a mesh, a cloud, a map, a union of hulls
};

/// Two bodies in the plane.
struct PlanarBodies {
  CombinedEllipse agent, obstacle;
};

struct Scene {
  SceneBody agent, obstacle;
  bool in_plane = false;                    // both are bodies of the plane, raised
  std::optional<PlanarBodies> planar = {};  // as the file gives them, where both are conics without margins

  /// Prepared; a planar scene's by its bodies raised. Cost: docs/measured/pairs.md.
  [[nodiscard]] Pair pair() const;
  /// w = v_agent - v_obstacle, m/s.
  [[nodiscard]] Eigen::Vector3d relative_velocity() const { return agent.velocity - obstacle.velocity; }
};

/// Reads a scene (YAML, of which JSON is a part), and the files it names, relative to its folder. Velocities
/// that are left out are zero. Throws InputError naming the file or the field, for example
/// "obstacle.semi_axes[1]". A file that is named again in the same way is not read again.
[[nodiscard]] Scene read_scene(const std::filesystem::path& file);

/// The same from text; `file` is named in errors.
[[nodiscard]] Scene scene_of_text(const std::string& text, const std::filesystem::path& file);

/// A spatial body: a file with a body's fields, or with what `vericone fit` wrote. Throws InputError naming
/// the file or the field.
[[nodiscard]] SceneBody read_body(const std::filesystem::path& file);

// Scenes and bodies to files (docs/reference/formats.md), so that reading gives the same to the bit.

/// Writes a scene that read_scene() reads as the same: the same bodies, poses and velocities, bit for bit. A
/// body that a file gave is written as that file gave it, with names of files relative to the new one's
/// folder. Others are written by their numbers: ellipsoids and hulls, a union of them; of a mesh or a cloud
/// the points stand beside the scene, in NAME-agent.ply and NAME-obstacle.ply.
///
/// What was written is read again first; nothing is written, or all. Throws InputError naming "agent" or
/// "obstacle" for a body made by a program that no fields give to the bit (one delimited by hyperboloids, an
/// ellipsoid that a pose moves, a map's boxes), and naming the path where it is no file's; std::system_error
/// where it cannot be written. Cost: that of reading it.
void write_scene(const Scene& scene, const std::filesystem::path& file);

/// The same of one body in space, for read_body(). Throws naming "body".
void write_body(const SceneBody& body, const std::filesystem::path& file);

}  // namespace vericone::scenes
