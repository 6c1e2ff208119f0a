// SPDX-License-Identifier: GPL-3.0-or-later
//
// Integers of GMP, polynomials over them and their real roots by CGAL's algebraic kernel. Slow to compile.
#pragma once

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/CORE_BigInt.h>
#include <CGAL/CORE_BigRat.h>
#include <gmpxx.h>
#include <vericone/geometry/ellipsoid.h>

#include <array>
#include <climits>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace vericone::verify::algebra {

using Integer = mpz_class;

template <int N>
using Vector = std::array<Integer, N>;
template <int N>
using Matrix = std::array<std::array<Integer, N>, N>;

constexpr int kNoExponent = INT_MAX / 4;

/// The largest e with x a multiple of 2^e.
inline int exponent(double x) {
  if (x == 0) return kNoExponent;
  mpz_class bits;
  int e = 0;
  mpz_set_d(bits.get_mpz_t(), std::ldexp(std::frexp(x, &e), 53));
  return e - 53 + static_cast<int>(mpz_scan1(bits.get_mpz_t(), 0));
}

/// x / 2^e for an exponent e of exponent(x) or less.
inline Integer whole(double x, int e) {
  if (x == 0) return 0;
  int shift = 0;
  Integer bits;
  mpz_set_d(bits.get_mpz_t(), std::ldexp(std::frexp(x, &shift), 53));
  shift -= 53 + e;
  if (shift >= 0)
    bits <<= static_cast<unsigned long>(shift);
  else
    mpz_tdiv_q_2exp(bits.get_mpz_t(), bits.get_mpz_t(), static_cast<unsigned long>(-shift));
  return bits;
}

/// Common unit of lengths 2^e for everything that is put on it.
struct Unit {
  int e = kNoExponent;

  void length(double x) { e = std::min(e, exponent(x)); }
  void area(double x) {
    const int g = exponent(x);
    if (g != kNoExponent) e = std::min(e, g >= 0 ? g / 2 : -((1 - g) / 2));
  }
  template <int D>
  void vector(const Eigen::Matrix<double, D, 1>& v) {
    for (int i = 0; i < D; ++i) length(v(i));
  }
  template <int D>
  void body(const BasicEllipsoid<D>& body) {
    vector<D>(body.center());
    for (int i = 0; i < D * D; ++i)
      body.defined_by_factor() ? length(body.factor()(i)) : area(body.shape()(i));
  }
};

template <int D>
Vector<D> on_unit(const Eigen::Matrix<double, D, 1>& v, int e) {
  Vector<D> r;
  for (int i = 0; i < D; ++i) r[i] = whole(v(i), e);
  return r;
}

/// The shape that defines the body, in units of 2^2e.
template <int D>
Matrix<D> shape_on_unit(const BasicEllipsoid<D>& body, int e) {
  Matrix<D> s;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      if (!body.defined_by_factor()) {
        s[i][j] = whole(body.shape()(i, j), 2 * e);
        continue;
      }
      s[i][j] = 0;
      for (int k = 0; k < D; ++k) s[i][j] += whole(body.factor()(i, k), e) * whole(body.factor()(j, k), e);
    }
  return s;
}

/// time (v_a - v_b), in whole multiples of 2^e.
struct Way {
  Vector<3> of;
  int e = 0;

  Way(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b, double time) {
    Unit unit;
    unit.vector<3>(v_a);
    unit.vector<3>(v_b);
    if (unit.e == kNoExponent) unit.e = 0;
    const int of_time = time == 0 ? 0 : exponent(time);
    const auto a = on_unit<3>(v_a, unit.e), b = on_unit<3>(v_b, unit.e);
    const Integer times = whole(time, of_time);
    for (int i = 0; i < 3; ++i) of[i] = (a[i] - b[i]) * times;
    e = unit.e + of_time;
  }
  /// In multiples of 2^unit, unit <= e.
  Integer on(int i, int unit) const { return of[i] << static_cast<unsigned long>(e - unit); }
};

template <int D>
Integer dot(const Vector<D>& x, const Vector<D>& y) {
  Integer sum = 0;
  for (int i = 0; i < D; ++i) sum += x[i] * y[i];
  return sum;
}

template <int D>
Vector<D> times(const Matrix<D>& m, const Vector<D>& x) {
  Vector<D> r;
  for (int i = 0; i < D; ++i) r[i] = dot<D>(m[i], x);
  return r;
}

/// The sign of the bilinear form x^T M y is read off its value.
template <int D>
Integer form(const Matrix<D>& m, const Vector<D>& x, const Vector<D>& y) {
  return dot<D>(times<D>(m, y), x);
}

template <int N, typename Entry>
Entry minor_determinant(const std::array<std::array<Entry, N>, N>& m, const std::vector<int>& rows,
                        const std::vector<int>& columns) {
  if (rows.size() == 1) return m[rows[0]][columns[0]];
  Entry sum{};
  const std::vector<int> rest(rows.begin() + 1, rows.end());
  for (std::size_t j = 0; j < columns.size(); ++j) {
    std::vector<int> others = columns;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(j));
    Entry term = m[rows[0]][columns[j]] * minor_determinant<N, Entry>(m, rest, others);
    if (j % 2 == 0)
      sum = sum + term;
    else
      sum = sum - term;
  }
  return sum;
}

