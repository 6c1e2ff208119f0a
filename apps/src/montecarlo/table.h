// SPDX-License-Identifier: BSD-3-Clause
//
// The campaign's table: one row an engagement (columns: docs/measured/campaign.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "montecarlo/outcome.h"

namespace vericone::montecarlo {

struct Row {
  double distance = 0, speed_agent = 0, speed_obstacle = 0, closing = 0;  // m, m/s
  StraightOutcome straight;
  std::vector<Outcome> outcomes;  // one a law
};

Row measure(std::uint64_t seed, std::uint64_t index, const std::vector<Flown>& laws,
            const FlightSettings& settings);

std::string csv_header(const std::vector<Flown>& laws);
std::string csv_row(std::uint64_t index, const Row& row);
/// Throws std::runtime_error naming file and line.
std::vector<Row> read_table(const std::filesystem::path& file, std::size_t laws);

}  // namespace vericone::montecarlo
