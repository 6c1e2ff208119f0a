// SPDX-License-Identifier: BSD-3-Clause
//
// Encounters that a scenario's bodies fly: tracks with weights, from a table or drawn from a population.
#pragma once

#include <vericone/simulation/scenario.h>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vericone::encounters {

/// Where a body is at times, ascending, from the encounter's beginning; straight on, or cubics with these
/// velocities between three places or more.
struct Way {
  std::vector<double> times;                        // s; the first is 0
  std::vector<Eigen::Vector3d> points, velocities;  // m, m/s; as many as times
};

struct FlownEncounter {
  double weight = 1;
  double duration = 0;    // s; 0: the scenario's
  std::vector<Way> ways;  // one for each of the scenario's bodies
};

struct EncounterSet {
  std::uint64_t count = 0;  // 0: as many as are asked for
  /// Drawn from distributions, so that weights have the mean 1; otherwise they are parts of their sum.
  bool drawn = false;
  double largest_weight = 1;  // none is above
  std::function<FlownEncounter(std::uint64_t index)> at;
};

/// A table with the columns encounter, body, t, x, y, z and maybe weight (docs/reference/formats.md,
/// "Encounters"), or a population (.yaml) for a scenario of two bodies, drawn by the scenario's seed. Throws
/// InputError naming the file, and line or field.
[[nodiscard]] EncounterSet read_encounters(const std::string& file, const simulation::Scenario& scenario);

/// The scenario on that encounter. `equipped`: bodies with a pilot start there and are flown by it; otherwise
/// no pilot flies, and they follow their ways too. Who follows a way of three places or more keeps its
/// attitude at the start.
[[nodiscard]] simulation::Scenario on_encounter(simulation::Scenario scenario,
                                                const FlownEncounter& encounter, bool equipped);

}  // namespace vericone::encounters
