// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/fitting/fit.h>
#include <vericone/geometry/combined_surface.h>
#include <nlohmann/json.hpp>

#include "fit/fit_sample.h"

namespace vericone::fit {

/// What apps/figures/fit.py draws: the scan, thinned to what a picture shows, and the pieces of the hull.
nlohmann::ordered_json fit_picture(const Scan& scan, const fitting::FitResult& result,
                                   const std::vector<CombinedSurface>& surfaces, const std::string& title);

}  // namespace vericone::fit
