// SPDX-License-Identifier: BSD-3-Clause
//
// The first step of the first rung: the coefficients of the shadows' cubic as quadratic forms of the
// velocity, and one error bound of each for all velocities (docs/explanation/theory.md, 2). No division, axis
// to drop or branch: one velocity takes a hundred operations; many go side by side through vector registers.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/internal/geometry/tracked.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "answers/elementary.h"
#include "ellipsoids/contact_polynomial.h"

namespace vericone {

/// A quadratic form of w as its coefficients at xx, xy, xz, yy, yz, zz; those of mixed products stand for
/// both entries of the symmetric matrix.
template <typename N>
struct QuadraticForm {
  N at[6];

  /// The mixed term of adj(A + t X), which is adj(A) + t (mixed term) + t^2 adj(X). The entries of symmetric
  /// matrices are asked for as a(r, c).
  template <typename A, typename X>
  static constexpr QuadraticForm mixed_adjugate(const A& a, const X& x) {
    const auto on = [&](int p, int q) {
      return (a(p, p) * x(q, q) + a(q, q) * x(p, p)) - a(p, q) * x(p, q) * 2;
    };
    const auto off = [&](int i, int j, int k) {
      return ((a(i, k) * x(k, j) + a(k, j) * x(i, k)) - (a(i, j) * x(k, k) + a(k, k) * x(i, j))) * 2;
    };
    return {{on(1, 2), off(0, 1, 2), off(0, 2, 1), on(2, 0), off(1, 2, 0), on(0, 1)}};
  }

  template <typename A>
  static constexpr QuadraticForm adjugate(const A& a) {
    const auto on = [&](int p, int q) { return a(p, p) * a(q, q) - a(p, q) * a(p, q); };
    const auto off = [&](int i, int j, int k) { return (a(i, k) * a(k, j) - a(i, j) * a(k, k)) * 2; };
    return {{on(1, 2), off(0, 1, 2), off(0, 2, 1), on(2, 0), off(1, 2, 0), on(0, 1)}};
  }

  friend constexpr QuadraticForm operator-(const QuadraticForm& x, const QuadraticForm& y) {
    QuadraticForm difference = x;
    for (int i = 0; i < 6; ++i) difference.at[i] = x.at[i] - y.at[i];
    return difference;
  }
};

/// Products of two components of a velocity.
template <typename N>
struct VelocityProducts {
  N xx, xy, xz, yy, yz, zz;

  constexpr VelocityProducts(const N& x, const N& y, const N& z)
      : xx(x * x), xy(x * y), xz(x * z), yy(y * y), yz(y * z), zz(z * z) {}

  constexpr N square() const { return (xx + yy) + zz; }

  /// The form with the coefficients k(0) to k(5).
  template <typename Coefficient>
  constexpr N form(const Coefficient& k) const {
    return ((k(0) * xx + k(1) * xy) + (k(2) * xz + k(3) * yy)) + (k(4) * yz + k(5) * zz);
  }
};

/// The cubic k3 x^3 - k2 x^2 - k1 x + k0 of ContactCubic for the shadows along w, each coefficient a form of
/// w: the determinant of a shadow of M is w.adj(M) w, and d.adj(shadow of M) d for the shadow d of c is
/// w.(mixed term of adj(M + t c c^T)) w. With w = (u, v, 1) both cubics are the same.
template <typename N>
struct CubicForms {
  QuadraticForm<N> k0, k1, k2, k3;

