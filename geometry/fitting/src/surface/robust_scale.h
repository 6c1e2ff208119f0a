// SPDX-License-Identifier: BSD-3-Clause
//
// The size of residuals most of which are noise.
#pragma once

#include <vector>

namespace vericone::fitting {

/// A weight and the size of a residual.
struct Residual {
  double size = 0, weight = 0;
};

/// Least size that `share` of the weight does not exceed. Reorders.
double weighted_quantile(std::vector<Residual>& residuals, double share);

/// Standard deviation of the normal part of residuals, some of which are gross: the median gives a first
/// value; then the mean square within 2.5 deviations, over what it is for normal residuals, until it stays.
/// At least `floor`.
double robust_scale(std::vector<Residual> residuals, double floor);

}  // namespace vericone::fitting
