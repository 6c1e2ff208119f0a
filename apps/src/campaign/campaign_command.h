// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "command/default_seed.h"
#include "output/output_options.h"

namespace vericone::montecarlo {

struct CampaignOptions : OutputOptions {
  CampaignOptions() { out = "out/campaign"; }
  std::uint64_t engagements = 10'000;
  std::uint64_t seed = kDefaultSeed;
  std::vector<std::string> laws{"slice", "exact", "motion", "clearance"};
  double most = 15;         // m/s^2
  double gain = 4;          // 1/s
  double reference = 0.05;  // w
  double required = 1;      // m
  double step = 0.05;       // s
};

/// Random engagements under every law, with a proof of what became of each. Returns the exit status: 1 where
/// a run met that a proved statement called safe, 130 interrupted. Throws InputError naming the option.
int run_campaign(const CampaignOptions& options, std::ostream& out);

}  // namespace vericone::montecarlo
