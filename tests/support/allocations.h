// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vericone::testing {

/// Calls of malloc, realloc and operator new so far in this program and in the static libraries.
std::size_t allocations();

}  // namespace vericone::testing
