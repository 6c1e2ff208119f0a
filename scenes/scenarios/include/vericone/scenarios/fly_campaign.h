// SPDX-License-Identifier: BSD-3-Clause
//
// A campaign with its table as a file, which grows and can be gone on with (docs/measured/campaign.md).
#pragma once

#include <vericone/simulation/montecarlo/campaign.h>
#include <vericone/simulation/montecarlo/summary.h>
#include <vericone/simulation/table.h>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace vericone::scenario {

struct CampaignOptions {
  std::optional<std::filesystem::path> out = {};  // folder for engagements.csv
  int threads = 0;                                // 0: one per processor
  bool resume = true;                             // go on with an unfinished table; otherwise it begins anew
  /// Called with the share done, 0 to 1, as rows come; false stops.
  std::function<bool(double)> progress = nullptr;
};

struct FlownCampaign {
  simulation::Table table;  // a row for each engagement
  montecarlo::Summary summary;
  std::uint64_t violations = 0;  // flights that met and that a proved statement had called safe: none
  bool finished = true;          // false where `progress` stopped it
};

/// Flies the engagements that are missing. engagements.csv is in `out` once all are there, until then
/// engagements.csv.partial; the result does not depend on threads and stops. Throws InputError naming a
/// setting, "threads", or "out" where it cannot be written to, another run writes to it, or it holds an
/// unfinished run of other settings. Cost: 3 ms an engagement of four laws.
[[nodiscard]] FlownCampaign fly_campaign(const montecarlo::Campaign& campaign,
                                         const CampaignOptions& options = {});

}  // namespace vericone::scenario
