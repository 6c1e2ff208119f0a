// SPDX-License-Identifier: BSD-3-Clause
//
// Closed outlines of straight edges in the plane: exact questions about their corners.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace vericone::outlines {

/// Which way a to b to c turns: 1 counter-clockwise, -1 clockwise, 0 straight; exact.
[[nodiscard]] int turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// Whether two segments, ends included, have a point in common; exact.
[[nodiscard]] bool meet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                        const Eigen::Vector2d& d);

/// Of points known to lie on one line: whether c is between a and b, or one of them.
[[nodiscard]] bool within(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// Of three or more finite points. Throws InputError naming "NAME[i]" unless no edge meets another but at the
/// corner they share. A sweep along x: quadratic at worst.
void require_simple(const std::vector<Eigen::Vector2d>& corners, const std::string& name);

/// The corner least in x, then y: a simple outline turns there as it does as a whole.
[[nodiscard]] std::size_t leftmost(const std::vector<Eigen::Vector2d>& corners);

}  // namespace vericone::outlines
