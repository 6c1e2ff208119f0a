// SPDX-License-Identifier: BSD-3-Clause
//
// All velocities of a box, or of a section through velocity space, cut into cells that are safe, colliding
// or undecided: the union of the cones of many bodies, with the gaps and windows between them
// (docs/explanation/velocity-map.md).
#pragma once

#include <vericone/guidance/bands.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace vericone::guidance {

struct VelocityMapOptions {
  /// m/s through the air: the box of velocities. Where both are equal along an axis it is a section.
  Eigen::Vector3d low = Eigen::Vector3d::Constant(-1), high = Eigen::Vector3d::Constant(1);
  double resolution = 0.1;  // m/s: cells are halved until their sides are shorter
  double until = 60;        // s: contacts later than that do not count
  double margin = 0;        // m to keep from every body
  /// s: colliding cells are halved too, until it is known to that when the first body is met, and which is.
  double time = std::numeric_limits<double>::infinity();
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();  // m/s, added to the agent's velocity through the air
  std::size_t most_cells = 1'000'000;              // asked about; the rest stays undecided, the largest first
};

struct VelocityCell {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  Eigen::Vector3d low, high;  // m/s, with all its sides
  /// `in`: with every velocity of it the margin is lost until then; `out`: with none.
  Certified label = Certified::undecided;
  /// Cells of one label that touch, directly or by others of it, have one number, from 0 (undecided ones have
  /// none). A gap or a window that is closed all around is a safe region of its own.
  std::uint32_t region = 0;
  /// Of a colliding cell: nothing is met before `earliest` with any velocity of it; every one has met
  /// `obstacle` until `latest`, s. `first`: no other body is met before that. All proved.
  double earliest = 0, latest = 0;
  std::size_t obstacle = kNone;
  bool first = false;
};

struct VelocityMap {
  std::vector<VelocityCell> cells;                // they cover the box and have no more than sides in common
  double colliding = 0, safe = 0, undecided = 0;  // each a fraction of the box, or of its section
  std::uint32_t safe_regions = 0;                 // of VelocityCell::region
  std::uint64_t asked = 0;                        // cells
  bool complete = true;                           // false: `most_cells` did not do
};

/// Of an agent that changes to a velocity at once and keeps it, among bodies that keep theirs. A cell is safe
/// where one plane a convex part proves it, colliding where one convex part is met with all its corners: such
/// velocities are a convex set. So what several parts cover only together is undecided down to the
/// resolution. Sums of wind and velocities are rounded (1e-16). Deterministic. Throws InputError naming
/// "low", "high", "wind" or another option. Cost: docs/measured/guidance.md.
[[nodiscard]] VelocityMap velocity_map(const Placed& agent, std::span<const Intruder> intruders,
                                       const VelocityMapOptions& options);

}  // namespace vericone::guidance
