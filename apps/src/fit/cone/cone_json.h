// SPDX-License-Identifier: BSD-3-Clause
//
// A comparison of cones as JSON, as a table, and for apps/figures/fit_cones.py.
#pragma once

#include <iosfwd>
#include <string>

#include "fit/cone/cone_comparison.h"
#include "json/json_forward.h"

namespace vericone {

/// docs/measured/fitting-cones.md has the fields.
Json cones_json(const ConeComparison& comparison);

void print_cones(const ConeComparison& comparison, std::ostream& out);

/// To be written as `fit_cones.json` into the folder given to draw_figures("fit_cones.py", folder).
Json cones_picture(const ConeComparison& comparison, const std::string& title);

}  // namespace vericone
