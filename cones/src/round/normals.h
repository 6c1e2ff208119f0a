// SPDX-License-Identifier: BSD-3-Clause
//
// Where the origin lies in a difference of round bodies: a search for normals n with h_K(n) <= 0, with as
// many digits as it needs.
//
// All directions are four triangles of a fan. A direction n that is tried and has h_K(n) > 0 gives a point x
// of K with n.x > 0; no normal with h_K <= 0 is on that side, and the side is cut off, with a margin for what
// was rounded. Tried is the centre of gravity of the largest part that is left, so that each cut takes at
// least a third of it. Nothing left: the origin is inside. One with h_K(n) < 0: outside. A part that shrinks
// to a point: a touch, whose normal is looked for among rationals; where h_K(n) = 0 exactly, the face of K
// there decides. Never wrong; a touch with an irrational normal stays undecided.
#pragma once

#include <vericone/cones/answers.h>

#include "round/silhouette.h"

namespace vericone::round {

struct Place {
  std::optional<Relation> relation;  // of the bodies whose difference K is
  IntegerVector<3> normal{0, 0, 0};  // h_K < 0 there where disjoint, 0 where touching
};

[[nodiscard]] Place place_of_origin(const LatticeDifference& k);

/// Whether the origin is in the face of K where h_K(n) = 0.
[[nodiscard]] bool origin_in_face(const LatticeDifference& k, const IntegerVector<3>& n);

/// The fraction with the least denominator in [lo, hi], lo <= hi, of denominators > 0.
struct Ratio {
  Integer numerator, denominator;
};
[[nodiscard]] Ratio simplest_between(const Ratio& lo, const Ratio& hi);

}  // namespace vericone::round
