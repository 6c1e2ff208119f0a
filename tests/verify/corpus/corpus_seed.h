// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace vericone::verify {

/// Of the files in tests/corpus.
inline constexpr std::uint64_t kCorpusSeed = 1;

}  // namespace vericone::verify
