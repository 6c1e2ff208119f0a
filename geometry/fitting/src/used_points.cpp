// SPDX-License-Identifier: BSD-3-Clause
#include "used_points.h"

#include <vericone/geometry/error.h>
#include <cmath>
#include <string>

namespace vericone::fitting {

std::vector<std::uint32_t> used_points(const Sample& sample) {
  std::vector<char> used(sample.points.size(), !sample.is_mesh());
  for (std::size_t t = 0; t < sample.triangles.size(); ++t)
    for (const std::uint32_t i : sample.triangles[t]) {
      if (i >= used.size())
        throw InputError("triangles[" + std::to_string(t) + "]", std::to_string(i),
                         "indices below the number of points, " + std::to_string(used.size()));
      used[i] = 1;
    }
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(sample.points[i](k)))
        throw InputError("points[" + std::to_string(i) + "]", to_text(sample.points[i](k)),
                         "a finite number (metres)");
    all.push_back(i);
  }
  return all;
}

Eigen::Vector3d middle(const Sample& sample, const std::vector<std::uint32_t>& points) {
  if (points.empty()) return Eigen::Vector3d::Zero();
  Eigen::Vector3d low = sample.points[points.front()], high = low;
  for (const std::uint32_t i : points) {
    low = low.cwiseMin(sample.points[i]);
    high = high.cwiseMax(sample.points[i]);
  }
  return 0.5 * low + 0.5 * high;
}

}  // namespace vericone::fitting
