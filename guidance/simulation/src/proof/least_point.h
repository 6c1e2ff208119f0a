// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>

namespace vericone::simulation {

/// Towards the point of least norm of a convex set by Wolfe's algorithm ("Finding the nearest point in a
/// polytope", Math. Programming 11, 1976), rounded. `farthest(d)`: a point of the set farthest along d. The
/// answer is a point of the set; zero where the set holds the origin to rounding.
Eigen::Vector3d least_point(const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& farthest,
                            const Eigen::Vector3d& start);

}  // namespace vericone::simulation
