// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>

namespace vericone::files {

/// The value that stands at `at` in little-endian order. The caller has checked that it is there.
template <typename T>
T little_endian(const char* at) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), at, raw.size());
  if constexpr (std::endian::native != std::endian::little) std::ranges::reverse(raw);
  return std::bit_cast<T>(raw);
}

}  // namespace vericone::files
