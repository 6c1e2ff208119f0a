// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/error.h>
#include <algorithm>
#include <string>
#include <thread>

namespace vericone {

/// As many threads as --threads asked for; 0: one per processor. Throws InputError naming "--threads".
inline int threads_for(int asked) {
  if (asked < 0 || asked > 1024)
    throw InputError("--threads", std::to_string(asked), "between 1 and 1024, or 0 for all");
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace vericone
