// SPDX-License-Identifier: BSD-3-Clause
//
// A quick question about bodies that fly straight.
#pragma once

#include <vericone/cones/pair.h>
#include <optional>

namespace vericone {

/// Whether two bodies of space will meet, or may for all that is certified, each at its velocity (m/s) for
/// ever; nothing where they are not apart, or not known to be. As of pair_of(a, b), without preparing more:
/// no allocation for two ellipsoids whose relation doubles decide. Throws like pair_of() and Pair::verdict().
[[nodiscard]] std::optional<bool> may_meet(const WorldBody& a, const WorldBody& b, const Eigen::Vector3d& v_a,
                                           const Eigen::Vector3d& v_b);

}  // namespace vericone
