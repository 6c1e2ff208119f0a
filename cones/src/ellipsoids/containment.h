// SPDX-License-Identifier: BSD-3-Clause
//
// One solid ellipse or ellipsoid inside another: the certificates of the lower rungs over any kind of number,
// the search for them in plain doubles, and the exact decision (docs/explanation/predicates/position.md).
//
// Bodies are given by quadratic forms S_A, S_B and C = c c^T, c = p_B - p_A; only their ratios count.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/interval.h>
#include <vericone/internal/geometry/exact/algebraic.h>
#include <vericone/internal/geometry/tracked.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ellipsoids/contact_polynomial.h"

namespace vericone {

/// Symmetric D x D, the upper triangle by rows.
template <int D, typename N>
struct SymmetricForm {
  std::array<N, D*(D + 1) / 2> entry{};

  static constexpr int at(int i, int j) { return i <= j ? i * D - i * (i - 1) / 2 + j - i : at(j, i); }
  constexpr const N& operator()(int i, int j) const { return entry[at(i, j)]; }
  constexpr N& operator()(int i, int j) { return entry[at(i, j)]; }
};

template <int D, typename N>
struct PairForms {
  SymmetricForm<D, N> a, b, c;
};

template <typename N>
constexpr N determinant(const SymmetricForm<2, N>& m) {
  return m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1);
}
template <typename N>
constexpr N determinant(const SymmetricForm<3, N>& m) {
  return m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(1, 2)) -
         m(0, 1) * (m(0, 1) * m(2, 2) - m(1, 2) * m(0, 2)) +
         m(0, 2) * (m(0, 1) * m(1, 2) - m(1, 1) * m(0, 2));
}

/// v^T M v.
template <int D, typename N>
constexpr N form_at(const SymmetricForm<D, N>& m, const std::array<N, D>& v) {
  N sum = v[0] * (m(0, 0) * v[0]);
  for (int i = 1; i < D; ++i) sum = sum + v[i] * (m(i, i) * v[i]);
  for (int i = 0; i < D; ++i)
    for (int j = i + 1; j < D; ++j) {
      const N term = v[i] * (m(i, j) * v[j]);
      sum = sum + (term + term);
    }
  return sum;
}

/// v^T adj(M) v.
template <typename N>
constexpr N adjugate_at(const SymmetricForm<2, N>& m, const std::array<N, 2>& v) {
  const N term = v[0] * (m(0, 1) * v[1]);
  return v[0] * (m(1, 1) * v[0]) + v[1] * (m(0, 0) * v[1]) - (term + term);
}
template <typename N>
constexpr N adjugate_at(const SymmetricForm<3, N>& m, const std::array<N, 3>& v) {
  SymmetricForm<3, N> adj;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const int r0 = (i + 1) % 3, r1 = (i + 2) % 3, c0 = (j + 1) % 3, c1 = (j + 2) % 3;
      adj(i, j) = m(r0, c0) * m(r1, c1) - m(r0, c1) * m(r1, c0);
    }
  return form_at<3, N>(adj, v);
}

// Certificates. Each is a list of polynomials whose signs prove the claim.

/// All positive: A lies in the interior of B. The leading minors of t (s S_B - S_A) - s c c^T, for any s, t >
/// 0 with s + t = 1 (S-procedure).
template <int D, typename N>
constexpr std::array<N, D> inside_minors(const PairForms<D, N>& pair, const N& s, const N& t) {
  SymmetricForm<D, N> m;
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) m(i, j) = t * (s * pair.b(i, j) - pair.a(i, j)) - s * pair.c(i, j);
  std::array<N, D> minors{};
  minors[0] = m(0, 0);
  minors[1] = m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1);
  if constexpr (D == 3) minors[2] = determinant(m);
  return minors;
}

/// First one negative, or second one positive: A reaches beyond B along n or -n, rho_A + |n.c| > rho_B. With
/// e = (n.c)^2 that is 2 sqrt(e) rho_A > r = rho_B^2 - rho_A^2 - e.
template <int D, typename N>
constexpr std::array<N, 2> reach_signs(const PairForms<D, N>& pair, const std::array<N, D>& n) {
  const N a = form_at<D, N>(pair.a, n), b = form_at<D, N>(pair.b, n), e = form_at<D, N>(pair.c, n);
  const N r = b - a - e;
  return {r, e * a * 4 - r * r};
}

