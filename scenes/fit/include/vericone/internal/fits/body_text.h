// SPDX-License-Identifier: BSD-3-Clause
//
// A fitted body as text.
#pragma once

#include <vericone/fits/fit_files.h>
#include <string>

namespace vericone::fits {

/// The hull as a body for scenes, YAML: what stands there under `obstacle`, or a list `pieces` of bodies.
/// Where the result is certified the bodies that scenes read from it contain, in exact arithmetic, every
/// point of the sample that the quadrics contain. `comment` is its first line. Throws std::runtime_error
/// where no fields do that.
[[nodiscard]] std::string body_text(const fitting::FitResult& result, const fitting::Sample& sample,
                                    const std::string& comment);

}  // namespace vericone::fits
