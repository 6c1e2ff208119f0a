// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace vericone::simulation {

/// Towards the point of least norm of a convex set by Wolfe's algorithm ("Finding the nearest point in a
/// polytope", Math. Programming 11, 1976), rounded. `farthest(d)`: a point of the set farthest along d. The
/// answer is a point of the set; zero where the set holds the origin to rounding. `made_of`: where given, set
/// to the directions whose farthest points have the answer as their mean, four at most.
struct MeanPart {
  Eigen::Vector3d direction;
  double weight;  // above 0, of sum 1
};
Eigen::Vector3d least_point(const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& farthest,
                            const Eigen::Vector3d& start, std::vector<MeanPart>* made_of = nullptr);

}  // namespace vericone::simulation
