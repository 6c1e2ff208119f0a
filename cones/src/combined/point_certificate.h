// SPDX-License-Identifier: BSD-3-Clause
//
// What one point says of a list of quadratic inequalities: near a tangency most lists are decided from there.
#pragma once

#include <vericone/internal/geometry/decompositions.h>
#include <cmath>
#include <vector>

#include "balance.h"
#include "quadratic_search.h"

namespace vericone {

/// At a tangency some multipliers lambda >= 0 make the gradients cancel. A moment before, the combination
/// sum lambda_i q_i is positive there, and where it is convex it is positive everywhere: `empty`, from one
/// point instead of many boxes. A moment after, a step that makes all of them alike leads inside: `found`,
/// and `z` is such a point. Otherwise nothing is said. Both answers are certain. Cost: about 1 us, no
/// allocation.
template <int N>
SearchOutcome decide_from(const std::vector<QuadraticConstraint<N>>& list, const SearchBox<N>& box,
                          Eigen::Matrix<double, N, 1>& z) {
  using Vector = Eigen::Matrix<double, N, 1>;
  /// Distances in units of the bodies: what is farther away plays no part in a tangency.
  constexpr double kNear = 1e-3;
  const auto in_box = [&](const Vector& x) {
    return ((x - box.middle).cwiseAbs() - box.half).maxCoeff() <= 0;  // where the slacks hold
  };
  if (!in_box(z)) return SearchOutcome::undecided;
  Balance<N> balance;
  for (int i = 0; i < static_cast<int>(list.size()); ++i) {
    typename Balance<N>::Bound bound;
    const double value = list[i].evaluate(z, bound.slope), size = bound.slope.norm();
    if (!(size > 0) || value < -kNear * size) continue;
    bound.index = i;
    bound.scale = 1 / size;
    bound.base = value * bound.scale;
    bound.slope *= bound.scale;
    balance.offer(bound);
  }
  if (!balance.solve()) return SearchOutcome::undecided;
  if (balance.base() <= 0) {
    const Vector x = z + balance.levelling_step();
    if (!x.allFinite() || !in_box(x)) return SearchOutcome::undecided;
    for (const QuadraticConstraint<N>& q : list) {
      Vector gradient;
      if (!(q.evaluate(x, gradient) + q.slack <= 0)) return SearchOutcome::undecided;
    }
    z = x;
    return SearchOutcome::found;
  }
  // The combination at z + d is base + rest.d + d^T H d or more.
  Eigen::Matrix<double, N, N> h = Eigen::Matrix<double, N, N>::Zero();
  double slack = 0, size = 0;
  for (int i = 0; i < balance.count(); ++i) {
    const auto& bound = balance[i];
    const QuadraticConstraint<N>& q = list[bound.index];
    const double weight = bound.weight * bound.scale;
    h += weight * q.h;
    slack += 2 * weight * q.slack;  // once more for what the gradients were rounded
    size += bound.weight * std::abs(bound.base) + weight * q.h.norm();
  }
  const auto above = [&](const Vector& x, double base, const Vector& rest) {
    const Vector reach = box.half + (x - box.middle).cwiseAbs();
    const double room = base - slack - rest.cwiseAbs().dot(reach) - 1e-14 * (size + reach.sum());
    if (!(room > 0)) return false;
    // It may bend down by room / |d|^2. What Cholesky's method rounds is far below 1e-14 |H|.
    Eigen::Matrix<double, N, N> bent = h;
    bent.diagonal().array() += 0.99 * room / reach.squaredNorm() - 1e-14 * size;
    return cholesky<N>(bent).positive;
  };
  if (above(z, balance.base(), balance.rest())) return SearchOutcome::empty;
  // Once more at its lowest point.
  Eigen::Matrix<double, N, N> eliminated = h;
  Vector down = balance.rest();
  solve_square(eliminated, down);
  const Vector x = z - 0.5 * down;
  if (!x.allFinite() || !in_box(x)) return SearchOutcome::undecided;
  double base = 0;
  Vector rest = Vector::Zero();
  for (int i = 0; i < balance.count(); ++i) {
    Vector gradient;
    const double weight = balance[i].weight * balance[i].scale;
    base += weight * list[balance[i].index].evaluate(x, gradient);
    rest += weight * gradient;
  }
  return above(x, base, rest) ? SearchOutcome::empty : SearchOutcome::undecided;
}

}  // namespace vericone
