// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/fitting/fit.h>
#include <vericone/geometry/mesh/surface.h>

#include <vericone/fits/fit_files.h>
#include "json/json_forward.h"

namespace vericone::fit {

/// What apps/figures/fit.py draws: the scan, thinned to what a picture shows, and the pieces of the hull.
Json fit_picture(const fits::Scan& scan, const fitting::FitResult& result,
                 const std::vector<CombinedSurface>& surfaces, const std::string& title);

/// The same of solids, and the points that touch them.
Json solid_picture(const fits::Scan& scan, const std::vector<CombinedSurface>& surfaces,
                   const std::vector<Eigen::Vector3d>& touching, const std::string& title);

}  // namespace vericone::fit
