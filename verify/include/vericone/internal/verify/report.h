// SPDX-License-Identifier: GPL-3.0-or-later
//
// The campaigns as text.
#pragma once

#include <cstdint>
#include <string>

namespace vericone::verify {

/// The tables of docs/measured/planar-accuracy.md: both planar methods over `cases` pairs of every family.
/// Markdown. About 50 ms a case.
[[nodiscard]] std::string planar_report(std::uint64_t cases, std::uint64_t seed);

/// The tables of docs/measured/spatial-checks.md: `cases` pairs of every family. About 0.15 s a case.
[[nodiscard]] std::string spatial_report(std::uint64_t cases, std::uint64_t seed);

}  // namespace vericone::verify
