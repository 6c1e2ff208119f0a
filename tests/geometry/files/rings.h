// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace vericone::files {

using Ring = std::vector<Eigen::Vector2d>;

/// Of corners that are small whole numbers: no rounding.
inline double twice_area(const Ring& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector2d &a = p[i], &b = p[(i + 1) % p.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

/// Whether a ray from x, of no corner's height, crosses the boundary an odd number of times.
inline bool crosses_odd(const Ring& p, const Eigen::Vector2d& x) {
  bool odd = false;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector2d &a = p[i], &b = p[(i + 1) % p.size()];
    if ((a.y() > x.y()) == (b.y() > x.y())) continue;
    if (a.x() + (x.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > x.x()) odd = !odd;
  }
  return odd;
}

}  // namespace vericone::files
