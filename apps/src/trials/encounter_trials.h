// SPDX-License-Identifier: BSD-3-Clause
//
// Trials on encounters: what became of each under every law and without any, and the risk ratios.
#pragma once

#include <vericone/simulation/run_tables.h>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "json/json_forward.h"
#include "scenarios/encounters/encounter_set.h"
#include "scenarios/encounters/near_miss.h"

namespace vericone::trials {

struct Encounters {
  encounters::EncounterSet set;
  std::vector<encounters::Volume> volumes;
  std::string file;
};

/// Of a law's cell, after the name: its columns beside those of other trials, and what they say of a flight.
std::string encounter_columns(const std::string& cell, const Encounters& with);
std::string encounter_cells(const simulation::Scenario& flown, const simulation::Run& run,
                            const std::vector<bool>& agents, const Encounters& with);

/// From the table's rows, whose cells are these; the first is without any law.
Json encounters_json(const simulation::Table& rows, const std::vector<std::string>& cells,
                     const Encounters& with);
void print_encounters(const Json& summary, std::ostream& out);

}  // namespace vericone::trials
