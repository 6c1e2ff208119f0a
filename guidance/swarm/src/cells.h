// SPDX-License-Identifier: BSD-3-Clause
//
// Points sorted into cubes, for what is near.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace vericone::swarm {

/// Memory is linear in the number of points, wherever they are.
class Cells {
 public:
  Cells() = default;
  Cells(const std::vector<Eigen::Vector3d>& points, double width) : width_(width) {
    entries_.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      entries_.push_back({cell_of(points[i]), static_cast<std::uint32_t>(i)});
    std::sort(entries_.begin(), entries_.end());
  }

  /// Calls visit(index) for all points within `distance` <= width of x, and for some more, in an order that
  /// depends on the points alone.
  template <class Visit>
  void around(const Eigen::Vector3d& x, Visit visit) const {
    const Cell middle = cell_of(x);
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        // Three cells that follow each other.
        const Cell first{middle[0] + dx, middle[1] + dy, middle[2] - 1};
        auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry{first, 0});
        for (; entry != entries_.end() && entry->cell[0] == first[0] && entry->cell[1] == first[1] &&
               entry->cell[2] <= middle[2] + 1;
             ++entry)
          visit(entry->index);
      }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Entry {
    Cell cell;
    std::uint32_t index;
    bool operator<(const Entry& other) const {
      return cell != other.cell ? cell < other.cell : index < other.index;
    }
  };
  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& x) const {
    Cell cell{};
    for (int k = 0; k < 3; ++k) cell[k] = static_cast<std::int64_t>(std::floor(x(k) / width_));
    return cell;
  }

  double width_ = 1;
  std::vector<Entry> entries_;
};

}  // namespace vericone::swarm
