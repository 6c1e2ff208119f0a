// SPDX-License-Identifier: BSD-3-Clause
#include "times/entry_time.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace vericone::exact {
namespace {

/// numerator / denominator towards zero, with so many binary digits at least.
Dyadic quotient(const Integer& numerator, const Integer& denominator, int digits) {
  if (numerator == 0) return {0, 0};
  const int exponent = std::max(digits + 1 + log2_floor(denominator) - log2_floor(numerator), 0);
  return {(numerator << static_cast<unsigned>(exponent)) / denominator, static_cast<unsigned>(exponent)};
}

/// x > 0 towards zero, with so many binary digits.
Dyadic leading(Dyadic x, int digits) {
  const int excess = std::min(log2_floor(x.numerator) + 1 - digits, static_cast<int>(x.exponent));
  if (excess <= 0) return x;
  return {x.numerator >> static_cast<unsigned>(excess), x.exponent - static_cast<unsigned>(excess)};
}

/// At least the square root, with so many binary digits.
Integer root_above(const Integer& x, int digits) {
  if (x == 0) return 0;
  const auto shift = static_cast<unsigned>(std::max(log2_floor(x) / 2 + 1 - digits, 0));
  return (sqrt(Integer(x >> (2 * shift))) + 1) << shift;
}

/// The smaller root of a2 t^2 + a1 t + a0 with a2 > 0 and real roots: not above it where it is positive.
Dyadic smaller_root(const Integer& a0, const Integer& a1, const Integer& a2, int digits) {
  const Integer root = root_above(a1 * a1 - 4 * a0 * a2, digits);
  return a1 < 0 ? quotient(2 * a0, root - a1, digits) : quotient(-a1 - root, 2 * a2, digits);
}

/// The smaller root t of p(x; .), so many digits of it, and derivatives there, times powers of two: p_x^2 /
/// (p_xx p_t) is in units of the last place of t, p_x / p_xx in those of x.
struct Passage {
  Dyadic t;
  Integer px, pt, pxx, pxt;

  Passage(const MovingContact& contact, const Dyadic& x, int digits) {
    std::array<Integer, 3> q, dq, ddq;
    for (int k = 0; k < 3; ++k) {
      const Polynomial& p = contact.by_time()[k];
      const Polynomial derived = derivative(p);
      q[k] = scaled_value(p, x);
      dq[k] = scaled_value(derived, x);
      ddq[k] = scaled_value(derivative(derived), x);
    }
    t = smaller_root(q[0], q[1], q[2], digits);
    const Integer& s = t.numerator;
    const auto value = [&](const std::array<Integer, 3>& c) {
      return Integer((c[2] * s + (c[1] << t.exponent)) * s + (c[0] << (2 * t.exponent)));
    };
    const auto slope = [&](const std::array<Integer, 3>& c) {
      return Integer(2 * c[2] * s + (c[1] << t.exponent));
    };
    px = value(dq);
    pxx = value(ddq);
    pt = slope(q);
    pxt = slope(dq);
  }
};

/// Changes of sign among the coefficients of (1 + y)^n p((lo + hi y) / (1 + y)): 0 or 1 is the number of
/// roots in (lo, hi), with multiplicities (Descartes).
int descartes_bound(const Polynomial& p, const Dyadic& lo, const Dyadic& hi) {
  const unsigned k = std::max(lo.exponent, hi.exponent);
  const Polynomial numerator{lo.numerator << (k - lo.exponent), hi.numerator << (k - hi.exponent)},
      denominator{Integer(1) << k, Integer(1) << k};
  Polynomial sum, power{1};  // Horner with the powers of the denominator
  for (auto it = p.rbegin(); it != p.rend(); ++it) {
    sum = sum * numerator + power * *it;
    power = power * denominator;
  }
  int changes = 0, last = 0;
  for (const Integer& x : sum) {
    const int s = x.sign();
    if (s != 0 && last != 0 && s != last) ++changes;
    if (s != 0) last = s;
  }
  return changes;
}

}  // namespace

