// SPDX-License-Identifier: BSD-3-Clause
//
// Random engagements of two moving ellipsoids for the campaign of guidance laws (docs/measured/campaign.md).
#pragma once

#include <vericone/simulation/scenario.h>
#include <Eigen/Core>
#include <cstdint>

namespace vericone::montecarlo {

/// Two ellipsoids as they start, the first one the agent; both turn with their headings.
struct Encounter {
  simulation::Body agent, obstacle;

  /// v_agent - v_obstacle at the start, m/s.
  [[nodiscard]] Eigen::Vector3d relative_velocity() const {
    return agent.start.velocity - obstacle.start.velocity;
  }
  /// Time in which the centres cover their distance at the relative speed, s.
  [[nodiscard]] double scale() const;
};

/// Encounter `index` of a campaign: bodies and places of `vericone accuracy` with the same seed (semi-axes
/// uniform in 1..10 m, uniform orientations, centres 1.5 to 3 times as far apart as where they touch along
/// the line of centres), speeds uniform in 5..15 m/s, and the relative velocity aimed at a point beside the
/// obstacle's centre, so that about two thirds are on a collision course. Depends on seed and index alone.
[[nodiscard]] Encounter random_encounter(std::uint64_t seed, std::uint64_t index);

}  // namespace vericone::montecarlo
