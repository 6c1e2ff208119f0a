// SPDX-License-Identifier: BSD-3-Clause
//
// One encounter of a campaign and its flights.
#pragma once

#include <vericone/simulation/montecarlo/campaign.h>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

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

/// Without saturation: accelerations up to this.
inline constexpr double kUnlimited = 1000;  // m/s^2

/// The laws by name, each with saturation and without. Throws InputError naming "laws".
[[nodiscard]] std::vector<Flown> flown_laws(const std::vector<std::string>& names,
                                            const FlightSettings& settings);

/// The rows of a table one after the other. Throws as read_table() does.
void each_row(const std::filesystem::path& file, std::size_t laws, const std::function<void(Row)>& take);

/// summarise() of the table in a file, which is read four times: memory does not grow with it. Throws as
/// read_table() does.
[[nodiscard]] Summary summarise_file(const std::filesystem::path& file, const std::vector<Flown>& laws);

/// Nothing for another text.
[[nodiscard]] std::optional<Fate> fate_of(const std::string& text);

/// Under one law, until the centres have passed and what follows is decided.
[[nodiscard]] Outcome fly(const Encounter& encounter, const Flown& law, const FlightSettings& settings);

[[nodiscard]] StraightOutcome fly_straight(const Encounter& encounter);

}  // namespace vericone::montecarlo