EntryTime::EntryTime(MovingContact contact, double ratio)
    : contact_(std::move(contact)), x_(Dyadic::of(std::isfinite(ratio) && ratio > 0 ? ratio : 1)) {}

bool EntryTime::narrow(int bits) const {
  if (hi_.numerator == 0) return false;
  const unsigned k = std::max(lo_.exponent, hi_.exponent);
  const Integer lo = lo_.numerator << (k - lo_.exponent), hi = hi_.numerator << (k - hi_.exponent);
  return (hi - lo) << static_cast<unsigned>(bits) <= lo;
}

void EntryTime::use_digits(int digits) {
  digits_ = digits;
  // What the last digits said of the sides of x may be wrong.
  x_low_.reset();
  x_high_.reset();
  log2_last_move_ = std::numeric_limits<int>::max();
}

void EntryTime::refine(int bits) {
  constexpr int kGuard = 16;
  if (digits_ < bits + kGuard) use_digits(bits + kGuard);
  while (!narrow(bits)) step(bits);
}

void EntryTime::step(int bits) {
  const Passage at(contact_, x_, digits_);
  if (compare(at.t, lo_) > 0) lo_ = at.t;
  if (at.px != 0) (at.px > 0 ? x_low_ : x_high_) = x_;
  // Newton's iteration for d t_x / dx = -p_x / p_t = 0, where it leads to a maximum.
  const Integer denominator = at.pxx * at.pt - at.pxt * at.px;
  if (denominator > 0) {
    // t* - t is about half of p_x^2 / denominator, in units of the last place of t.
    const Integer width = at.px * at.px / denominator + 8;
    if (at.t.numerator > 0 && width << static_cast<unsigned>(bits) <= at.t.numerator) {
      const Dyadic later{at.t.numerator + width, at.t.exponent};
      if (contact_.surely_overlapping(later) && (hi_.numerator == 0 || compare(later, hi_) < 0)) hi_ = later;
      if (narrow(bits)) return;
    }
    const int digits = digits_ / 2 + 16;
    const auto finer = static_cast<unsigned>(std::max(digits - log2_floor(x_.numerator), 0));
    const Integer move = -((at.px * at.pt) << finer) / denominator;
    Dyadic next{(x_.numerator << finer) + move, x_.exponent + finer};
    if (next.numerator > 0) next = leading(std::move(next), digits);
    if (width < 16 || move == 0 || compare(next, x_) == 0) return use_digits(2 * digits_);
    const int log2_move = log2_floor(move) - static_cast<int>(x_.exponent + finer);
    if (next.numerator > 0 && log2_move < log2_last_move_ && !(x_low_ && compare(next, *x_low_) < 0) &&
        !(x_high_ && compare(next, *x_high_) > 0)) {
      log2_last_move_ = log2_move;
      x_ = std::move(next);
      return;
    }
  }
  log2_last_move_ = std::numeric_limits<int>::max();
  if (x_low_ && x_high_) {
    x_ = between(*x_low_, *x_high_);
    if (log2_floor(x_.numerator) > digits_) use_digits(2 * digits_);
  } else if (x_low_) {
    x_.numerator <<= 4;
  } else {
    x_.exponent += 4;
  }
}

const Polynomial& EntryTime::discriminant() {
  if (discriminant_.empty()) discriminant_ = contact_.discriminant();
  return discriminant_;
}

RealRoot EntryTime::root() {
  Polynomial d = discriminant();
  constexpr int kFirst = 64, kSquarefree = 256;
  for (int bits = kFirst;; bits *= 2) {
    refine(bits);
    if (bits == kSquarefree) d = squarefree_part(d);
    // t* may be lo itself, so a little less.
    const auto b = static_cast<unsigned>(bits);
    const Dyadic less{(lo_.numerator << b) - lo_.numerator, lo_.exponent + b};
    if (sign_at(d, less) != 0 && sign_at(d, hi_) != 0 && descartes_bound(d, less, hi_) == 1)
      return {std::make_shared<const Polynomial>(std::move(d)), less, hi_};
  }
}

}  // namespace vericone::exact
