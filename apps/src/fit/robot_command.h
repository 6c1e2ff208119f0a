// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "fit/fit_command.h"

namespace vericone {

/// `vericone fit ROBOT --urdf FILE` or `--sdf FILE`: the robot again, the collisions of each link replaced by
/// a union of solids that is proved to contain them. As run_fit().
int run_robot_fit(const FitCommandOptions& given, std::ostream& out);

}  // namespace vericone
