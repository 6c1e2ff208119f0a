// SPDX-License-Identifier: BSD-3-Clause
//
// Time to contact as an enclosure that is proved to contain it.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/interval.h>
#include <array>
#include <optional>

namespace vericone {

/// Contains the first t >= 0, in seconds, at which A moving by (v_a - v_b) t touches B, the difference taken
/// without rounding; [0, 0] for bodies that touch or overlap now, nothing when they never touch. Both answers
/// are exact. A relative width of some 1e-14 away from grazing; grazing and nearly grazing contacts are
/// enclosed from their exact value to full double precision. Cost: 4 us by intervals, 1 ms where the exact
/// value is needed. Throws InputError naming "agent_velocity[i]" or "obstacle_velocity[i]" where not finite.
[[nodiscard]] std::optional<Interval> enclose_time_to_contact(const ConeOracle& oracle,
                                                              const Eigen::Vector3d& v_a,
                                                              const Eigen::Vector3d& v_b);

/// The same by intervals alone, for bodies and velocities known to meet ahead; nothing where no enclosure of
/// a relative width below `widest` can be proved. No allocation, no throw.
[[nodiscard]] std::optional<Interval> interval_time_to_contact(const Ellipsoid& a, const Ellipsoid& b,
                                                               const std::array<Interval, 3>& w,
                                                               double widest = 1e-9) noexcept;

/// The same from the exact value, correct to a few units in the last place. Requires finite velocities.
[[nodiscard]] std::optional<Interval> exact_time_to_contact(const ConeOracle& oracle,
                                                            const Eigen::Vector3d& v_a,
                                                            const Eigen::Vector3d& v_b);

}  // namespace vericone
