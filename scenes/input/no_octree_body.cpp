// SPDX-License-Identifier: BSD-3-Clause
//
// A build without OctoMap: the command says which bodies it lacks.
#include <vericone/geometry/error.h>

#include "input/fields.h"
#include "input/octree_body.h"

namespace vericone::input {

bool have_octrees() { return false; }

OctreePieces read_octree_pieces(const Json& value, const std::string& path, const std::filesystem::path&,
                                double) {
  throw InputError(path + ".octree", quoted(value["octree"]),
                   "left out: this vericone was built without octree maps (VERICONE_OCTOMAP)");
}

}  // namespace vericone::input
