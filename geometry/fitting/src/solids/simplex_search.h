// SPDX-License-Identifier: BSD-3-Clause
//
// Nelder and Mead's search for a minimum without derivatives (The Computer Journal 7, 1965).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

namespace vericone::fitting {

template <std::size_t N>
struct Minimum {
  std::array<double, N> at{};
  double value = 0;
};

/// From a simplex with edges `step` at `start`; ends after `evaluations` or where the values differ by less
/// than 1e-9 of themselves.
template <std::size_t N, typename Function>
Minimum<N> search_minimum(const std::array<double, N>& start, const std::array<double, N>& step,
                          int evaluations, const Function& value) {
  constexpr double kEqual = 1e-9;
  using Point = std::array<double, N>;
  std::array<Minimum<N>, N + 1> corners;
  corners[0] = {start, value(start)};
  for (std::size_t k = 0; k < N; ++k) {
    Point x = start;
    x[k] += step[k];
    corners[k + 1] = {x, value(x)};
  }
  const auto less = [](const Minimum<N>& a, const Minimum<N>& b) { return a.value < b.value; };
  for (int count = int(N) + 1; count < evaluations;) {
    std::stable_sort(corners.begin(), corners.end(), less);
    Minimum<N>& worst = corners[N];
    if (!(worst.value - corners[0].value > kEqual * corners[0].value)) break;
    Point middle{};
    for (std::size_t k = 0; k < N; ++k)
      for (std::size_t i = 0; i < N; ++i) middle[k] += corners[i].at[k] / double(N);
    const auto along = [&](double by) {
      Point x{};
      for (std::size_t k = 0; k < N; ++k) x[k] = middle[k] + by * (worst.at[k] - middle[k]);
      ++count;
      return Minimum<N>{x, value(x)};
    };
    const Minimum<N> reflected = along(-1);
    if (reflected.value < corners[0].value) {
      const Minimum<N> farther = along(-2);
      worst = less(farther, reflected) ? farther : reflected;
    } else if (reflected.value < corners[N - 1].value) {
      worst = reflected;
    } else {
      const Minimum<N> nearer = along(reflected.value < worst.value ? -0.5 : 0.5);
      if (nearer.value < std::min(worst.value, reflected.value)) {
        worst = nearer;
        continue;
      }
      for (std::size_t i = 1; i <= N; ++i) {
        for (std::size_t k = 0; k < N; ++k) corners[i].at[k] = 0.5 * (corners[i].at[k] + corners[0].at[k]);
        corners[i].value = value(corners[i].at);
        ++count;
      }
    }
  }
  return *std::min_element(corners.begin(), corners.end(), less);
}

}  // namespace vericone::fitting