/// Both positive: n separates the bodies strictly, |n.c| > rho_A + rho_B.
template <int D, typename N>
constexpr std::array<N, 2> apart_signs(const PairForms<D, N>& pair, const std::array<N, D>& n) {
  const N a = form_at<D, N>(pair.a, n), b = form_at<D, N>(pair.b, n), e = form_at<D, N>(pair.c, n);
  const N r = e - a - b;
  return {r, r * r - a * b * 4};
}

/// Positive: y, taken from the centre, is an interior point of the body.
template <int D, typename N>
constexpr N depth_sign(const SymmetricForm<D, N>& shape, const std::array<N, D>& y) {
  return determinant(shape) - adjugate_at(shape, y);
}

/// Products below the smallest normal number lose more than a relative rounding. The callers see to it that
/// the entries of S_A, S_B stay below 2^90 and those of C below 2^160; the certificates have degree three in
/// them at most, so one loss of 2^-1074 grows to less than 2^-600, and all of them together stay far below
/// this.
constexpr double kFormUnderflow = 1e-150;

inline bool surely_positive(const Tracked& x, RoundingCount count) {
  return x.certain(count, kFormUnderflow) > 0;
}
inline bool surely_positive(const Interval& x, RoundingCount) { return x.positive(); }

/// Counts of roundings of the certificates, from those of the forms' entries.
template <int D>
struct CertificateCounts {
  std::array<RoundingCount, D> minors;
  std::array<RoundingCount, 2> reach, apart;
  RoundingCount depth_a, depth_b;

  static constexpr CertificateCounts of(RoundingCount shape, RoundingCount center,
                                        RoundingCount square_of_center) {
    PairForms<D, RoundingCount> pair;
    for (auto& x : pair.a.entry) x = shape;
    for (auto& x : pair.b.entry) x = shape;
    for (auto& x : pair.c.entry) x = square_of_center;
    std::array<RoundingCount, D> input{}, from_b{};
    for (auto& x : from_b) x = RoundingCount{} - center;
    return {inside_minors<D, RoundingCount>(pair, {}, {}), reach_signs<D, RoundingCount>(pair, input),
            apart_signs<D, RoundingCount>(pair, input), depth_sign<D, RoundingCount>(pair.a, input),
            depth_sign<D, RoundingCount>(pair.b, from_b)};
  }
};

/// 1 - t and t for s in (0, 1), so that the sum is one without rounding.
struct Weights {
  double s, t;
  explicit Weights(double near_s) : s(near_s), t(1 - near_s) { s = 1 - t; }
};

inline Tracked lifted(double x, const Tracked*) { return Tracked::of(x); }
inline Interval lifted(double x, const Interval*) { return x; }
template <typename N>
N lift(double x) {
  return lifted(x, static_cast<const N*>(nullptr));
}
template <int D, typename N>
std::array<N, D> lift(const Eigen::Matrix<double, D, 1>& v) {
  std::array<N, D> r;
  for (int i = 0; i < D; ++i) r[i] = lift<N>(v(i));
  return r;
}

template <int D, typename N>
bool surely_inside(const PairForms<D, N>& pair, double s, const CertificateCounts<D>& counts) {
  const Weights w(s);
  if (!(w.s > 0 && w.t > 0)) return false;
  const auto minors = inside_minors<D, N>(pair, lift<N>(w.s), lift<N>(w.t));
  for (int i = 0; i < D; ++i)
    if (!surely_positive(minors[i], counts.minors[i])) return false;
  return true;
}

template <int D, typename N>
bool surely_reaches_beyond(const PairForms<D, N>& pair, const Eigen::Matrix<double, D, 1>& n,
                           const CertificateCounts<D>& counts) {
  const auto signs = reach_signs<D, N>(pair, lift<D, N>(n));
  return surely_positive(-signs[0], counts.reach[0]) || surely_positive(signs[1], counts.reach[1]);
}

