// SPDX-License-Identifier: BSD-3-Clause
//
// Single rungs of the transit through an orifice that faces the agent.
#pragma once

#include <vericone/cones/opening/orifice.h>
#include <optional>

namespace vericone {

/// Its rungs, for checked input.
[[nodiscard]] std::optional<Transit> triage_facing_orifice_transit(const Eigen::Vector3d& center_line,
                                                                   double agent_radius, double opening_radius,
                                                                   const Eigen::Vector3d& w) noexcept;

[[nodiscard]] std::optional<Transit> interval_facing_orifice_transit(const Eigen::Vector3d& center_line,
                                                                     double agent_radius,
                                                                     double opening_radius,
                                                                     const Eigen::Vector3d& w) noexcept;

[[nodiscard]] Transit exact_facing_orifice_transit(const Eigen::Vector3d& center_line, double agent_radius,
                                                   double opening_radius, const Eigen::Vector3d& w);

}  // namespace vericone
