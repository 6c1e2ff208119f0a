// SPDX-License-Identifier: BSD-3-Clause
//
// Which shape, and why; and what a user should know of a fit.
#pragma once

#include <vericone/fitting/fit.h>
#include <vericone/internal/fitting/canonical.h>
#include <string>
#include <vector>

namespace vericone::fitting {

/// Log of the volume (containing) or of the noise (near the points), and kPricePerParameter for each
/// parameter; infinite where a surface has not converged.
void score(Candidate& candidate, Mode mode);

/// A parameter has to take away 1 % of volume or noise.
inline constexpr double kPricePerParameter = 0.01;

std::string explain_choice(const std::vector<Candidate>& candidates, Shape chosen, Mode mode);

/// Single points that make the hull much larger, what is not seen, what is not proved, delimiters that cut
/// nothing.
std::vector<std::string> remarks(const Sample& sample, const CanonicalSample& canon,
                                 const std::vector<char>& kept, const FitResult& result,
                                 const FitOptions& options);

}  // namespace vericone::fitting
