// SPDX-License-Identifier: BSD-3-Clause
#include "pieces/world_mesh.h"

#include <map>

namespace vericone {

WorldMesh world_mesh(const Assembly& pieces, const Pose& pose) {
  WorldMesh mesh;
  std::map<std::array<double, 3>, std::uint32_t> index;
  for (const auto& corners : pieces.by_slot().triangles) {
    auto& triangle = mesh.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& x = corners[k];
      const auto [it, is_new] =
          index.try_emplace({x.x(), x.y(), x.z()}, static_cast<std::uint32_t>(mesh.points.size()));
      if (is_new) mesh.points.push_back(pose.to_world(x));
      triangle[k] = it->second;
    }
  }
  return mesh;
}

}  // namespace vericone
