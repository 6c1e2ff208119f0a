// SPDX-License-Identifier: BSD-3-Clause
//
// What proves an answer about hulls, written once over the type of number. A plane proves that a line, or the
// bodies, stay apart; a convex combination of points proves that they meet.
#pragma once

#include <vericone/internal/geometry/tracked.h>
#include <array>

#include "ellipsoids/contact_polynomial.h"
#include "hulls/scene.h"

namespace vericone {

/// Positive iff the combination sum weight_t d_t, seen along w, is strictly inside the ellipse that the
/// ellipsoid casts: sigma^2 det M - x^T adj(M) x, M = L S L^T, x = sum weight_t L d_t, sigma = sum weight_t.
/// Coordinates in the order i, j, k; w = (u, v, 1).
template <typename N, typename Shape>
constexpr N shadow_depth(const Shape& shape, const std::array<std::array<N, 3>, 3>& d,
                         const std::array<N, 3>& weight, const N& minus_u, const N& minus_v) {
  const auto m = affine_shadow<N>(shape, minus_u, minus_v, 0, 1, 2);
  const auto along = [&](int r, const N& minus_slope) {
    const auto term = [&](int t) { return weight[t] * (d[t][r] + minus_slope * d[t][2]); };
    return term(0) + term(1) + term(2);
  };
  const N x = along(0, minus_u), y = along(1, minus_v), sigma = weight[0] + weight[1] + weight[2];
  const N off = x * y * m.b;
  return sigma * sigma * (m.a * m.c - m.b * m.b) - (x * x * m.c + y * y * m.a - (off + off));
}

/// x_1 y_2 - x_2 y_1 of two points seen along w = (u, v, 1).
template <typename N>
constexpr N shadow_cross(const std::array<N, 3>& p, const std::array<N, 3>& q, const N& minus_u,
                         const N& minus_v) {
  return (p[0] + minus_u * p[2]) * (q[1] + minus_v * q[2]) -
         (p[1] + minus_v * p[2]) * (q[0] + minus_u * q[2]);
}

/// Roundings on the way to these. A centred point: 1. S: 3 (three products of factors summed). u, v: 3 (two
/// differences of velocities, the quotient). The weights are taken as they are.
constexpr auto kHullCount = [] {
  struct Counts {
    RoundingCount depth, cross;
  };
  constexpr RoundingCount kPoint{1}, kShape{3}, kSlope{3}, kInput{0};
  constexpr RoundingCount kDifference = kPoint - kPoint;
  constexpr std::array<RoundingCount, 3> kD{kDifference, kDifference, kDifference};
  return Counts{shadow_depth<RoundingCount>([kShape](int, int) { return kShape; }, {kD, kD, kD},
                                            {kInput, kInput, kInput}, kSlope, kSlope),
                shadow_cross<RoundingCount>(kD, kD, kSlope, kSlope)};
}();

/// Products below the smallest normal number lose more than a relative rounding. All factors are below 2^40
/// or so, hence all such losses together stay far below this.
constexpr double kHullUnderflow = 1e-250;

/// Bounds below are sums of at most a dozen non-negative terms.
constexpr double kRoundUp = 1 + 0x1p-48;

/// An upper bound of rho(n) = sqrt(n^T S n), |n_k| <= 2; 0 without an ellipsoid.
double radius_above(const HullScene& scene, const Eigen::Vector3d& n) noexcept;

/// Whether n.x > 0 on all of K, by the bounds of the first rung. `support` belongs to `near`, a vector close
/// to n. True is certain.
bool triage_ahead_of(const HullScene& scene, const Eigen::Vector3d& near, const HullSupport& support,
                     const Eigen::Vector3d& n) noexcept;

/// The same in intervals.
bool interval_ahead_of(const HullScene& scene, const Eigen::Vector3d& near, const HullSupport& support,
                       const Eigen::Vector3d& n) noexcept;

/// n . w in the two arithmetics, w off by one rounding in the first: 1 or -1 where certain, else 0.
int triage_side(const Eigen::Vector3d& n, const Eigen::Vector3d& w) noexcept;
int interval_side(const Eigen::Vector3d& n, const std::array<Interval, 3>& w) noexcept;

/// b - a, centred and scaled, enclosed.
std::array<Interval, 3> enclosed_difference(const HullScene& scene, HullPair pair) noexcept;

/// Whether the combination of `count` <= 4 points is in the interior of the ellipsoid, in space.
bool interval_inside(const HullScene& scene, const HullPair* pairs, const double* weights,
                     int count) noexcept;

/// Whether the tetrahedron of four points has the origin in its interior.
bool interval_surrounds(const HullScene& scene, const HullPair* pairs) noexcept;

}  // namespace vericone
