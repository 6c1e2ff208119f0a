// SPDX-License-Identifier: BSD-3-Clause
#include "proof/rounded_quadric.h"

#include <array>
#include <cmath>
#include <limits>

namespace vericone::fitting {
namespace {

using exact::Rational;

/// Roundings of each b tried on either side.
constexpr int kSteps = 12;

double ulp(double x) {
  const double a = std::abs(x);
  return std::nextafter(a, std::numeric_limits<double>::infinity()) - a;
}

/// x modulo 1, of a rational number.
double fraction(const Rational& x) {
  exact::Rational rest = x - Rational(numerator(x) / denominator(x));
  if (rest.sign() < 0) rest += 1;
  return nearly(rest);
}

}  // namespace

Quadric rounded_quadric(const exact::RationalMatrix<3>& a, const exact::RationalVector<3>& center,
                        double constant, const Eigen::Vector3d& reach) {
  Eigen::Matrix4d q;
  // The value at the centre is the constant: c = constant - p^T A p - 2 b.p with the rounded A and b.
  Rational last = constant;
  double slack = 0;  // what the roundings of A and b add within reach, about
  for (int i = 0; i < 3; ++i) {
    const auto r = static_cast<std::size_t>(i);
    Rational b = 0;
    for (int j = 0; j < 3; ++j) {
      const auto s = static_cast<std::size_t>(j);
      q(i, j) = nearly(a[r][s]);
      b -= Rational(q(i, j)) * center[s];
      slack += ulp(q(i, j)) * reach(i) * reach(j);
    }
    q(i, 3) = q(3, i) = nearly(b);
    slack += ulp(q(i, 3)) * reach(i);
    last += center[r] * (b - 2 * Rational(q(i, 3)));
  }
  const double grid = ulp(rounded_down(last));
  if (grid > 4 * slack) {
    // b_i moved by k_i roundings moves the constant that is wanted by -2 k_i ulp(b_i) p_i: a value that is
    // just above a double is looked for.
    const double start = fraction(Rational(last / Rational(grid)));
    std::array<double, 3> unit{}, step{};
    for (int i = 0; i < 3; ++i) {
      const auto r = static_cast<std::size_t>(i);
      if (q(i, 3) == 0) continue;
      unit[r] = ulp(q(i, 3));
      step[r] = fraction(Rational(2 * Rational(unit[r]) * center[r] / Rational(grid)));
    }
    double best = 1;
    std::array<int, 3> chosen{};
    for (int k = -kSteps; k <= kSteps; ++k)
      for (int l = -kSteps; l <= kSteps; ++l)
        for (int m = -kSteps; m <= kSteps; ++m) {
          const double f = start - k * step[0] - l * step[1] - m * step[2];
          // The loss is what the constant is lowered by; the rest of it covers the roundings.
          const double loss = f - std::floor(f);
          const double needed =
              slack + 2 * (std::abs(k) * unit[0] * reach(0) + std::abs(l) * unit[1] * reach(1) +
                           std::abs(m) * unit[2] * reach(2));
          if (loss * grid >= needed && loss < best) {
            best = loss;
            chosen = {k, l, m};
          }
        }
    for (int i = 0; i < 3; ++i) {
      const auto r = static_cast<std::size_t>(i);
      const double moved = q(i, 3) + chosen[r] * unit[r];
      last -= 2 * center[r] * (Rational(moved) - Rational(q(i, 3)));
      q(i, 3) = q(3, i) = moved;
    }
  }
  q(3, 3) = rounded_down(last);
  return Quadric(q);
}

Quadric slab(double low, double high) {
  const Rational l = low, h = high, half = (h - l) / 2;
  exact::RationalMatrix<3> a;  // of zeros
  a[2][2] = 1 / (half * half);
  return rounded_quadric(a, {Rational(0), Rational(0), Rational((l + h) / 2)}, -1,
                         {0, 0, 0.5 * (high - low)});
}

}  // namespace vericone::fitting
