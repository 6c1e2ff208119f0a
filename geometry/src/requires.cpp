// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/geometry/requires.h>
#include <cstdio>
#include <cstdlib>

namespace vericone::detail {

void requirement_broken(const char* function, const char* requirement) noexcept {
  std::fprintf(stderr, "vericone: %s() requires %s\n", function, requirement);
  std::abort();
}

}  // namespace vericone::detail
