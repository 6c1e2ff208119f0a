// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/fitting/sample.h>
#include <optional>
#include <string>

namespace vericone::fit {

/// One sentence about the point farthest from the others, where all of them are to be inside and this one
/// alone makes the minimum-volume ellipsoid half as large again or larger; nothing otherwise.
std::optional<std::string> outlier_note(const fitting::Sample& sample);

}  // namespace vericone::fit
