// SPDX-License-Identifier: BSD-3-Clause
#include "pieces/convex_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone {

std::vector<std::array<Eigen::Vector3d, 3>> convex_mesh(const Convex& body, const Pose& pose, int rings) {
  constexpr double pi = std::numbers::pi;
  const int around = 2 * rings;
  // Rings of directions beside the poles and the equator, where bodies about z have their edges.
  const auto farthest = [&](double polar, int j) {
    const double azimuth = 2 * pi * (j + 0.5) / around;
    const double across = polar < pi ? std::sin(polar) : 0;  // straight down, and not to a rim
    return pose.to_world(
        body.support_point({across * std::cos(azimuth), across * std::sin(azimuth), std::cos(polar)}));
  };
  std::vector<std::vector<Eigen::Vector3d>> grid(std::size_t(rings) + 2);
  for (int i = 0; i <= rings + 1; ++i) {
    const double polar = pi * std::clamp((i - 0.5) / rings, 0., 1.);
    for (int j = 0; j < around; ++j) grid[std::size_t(i)].push_back(farthest(polar, j));
  }
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  const auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if ((b - a).cross(c - a).norm() > 1e-9 * longest * longest) triangles.push_back({a, b, c});
  };
  for (std::size_t i = 0; i + 1 < grid.size(); ++i)
    for (std::size_t j = 0; j < std::size_t(around); ++j) {
      const std::size_t next = (j + 1) % std::size_t(around);
      add(grid[i][j], grid[i + 1][j], grid[i + 1][next]);
      add(grid[i][j], grid[i + 1][next], grid[i][next]);
    }
  return triangles;
}

}  // namespace vericone
