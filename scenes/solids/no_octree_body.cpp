// SPDX-License-Identifier: BSD-3-Clause
//
// A build without OctoMap: the command says which bodies it lacks.
#include <vericone/geometry/error.h>

#include "input/assembly_body.h"
#include "input/fields.h"
#include "json/json_value.h"

namespace vericone::input {

bool have_octrees() { return false; }

OctreePieces read_octree_pieces(const OctreeFields&, const std::string& name, const std::filesystem::path&,
                                double) {
  throw InputError("octree", input::quoted(name),
                   "left out: this vericone was built without octree maps (VERICONE_OCTOMAP)");
}

}  // namespace vericone::input
