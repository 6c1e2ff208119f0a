// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace vericone::files {

/// Gives equal points one index (coordinates are equal as numbers: -0 is 0), in the order of first use.
/// Constant expected time a point.
class PointMerger {
 public:
  /// `points` takes the points and must outlive the merger; it starts empty.
  explicit PointMerger(std::vector<Eigen::Vector3d>& points) : points_(points) {}

  /// A point that is not finite is equal to none.
  std::uint32_t index(const Eigen::Vector3d& p);

 private:
  std::size_t slot(const Eigen::Vector3d& p) const;
  void grow();

  std::vector<Eigen::Vector3d>& points_;
  std::vector<std::uint32_t> table_;  // open addressing, at most half full
  std::size_t entries_ = 0;
};

}  // namespace vericone::files
