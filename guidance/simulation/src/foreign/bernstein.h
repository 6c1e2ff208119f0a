// SPDX-License-Identifier: BSD-3-Clause
//
// Vectors that are polynomials of a piece of time, by their Bernstein coefficients over it: the curve lies in
// the hull of these.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

namespace vericone::simulation {

using ControlPoints = std::vector<Eigen::Vector3d>;

inline constexpr int kMostDegree = 9;

inline int degree_of(const ControlPoints& points) { return static_cast<int>(points.size()) - 1; }

/// n over k, n <= 18: exact.
inline double binomial(int n, int k) {
  double c = 1;
  for (int i = 0; i < k; ++i) c = c * (n - i) / (i + 1);
  return c;
}

/// At tau in [0, 1].
inline Eigen::Vector3d value_at(ControlPoints p, double tau) {
  for (std::size_t n = p.size() - 1; n > 0; --n)
    for (std::size_t k = 0; k < n; ++k) p[k] += tau * (p[k + 1] - p[k]);
  return p[0];
}

/// By tau.
inline ControlPoints derivative_of(const ControlPoints& p) {
  if (p.size() == 1) return {Eigen::Vector3d::Zero()};
  ControlPoints d(p.size() - 1);
  for (std::size_t k = 0; k < d.size(); ++k) d[k] = degree_of(p) * (p[k + 1] - p[k]);
  return d;
}

/// On the part [from, to] of [0, 1], from < to.
inline ControlPoints part_of(ControlPoints p, double from, double to) {
  const std::size_t n = p.size() - 1;
  if (to < 1)
    for (std::size_t j = 1; j <= n; ++j)
      for (std::size_t k = n; k >= j; --k) p[k] = p[k - 1] + to * (p[k] - p[k - 1]);
  if (from > 0) {
    const double s = from / to;
    for (std::size_t j = 1; j <= n; ++j)
      for (std::size_t k = 0; k + j <= n; ++k) p[k] += s * (p[k + 1] - p[k]);
  }
  return p;
}

/// Not below the length of the vector anywhere.
inline double most_of(const ControlPoints& p) {
  double most = 0;
  for (const Eigen::Vector3d& x : p) most = std::max(most, x.norm());
  return most;
}

}  // namespace vericone::simulation
