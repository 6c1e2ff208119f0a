// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies that contain the fish however its tail stands, about its centre of mass, x ahead and z up. Why they
// do: docs/explanation/fish.md.
#pragma once

#include <vericone/vehicles/fish_dynamics.h>
#include <Eigen/Core>

namespace vericone::vehicles {

/// |alpha_1| never exceeds this, rad: the largest amplitude and the largest bias together.
[[nodiscard]] double most_tail_angle(const FishParameters& fish);

/// Without its tail: the ellipsoid with the areas A_x and A_y of the drag, as long as the body, metres.
struct Trunk {
  double ahead = 0;  // of its centre, m
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Zero();
};
[[nodiscard]] Trunk trunk_of(const FishParameters& fish);

/// Semi-axes (m) of an ellipsoid that contains trunk and tail; of these nearly the one of least volume. Cost:
/// 16 ms.
[[nodiscard]] Eigen::Vector3d ellipsoid_of(const FishParameters& fish);

/// Radius (m) of a ball that contains trunk and tail: the source's R_A, which it does not print.
[[nodiscard]] double sphere_of(const FishParameters& fish);

}  // namespace vericone::vehicles
