// SPDX-License-Identifier: BSD-3-Clause
//
// The sign of the least value of a support function on a line of normals: whether a straight line meets a
// body of round pieces, and whether a plane that turns about an edge can part two bodies.
//
// Along n(t) = u + t v the support function of K = obstacle - agent is convex: the largest of functions f,
// one for each pair of pieces, each the sum of a linear term l and at most three roots of quadratic ones, q
// (branches.h). Its least value is bracketed by bisection with exact signs, and nearly always decided there.
// Bisection alone would not end at a least value of 0. That is attained where some q vanishes (a disc
// edge-on: a rational t), at a multiple root of the norm of one f (f = f' = 0), or at a common root of the
// norms of two (a corner of the largest): those few roots in the bracket are tried, exactly, and where none
// is a zero bisection goes on and ends.
#pragma once

#include <vericone/internal/geometry/exact/algebraic.h>
#include <array>
#include <optional>
#include <vector>

#include "round/root_sum.h"

namespace vericone::round {

using exact::Dyadic;

/// p + { F x : |x| <= 1 } on a lattice; shape = F F^T, of any rank.
struct LatticePiece {
  IntegerVector<3> p;
  IntegerMatrix<3> shape;
  bool round = false;  // shape is not 0
};

/// K: h_K(n) = max n.b + sqrt(n'Sn) over `obstacle` + the same over `agent` (mirrored) + margin |n|.
struct LatticeDifference {
  std::vector<LatticePiece> obstacle, agent;
  Integer squared_margin = 0;
};

/// Two directions that span the plane orthogonal to w, of lengths about that of w.
struct Plane {
  IntegerVector<3> u{0, 0, 0}, v{0, 0, 0};

  explicit Plane(const IntegerVector<3>& w) {
    int k = 0;
    for (int i = 1; i < 3; ++i)
      if (abs(w[i]) > abs(w[k])) k = i;
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    u[i] = v[j] = w[k];
    u[k] = -w[i];
    v[k] = -w[j];
  }
};

[[nodiscard]] inline Integer inner(const IntegerVector<3>& x, const IntegerVector<3>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// Sign of h_K(n).
[[nodiscard]] int support_sign(const LatticeDifference& k, const IntegerVector<3>& n);

/// Sign of the least value of h_K on the plane of normals spanned by u and v, which are independent, without
/// 0. -1: 0 is outside the image of K under (u, v); 0: on its boundary; 1: in its interior.
[[nodiscard]] int least_support_sign(const LatticeDifference& k, const IntegerVector<3>& u,
                                     const IntegerVector<3>& v);

}  // namespace vericone::round
