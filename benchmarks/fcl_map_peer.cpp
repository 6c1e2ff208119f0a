// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/fcl_map_peer.h>

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <octomap/octomap.h>

namespace vericone::benchmarks {

struct FclMap::Objects {
  explicit Objects(const std::string& file)
      : map(std::make_shared<fcl::OcTreed>(std::make_shared<octomap::OcTree>(file))) {
    map->computeLocalAABB();
  }
  std::shared_ptr<fcl::OcTreed> map;
};

FclMap::FclMap(const std::string& bt_file) : objects_(std::make_unique<Objects>(bt_file)) {}
FclMap::~FclMap() = default;

bool FclMap::naive(const Eigen::Vector3d& center, const Eigen::Vector3d& semi_axes,
                   const Eigen::Vector3d& way, std::size_t steps) const {
  const fcl::Ellipsoidd agent(semi_axes);
  fcl::Transform3d from = fcl::Transform3d::Identity(), to = from;
  from.translation() = center;
  to.translation() = center + way;
  const fcl::Transform3d rest = fcl::Transform3d::Identity();
  fcl::ContinuousCollisionRequestd request;
  request.num_max_iterations = steps;
  request.ccd_solver_type = fcl::CCDC_NAIVE;
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide<double>(&agent, from, to, objects_->map.get(), rest, rest, request, result);
  return result.is_collide;
}

}  // namespace vericone::benchmarks
