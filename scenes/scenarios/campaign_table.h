// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/montecarlo/campaign.h>
#include <vector>

#include "work/resumable_table.h"

namespace vericone::scenario {

/// engagements.csv, a row for each engagement of a campaign, which must outlive it.
work::ResumableTable campaign_table(const montecarlo::Campaign& campaign,
                                    const std::vector<montecarlo::Flown>& laws, int threads);

}  // namespace vericone::scenario
