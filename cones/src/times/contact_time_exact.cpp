// SPDX-License-Identifier: BSD-3-Clause
#include "times/contact_time_exact.h"

#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <cstdlib>

#include "ellipsoids/contact_polynomial.h"
#include "ellipsoids/pair_on_grid.h"

namespace vericone::exact {
namespace {

/// v_a - v_b = w 2^exponent.
struct VelocityOnGrid {
  IntegerVector<3> w;
  int exponent;

  VelocityOnGrid(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) {
    constexpr int kNone = 1 << 20;
    exponent = kNone;
    for (int i = 0; i < 3; ++i)
      exponent = std::min({exponent, grid_exponent(v_a(i), kNone), grid_exponent(v_b(i), kNone)});
    for (int i = 0; i < 3; ++i) w[i] = on_grid(v_a(i), exponent) - on_grid(v_b(i), exponent);
  }
};

/// The exponent of the unit of length of a pair, from the centres; they differ.
int length_exponent(const PairOnGrid<3>& pair, const Ellipsoid& a, const Ellipsoid& b) {
  constexpr int kNone = 1 << 20;
  int i = 0;
  while (pair.c[i] == 0) ++i;
  const double x = a.center()(i), y = b.center()(i);
  const int e = std::min(grid_exponent(x, kNone), grid_exponent(y, kNone));
  const Integer c = on_grid(y, e) - on_grid(x, e);
  return e - static_cast<int>(msb(Integer(abs(pair.c[i])))) + static_cast<int>(msb(Integer(abs(c))));
}

/// Shadows along w.
struct Shadows {
  int i, j, k;
  Symmetric2<Integer> a, b;
  Integer dx, dy;
  Polynomial cubic;

  Shadows(const PairOnGrid<3>& pair, const IntegerVector<3>& w) {
    k = w[0] != 0 ? 0 : w[1] != 0 ? 1 : 2;
    i = (k + 1) % 3;
    j = (k + 2) % 3;
    const auto entry = [](const IntegerMatrix<3>& s) {
      return [&s](int r, int col) -> const Integer& { return s[r][col]; };
    };
    a = shadow<Integer>(entry(pair.a), w[i], w[j], w[k], i, j, k);
    b = shadow<Integer>(entry(pair.b), w[i], w[j], w[k], i, j, k);
    dx = w[k] * pair.c[i] - w[i] * pair.c[k];
    dy = w[k] * pair.c[j] - w[j] * pair.c[k];
    const ContactCubic<Integer> c(a, b, dx, dy);
    cubic = {c.k0, -c.k1, -c.k2, c.k3};
  }
};

struct Fraction {
  Integer numerator, denominator;  // positive
};

/// When the supporting points for rho_A / rho_B = x / y pass each other: n = L^T adj(y M_A + x M_B) d,
/// n.c = rho_A + rho_B, and t = q.w / w.w with q = c - S_A n / rho_A - S_B n / rho_B.
Fraction passing_time(const PairOnGrid<3>& pair, const IntegerVector<3>& w, const Shadows& s,
                      const Integer& x, const Integer& y) {
  const Integer m11 = y * s.a.a + x * s.b.a, m12 = y * s.a.b + x * s.b.b, m22 = y * s.a.c + x * s.b.c;
  const Integer u = m22 * s.dx - m12 * s.dy, v = m11 * s.dy - m12 * s.dx;
  IntegerVector<3> n;
  n[s.i] = w[s.k] * u;
  n[s.j] = w[s.k] * v;
  n[s.k] = -(w[s.i] * u + w[s.j] * v);
  const auto dot = [](const IntegerVector<3>& f, const IntegerVector<3>& g) {
    return Integer(f[0] * g[0] + f[1] * g[1] + f[2] * g[2]);
  };
  const Integer nc_xy = dot(n, pair.c) * x * y;
  return {dot(pair.c, w) * nc_xy -
              (x + y) * (y * bilinear_form<3>(pair.a, n, w) + x * bilinear_form<3>(pair.b, n, w)),
          dot(w, w) * nc_xy};
}

/// The time of a grazing contact is rational: rho_A / rho_B is the double root of the shadows' cubic.
RealRoot grazing_time(const PairOnGrid<3>& pair, const IntegerVector<3>& w, int unit) {
  const Shadows shadows(pair, w);
  const Polynomial repeated = gcd(shadows.cubic, derivative(shadows.cubic));  // linear: one root is negative
  Fraction t = passing_time(pair, w, shadows, -repeated[0], repeated[1]);
  (unit > 0 ? t.numerator : t.denominator) <<= std::abs(unit);
  return positive_roots({-t.numerator, t.denominator}).front();
}

/// A guess of rho_A / rho_B at the first contact.
double ratio_at_contact(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& w) {
  if (!w.allFinite()) return 1;
  const Eigen::Vector3d c = b.center() - a.center() - vericone::contact_time(a, b, w) * w;
  return ContactFrame<3>(a.factor(), b.factor(), c).ratio;
}

}  // namespace

ContactTime::ContactTime(const ConeOracle& oracle, const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) {
  const Verdict verdict = oracle.verdict(v_a, v_b);
  if (verdict == Verdict::overlapping || verdict == Verdict::touching) when_ = When::now;
  if (verdict != Verdict::in && verdict != Verdict::on) return;
  when_ = When::later;
  const PairOnGrid<3> pair(oracle.a(), oracle.b());
  const VelocityOnGrid velocity(v_a, v_b);
  // A length of 2^a and a speed of 2^b make a time of 2^(a - b).
  const int unit = length_exponent(pair, oracle.a(), oracle.b()) - velocity.exponent;
  if (verdict == Verdict::on)
    root_ = grazing_time(pair, velocity.w, unit);
  else
    entry_.emplace(MovingContact(pair, velocity.w, unit),
                   ratio_at_contact(oracle.a(), oracle.b(), v_a - v_b));
}

const Polynomial& ContactTime::polynomial() { return entry_ ? entry_->discriminant() : root_->polynomial(); }

RealRoot& ContactTime::root() {
  if (!root_) root_ = entry_->root();
  return *root_;
}

std::pair<Dyadic, Dyadic> ContactTime::bounds(int bits) {
  if (entry_) {
    entry_->refine(bits);
    return {entry_->lo(), entry_->hi()};
  }
  root_->refine(bits);
  return {root_->lo(), root_->hi()};
}

Interval ContactTime::enclosure() {
  const auto [lo, hi] = bounds(56);
  return hull(exact::enclosure(lo), exact::enclosure(hi));
}

int compare(ContactTime& x, ContactTime& y) {
  if (x.when_ != y.when_) return x.when_ < y.when_ ? -1 : 1;
  if (x.when_ != ContactTime::When::later) return 0;
  // Most ties have a reason, and other times rarely agree in so many digits.
  if (x.entry_ && y.entry_ && x.entry_->contact().same_as(y.entry_->contact())) return 0;
  const auto by_bounds = [&](int bits) {
    const auto [x_lo, x_hi] = x.bounds(bits);
    const auto [y_lo, y_hi] = y.bounds(bits);
    return compare(x_hi, y_lo) < 0 ? -1 : compare(y_hi, x_lo) < 0 ? 1 : 0;
  };
  for (const int bits : {64, 192})
    if (const int s = by_bounds(bits)) return s;
  if (!surely_coprime(x.polynomial(), y.polynomial())) return compare(x.root(), y.root());
  for (int bits = 384;; bits *= 2)
    if (const int s = by_bounds(bits)) return s;
}

}  // namespace vericone::exact
