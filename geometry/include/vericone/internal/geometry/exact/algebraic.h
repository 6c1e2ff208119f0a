// SPDX-License-Identifier: BSD-3-Clause
//
// Real algebraic numbers: roots of integer polynomials, held by isolating intervals with dyadic ends. Signs
// and comparisons are exact; equality is decided by greatest common divisors, never by a tolerance.
#pragma once

#include <vericone/geometry/interval.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <memory>
#include <vector>

namespace vericone::exact {

/// Integer coefficients, lowest first; the leading one is not zero. The zero polynomial is empty.
using Polynomial = std::vector<Integer>;

/// numerator / 2^exponent.
struct Dyadic {
  Integer numerator;
  unsigned exponent = 0;

  [[nodiscard]] static Dyadic power_of_two(int exponent);
  [[nodiscard]] static Dyadic of(double finite);
};

/// floor(log2 |x|), x != 0.
[[nodiscard]] int log2_floor(const Integer& x);
[[nodiscard]] int log2_floor(const Dyadic& x);

/// Sign of x - y.
[[nodiscard]] int compare(const Dyadic& x, const Dyadic& y);

/// Strictly between lo < hi, which have one sign: the arithmetic mean of near numbers, about the geometric
/// one of numbers of different sizes.
[[nodiscard]] Dyadic between(Dyadic lo, Dyadic hi);

/// Contains x, at most a few units in the last place wide; of infinite radius beyond the range of doubles.
[[nodiscard]] Interval enclosure(const Dyadic& x);

/// Removes leading zeros.
void trim(Polynomial& p);

/// Divided by the greatest common divisor of the coefficients; signs are kept.
[[nodiscard]] Polynomial primitive_part(Polynomial p);

[[nodiscard]] Polynomial derivative(const Polynomial& p);
Polynomial operator+(const Polynomial& p, const Polynomial& q);
Polynomial operator-(const Polynomial& p, const Polynomial& q);
Polynomial operator*(const Polynomial& p, const Polynomial& q);
Polynomial operator*(const Polynomial& p, const Integer& factor);

/// Whether p and q certainly have no common factor: they have none modulo a prime that does not divide their
/// leading coefficients. Hardly ever false for coprime polynomials, and fast.
[[nodiscard]] bool surely_coprime(const Polynomial& p, const Polynomial& q);

/// Greatest common divisor, primitive and with a positive leading coefficient; 1 for coprime polynomials. At
/// most one of p, q is zero.
[[nodiscard]] Polynomial gcd(Polynomial p, Polynomial q);

/// p / q where q is primitive and divides p.
[[nodiscard]] Polynomial divide_exactly(Polynomial p, const Polynomial& q);

/// The polynomial with the same roots, each simple; p is not zero.
[[nodiscard]] Polynomial squarefree_part(const Polynomial& p);

/// p, p' and the negated remainders, up to positive factors.
[[nodiscard]] std::vector<Polynomial> sturm_chain(const Polynomial& p);

/// 2^(k n) p(x) for x = m / 2^k and n + 1 coefficients.
[[nodiscard]] Integer scaled_value(const Polynomial& p, const Dyadic& x);

/// Sign of p(x).
[[nodiscard]] int sign_at(const Polynomial& p, const Dyadic& x);

/// Changes of sign along a Sturm chain: changes at lo minus changes at hi is the number of distinct roots in
/// (lo, hi] unless p(lo) = 0 is a multiple root.
[[nodiscard]] int sign_changes_at(const std::vector<Polynomial>& chain, const Dyadic& x);
/// At zero from the right as long as p(0) is not zero, and at plus infinity.
[[nodiscard]] int sign_changes_at_zero(const std::vector<Polynomial>& chain);
[[nodiscard]] int sign_changes_at_infinity(const std::vector<Polynomial>& chain);

/// One real root of a polynomial. Functions that need to know it better refine it in place; its value never
/// changes.
class RealRoot {
 public:
  /// The number x itself.
  explicit RealRoot(Dyadic x);
  /// The one root in (lo, hi) of a polynomial that has no other there, counted with multiplicity, and
  /// vanishes at neither end; 0 <= lo or hi <= 0.
  RealRoot(std::shared_ptr<const Polynomial> p, Dyadic lo, Dyadic hi);

  /// The root is one of its simple ones.
  [[nodiscard]] const Polynomial& polynomial() const { return *p_; }
  /// lo < root < hi, or lo = root = hi where it is known as a dyadic number.
  [[nodiscard]] const Dyadic& lo() const { return lo_; }
  [[nodiscard]] const Dyadic& hi() const { return hi_; }
  [[nodiscard]] bool is_dyadic() const { return sign_lo_ == 0; }
  /// Sign of the root.
  [[nodiscard]] int sign() const;

  /// Until hi - lo <= 2^-bits min(|lo|, |hi|). Quadratic interval refinement (Abbott 2006): digits double.
  void refine(int bits);

 private:
  friend int compare(RealRoot& x, const Dyadic& y);
  [[nodiscard]] bool narrow(int bits) const;
  void set(Dyadic x);

  std::shared_ptr<const Polynomial> p_;
  Dyadic lo_, hi_;
  int sign_lo_ = 0;    // sign of p at lo, the opposite of that at hi; 0 for a dyadic root
  int log2_cuts_ = 1;  // the next step cuts the interval into this many parts
};

/// All distinct real roots in increasing order; p is not zero. The intervals do not overlap and no root of p
/// lies at an end, so the ends separate the roots.
[[nodiscard]] std::vector<RealRoot> real_roots(const Polynomial& p);

/// Those in the closed interval.
[[nodiscard]] std::vector<RealRoot> real_roots_in(const Polynomial& p, const Dyadic& lo, const Dyadic& hi);

/// The positive ones.
[[nodiscard]] std::vector<RealRoot> positive_roots(const Polynomial& p);

/// Sign of q at the root.
int sign_at(const Polynomial& q, RealRoot& x);

/// Sign of x - y.
int compare(RealRoot& x, RealRoot& y);
int compare(RealRoot& x, const Dyadic& y);

/// How many times x is a root of q; q is not zero.
int multiplicity(RealRoot& x, const Polynomial& q);

/// Contains the root, a few units in the last place wide.
Interval enclosure(RealRoot& x);

}  // namespace vericone::exact
