// SPDX-License-Identifier: BSD-3-Clause
//
// What FCL offers for an ellipsoid that moves through an octree map.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>

namespace vericone::benchmarks {

/// A map of OctoMap as an FCL geometry, its occupied cells only.
class FclMap {
 public:
  explicit FclMap(const std::string& bt_file);
  ~FclMap();

  /// continuousCollide() of an upright ellipsoid that moves from `center` by `way`, with CCDC_NAIVE, the one
  /// kind that has octrees in its tables: static tests at `steps` places of the way.
  bool naive(const Eigen::Vector3d& center, const Eigen::Vector3d& semi_axes, const Eigen::Vector3d& way,
             std::size_t steps) const;

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace vericone::benchmarks