template <int N>
std::vector<int> without(int k) {
  std::vector<int> r;
  for (int i = 0; i < N; ++i)
    if (i != k) r.push_back(i);
  return r;
}

template <int D>
Matrix<D> adjugate(const Matrix<D>& m) {
  Matrix<D> r;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      r[i][j] = minor_determinant<D, Integer>(m, without<D>(j), without<D>(i));
      if ((i + j) % 2) r[i][j] = -r[i][j];
    }
  return r;
}

template <int D>
Integer determinant(const Matrix<D>& m) {
  return minor_determinant<D, Integer>(m, without<D>(-1), without<D>(-1));
}

/// Coefficients from the constant term up; a binary form in (x, y) is kept as its value at (1, t).
struct Form {
  std::vector<Integer> c;

  Form() = default;
  Form(std::vector<Integer> coefficients) : c(std::move(coefficients)) {}

  friend Form operator*(const Form& a, const Form& b) {
    if (a.c.empty() || b.c.empty()) return {};
    Form r(std::vector<Integer>(a.c.size() + b.c.size() - 1, Integer(0)));
    for (std::size_t i = 0; i < a.c.size(); ++i)
      for (std::size_t j = 0; j < b.c.size(); ++j) r.c[i + j] += a.c[i] * b.c[j];
    return r;
  }
  friend Form operator+(Form a, const Form& b) {
    if (a.c.size() < b.c.size()) a.c.resize(b.c.size(), Integer(0));
    for (std::size_t i = 0; i < b.c.size(); ++i) a.c[i] += b.c[i];
    return a;
  }
  friend Form operator-(Form a, const Form& b) {
    if (a.c.size() < b.c.size()) a.c.resize(b.c.size(), Integer(0));
    for (std::size_t i = 0; i < b.c.size(); ++i) a.c[i] -= b.c[i];
    return a;
  }
  friend Form operator*(const Integer& x, Form a) {
    for (Integer& y : a.c) y *= x;
    return a;
  }

  bool is_zero() const {
    for (const Integer& x : c)
      if (x != 0) return false;
    return true;
  }
};

/// A rational number, denominator > 0.
using Rational = mpq_class;

inline int sign_at(const Form& p, const Rational& x) {
  // Horner on numerators: every step multiplies the value by the denominator.
  Integer sum = 0, power = 1;
  for (auto it = p.c.rbegin(); it != p.c.rend(); ++it) {
    sum = sum * x.get_num() + *it * power;
    power *= x.get_den();
  }
  return sgn(sum);
}

/// Real roots in increasing order, and exact signs at them and between them.
class Roots {
 public:
  using Kernel = CGAL::Algebraic_kernel_d_1<CORE::BigInt>;
  using Polynomial = Kernel::Polynomial_1;
  using Root = Kernel::Algebraic_real_1;

  /// `p` is not the zero polynomial.
  explicit Roots(const Form& p) {
    const Polynomial q = polynomial(p);
    if (CGAL::degree(q) > 0) kernel_.solve_1_object()(q, std::back_inserter(roots_));
  }

  std::size_t size() const { return roots_.size(); }
  const Root& root(std::size_t i) const { return roots_[i].first; }
  unsigned multiplicity(std::size_t i) const { return roots_[i].second; }

  int sign_of_root(std::size_t i) const { return static_cast<int>(CGAL::sign(roots_[i].first)); }
  int sign_at(const Form& p, std::size_t i) const {
    if (p.is_zero()) return 0;
    return static_cast<int>(kernel_.sign_at_1_object()(polynomial(p), roots_[i].first));
  }
  /// Sign of root(i) - other.root(j).
  int compare(std::size_t i, const Roots& other, std::size_t j) const {
    return static_cast<int>(kernel_.compare_1_object()(roots_[i].first, other.roots_[j].first));
  }

  /// One rational number in each gap: size() + 1 of them, the first below all roots, the last above.
  std::vector<Rational> between() const {
    if (roots_.empty()) return {Rational(0)};
    std::vector<Rational> r;
    r.push_back(rational(kernel_.approximate_absolute_1_object()(roots_.front().first, 0).first) - 1);
    for (std::size_t i = 0; i + 1 < roots_.size(); ++i)
      r.push_back(rational(kernel_.bound_between_1_object()(roots_[i].first, roots_[i + 1].first)));
    r.push_back(rational(kernel_.approximate_absolute_1_object()(roots_.back().first, 0).second) + 1);
    return r;
  }

 private:
  /// Divided by the greatest common divisor of the coefficients.
  static Polynomial polynomial(const Form& p) {
    Integer common = 0;
    for (const Integer& x : p.c) common = gcd(common, x);
    std::vector<CORE::BigInt> z;
    for (const Integer& x : p.c) {
      CORE::BigInt value(0);
      if (common != 0) mpz_divexact(value.get_mp(), x.get_mpz_t(), common.get_mpz_t());
      z.push_back(value);
    }
    return Polynomial(z.begin(), z.end());
  }
  static Rational rational(const CORE::BigRat& x) { return Rational(x.get_mp()); }

  Kernel kernel_;
  std::vector<std::pair<Root, unsigned>> roots_;
};

}  // namespace vericone::verify::algebra
