// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "round/search.h"

namespace vericone {

/// The first rung: w is within one rounding of each entry.
template <class Scene>
struct TriageShadow {
  const Scene& scene;
  const Eigen::Vector3d& w;
  double length = w.norm(), least_turn = 32 * scene.size * scene.slack;

  /// A plane along w to rounding is turned away from it: by n.w / |w| and 32 roundings of K's size.
  bool outside(const Eigen::Vector3d& n, double largest, const RoundSupport& support) const noexcept {
    const double tilt = std::max(n.dot(w), 0.0) / length + 64 * kUnitRoundoff * largest;
    return support.value > scene.slack * largest + tilt * scene.size * (1 + 0x1p-40);
  }
  /// Shadows are off by 3 slack and at most 2 size long, so their cross products by 26 size slack.
  template <std::size_t kCount>
  bool around(const std::array<ShadowPoint, kCount>& corner) const noexcept {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = 0; i < kCount; ++i) {
      const Eigen::Vector2d &p = corner[i].y, &q = corner[(i + 1) % kCount].y;
      const double turn = p.x() * q.y() - p.y() * q.x();
      least = std::min(least, turn);
      most = std::max(most, turn);
    }
    return least > least_turn || most < -least_turn;
  }
};

}  // namespace vericone
