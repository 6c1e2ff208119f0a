// SPDX-License-Identifier: BSD-3-Clause
#include "point_merger.h"

#include <bit>
#include <limits>

namespace vericone::files {
namespace {

constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

std::size_t hash(const Eigen::Vector3d& p) {
  std::uint64_t h = 0;
  const auto mix = [&h] {
    h *= 0x9e3779b97f4a7c15U;
    h ^= h >> 32;
  };
  for (int i = 0; i < 3; ++i) {
    h ^= std::bit_cast<std::uint64_t>(p(i) + 0.0);  // -0 + 0 is 0
    mix();
  }
  mix();  // round numbers have their bits at the top
  return std::size_t(h);
}

}  // namespace

std::size_t PointMerger::slot(const Eigen::Vector3d& p) const {
  const std::size_t mask = table_.size() - 1;
  std::size_t at = hash(p) & mask;
  while (table_[at] != kFree && points_[table_[at]] != p) at = (at + 1) & mask;
  return at;
}

void PointMerger::grow() {
  std::vector<std::uint32_t> old(std::max<std::size_t>(64, 2 * table_.size()), kFree);
  std::swap(old, table_);
  for (const std::uint32_t i : old)
    if (i != kFree) table_[slot(points_[i])] = i;
}

std::uint32_t PointMerger::index(const Eigen::Vector3d& p) {
  const auto next = std::uint32_t(points_.size());
  if (p.allFinite()) {
    if (2 * entries_ >= table_.size()) grow();
    std::uint32_t& entry = table_[slot(p)];
    if (entry != kFree) return entry;
    entry = next;
    ++entries_;
  }
  points_.push_back(p);
  return next;
}

}  // namespace vericone::files
