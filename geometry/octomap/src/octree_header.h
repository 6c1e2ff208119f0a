// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/octomap/read_octree.h>

#include <string>

#include "source.h"

namespace vericone::octomap {

/// The deepest level of an OcTree.
constexpr int kDepth = 16;

struct OctreeHeader {
  std::string id;
  bool is_binary = false;  // .bt
  double resolution = 0;
  std::size_t nodes = 0;
  std::size_t size = 0;  // of the header in bytes
};

/// Reads the header and walks through the tree without building it, so that OctoMap is given sound trees
/// only: at the end of a file it goes on with what its variables happen to hold, and it has no limit of
/// depth.
OctreeHeader check_octree(const files::Source& source);

/// read_octree() of a file that is in memory.
Octree read_octree(const files::Source& source);

}  // namespace vericone::octomap
