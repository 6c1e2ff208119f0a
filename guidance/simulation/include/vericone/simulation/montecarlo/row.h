// SPDX-License-Identifier: BSD-3-Clause
//
// A campaign's table: one row an engagement (columns: docs/measured/campaign.md).
#pragma once

#include <vericone/simulation/montecarlo/outcome.h>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vericone::montecarlo {

/// One engagement under every law.
struct Row {
  double distance = 0, speed_agent = 0, speed_obstacle = 0, closing = 0;  // m, m/s
  StraightOutcome straight;
  std::vector<Outcome> outcomes;  // one a law
};

/// Engagement `index` of a campaign. Depends on its arguments alone. Cost: 3 ms for four laws.
[[nodiscard]] Row measure(std::uint64_t seed, std::uint64_t index, const std::vector<Flown>& laws,
                          const FlightSettings& settings);

/// The line of columns, and a row as a line, both without their ends.
[[nodiscard]] std::string csv_header(const std::vector<Flown>& laws);
[[nodiscard]] std::string csv_row(std::uint64_t index, const Row& row);
/// The row of such a line, of as many laws. Throws InputError naming "row" for another.
[[nodiscard]] Row row_of(const std::string& line, std::size_t laws);
/// Reads a file of a line of settings, csv_header() and rows. Throws InputError naming file and line.
[[nodiscard]] std::vector<Row> read_table(const std::filesystem::path& file, std::size_t laws);

}  // namespace vericone::montecarlo
