// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>

#include "times/moving_contact.h"

namespace vericone::exact {

/// The first contact t* of bodies that are disjoint now and will overlap, in seconds, between two dyadic
/// numbers as near as wanted.
///
/// For every x > 0, { p(x; .) <= 0 } is the ray's passage through an ellipsoid that contains K. So the
/// smaller root t_x of this quadratic bounds t* from below, is quasi-concave in x, and t* is its maximum: an
/// x with half the digits gives t* with all of them. From above t* is bounded by a time at which the
/// discriminant proves that the bodies overlap. How x was found is of no consequence for either bound.
class EntryTime {
 public:
  /// `ratio`: a guess of x at t*, rho_A / rho_B.
  EntryTime(MovingContact contact, double ratio);

  const MovingContact& contact() const { return contact_; }
  /// lo <= t* < hi, once refined.
  const Dyadic& lo() const { return lo_; }
  const Dyadic& hi() const { return hi_; }

  /// Until hi - lo <= 2^-bits lo.
  void refine(int bits);

  /// That of the contact polynomial, of which t* is a root.
  const Polynomial& discriminant();
  RealRoot root();

 private:
  bool narrow(int bits) const;
  void step(int bits);
  void use_digits(int digits);

  MovingContact contact_;
  Polynomial discriminant_;  // empty until asked for
  Dyadic x_, lo_{0, 0}, hi_{0, 0};
  int digits_ = 0;                        // binary ones, of t_x
  std::optional<Dyadic> x_low_, x_high_;  // t_x rises at the one and falls at the other
  int log2_last_move_ = std::numeric_limits<int>::max();
};

}  // namespace vericone::exact
