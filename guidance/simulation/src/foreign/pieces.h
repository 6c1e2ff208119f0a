// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/trajectory.h>
#include <string>

namespace vericone::simulation {

/// Throws InputError naming `times` or, with its number, `points` unless there are pieces of degree 0 to 9,
/// finite, at ascending times.
void require_pieces(const Piecewise& of, const std::string& times, const std::string& points);

[[nodiscard]] bool is_rotation(const Eigen::Matrix3d& matrix);

}  // namespace vericone::simulation
