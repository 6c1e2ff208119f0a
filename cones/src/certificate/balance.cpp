// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/balance.h"

#include <cmath>
#include <memory>
#include <utility>

namespace vericone::certificates {
namespace {

using exact::Dyadic;
using exact::Integer;
using exact::IntegerMatrix;
using exact::IntegerVector;
using exact::Polynomial;

template <int D>
IntegerVector<D> times(const IntegerMatrix<D>& m, const IntegerVector<D>& v) {
  IntegerVector<D> r;
  for (int i = 0; i < D; ++i) {
    r[i] = m[i][0] * v[0];
    for (int j = 1; j < D; ++j) r[i] += m[i][j] * v[j];
  }
  return r;
}

/// m(x)^T s m(x), m by its coefficients.
template <int D>
Polynomial form_of(const std::array<IntegerVector<D>, D>& m, const IntegerMatrix<D>& s) {
  Polynomial p(2 * D - 1, Integer(0));
  for (int j = 0; j < D; ++j) {
    const IntegerVector<D> image = times<D>(s, m[j]);
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k) p[i + j] += m[i][k] * image[k];
  }
  return p;
}

/// x (1 + 2^-bits) or x (1 - 2^-bits).
Dyadic beside(const Dyadic& x, unsigned bits, bool above) {
  const Integer wide = x.numerator << bits;
  return {above ? Integer(wide + x.numerator) : Integer(wide - x.numerator), x.exponent + bits};
}

Dyadic times_power(const Dyadic& x, unsigned bits, bool up) {
  if (!up) return {x.numerator, x.exponent + bits};
  if (x.exponent >= bits) return {x.numerator, x.exponent - bits};
  return {x.numerator << (bits - x.exponent), 0};
}

}  // namespace

template <int D>
Balance<D>::Balance(const IntegerMatrix<D>& a, const IntegerMatrix<D>& b, IntegerVector<D> c)
    : a_(a), b_(b), c_(std::move(c)), pencil_(a_, b_) {
  for (int i = 0; i < D; ++i) m_[i] = times<D>(pencil_.adjugate[i], c_);
}

template <int D>
Dyadic Balance<D>::root(double guess, int bits) const {
  // Positive below the root and negative above.
  Polynomial p = form_of<D>(m_, a_);
  const Polynomial of_b = form_of<D>(m_, b_);
  p.resize(of_b.size() + 2, Integer(0));
  for (std::size_t i = 0; i < of_b.size(); ++i) p[i + 2] -= of_b[i];
  exact::trim(p);
  Dyadic x = Dyadic::of(std::isfinite(guess) && guess > 1e-200 && guess < 1e200 ? guess : 1.0);
  const int side = exact::sign_at(p, x);
  if (side == 0) return x;
  // Nearly always within 2^-36 of the guess.
  Dyadic other = beside(x, 36, side > 0);
  for (unsigned step = 1; exact::sign_at(p, other) == side; step *= 2) {
    x = other;
    other = times_power(x, step, side > 0);
  }
  if (exact::sign_at(p, other) == 0) return other;
  if (side < 0) std::swap(x, other);
  exact::RealRoot root(std::make_shared<const Polynomial>(std::move(p)), x, other);
  root.refine(bits);
  return root.lo();
}

template <int D>
IntegerVector<D> Balance<D>::normal(const Dyadic& x) const {
  return normal(std::array<Integer, 2>{x.numerator, Integer(1) << x.exponent});
}

template <int D>
IntegerVector<D> Balance<D>::normal(const std::array<Integer, 2>& x) const {
  IntegerVector<D> r = m_[D - 1];
  Integer power = 1;
  for (int i = D - 2; i >= 0; --i) {
    power *= x[1];
    for (int k = 0; k < D; ++k) r[k] = r[k] * x[0] + m_[i][k] * power;
  }
  return r;
}

template <int D>
Integer Balance<D>::determinant(const Dyadic& x) const {
  Integer r = pencil_.determinant[D];
  for (int i = D - 1; i >= 0; --i)
    r = r * x.numerator + (pencil_.determinant[i] << (x.exponent * static_cast<unsigned>(D - i)));
  return r;
}

template <int D>
std::optional<std::array<Integer, 2>> Balance<D>::touching_root() const {
  Polynomial p(D + 2, Integer(0));
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k) p[i + 1] += c_[k] * m_[i][k];
  for (int i = 0; i <= D; ++i) {
    p[i] -= pencil_.determinant[i];
    p[i + 1] -= pencil_.determinant[i];
  }
  const auto ratio = [](Integer above, Integer below) -> std::optional<std::array<Integer, 2>> {
    if (below.sign() < 0) above = -above, below = -below;
    if (above.sign() <= 0 || below.is_zero()) return std::nullopt;
    return std::array<Integer, 2>{above, below};
  };
  if constexpr (D == 2) {
    // The third root is negative, so a positive multiple one is exactly double.
    return ratio(9 * p[0] * p[3] - p[1] * p[2], 2 * (p[2] * p[2] - 3 * p[1] * p[3]));
  } else {
    const Polynomial common = exact::gcd(p, exact::derivative(p));
    if (common.size() == 2) return ratio(-common[0], common[1]);
    if (common.size() != 3) return std::nullopt;
    // Two double roots: the positive one is rational too.
    const Integer square = common[1] * common[1] - 4 * common[0] * common[2];
    if (square.sign() < 0) return std::nullopt;
    const Integer root = sqrt(square);
    return ratio(root - common[1], 2 * common[2]);  // the leading coefficient is positive
  }
}

template class Balance<2>;
template class Balance<3>;

}  // namespace vericone::certificates
