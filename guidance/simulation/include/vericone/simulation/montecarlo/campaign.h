// SPDX-License-Identifier: BSD-3-Clause
//
// A campaign: random engagements under every law, with a proof of what became of each
// (docs/measured/campaign.md).
#pragma once

#include <vericone/simulation/montecarlo/outcome.h>
#include <cstdint>
#include <string>
#include <vector>

namespace vericone::montecarlo {

/// What decides every row.
struct Campaign {
  std::uint64_t engagements = 10'000, seed = 1;
  std::vector<std::string> laws{"slice", "exact", "motion", "clearance"};
  FlightSettings flight;
};

/// The laws that are flown: those named, each with saturation and without. Throws InputError naming
/// "engagements", "laws", "most", "gain", "reference", "required" or "step".
[[nodiscard]] std::vector<Flown> laws_of(const Campaign& campaign);

/// The first line of its table: whoever goes on with an unfinished table compares it.
[[nodiscard]] std::string settings_line(const Campaign& campaign);

}  // namespace vericone::montecarlo
