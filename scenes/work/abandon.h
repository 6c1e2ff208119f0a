// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>

namespace vericone::work {

/// Held while files appear in a folder, so that an interruption finds all of them or none.
std::mutex& appearing();

/// Removes the unfinished files of all folders that are held. The process must end after that.
void abandon_output();

}  // namespace vericone::work
