// SPDX-License-Identifier: BSD-3-Clause
//
// A hall to fly in.
#pragma once

#include <vericone/geometry/pose.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace vericone::testing {

/// 12 x 12 x 4 m about (0, 0, 2), with a wall across at x = 0 that has a door at least so wide, and up to six
/// pillars that are not before it.
inline std::vector<Box> hall(RandomBodies& random, double door_width) {
  std::vector<Box> boxes;
  const auto add = [&](double x0, double x1, double y0, double y1, double z0, double z1) {
    boxes.push_back({{x0, y0, z0}, {x1, y1, z1}});
  };
  for (const double at : {-6.2, 6.0}) {
    add(at, at + 0.2, -6.2, 6.2, 0, 4);
    add(-6.2, 6.2, at, at + 0.2, 0, 4);
  }
  for (const double at : {-0.2, 4.0}) add(-6.2, 6.2, -6.2, 6.2, at, at + 0.2);
  const double door = random.uniform(-4.5, 3.5), wide = door_width + random.uniform(0, 0.6);
  add(-0.1, 0.1, -6, door, 0, 4);
  add(-0.1, 0.1, door + wide, 6, 0, 4);
  for (int i = random.integer(0, 6); i > 0; --i) {
    const double x = random.uniform(-5, 5), y = random.uniform(-5, 5), a = random.uniform(0.1, 0.6),
                 b = random.uniform(0.1, 0.6), height = random.uniform(1, 4);
    if (std::abs(x) > 1.8) add(x - a, x + a, y - b, y + b, 0, height);
  }
  return boxes;
}

/// m, from a point to the nearest of them.
inline double distance(const Eigen::Vector3d& x, const std::vector<Box>& boxes) {
  double least = std::numeric_limits<double>::infinity();
  for (const Box& box : boxes) least = std::min(least, (x.cwiseMax(box.low).cwiseMin(box.high) - x).norm());
  return least;
}

}  // namespace vericone::testing
