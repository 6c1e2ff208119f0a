// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vericone::testing {

/// f'(0) by central differences at h, h/2, h/4, extrapolated: error of order h^6 f^(7) plus rounding / h.
template <typename Function>
double richardson_derivative(Function&& f, double h) {
  double d[3];
  for (int i = 0; i < 3; ++i, h /= 2) d[i] = (f(h) - f(-h)) / (2 * h);
  const double first = (4 * d[1] - d[0]) / 3, second = (4 * d[2] - d[1]) / 3;
  return (16 * second - first) / 15;
}

}  // namespace vericone::testing
