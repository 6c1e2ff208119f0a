// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/fitting/hull.h>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <vericone/internal/fitting/solids.h>
#include "fit/robot_text.h"
#include "robot/robot.h"

namespace vericone {

/// A robot's file: its text, and the collisions of its links as they are read.
class RobotShapes {
 public:
  /// `packages`: NAME=FOLDER each. Throws InputError naming the file or "--package".
  RobotShapes(const std::string& file, const std::vector<std::string>& packages);

  struct Link {
    fit::LinkText text;
    const std::vector<robot::Geometry>* shapes = nullptr;  // as many as the text has
  };
  /// Those with collisions.
  [[nodiscard]] std::vector<Link> links() const;
  [[nodiscard]] bool is_urdf() const { return is_urdf_; }
  [[nodiscard]] const std::string& text() const { return text_; }

  /// The triangles of a mesh, placed in its link, to others.
  void add_mesh(const robot::Geometry& one, fitting::Sample& meshes) const;

 private:
  [[nodiscard]] std::filesystem::path path_of(const robot::MeshFile& mesh) const;

  std::string file_, text_;
  bool is_urdf_ = false;
  std::map<std::string, std::filesystem::path> packages_;
  robot::Robot robot_;
};

/// Equal points and triangles once, and no others.
fitting::Sample merged(fitting::Sample mesh);

/// A shape as the solid that it is, placed in its link; none where it is of another kind.
std::optional<fitting::Solid> solid_of(const robot::Geometry& one);

/// Points whose hull has a shape in it that is no mesh: of ellipses the corners around them, of balls cubes.
fitting::Sample corners_around(const robot::Geometry& one);

/// Whether a file's name says that it is a robot: .urdf, .sdf, .world, .xml.
bool is_robot_file(const std::string& file);

}  // namespace vericone
