// SPDX-License-Identifier: GPL-3.0-or-later
//
// Intervals with multiple-precision ends, rounded outward by MPFR.
#pragma once

#include <mpfr.h>

#include <vericone/internal/verify/spatial/enclosed_real.h>
#include <array>
#include <cmath>
#include <utility>

namespace vericone::verify {

class Mp {
 public:
  explicit Mp(mpfr_prec_t bits) { mpfr_init2(x_, bits); }
  Mp(const Mp& other) : Mp(mpfr_get_prec(other.x_)) { mpfr_set(x_, other.x_, MPFR_RNDN); }
  Mp& operator=(const Mp& other) {
    if (this != &other) {
      mpfr_set_prec(x_, mpfr_get_prec(other.x_));
      mpfr_set(x_, other.x_, MPFR_RNDN);
    }
    return *this;
  }
  ~Mp() { mpfr_clear(x_); }

  mpfr_ptr get() { return x_; }
  mpfr_srcptr get() const { return x_; }
  int sign() const { return mpfr_sgn(x_); }
  mpfr_prec_t bits() const { return mpfr_get_prec(x_); }

 private:
  mpfr_t x_;
};

struct MpInterval {
  Mp lo, hi;

  explicit MpInterval(mpfr_prec_t bits) : lo(bits), hi(bits) {
    mpfr_set_zero(lo.get(), 1);
    mpfr_set_zero(hi.get(), 1);
  }

  /// [q_lo, q_hi].
  MpInterval(mpq_srcptr q_lo, mpq_srcptr q_hi, mpfr_prec_t bits) : lo(bits), hi(bits) {
    mpfr_set_q(lo.get(), q_lo, MPFR_RNDD);
    mpfr_set_q(hi.get(), q_hi, MPFR_RNDU);
  }

  static MpInterval pi(mpfr_prec_t bits) {
    MpInterval r(bits);
    mpfr_const_pi(r.lo.get(), MPFR_RNDD);
    mpfr_const_pi(r.hi.get(), MPFR_RNDU);
    return r;
  }

  /// 1, -1, or 0 when the interval reaches 0.
  int certain_sign() const { return lo.sign() > 0 ? 1 : hi.sign() < 0 ? -1 : 0; }

  friend MpInterval operator+(const MpInterval& a, const MpInterval& b) {
    MpInterval r(a.lo.bits());
    mpfr_add(r.lo.get(), a.lo.get(), b.lo.get(), MPFR_RNDD);
    mpfr_add(r.hi.get(), a.hi.get(), b.hi.get(), MPFR_RNDU);
    return r;
  }
  friend MpInterval operator-(const MpInterval& a, const MpInterval& b) {
    MpInterval r(a.lo.bits());
    mpfr_sub(r.lo.get(), a.lo.get(), b.hi.get(), MPFR_RNDD);
    mpfr_sub(r.hi.get(), a.hi.get(), b.lo.get(), MPFR_RNDU);
    return r;
  }
  /// this * 2^exponent.
  MpInterval scaled(long exponent) const {
    MpInterval r(lo.bits());
    mpfr_mul_2si(r.lo.get(), lo.get(), exponent, MPFR_RNDD);
    mpfr_mul_2si(r.hi.get(), hi.get(), exponent, MPFR_RNDU);
    return r;
  }

  /// Whether the width is below 2^-160 of the distance from 0, which is what EnclosedReal promises.
  bool precise() const {
    if (mpfr_equal_p(lo.get(), hi.get())) return true;
    if (certain_sign() == 0) return false;
    Mp width(64), nearer(64);
    mpfr_sub(width.get(), hi.get(), lo.get(), MPFR_RNDU);
    mpfr_abs(nearer.get(), certain_sign() > 0 ? lo.get() : hi.get(), MPFR_RNDZ);
    mpfr_mul_2si(width.get(), width.get(), 160, MPFR_RNDU);
    return mpfr_cmp(width.get(), nearer.get()) < 0;
  }

  /// The enclosure rounded outward to doubles, and the middle as a sum of doubles.
  EnclosedReal enclosed() const {
    Mp rest(lo.bits() + 2);
    mpfr_add(rest.get(), lo.get(), hi.get(), MPFR_RNDN);
    mpfr_div_2ui(rest.get(), rest.get(), 1, MPFR_RNDN);
    std::array<double, 3> parts;
    for (double& part : parts) {
      part = mpfr_get_d(rest.get(), MPFR_RNDN);
      mpfr_sub_d(rest.get(), rest.get(), part, MPFR_RNDN);
    }
    return {mpfr_get_d(lo.get(), MPFR_RNDD), mpfr_get_d(hi.get(), MPFR_RNDU), parts};
  }

  /// Whether enclosed() gives one double or two adjacent ones.
  bool adjacent() const {
    const double l = mpfr_get_d(lo.get(), MPFR_RNDD), h = mpfr_get_d(hi.get(), MPFR_RNDU);
    return l == h || std::nextafter(l, h) == h;
  }
};

}  // namespace vericone::verify
