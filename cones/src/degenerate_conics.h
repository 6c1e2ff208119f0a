// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace vericone {

/// Normals of the inner common tangents, B on the positive side, the one with the larger y first.
struct InnerTangents {
  std::array<Eigen::Vector2d, 2> normals;
};

/// Source, Algorithm 3, for two ellipses with the given shapes and centres at distance 1 along x. Nothing
/// when the pencil has no three real degenerate members in floating point.
std::optional<InnerTangents> inner_tangents_by_degenerate_conics(const Eigen::Matrix2d& shape_a,
                                                                 const Eigen::Matrix2d& shape_b);

}  // namespace vericone
