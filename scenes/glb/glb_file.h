// SPDX-License-Identifier: BSD-3-Clause
//
// Binary glTF 2.0 (GLB): bodies as triangles, points and lines, placed and moved, for any viewer of it. A
// picture: numbers are rounded to single precision, and what is proved stands in `extras`.
#pragma once

#include <vericone/geometry/pose.h>
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "json/json_value.h"

namespace vericone::glb {

/// Triangles with corners among the points, counter-clockwise seen from outside; without triangles and lines
/// the points themselves; with `line` a line through them. Metres.
struct Drawn {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool line = false;
};

struct Color {
  double red, green, blue;
  double alpha = 1;  // below 1 it shows what is behind it
};

/// The color of the i-th body of a picture; they repeat after eight.
Color color_of(std::size_t i);

/// One file. x, y and z are those of the project: a node turns them into glTF's, whose y is up. The same
/// calls give the same bytes.
class GlbFile {
 public:
  /// `extras`: of the asset, under the key "vericone".
  explicit GlbFile(Json extras);

  /// What is drawn, once; for nodes. Throws InputError naming "--glb" where a coordinate is no finite float.
  int mesh(const std::string& name, const Drawn& drawn, const Color& color);

  /// Something drawn where it stands. `extras` may be null.
  int node(const std::string& name, int mesh, const Pose& pose, const Json& extras = nullptr);

  /// How a node moves: its pose at each of the times (s, from 0 on, ascending), straight and by slerp in
  /// between. Times that are equal as floats are left out.
  void animate(int node, const std::vector<double>& times, const std::vector<Pose>& poses);

  /// The file. Requires a node.
  [[nodiscard]] std::string bytes() const;

 private:
  /// Numbers into the buffer: the index of their accessor. `width` numbers an element; 0: bounds are left
  /// out.
  int floats(const std::vector<float>& numbers, int width, bool bounds, int target);
  int indices(const Drawn& drawn);
  int view(const void* from, std::size_t size, int target);

  Json extras_;
  Json meshes_ = Json::array(), materials_ = Json::array(), nodes_ = Json::array();
  Json accessors_ = Json::array(), views_ = Json::array();
  Json samplers_ = Json::array(), channels_ = Json::array();
  std::string buffer_;
};

}  // namespace vericone::glb
