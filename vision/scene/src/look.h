// SPDX-License-Identifier: BSD-3-Clause
//
// What vehicles are painted with.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vericone::vision {

using Colour = Eigen::Vector3f;  // blue, green, red: 0 to 255

/// A well mixed number of two.
std::uint64_t mixed(std::uint64_t seed, std::uint64_t k);

/// Blue, green and red as eyes weigh them.
inline float grey(const Colour& c) { return 0.114f * c.x() + 0.587f * c.y() + 0.299f * c.z(); }

/// A car from above and from the sides: paint, windows, lights, and patches on roof and bonnet by which cars
/// of different seeds differ.
class Look {
 public:
  explicit Look(std::uint32_t seed);

  /// Of the roof: along from the back, 0, to the front, 1; across from left, 0, to right, 1.
  const Colour& roof(double along, double across) const {
    return texels_[cell(along, kAlong) * kAcross + cell(across, kAcross)];
  }
  /// Of a side: how high, 0 to 1, and along it, 0 to 1.
  Colour side(double along, double high) const {
    const bool window = high > 0.55 && high < 0.92 && along > 0.12 && along < 0.88;
    return window ? Colour(40, 34, 30) : Colour(0.62f * paint_);
  }

 private:
  static constexpr std::size_t kAlong = 48, kAcross = 20;
  static std::size_t cell(double x, std::size_t n) {
    return x <= 0 ? 0 : std::min(n - 1, std::size_t(x * double(n)));
  }

  Colour paint_;
  std::vector<Colour> texels_;
};

}  // namespace vericone::vision