  template <typename A, typename B, typename C>
  static constexpr CubicForms of(const A& a, const B& b, const C& c) {
    const auto beyond = [&c](const auto& s) { return [&](int i, int j) { return c(i) * c(j) - s(i, j); }; };
    const auto adj_a = QuadraticForm<N>::adjugate(a), adj_b = QuadraticForm<N>::adjugate(b);
    return {adj_a, QuadraticForm<N>::mixed_adjugate(a, beyond(b)) - adj_a,
            QuadraticForm<N>::mixed_adjugate(b, beyond(a)) - adj_b, adj_b};
  }
};

/// Largest sum of a row of the symmetric matrix of magnitudes: by 2 |x y| <= x^2 + y^2 no magnitude of the
/// form exceeds it times |w|^2.
inline double largest_row(const QuadraticForm<Tracked>& k) {
  const auto row = [&k](int on, int off1, int off2) {
    return k.at[on].magnitude() + 0.5 * (k.at[off1].magnitude() + k.at[off2].magnitude());
  };
  return std::max({row(0, 1, 2), row(3, 1, 4), row(5, 2, 4)});
}

/// Most roundings on the way to each quantity, from the formulas themselves, and on the way to its bound,
/// which is made of sums and products of magnitudes, so that bound() covers what both lose.
struct FormCounts {
  // Of the inputs. c: 1 (difference of the centres). S: 3 (three products of factors summed). w: 1
  // (difference of velocities). The normal is taken as it is.
  static constexpr RoundingCount kCenter{1}, kShape{3}, kVelocity{1}, kNormal{0};

  RoundingCount ahead, inner, discriminant;

