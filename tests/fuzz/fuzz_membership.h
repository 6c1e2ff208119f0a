// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace vericone::fuzz {

/// a.center, a.shape (xx, xy, xz, yy, yz, zz), the same of b, w.
using Doubles = std::array<double, 21>;

/// Aborts with the numbers in hexadecimal where a rung is wrong. False where the numbers are no two bodies.
bool check_membership(const Doubles& input);

}  // namespace vericone::fuzz
