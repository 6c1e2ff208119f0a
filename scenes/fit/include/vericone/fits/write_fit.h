// SPDX-License-Identifier: BSD-3-Clause
//
// A fitted hull as files (docs/reference/formats.md, fits).
#pragma once

#include <vericone/fits/read_scan.h>
#include <vericone/fitting/fit.h>
#include <filesystem>
#include <string>

namespace vericone::fits {

/// The hull as a body for scenes, YAML: what stands there under `obstacle`, or a list `pieces` of bodies.
/// Where the result is certified the bodies that scenes read from it contain, in exact arithmetic, every
/// point of the sample that the quadrics contain. `comment` is its first line. Throws std::runtime_error
/// where no fields do that.
[[nodiscard]] std::string body_text(const fitting::FitResult& result, const fitting::Sample& sample,
                                    const std::string& comment);

/// fit.json, body.yaml, hull.obj and hull.ply into `folder`, which must exist. `options` are those that the
/// result was made with; `seconds` what it took. Throws std::system_error naming the path that cannot be
/// written, and as body_text().
void write_fit(const Scan& scan, const fitting::FitOptions& options, const fitting::FitResult& result,
               double seconds, const std::filesystem::path& folder);

}  // namespace vericone::fits
