// SPDX-License-Identifier: BSD-3-Clause
//
// A fitted hull as JSON (docs/reference/formats.md), and what is proved of it in words.
#pragma once

#include <vericone/fits/fit_files.h>
#include <vericone/fitting/fit.h>
#include <optional>
#include <string>

#include "json/json_forward.h"

namespace vericone::fit {

std::string to_string(fitting::Mode mode);

/// "all 8 points", "7 of 8 points"
std::string of_all(std::size_t part, std::size_t all, const std::string& what);

/// What fits of quadrics and of solids write alike.
Json certificate_json(const fitting::Certificate& certificate, bool mesh, const std::string& statement);
Json distance_json(const std::optional<fitting::DistanceStatistics>& distance);

/// What exact arithmetic says, in one sentence.
std::string statement(const fitting::FitResult& result, const fits::Scan& scan);

/// Every field is always there; null: does not apply or is not known. `bodies`: the fields of each piece for
/// scenes (fit_body.h).
Json fit_json(const fits::Scan& scan, const fitting::FitOptions& options, const fitting::FitResult& result,
              const std::vector<Json>& bodies);

}  // namespace vericone::fit
