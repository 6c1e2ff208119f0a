// SPDX-License-Identifier: BSD-3-Clause
#include "combined/relation.h"

#include <vericone/geometry/combined.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace vericone {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// A direction up to sign by one number, increasing counter-clockwise over half a turn: (1, tau) for tau in
/// [-1, 1], (2 - tau, 1) for tau in [1, 3].
Vector2d direction(double tau) { return tau <= 1 ? Vector2d(1, tau) : Vector2d(2 - tau, 1); }
double direction_parameter(const Vector2d& u) {
  return std::abs(u.y()) <= std::abs(u.x()) ? u.y() / u.x() : 2 - u.x() / u.y();
}

using Parameters = SmallList<double, 64>;
using Quartic = std::array<double, 5>;  // Bernstein coefficients

/// The one root between ends of different signs, by false position with halving (Illinois).
double bracketed_root(const Quartic& b, double lo, double hi) {
  const auto value = [&](double s) {
    const double r = 1 - s;
    return r * r * (r * (r * b[0] + 4 * s * b[1]) + 6 * s * s * b[2]) + s * s * s * (4 * r * b[3] + s * b[4]);
  };
  double x = 0, y = 1, fx = b[0], fy = b[4];
  for (int iteration = 0; iteration < 60 && y - x > 1e-16; ++iteration) {
    // Every third step a bisection, against slow convergence next to another root.
    const double s = iteration % 3 == 2 ? 0.5 * (x + y) : std::clamp(x + (y - x) * fx / (fx - fy), x, y);
    const double f = value(s);
    if (f == 0 || s == x || s == y) return lo + s * (hi - lo);
    if ((f < 0) == (fx < 0)) {
      x = s, fx = f, fy *= 0.5;
    } else {
      y = s, fy = f, fx *= 0.5;
    }
  }
  return lo + 0.5 * (x + y) * (hi - lo);
}

