// SPDX-License-Identifier: BSD-3-Clause
#include "surface/robust_scale.h"

#include <algorithm>
#include <cmath>

namespace vericone::fitting {

double weighted_quantile(std::vector<Residual>& residuals, double share) {
  std::sort(residuals.begin(), residuals.end(), [](const Residual& x, const Residual& y) {
    return x.size < y.size || (x.size == y.size && x.weight < y.weight);
  });
  double all = 0, sum = 0;
  for (const Residual& r : residuals) all += r.weight;
  for (const Residual& r : residuals) {
    sum += r.weight;
    // The slack keeps the choice where the sum of equal weights meets the share to rounding.
    if (sum >= share * all * (1 - 1e-9)) return r.size;
  }
  return residuals.empty() ? 0 : residuals.back().size;
}

double robust_scale(std::vector<Residual> residuals, double floor) {
  // Median of |x| and mean of x^2 within 2.5 deviations of a standard normal variable.
  constexpr double kMedian = 0.6744897501960817, kWithin = 2.5, kMeanSquare = 0.9112563609353919;
  double scale = std::max(floor, weighted_quantile(residuals, 0.5) / kMedian);
  std::vector<double> weights{0}, squares{0};
  for (const Residual& r : residuals) {
    weights.push_back(weights.back() + r.weight);
    squares.push_back(squares.back() + r.weight * r.size * r.size);
  }
  for (int i = 0; i < 100; ++i) {
    const auto end = std::upper_bound(residuals.begin(), residuals.end(), kWithin * scale,
                                      [](double x, const Residual& r) { return x < r.size; }) -
                     residuals.begin();
    const auto k = static_cast<std::size_t>(end);
    if (weights[k] <= 0) break;
    const double next = std::max(floor, std::sqrt(squares[k] / weights[k] / kMeanSquare));
    if (next == scale) break;
    scale = next;
  }
  return scale;
}

}  // namespace vericone::fitting
