// SPDX-License-Identifier: BSD-3-Clause
//
// A page that shows each figure beside what the source claims with it; one file, nothing loaded.
#pragma once

#include <string>
#include <vector>

#include "claim.h"
#include "figure.h"

namespace vericone::dhal2022 {

struct ReportFigure {
  Figure figure;
  std::string png;  // the picture's bytes; empty: not made
  Json provenance;  // of this figure
};

/// `provenance`: of the claims.
std::string report_html(const std::vector<ReportFigure>& figures, const std::vector<Claim>& claims,
                        const Json& provenance);

/// How many results and given values got each verdict.
Json count_verdicts(const std::vector<Claim>& claims);

}  // namespace vericone::dhal2022
