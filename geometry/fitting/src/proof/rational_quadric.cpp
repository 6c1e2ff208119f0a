// SPDX-License-Identifier: BSD-3-Clause
#include "proof/rational_quadric.h"

#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <cmath>
#include <cstdint>
#include <limits>

#include "infinity.h"

namespace vericone::fitting {

using exact::Integer;
using exact::Rational;

exact::RationalMatrix<4> quadric_about(const exact::RationalVector<3>& center,
                                       const exact::RationalMatrix<3>& a, const Rational& constant) {
  exact::RationalMatrix<4> q;
  q[3][3] = constant;
  for (std::size_t i = 0; i < 3; ++i) {
    Rational b = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      q[i][j] = a[i][j];
      b -= a[i][j] * center[j];
    }
    q[i][3] = q[3][i] = b;
    q[3][3] -= b * center[i];
  }
  return q;
}

exact::RationalMatrix<3> inverse_shape(const Ellipsoid& body) {
  const exact::RationalMatrix<3> s = exact::defining_shape<3>(body);
  const Rational det = exact::determinant<3>(s);
  exact::RationalMatrix<3> inverse;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
      inverse[i][j] = (s[r0][c0] * s[r1][c1] - s[r0][c1] * s[r1][c0]) / det;
    }
  return inverse;
}

exact::RationalMatrix<3> inverse_shape(const Ellipse& body) {
  const exact::RationalMatrix<2> s = exact::defining_shape<2>(body);
  const Rational det = exact::determinant<2>(s);
  exact::RationalMatrix<3> inverse;  // of zeros
  inverse[0][0] = s[1][1] / det;
  inverse[1][1] = s[0][0] / det;
  inverse[0][1] = inverse[1][0] = -s[0][1] / det;
  return inverse;
}

exact::RationalVector<3> center_in_space(const Ellipsoid& body) {
  return exact::to_rational<3>(body.center());
}

exact::RationalVector<3> center_in_space(const Ellipse& body) {
  return {Rational(body.center().x()), Rational(body.center().y()), Rational(0)};
}

double nearly(const Rational& x) {
  if (x.sign() == 0) return 0;
  Integer n = abs(numerator(x)), d = denominator(x);
  // Shifted so that the quotient has 60 or 61 bits.
  const int shift = 60 - (static_cast<int>(msb(n)) - static_cast<int>(msb(d)));
  (shift > 0 ? n : d) <<= static_cast<unsigned>(std::abs(shift));
  const auto bits = static_cast<std::int64_t>(Integer(n / d));
  return std::copysign(std::ldexp(static_cast<double>(bits), -shift), x.sign());
}

double rounded_up(const Rational& x) {
  double d = nearly(x);
  if (!std::isfinite(d)) return d > 0 ? kInfinity : std::numeric_limits<double>::lowest();
  while (Rational(d) < x) {
    d = std::nextafter(d, kInfinity);
    if (d == kInfinity) return d;
  }
  for (double below = std::nextafter(d, -kInfinity); std::isfinite(below) && Rational(below) >= x;) {
    d = below;
    below = std::nextafter(d, -kInfinity);
  }
  return d;
}

double rounded_down(const Rational& x) { return -rounded_up(Rational(-x)); }

Interval enclosed(const Rational& x) {
  const double low = rounded_down(x), high = rounded_up(x);
  return low == high ? Interval(low) : Interval::between(low, high);
}

}  // namespace vericone::fitting
