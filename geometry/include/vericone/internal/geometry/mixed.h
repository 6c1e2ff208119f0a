// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace vericone::detail {

/// A step of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): every bit of the result depends on every bit of x.
/// The same on every machine; as good for a counter as for a state.
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

}  // namespace vericone::detail