/// What a search in plain doubles proposes about A inside B.
template <int D>
struct ContainmentGuess {
  bool inside = false;
  double s = 0;                        // multiplier that should prove it
  Eigen::Matrix<double, D, 1> normal;  // else: where A should reach beyond B
};

/// Search in coordinates in which both shapes are diagonal: a, b > 0 their entries, c the line of centres.
///
/// With r_i = a_i / b_i and k_i = c_i^2 / b_i the question is whether f(s) = 1 - s - s sum k_i / (s - r_i)
/// has a positive value on s > max r_i. f is concave there; f' = 0 is the secular equation of a trust region,
/// sum k_i r_i / (s - r_i)^2 = 1, and at its root n_i = c_i / (b_i (s - r_i)) has rho_A(n) = 1 and reaches
/// beyond B iff f < 0.
template <int D>
ContainmentGuess<D> search_containment(const Eigen::Matrix<double, D, 1>& a,
                                       const Eigen::Matrix<double, D, 1>& b,
                                       const Eigen::Matrix<double, D, 1>& c) {
  using Vector = Eigen::Matrix<double, D, 1>;
  const Vector r = a.cwiseQuotient(b), k = c.cwiseAbs2().cwiseQuotient(b);
  Eigen::Index last = 0;
  const double first = r.maxCoeff(&last);
  Vector d, w;
  double u = 0;
  for (int i = 0; i < D; ++i) {
    d(i) = first - r(i);
    w(i) = k(i) * r(i);
    u = std::max(u, std::sqrt(w(i)) - d(i));
  }
  // Newton on 1/sqrt(sum) = 1, a concave function: monotone from the left.
  for (int iteration = 0; iteration < 30; ++iteration) {
    double sum = 0, slope = 0;
    for (int i = 0; i < D; ++i) {
      if (w(i) == 0) continue;
      const double q = w(i) / ((u + d(i)) * (u + d(i)));
      sum += q;
      slope += q / (u + d(i));
    }
    if (!(sum > 1)) break;  // also the hard case: no root beyond the pole
    const double step = (std::sqrt(sum) - 1) * sum / slope;
    u += step;
    if (!(step > 1e-9 * u)) break;
  }
  const auto f_at = [&](double beyond) {
    double sum = 0;
    for (int i = 0; i < D; ++i)
      if (k(i) != 0) sum += k(i) / (beyond + d(i));
    return 1 - (first + beyond) * (1 + sum);
  };
  ContainmentGuess<D> guess;
  const double best = f_at(u);
  if (best > 0) {
    guess.inside = true;
    // Towards larger s, where the matrix is farther from singular, as long as f keeps half its value.
    double beyond = u;
    for (double share = 0.5; share > 0x1p-12; share *= 0.5) {
      const double next = u + share * (1 - first - u);
      if (f_at(next) > 0.5 * best) {
        beyond = next;
        break;
      }
    }
    guess.s = first + beyond;
    return guess;
  }
  Vector& n = guess.normal;
  double rho2 = 0;
  for (int i = 0; i < D; ++i) {
    n(i) = c(i) == 0 ? 0 : c(i) / (b(i) * (u + d(i)));
    rho2 += a(i) * n(i) * n(i);
  }
  if (rho2 < 1) n(last) = std::copysign(std::sqrt((1 - rho2) / a(last) + n(last) * n(last)), c(last));
  n /= n.cwiseAbs().maxCoeff();
  return guess;
}

namespace exact {

/// A in B: not at all, with a common boundary point (equal bodies included), or in the interior.
enum class Containment : std::uint8_t { outside, touching, inside };

/// Decision from P(s) = (1-s) det(s S_B - S_A) - s c^T adj(s S_B - S_A) c and its part det(s S_B - S_A).
Containment containment(const Polynomial& whole, const Polynomial& pencil, bool concentric);

/// Two ellipses; all three forms by a common factor are enough. C = c c^T.
Containment containment(const Symmetric2<Integer>& a, const Symmetric2<Integer>& b,
                        const Symmetric2<Integer>& c);

}  // namespace exact
}  // namespace vericone
