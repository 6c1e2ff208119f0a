// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/montecarlo/campaign.h>
#include <iosfwd>
#include <string>

#include "json/json_forward.h"

namespace vericone::montecarlo {

Json to_json(const Summary& summary);

/// One row a law.
std::string summary_csv(const Summary& summary);
void print_summary(const Summary& summary, std::ostream& out);

}  // namespace vericone::montecarlo
