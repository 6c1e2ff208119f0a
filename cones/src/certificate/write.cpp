// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/write.h"

#include <charconv>
#include <cmath>

namespace vericone::certificates {

Text& Text::number(double x) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, x == 0 ? 0.0 : x).ptr;
  text_.append(digits, end);
  return *this;
}

Text& Text::number(const Eigen::Vector3d& v) {
  raw("[").number(v.x()).raw(", ").number(v.y()).raw(", ").number(v.z());
  return raw("]");
}

Text& Text::number(const Integer& x, int exponent) {
  if (x.is_zero()) return raw("0");
  const Integer size = abs(x);
  const auto zeros = static_cast<int>(lsb(size)), bits = static_cast<int>(msb(size)) + 1;
  // A normal double holds it.
  if (bits - zeros <= 53 && bits + exponent < 1024 && zeros + exponent > -1022) {
    const auto top = static_cast<std::int64_t>(Integer(size >> static_cast<unsigned>(zeros)));
    const double value = std::ldexp(static_cast<double>(top), zeros + exponent);
    return number(x.sign() < 0 ? -value : value);
  }
  const char* sign = x.sign() < 0 ? "\"-" : "\"";
  if (zeros + exponent >= 0 || exponent >= 0) {
    const Integer whole = exponent >= 0 ? Integer(size << static_cast<unsigned>(exponent))
                                        : Integer(size >> static_cast<unsigned>(-exponent));
    return raw(sign).raw(whole.str()).raw("\"");
  }
  const Integer below = Integer(1) << static_cast<unsigned>(-exponent - zeros);
  const Integer above = size >> static_cast<unsigned>(zeros);
  return raw(sign).raw(above.str()).raw("/").raw(below.str()).raw("\"");
}

Text& Text::number(const Vector& v, int exponent) {
  raw("[").number(v[0], exponent).raw(", ").number(v[1], exponent).raw(", ").number(v[2], exponent);
  return raw("]");
}

Text& Text::number(const Rational& x, int exponent) {
  Integer above = numerator(x), below = denominator(x);
  if (exponent >= 0)
    above <<= static_cast<unsigned>(exponent);
  else
    below <<= static_cast<unsigned>(-exponent);
  if ((below & (below - 1)).is_zero()) return number(above, -static_cast<int>(lsb(below)));
  const Integer common = gcd(above, below);
  above /= common;
  below /= common;
  if (below == 1) return number(above, 0);
  return raw("\"").raw(above.str()).raw("/").raw(below.str()).raw("\"");
}

}  // namespace vericone::certificates
