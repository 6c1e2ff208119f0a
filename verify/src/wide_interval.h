// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vericone/internal/verify/spatial/enclosed_real.h>
#include <algorithm>

#include "mp_interval.h"

namespace vericone::verify {

/// An interval with ends of 320 bits, as a number type.
class WideInterval {
 public:
  WideInterval() : v_(kBits) {}
  WideInterval(double x) : v_(kBits) {  // NOLINT(google-explicit-constructor): a double is one exactly
    mpfr_set_d(v_.lo.get(), x, MPFR_RNDD);
    mpfr_set_d(v_.hi.get(), x, MPFR_RNDU);
  }

  int certain_sign() const { return v_.certain_sign(); }
  bool certainly_not_positive() const { return v_.hi.sign() <= 0; }
  bool certainly_not_negative() const { return v_.lo.sign() >= 0; }

  friend WideInterval operator+(const WideInterval& a, const WideInterval& b) { return a.v_ + b.v_; }
  friend WideInterval operator-(const WideInterval& a, const WideInterval& b) { return a.v_ - b.v_; }
  friend WideInterval operator*(const WideInterval& a, const WideInterval& b) {
    return of_ends(
        [&](Mp& r, const Mp& x, const Mp& y, mpfr_rnd_t way) { mpfr_mul(r.get(), x.get(), y.get(), way); }, a,
        b);
  }
  /// The denominator must not reach 0.
  friend WideInterval operator/(const WideInterval& a, const WideInterval& b) {
    return of_ends(
        [&](Mp& r, const Mp& x, const Mp& y, mpfr_rnd_t way) { mpfr_div(r.get(), x.get(), y.get(), way); }, a,
        b);
  }
  /// Of the part that is not negative.
  friend WideInterval root(const WideInterval& a) {
    WideInterval r;
    if (a.v_.lo.sign() > 0) mpfr_sqrt(r.v_.lo.get(), a.v_.lo.get(), MPFR_RNDD);
    if (a.v_.hi.sign() > 0) mpfr_sqrt(r.v_.hi.get(), a.v_.hi.get(), MPFR_RNDU);
    return r;
  }
  double middle() const {
    return 0.5 * mpfr_get_d(v_.lo.get(), MPFR_RNDN) + 0.5 * mpfr_get_d(v_.hi.get(), MPFR_RNDN);
  }

 private:
  static constexpr mpfr_prec_t kBits = 320;
  WideInterval(const MpInterval& v) : v_(v) {}  // NOLINT(google-explicit-constructor)

  /// The hull of an operation on all pairs of ends; it is monotonic in each.
  template <typename Operation>
  static WideInterval of_ends(Operation&& operation, const WideInterval& a, const WideInterval& b) {
    WideInterval r;
    Mp x(kBits);
    bool first = true;
    for (const Mp* p : {&a.v_.lo, &a.v_.hi})
      for (const Mp* q : {&b.v_.lo, &b.v_.hi}) {
        operation(x, *p, *q, MPFR_RNDD);
        if (first || mpfr_cmp(x.get(), r.v_.lo.get()) < 0) r.v_.lo = x;
        operation(x, *p, *q, MPFR_RNDU);
        if (first || mpfr_cmp(x.get(), r.v_.hi.get()) > 0) r.v_.hi = x;
        first = false;
      }
    return r;
  }

  MpInterval v_;
};

}  // namespace vericone::verify
