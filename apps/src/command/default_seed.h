// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace vericone {

/// Of the random numbers of every command that is not given --seed.
inline constexpr std::uint64_t kDefaultSeed = 1;

}  // namespace vericone
