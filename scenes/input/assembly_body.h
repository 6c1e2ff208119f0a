// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies of pieces: meshes, clouds and octree maps from files, convex hulls of points.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/body.h"

namespace vericone::input {

/// Whether the fields of a body say that it is made of pieces.
bool is_pieces_body(const Json& value);

/// A body given by mesh, cloud, octree, hull or points. A file that is used again in the same way is not read
/// again. Throws InputError with `path` before the field; the file's own error stands in the value.
SceneBody read_pieces_body(const Json& value, const std::string& path, const std::filesystem::path& folder);

/// A file as what it is, in its own coordinates: an octree map (.bt, .ot) with unknown space as `unknown`
/// says, a mesh where it has faces, a cloud otherwise, its balls of `radius` in parts of the largest side of
/// the points' bounds. Throws InputError naming the file.
SceneBody read_any_body(const std::filesystem::path& file, double radius, const std::string& unknown);

/// A convex polyhedron given by hull or points, with its pose. Throws InputError.
SceneBody read_hull_agent(const Json& value, const std::string& path, const std::filesystem::path& folder);

/// "mesh, cloud, octree, hull, points", without those that this build lacks.
std::string pieces_kinds();

/// All their fields but center and rotation.
std::vector<std::string_view> pieces_fields();

struct OctreePieces {
  Assembly boxes;
  scenes::Reading reading;
};

/// Which cells of a map are obstacles.
struct OctreeFields {
  bool unknown_occupied = true, free_occupied = false;
  double occupied_above = 0.5;
  std::optional<Box> region;
};

/// Whether this build reads octree maps.
bool have_octrees();

/// Those of the map `name`, which is `file`. Throws InputError naming the field within the body.
OctreePieces read_octree_pieces(const OctreeFields& fields, const std::string& name,
                                const std::filesystem::path& file, double scale);

}  // namespace vericone::input
