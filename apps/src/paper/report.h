// SPDX-License-Identifier: BSD-3-Clause
//
// A page that shows each figure beside what the source claims with it; one file, nothing loaded.
#pragma once

#include <string>
#include <vector>

#include "paper/paper.h"

namespace vericone::paper {

struct ReportFigure {
  Figure figure;
  std::string png;  // the picture's bytes; empty: not made
  Json provenance;  // of this figure
};

/// `provenance`: of the claims.
std::string report_html(const Paper& paper, const std::vector<ReportFigure>& figures,
                        const std::vector<Claim>& claims, const Json& provenance);

}  // namespace vericone::paper
