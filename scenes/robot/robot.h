// SPDX-License-Identifier: BSD-3-Clause
//
// Robots as URDF and SDF describe them: links with convex geometries and meshes, and the joints between them.
#pragma once

#include <vericone/geometry/convex.h>
#include <vericone/geometry/pose.h>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "robot/xml.h"

namespace vericone::robot {

/// A file of triangles, each coordinate times its scale.
struct MeshFile {
  std::string name;  // as written: relative, "file://...", "package://NAME/...", "model://NAME/..."
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  int line = 0;
  /// What it is relative to: the folder of an included file; empty: of the robot's own.
  std::filesystem::path folder = {};
};

/// One of a link's, where it stands in the link's frame: a convex body, what is behind a plane, or a mesh.
struct Geometry {
  Pose pose;
  std::optional<Convex> body;
  std::optional<Eigen::Vector3d> plane;  // through the pose's origin: its normal, of length 1
  MeshFile mesh;
};

struct Link {
  std::string name;
  std::vector<Geometry> geometries;
  /// In the model's frame with all joints at 0, where the file says that; URDF says it by joints alone.
  std::optional<Pose> rest;
};

/// The child's frame in the parent's is origin, moved by the joint's value along or about `axis`, then
/// `child_in`.
struct Joint {
  std::string name, type;
  std::size_t parent = 0, child = 0;  // links
  Pose origin, child_in;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // of length 1
  std::optional<double> lower, upper;               // rad, m
  struct Mimic {
    std::string joint;
    double multiplier = 1, offset = 0;
    int line = 0;
  };
  std::optional<Mimic> mimic;
  int line = 0;

  [[nodiscard]] bool turns() const { return type == "revolute" || type == "continuous"; }
  [[nodiscard]] bool moves() const { return turns() || type == "prismatic"; }
};

struct Robot {
  std::vector<Link> links;
  std::vector<Joint> joints;
};

enum class Shown { collision, visual };

/// A file that SDF includes, by its URI in that line.
struct IncludedFile {
  Element root;
  std::filesystem::path folder;
};
using Include = std::function<IncludedFile(const std::string& uri, int line)>;

// Throw InputErrors of refuse(), or naming "joints" or "links".

Robot read_urdf(const Element& root, Shown shown);
Robot read_sdf(const Element& root, Shown shown, const Include& include);
/// Whichever the outermost element says.
Robot read_robot(const Element& root, Shown shown, const Include& include);

/// Where each link stands with these values of the joints, rad and m; 0 of those left out. A root link stands
/// where its file says, or at the origin. Throws InputError naming "joints" or "joints.NAME": unknown, beyond
/// its limits (0 too), one that mimics another or does not move; links whose joints go round in a circle or
/// that have two parents.
std::vector<Pose> link_places(const Robot& robot, const std::map<std::string, double>& values);

// For the readers.

/// Numbers of an attribute or a text. Throws InputError of refuse().
std::vector<double> numbers(const std::string& text, std::size_t count, int line, const std::string& what);
template <int N>
Eigen::Matrix<double, N, 1> vector_of(const std::string& text, int line, const std::string& what) {
  const std::vector<double> x = numbers(text, N, line, what);
  return Eigen::Map<const Eigen::Matrix<double, N, 1>>(x.data());
}
/// About the fixed axes x, y, z in turn, radians.
Eigen::Matrix3d turn_of(const Eigen::Vector3d& roll_pitch_yaw);
/// The attribute, which has to be there.
const std::string& needed(const Element& element, const char* attribute);
/// The child, which has to be there.
const Element& needed_child(const Element& element, const char* child);
/// A size, 0 or more.
double size_of(const std::string& text, int line, const std::string& what);
Eigen::Vector3d unit_axis(const Eigen::Vector3d& axis, int line);

}  // namespace vericone::robot
