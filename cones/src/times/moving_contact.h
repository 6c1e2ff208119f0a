// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/internal/geometry/exact/algebraic.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <array>
#include "ellipsoids/pair_on_grid.h"

namespace vericone::exact {

/// The contact polynomial of two bodies t seconds after now, p(x; t) = P_0(x) + P_1(x) t + P_2(x) t^2, up to
/// a positive factor and without the factors that do not depend on t: of degree 2 to 4 in x. For bodies that
/// overlap at some time.
///
/// Such factors come from symmetries (two balls: a square), and would make the discriminant vanish for every
/// t. They have no positive root if the bodies overlap at any time, and no other factor can be repeated for
/// every t: it would hold the two positive roots apart, which meet at contact.
class MovingContact {
 public:
  /// w in units of velocity of which one unit of length takes 2^unit seconds.
  MovingContact(const PairOnGrid<3>& pair, const IntegerVector<3>& w, int unit);

  /// P_0, P_1, P_2, all with as many coefficients (some leading ones may be zero).
  const std::array<Polynomial, 3>& by_time() const { return by_time_; }

  /// Whether p(x; t) is that of the other pair up to a factor, or with A and B exchanged: the relation is the
  /// same at all times then. So it is for pairs that a linear map carries into each other, since adjugates
  /// and determinants take a common factor.
  bool same_as(const MovingContact& other) const;

  /// A positive multiple of the discriminant with regard to x; of degree 12 in t at most.
  Polynomial discriminant() const;

  /// Whether the discriminant is negative at t, which proves that the bodies overlap. (Two roots of p are
  /// always real and negative, so the others are not real.) True for a while after the first contact.
  bool surely_overlapping(const Dyadic& t) const;

 private:
  std::array<Polynomial, 3> by_time_;
};

}  // namespace vericone::exact