/// Roots on [lo, hi] by Descartes' rule: subdivided until one sign change is left, or so short that only
/// rounding could tell two close roots from none; then the middle is reported, so that it is looked at.
void isolate(const Quartic& b, double lo, double hi, int depth, Parameters& roots) {
  int changes = 0;
  double last = 0;
  for (const double x : b) {
    if (x == 0) continue;
    changes += last * x < 0;
    last = x;
  }
  if (b[0] == 0) roots.push_back(lo);
  if (changes == 0) return;
  if (changes == 1 && b[0] != 0 && b[4] != 0) {
    roots.push_back(bracketed_root(b, lo, hi));
    return;
  }
  const double middle = 0.5 * (lo + hi);
  if (depth == 0) {
    roots.push_back(middle);
    return;
  }
  Quartic left, right = b;
  for (int k = 0; k < 5; ++k) {
    left[k] = right[0];
    for (int i = 0; i + 1 < 5 - k; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
  }
  // right now holds its coefficients in order from the common point.
  isolate(left, lo, middle, depth - 1, roots);
  isolate(right, middle, hi, depth - 1, roots);
}

/// c[0] + c[1] t + ... on [-1, 1] to Bernstein form.
Quartic bernstein(const Quartic& c) {
  // With t = 2 s - 1: Taylor shift to -1, then scale by 2, then divide by binomials.
  Quartic p = c;
  for (int i = 0; i < 4; ++i)
    for (int j = 3; j >= i; --j) p[j] -= p[j + 1];
  for (int i = 1; i < 5; ++i) p[i] *= 1 << i;
  static constexpr int kBinomial[5] = {1, 4, 6, 4, 1};
  Quartic b{};
  for (int i = 0; i < 5; ++i) p[i] /= kBinomial[i];
  for (int i = 0; i < 5; ++i) {
    // b_i = sum_k binom(i, k) p_k.
    static constexpr int kRows[5][5] = {
        {1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}};
    for (int k = 0; k <= i; ++k) b[i] += kRows[i][k] * p[k];
  }
  return b;
}

/// A body where the other's ellipse is the unit disc about the origin: conic j is
/// n(x) + 2 g.x + constant = 0.
struct SeenConic {
  Matrix2d n;
  Vector2d g;
  double constant;
};

SeenConic seen_conic(const PlanarBoundary& a, const PlanarBoundary& b, int j) {
  const Matrix2d& f = a.rounds()[0].factor;
  const Vector2d c = b.body().center() - a.body().center();
  if (j == 0) {
    const Matrix2d g = b.rounds()[0].inverse * f;
    const Vector2d d = b.rounds()[0].inverse * c;
    return {g.transpose() * g, -(g.transpose() * d), d.squaredNorm() - 1};
  }
  const Delimiter<2>& delimiter = b.body().delimiters()[j - 1];
  return {f.transpose() * delimiter.matrix * f, -(f.transpose() * (delimiter.matrix * c)),
          c.dot(delimiter.matrix * c) - delimiter.level};
}

/// Directions in which the conic u^T m u = level about the origin crosses the other one. On both,
/// (level n(u) + constant m(u))^2 = 4 level m(u) g(u)^2, a quartic in the direction.
void crossings(const Matrix2d& m, double level, const SeenConic& other, Parameters& roots) {
  using Quadratic = std::array<double, 3>;
  const auto form = [](const Matrix2d& q) -> Quadratic { return {q(0, 0), 2 * q(0, 1), q(1, 1)}; };
  const Quadratic n = form(other.n), mm = form(m);
  Quadratic p{};
  for (int i = 0; i < 3; ++i) p[i] = level * n[i] + other.constant * mm[i];
  const Quadratic gg{other.g.x() * other.g.x(), 2 * other.g.x() * other.g.y(), other.g.y() * other.g.y()};
  Quartic f{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) f[i + j] += p[i] * p[j] - 4 * level * mm[i] * gg[j];
  constexpr int kDepth = 50;
  isolate(bernstein(f), -1, 1, kDepth, roots);
  std::reverse(f.begin(), f.end());
  Parameters other_chart;
  isolate(bernstein(f), -1, 1, kDepth, other_chart);
  for (const double t : other_chart) roots.push_back(2 - t);
}

class Meeting {
 public:
  Meeting(const PlanarBoundary& a, const PlanarBoundary& b) : a_(a), b_(b) {}

  /// Whether some boundary point of A is in B.
  bool boundary_reaches() const {
    Parameters taus;
    const auto corners = a_.corners();
    for (const auto& corner : corners) {
      const Vector2d u = a_.rounds()[0].inverse * corner.offset;
      if (common(u)) return true;
      if (u != Vector2d::Zero()) taus.push_back(direction_parameter(u));
    }
    SmallList<SeenConic, 4> seen;
    for (int j = 0; j < b_.conics(); ++j) seen.push_back(seen_conic(a_, b_, j));
    SmallList<Matrix2d, 4> own;
    for (int i = 0; i < a_.conics(); ++i) own.push_back(a_.matrix(i));
    for (int i = 0; i < a_.conics(); ++i) {
      if (a_.level(i) == 0) {
        if (lines_reach(own, own[i], seen)) return true;
        continue;
      }
      for (const SeenConic& other : seen) crossings(own[i], a_.level(i), other, taus);
    }
    std::sort(taus.begin(), taus.end());
    // Between crossings and corners nothing changes, so one point of each piece tells; the crossings
    // themselves are asked for the sake of those that rounding makes of a touch.
    const std::size_t count = taus.size();
    if (count == 0) return arc_point(own, 0);
    for (std::size_t k = 0; k < count; ++k) {
      const double next = k + 1 < count ? taus[k + 1] : taus[0] + 4;
      const double middle = 0.5 * (taus[k] + next);
      if (arc_point(own, taus[k]) || arc_point(own, middle > 3 ? middle - 4 : middle)) return true;
    }
    return false;
  }

 private:
  /// Certain: the point F u of A, moved inwards or aside by as much as its own rounding may be, is in both.
  bool common(const Vector2d& u) const {
    const Vector2d c = b_.body().center() - a_.body().center();
    const Matrix2d& f = a_.rounds()[0].factor;
    if (!b_.contains(f * u - c)) return false;
    const Vector2d across(-u.y(), u.x());
    for (const double step : {0.0, 1e-15, 1e-14, 1e-12, 1e-10, 1e-8})
      for (const double aside : {0.0, step, -step}) {
        const Vector2d point = a_.body().center() + f * ((1 - step) * u + aside * across);
        if (side<2>(a_.body(), point) != Sign::positive && side<2>(b_.body(), point) != Sign::positive)
          return true;
        if (step == 0) break;
      }
    return false;
  }

  double radius(const SmallList<Matrix2d, 4>& own, const Vector2d& u) const {
    double inverse = u.squaredNorm();
    for (int i = 1; i < a_.conics(); ++i) {
      const double value = u.dot(own[i] * u);
      if (!(value > 0)) continue;
      if (a_.level(i) == 0) return 0;
      inverse = std::max(inverse, value / a_.level(i));
    }
    return 1 / std::sqrt(inverse);
  }

  bool arc_point(const SmallList<Matrix2d, 4>& own, double tau) const {
    const Vector2d u = direction(tau);
    const Vector2d point = radius(own, u) * u;
    return common(point) || common(-point);
  }

  /// The boundary lines of a delimiter of level 0, as far as they belong to the body.
  bool lines_reach(const SmallList<Matrix2d, 4>& own, const Matrix2d& m,
                   const SmallList<SeenConic, 4>& seen) const {
    Vector2d lines[2];
    const int found = root_directions(m, lines);
    for (int k = 0; k < found; ++k) {
      const Vector2d& u = lines[k];
      double inverse = 1;
      for (int i = 1; i < a_.conics(); ++i) {
        const double value = u.dot(own[i] * u);
        if (a_.level(i) > 0) {
          inverse = std::max(inverse, value / a_.level(i));
        } else if (value > 1e-15 * own[i].cwiseAbs().sum()) {
          inverse = std::numeric_limits<double>::infinity();
        }
      }
      const double reach = 1 / std::sqrt(inverse);
      SmallList<double, 16> stops;
      stops.push_back(-reach);
      stops.push_back(reach);
      stops.push_back(0);
      for (const SeenConic& s : seen) {
        const double p = u.dot(s.n * u), q = s.g.dot(u);
        const double root = std::sqrt(std::max(q * q - p * s.constant, 0.0));
        const double big = -(q + std::copysign(root, q));
        for (const double r : {big / p, s.constant / big})
          if (std::abs(r) < reach) stops.push_back(r);
      }
      std::sort(stops.begin(), stops.end());
      for (std::size_t i = 0; i < stops.size(); ++i) {
        if (common(stops[i] * u)) return true;
        if (i + 1 < stops.size() && common(0.5 * (stops[i] + stops[i + 1]) * u)) return true;
      }
    }
    return false;
  }

  const PlanarBoundary &a_, &b_;
};

}  // namespace

// Bodies that meet without either centre in the other body have crossing boundaries: both are star-shaped
// about their centres, so neither can lie inside the other.
bool bodies_meet(const PlanarBoundary& a, const PlanarBoundary& b) {
  if (side<2>(a.body(), b.body().center()) != Sign::positive) return true;
  if (side<2>(b.body(), a.body().center()) != Sign::positive) return true;
  return Meeting(a, b).boundary_reaches() || Meeting(b, a).boundary_reaches();
}

}  // namespace vericone
