// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/error.h>
#include <algorithm>
#include <string>
#include <thread>

namespace vericone {

/// As many threads as were asked for; 0: one per processor. Throws InputError naming `field`.
inline int threads_for(int asked, const std::string& field = "--threads") {
  if (asked < 0 || asked > 1024)
    throw InputError(field, std::to_string(asked), "between 1 and 1024, or 0 for all");
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace vericone
