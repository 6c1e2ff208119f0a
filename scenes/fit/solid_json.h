// SPDX-License-Identifier: BSD-3-Clause
//
// Hulls of solids (capsules, boxes, ...) as JSON and as bodies that scenes read.
#pragma once

#include <vericone/fits/fit_files.h>
#include <vericone/internal/fitting/solids.h>
#include <string>
#include <vector>

#include "json/json_forward.h"

namespace vericone::fit {

/// The body fields of a solid: `center`, `rotation`, and its word with its sizes; of a sphere and an
/// ellipsoid `semi_axes`. What is proved is proved of these numbers.
Json solid_fields(const fitting::Solid& solid);

/// Back again. Throws InputError naming the field below `path`.
fitting::Solid solid_of(const Json& fields, const std::string& path);

/// What exact arithmetic says, in one sentence.
std::string solid_statement(const fitting::SolidFit& result, const fits::Scan& scan);

/// "3 boxes, 1 capsule"
std::string counts_of(const std::vector<fitting::Solid>& solids);

/// The fields of fit_json(); those of quadrics are null. `shape`: the kinds, with commas.
Json solid_fit_json(const fits::Scan& scan, const fitting::SolidOptions& options, const std::string& shape,
                    const fitting::SolidFit& result);

}  // namespace vericone::fit
