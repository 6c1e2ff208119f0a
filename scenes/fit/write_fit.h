// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/fits/fit_files.h>
#include <vector>

#include "fit/hull_files.h"
#include "json/json_forward.h"

namespace vericone::fit {

/// The fields of each piece for scenes (fit_body.h), enclosing what is proved to be inside.
std::vector<Json> bodies_of(const fitting::FitResult& result, const fitting::Sample& sample);

/// "mesh.ply: containing, biconcave, 2 pieces"
std::string title_of(const fits::Scan& scan, const fitting::FitResult& result);

/// `json`: fit_json() with what else is known.
void write_files(const Json& json, const std::vector<Json>& bodies, const std::string& title,
                 const std::vector<CombinedSurface>& surfaces, const std::filesystem::path& folder);

}  // namespace vericone::fit
