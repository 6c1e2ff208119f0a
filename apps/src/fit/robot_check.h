// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "fit/fit_command.h"

namespace vericone {

/// `vericone fit ROBOT --check OTHER` of two robots: whether every triangle of each link's collisions is
/// inside one solid of the other's, in exact arithmetic of the numbers as they are read, and every other
/// shape of it is there again or has the corners around it in one. Exit status 0, or 1 where not. Throws
/// InputError naming a file.
int check_robot(const FitCommandOptions& given, std::ostream& out);

}  // namespace vericone
