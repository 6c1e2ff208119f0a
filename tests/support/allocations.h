// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vericone::testing {

/// Calls of operator new so far in this program.
std::size_t allocations();

}  // namespace vericone::testing