  static constexpr FormCounts of_the_formulas() {
    const auto larger = [](RoundingCount x, RoundingCount y) { return x.roundings > y.roundings ? x : y; };
    const auto s = [](int, int) { return kShape; };
    const auto forms = CubicForms<RoundingCount>::of(s, s, [](int) { return kCenter; });
    const VelocityProducts<RoundingCount> products(kVelocity, kVelocity, kVelocity);
    const auto value = [&](const QuadraticForm<RoundingCount>& k) {
      return products.form([&k](int i) { return k.at[i]; });
    };
    const auto row = [](const QuadraticForm<RoundingCount>& k) {
      return ((k.at[0] + k.at[1]) + (k.at[2] + k.at[3])) + (k.at[4] + k.at[5]);
    };
    const RoundingCount square = products.square(), fourth = square * square, height = kNormal * kVelocity;
    return {(height + height) + height,
            larger(larger(value(forms.k1), value(forms.k2)), larger(row(forms.k1), row(forms.k2)) * square),
            larger(cubic_discriminant(value(forms.k0), value(forms.k1), value(forms.k2), value(forms.k3)),
                   cubic_discriminant(row(forms.k0), row(forms.k1), row(forms.k2), row(forms.k3)) *
                       (fourth * fourth))};
  }
};

/// |w|^2 for which nothing overflows and all that products below the normal numbers lose together is below
/// kLost: the coefficients are below 2^45 and the discriminant, of degree 8 in w, below 2^(194 + 256), so
/// they lose less than 2^-600 of it, and kLost |w|^8 is at least 2^-556.
inline constexpr double kLeastSquare = 0x1p-64, kMostSquare = 0x1p64, kLost = 0x1p-300;
/// Velocities with a largest component in [2^(e-1), 2^e) are all inside of that for |e| below this.
inline constexpr int kMostExponent = 31;

/// The forms of a pair scaled so that |c| is near one, and their bounds; `normal` separates the bodies where
/// `certified`.
template <typename Shape, typename Center>
detail::VelocityForms bounded_forms(const Shape& a, const Shape& b, const Center& c,
                                    const Eigen::Vector3d& normal, bool certified) {
  constexpr FormCounts kCounts = FormCounts::of_the_formulas();
  const auto forms = CubicForms<Tracked>::of(a, b, c);
  detail::VelocityForms f;
  for (int i = 0; i < 6; ++i) {
    f.outer[i][0] = forms.k0.at[i].value();
    f.outer[i][1] = forms.k3.at[i].value();
    f.inner[i][0] = forms.k1.at[i].value();
    f.inner[i][1] = forms.k2.at[i].value();
  }
  const double row0 = largest_row(forms.k0), row1 = largest_row(forms.k1), row2 = largest_row(forms.k2),
               row3 = largest_row(forms.k3);
  f.inner_bound[0] = kCounts.inner.bound() * row1 + kLost;
  f.inner_bound[1] = kCounts.inner.bound() * row2 + kLost;
  const Tracked largest =
      cubic_discriminant(Tracked::of(row0), Tracked::of(row1), Tracked::of(row2), Tracked::of(row3));
  f.discriminant = kCounts.discriminant.bound() * largest.magnitude() + kLost;
  if (!certified) return f;
  // By a power of two: exact. |n.w| is off by at most bound() |n| |w|.
  const Eigen::Vector3d n = normal * std::ldexp(1.0, -binary_exponent(normal.cwiseAbs().maxCoeff()));
  for (int i = 0; i < 3; ++i) f.normal[i] = n(i);
  f.ahead = kCounts.ahead.bound() * kCounts.ahead.bound() * n.squaredNorm() + kLost;
  return f;
}

/// From the values of the forms, n.w and |w|^2: 1 where w is certainly in, -1 where it is out, else 0. All by
/// sign bits: compilers make no branches of them, which directions would make hard to predict, and vector
/// registers of any kind take them. The sign of a rounded difference is that of the difference.
[[gnu::always_inline]] inline std::int64_t certain_side(const detail::VelocityForms& f, double k0, double k1,
                                                        double k2, double k3, double ahead, double square) {
  const auto bits = [](double x) { return std::bit_cast<std::int64_t>(x); };
  const double discriminant = cubic_discriminant(k0, k1, k2, k3);
  const double fourth = square * square;
  const double bound = f.discriminant * (fourth * fourth), bound1 = f.inner_bound[0] * square,
               bound2 = f.inner_bound[1] * square;
  const double side = ahead * std::abs(ahead), side_bound = f.ahead * square;
  // Not negative where |w|^2 is in its range; of numbers that are not, the bits are out of it.
  const std::int64_t known = ~((bits(square) - bits(kLeastSquare)) | (bits(kMostSquare) - bits(square)));
  // As of ContactCubic: two positive roots miss. No sign change in the coefficients, no positive root,
  // whatever the discriminant.
  const std::int64_t misses = bits(bound - discriminant) & (bits(bound1 - k1) | bits(bound2 - k2));
  const std::int64_t meets = bits(discriminant + bound) | (bits(k1 + bound1) & bits(k2 + bound2));
  const std::int64_t out = (bits(side + side_bound) | misses) & known;
  const std::int64_t in = (bits(side_bound - side) & meets) & known;
  const auto one = [](std::int64_t x) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(x) >> 63);
  };
  return one(in) - one(out);
}

/// Two numbers that go through the same operations.
using Both = double __attribute__((vector_size(16)));

/// certain_side() of one velocity.
[[gnu::always_inline]] inline std::int64_t certain_side(const detail::VelocityForms& f,
                                                        const Eigen::Vector3d& w) {
  const auto both = [](double x) { return Both{x, x}; };
  const VelocityProducts<Both> products(both(w.x()), both(w.y()), both(w.z()));
  const auto form = [&](const double(&k)[6][2]) {
    return products.form([&k](int i) { return Both{k[i][0], k[i][1]}; });
  };
  const Both outer = form(f.outer), inner = form(f.inner);
  const double ahead = (f.normal[0] * w.x() + f.normal[1] * w.y()) + f.normal[2] * w.z();
  return certain_side(f, outer[0], inner[0], inner[1], outer[1], ahead, products.square()[0]);
}

/// The membership that certain_side() stands for; `on` is never certain, and stands for neither.
constexpr Membership membership_of(std::int64_t side) { return static_cast<Membership>(1 + side); }
static_assert(membership_of(1) == Membership::in && membership_of(-1) == Membership::out &&
              membership_of(0) == Membership::on);

}  // namespace vericone
