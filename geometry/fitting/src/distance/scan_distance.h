// SPDX-License-Identifier: BSD-3-Clause
//
// Distances from many points to a sample.
#pragma once

#include <vericone/fitting/hull.h>
#include <vericone/internal/geometry/hierarchy.h>
#include <array>
#include <vector>

namespace vericone::fitting {

/// To the nearest triangle of a mesh, the nearest point of a cloud: under a tree of boxes.
class ScanDistance {
 public:
  explicit ScanDistance(const Sample& sample);

  double operator()(const Eigen::Vector3d& point) const;

 private:
  double to_piece(std::uint32_t piece, const Eigen::Vector3d& x) const;

  Eigen::Vector3d origin_;  // the boxes are in floats: about the sample's own place
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  Hierarchy tree_;
};

}  // namespace vericone::fitting
