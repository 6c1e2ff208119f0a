// SPDX-License-Identifier: BSD-3-Clause
//
// Single flights of two convex parts, and a margin.
#pragma once

#include <vericone/cones/pair.h>
#include <algorithm>
#include <cmath>

#include "bands/threats.h"

namespace vericone::guidance::banding {

/// How near they come within a horizon.
inline Miss nearest_within(const Pair& pair, const Eigen::Vector3d& v, const Eigen::Vector3d& other,
                           const Horizon& horizon) {
  if (horizon.from > 0) {
    Placed then = pair.agent();
    then.pose.position += horizon.from * (v - other);
    return nearest_within(Pair(then, pair.obstacle()), v, other, {0, horizon.until - horizon.from});
  }
  // Of a pair that meets later the time of Miss is not that of the contact; until then it only comes nearer.
  Miss miss = pair.miss(v, other);
  if (miss.least > 0 && miss.time <= horizon.until) return miss;
  if (std::isinf(horizon.until)) return miss;
  Placed then = pair.agent();
  then.pose.position += horizon.until * (v - other);
  return Pair(then, pair.obstacle()).miss(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
}

/// What one plane proves to keep the margin, with this velocity over ground in it.
inline std::optional<SafeHalfSpace> safe(const Part& part, const Eigen::Vector3d& velocity,
                                         const Horizon& horizon, double margin) {
  auto half = part.swollen().safe_half_space(velocity, part.velocity, horizon);
  if (!half || margin == 0) return half;
  const Eigen::Vector3d w = velocity - part.velocity;
  half->room = part.pair.gap(half->normal) - margin * half->normal.norm() * (1 + 0x1p-48);
  const auto holds = [&] {
    const double most = half->most(horizon), along = half->normal.dot(w);
    return along + 0x1p-48 * (half->normal.norm() * w.norm() + std::abs(most)) < most;
  };
  if (holds()) return half;
  // Where the swollen body is less than the margin, the plane where they are nearest leaves more.
  const Miss nearest = nearest_within(part.pair, velocity, part.velocity, horizon);
  if (!(nearest.least > margin)) return std::nullopt;
  const Eigen::Vector3d& n = nearest.normal;
  *half = {n, part.pair.gap(n) - margin * n.norm() * (1 + 0x1p-48)};
  return holds() ? half : std::nullopt;
}

/// Whether they surely come nearer than the margin, of convex bodies that are what they are; or meet.
inline bool comes_nearer(const Part& part, const Eigen::Vector3d& velocity, const Horizon& horizon,
                         double margin) {
  const Verdict verdict = part.swollen().verdict(velocity, part.velocity, horizon);
  if (verdict == Verdict::in || verdict == Verdict::overlapping) return true;
  return margin > 0 && nearest_within(part.pair, velocity, part.velocity, horizon).most < margin;
}

}  // namespace vericone::guidance::banding
