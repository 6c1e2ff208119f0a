// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/fitting/fit.h>

#include <algorithm>
#include <cmath>

namespace vericone::fitting {

/// Sums with more digits than doubles have, so that the order of the points does not show.
class DistanceSum {
 public:
  void add(double distance) {
    ++count_;
    sum_ += distance;
    squares_ += static_cast<long double>(distance) * distance;
    max_ = std::max(max_, distance);
  }
  [[nodiscard]] DistanceStatistics result() const {
    if (count_ == 0) return {};
    return {static_cast<double>(sum_ / count_), static_cast<double>(std::sqrt(squares_ / count_)), max_};
  }

 private:
  long double count_ = 0, sum_ = 0, squares_ = 0;
  double max_ = 0;
};

}  // namespace vericone::fitting
