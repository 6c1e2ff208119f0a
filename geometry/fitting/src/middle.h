// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/fitting/hull.h>

namespace vericone::fitting {

/// Of the box about some of a sample's points, which forms are expanded about; zero without points.
inline Eigen::Vector3d middle(const Sample& sample, const std::vector<std::uint32_t>& points) {
  if (points.empty()) return Eigen::Vector3d::Zero();
  Eigen::Vector3d low = sample.points[points.front()], high = low;
  for (const std::uint32_t i : points) {
    low = low.cwiseMin(sample.points[i]);
    high = high.cwiseMax(sample.points[i]);
  }
  return 0.5 * low + 0.5 * high;
}

}  // namespace vericone::fitting
