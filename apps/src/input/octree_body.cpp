// SPDX-License-Identifier: BSD-3-Clause
#include "input/octree_body.h"

#include "input/fields.h"

namespace vericone::input {

const std::vector<std::string>& octree_fields() {
  static const std::vector<std::string> fields{"unknown", "free", "occupied_above", "region"};
  return fields;
}

bool have_octrees() { return false; }

OctreePieces read_octree_pieces(const Json& value, const std::string& path, const std::filesystem::path&,
                                double) {
  throw InputError(path + ".octree", quoted(value["octree"]),
                   "left out: this vericone was built without octree maps (VERICONE_OCTOMAP)");
}

}  // namespace vericone::input
