// SPDX-License-Identifier: BSD-3-Clause
//
// The text of a robot (URDF, SDF) with other collisions: all other bytes stay as they are.
#pragma once

#include <vericone/internal/fitting/solids.h>
#include <cstddef>
#include <string>
#include <vector>

namespace vericone::fit {

/// A <collision> as it stands in the text, from `begin` to before `end`.
struct CollisionText {
  std::string name;  // its attribute; empty where it has none
  std::size_t begin = 0, end = 0;
  std::string properties;  // its children but name, pose, origin and geometry, as they stand
};

/// A link that has collisions, in the order of the text.
struct LinkText {
  std::string name;  // of SDF with its models: "model::link"
  std::vector<CollisionText> collisions;
};

/// Of a text that the reader of robots took: its outermost element is <robot> or <sdf>.
std::vector<LinkText> links_of(const std::string& text);

/// Which collisions of a link go, by their numbers, and what comes in place of the first of them.
struct Replacement {
  LinkText link;
  std::vector<std::size_t> gone;
  std::vector<fitting::Solid> solids;  // in the link's frame, rotations by turn_of(angles_of())
};

/// What a format has no word for throws InputError naming "--kinds".
std::string with_collisions(const std::string& text, bool urdf, const std::vector<Replacement>& replacements);

/// Roll, pitch and yaw (about the fixed axes x, y, z) of a rotation, radians.
Eigen::Vector3d angles_of(const Eigen::Matrix3d& rotation);

}  // namespace vericone::fit
