// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Minkowski sum of two hulls of points, known exactly.
#pragma once

#include <vericone/internal/verify/assembly/truth.h>

#include <memory>
#include <span>

namespace vericone::verify {

/// K = obstacle - agent as the convex hull of all differences of points.
class HullSum {
 public:
  HullSum(std::span<const Eigen::Vector3d> agent, std::span<const Eigen::Vector3d> obstacle);

  /// Whether K has an interior. What follows is for those that have.
  bool solid() const;
  /// Where { t w : from <= t <= to } meets the interior of K (`in`) or its boundary alone (`on`).
  /// `to` may be infinite.
  Membership meets(double from, double to, const Eigen::Vector3d& w) const;

 private:
  struct Exact;
  std::shared_ptr<const Exact> exact_;
};

}  // namespace vericone::verify
