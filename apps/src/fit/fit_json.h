// SPDX-License-Identifier: BSD-3-Clause
//
// A fitted hull as JSON (docs/formats.md), and what is proved of it in words.
#pragma once

#include <vericone/fitting/fit.h>
#include <nlohmann/json.hpp>

#include "fit/fit_sample.h"

namespace vericone::fit {

std::string to_string(fitting::Mode mode);

/// What exact arithmetic says, in one sentence.
std::string statement(const fitting::FitResult& result, const Scan& scan);

/// Every field is always there; null: does not apply or is not known. `bodies`: the fields of each piece for
/// scenes (fit_body.h).
nlohmann::ordered_json fit_json(const Scan& scan, const fitting::FitOptions& options,
                                const fitting::FitResult& result,
                                const std::vector<nlohmann::ordered_json>& bodies);

}  // namespace vericone::fit
