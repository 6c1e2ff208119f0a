// SPDX-License-Identifier: BSD-3-Clause
#include "contact_time_exact.h"

#include <vericone/cones/clearance.h>
#include <cmath>
#include <functional>

#include "contact_polynomial.h"

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

/// The contact polynomial of two bodies t after now, p(x; t), without the factors that do not depend on t: a
/// polynomial in x of degree 2 to 4, each coefficient one in t of degree 2.
///
/// Such factors come from symmetries (two balls: a square), and would make the discriminant vanish for every
/// t. They have no positive root if the bodies overlap at any time, and no other factor can be repeated for
/// every t: it would hold the two positive roots apart, which meet at contact.
class MovingContact {
 public:
  MovingContact(const PairOnGrid<3>& pair, const IntegerVector<3>& w) {
    const ShapePencil<3> pencil(pair.a, pair.b);
    std::array<Polynomial, 3> by_time;  // coefficients of 1, t, t^2
    for (Polynomial& q : by_time) q.assign(5, Integer(0));
    for (int i = 0; i < 3; ++i) {
      const auto& e = pencil.adjugate[i];
      by_time[0][i + 1] = bilinear_form<3>(e, pair.c, pair.c);
      by_time[1][i + 1] = -2 * bilinear_form<3>(e, pair.c, w);
      by_time[2][i + 1] = bilinear_form<3>(e, w, w);
    }
    for (int i = 0; i < 4; ++i) {
      by_time[0][i] -= pencil.determinant[i];
      by_time[0][i + 1] -= pencil.determinant[i];
    }
    for (Polynomial& q : by_time) trim(q);
    const Polynomial fixed = gcd(gcd(by_time[0], by_time[1]), by_time[2]);
    p_.resize(by_time[0].size() - fixed.size() + 1);
    for (std::size_t k = 0; k < 3; ++k) {
      if (by_time[k].empty()) continue;
      const Polynomial reduced = divide_exactly(std::move(by_time[k]), fixed);
      for (std::size_t i = 0; i < reduced.size(); ++i) {
        p_[i].resize(k + 1, Integer(0));
        p_[i][k] = reduced[i];
      }
    }
    for (Polynomial& q : p_) trim(q);
  }

  /// A positive multiple of the discriminant with regard to x; of degree 12 in t at most.
  Polynomial discriminant() const {
    const auto times = [](long k, const Polynomial& p) { return p * Integer(k); };
    if (p_.size() == 3) return primitive_part(p_[1] * p_[1] - times(4, p_[0] * p_[2]));
    if (p_.size() == 4) {
      const auto &d = p_[0], &c = p_[1], &b = p_[2], &a = p_[3];
      const Polynomial bc = b * c, ad = a * d;
      return primitive_part(bc * bc - times(4, a * c * c * c + b * b * b * d) +
                            ad * (times(18, bc) - times(27, ad)));
    }
    const auto &e = p_[0], &d = p_[1], &c = p_[2], &b = p_[3], &a = p_[4];
    const Polynomial i = times(12, a * e) - times(3, b * d) + c * c;
    const Polynomial j =
        c * (times(72, a * e) + times(9, b * d) - times(2, c * c)) - times(27, a * d * d + b * b * e);
    return primitive_part(times(4, i * i * i) - j * j);
  }

  bool overlapping(const Dyadic& t) const {
    // p at t = m / 2^k, times 2^2k.
    Polynomial at_t;
    for (const Polynomial& q : p_) {
      Integer sum = 0;
      for (std::size_t i = 0; i < 3; ++i)
        if (i < q.size()) {
          Integer term = q[i] << static_cast<unsigned>((2 - i) * t.exponent);
          for (std::size_t k = 0; k < i; ++k) term *= t.numerator;
          sum += term;
        }
      at_t.push_back(std::move(sum));
    }
    return distinct_positive_roots(primitive_part(std::move(at_t))) == 0;
  }

 private:
  std::vector<Polynomial> p_;
};

/// Changes of sign among the coefficients of (1 + y)^n p((lo + hi y) / (1 + y)): 0 or 1 is the number of
/// roots in (lo, hi), with multiplicities (Descartes).
int descartes_bound(const Polynomial& p, const Dyadic& lo, const Dyadic& hi) {
  const unsigned k = std::max(lo.exponent, hi.exponent);
  const Polynomial numerator{lo.numerator << (k - lo.exponent), hi.numerator << (k - hi.exponent)},
      denominator{Integer(1) << k, Integer(1) << k};
  Polynomial sum, power{1};  // Horner with the powers of the denominator
  for (auto it = p.rbegin(); it != p.rend(); ++it) {
    sum = sum * numerator + power * *it;
    power = power * denominator;
  }
  int changes = 0, last = 0;
  for (const Integer& x : sum) {
    const int s = x.sign();
    if (s != 0 && last != 0 && s != last) ++changes;
    if (s != 0) last = s;
  }
  return changes;
}

Dyadic middle(const Dyadic& x, const Dyadic& y) {
  const unsigned k = std::max(x.exponent, y.exponent);
  return {(x.numerator << (k - x.exponent)) + (y.numerator << (k - y.exponent)), k + 1};
}

Dyadic shifted(const Dyadic& x, int by) {
  if (by < 0) return {x.numerator, x.exponent + static_cast<unsigned>(-by)};
  const unsigned up = static_cast<unsigned>(by);
  return up <= x.exponent ? Dyadic{x.numerator, x.exponent - up}
                          : Dyadic{x.numerator << (up - x.exponent), 0};
}

/// The root 2^by x of p(2^-by t).
RealRoot scaled_root(Polynomial p, const Dyadic& lo, const Dyadic& hi, int by) {
  const auto n = p.size() - 1;
  for (std::size_t i = 0; i <= n; ++i) p[i] <<= by > 0 ? (n - i) * by : i * -by;
  return {std::make_shared<const Polynomial>(primitive_part(std::move(p))), shifted(lo, by), shifted(hi, by)};
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
  const Fraction t = passing_time(pair, w, shadows, -repeated[0], repeated[1]);
  const Polynomial linear = primitive_part({-t.numerator, t.denominator});
  const RealRoot root = positive_roots(linear).front();
  return scaled_root(linear, root.lo(), root.hi(), unit);
}

/// A time at which bodies overlap that hardly do so: the cubic has no double root, but nearly.
std::optional<Dyadic> nearly_grazing_time(const PairOnGrid<3>& pair, const IntegerVector<3>& w) {
  const Shadows shadows(pair, w);
  auto extrema = positive_roots(derivative(shadows.cubic));
  if (extrema.empty()) return std::nullopt;
  extrema.back().refine(100);
  const Dyadic& x = extrema.back().lo();
  const Fraction t = passing_time(pair, w, shadows, x.numerator, Integer(1) << x.exponent);
  if (t.numerator <= 0 || t.denominator <= 0) return std::nullopt;
  const int bits = static_cast<int>(msb(t.denominator)) - static_cast<int>(msb(t.numerator)) + 100;
  const auto exponent = static_cast<unsigned>(std::max(bits, 0));
  return Dyadic{(t.numerator << exponent) / t.denominator, exponent};
}

/// The first contact of bodies that will overlap, in the units of the grid. `first` and `inside`: guesses of
/// it and of times at which they overlap.
RealRoot entry_time(const MovingContact& contact, double first, std::array<double, 2> inside,
                    const std::function<std::optional<Dyadic>()>& last_guess, int unit) {
  const Polynomial discriminant = contact.discriminant();
  const auto by_all_roots = [&] {
    // Between neighbouring roots of the discriminant the relation does not change.
    const auto roots = positive_roots(discriminant);
    std::size_t i = 0;
    while (!contact.overlapping(roots[i].hi())) ++i;
    return scaled_root(roots[i].polynomial(), roots[i].lo(), roots[i].hi(), unit);
  };
  const auto usable = [](double t) { return std::isfinite(t) && t > 0; };
  Dyadic lo{0, 0}, hi{0, 0};
  for (const double t : inside)
    if (hi.numerator == 0 && usable(t) && contact.overlapping(Dyadic::of(t))) hi = Dyadic::of(t);
  if (hi.numerator == 0) {
    const auto t = last_guess();
    if (!t || !contact.overlapping(*t)) return by_all_roots();
    hi = *t;
  }
  const auto narrow_to = [&](const Dyadic& t) {
    if (exact::compare(t, lo) <= 0 || exact::compare(t, hi) >= 0) return;
    (contact.overlapping(t) ? hi : lo) = t;
  };
  if (usable(first))
    for (const double part : {0x1p-40, 0x1p-20, 0x1p-8}) {
      narrow_to(Dyadic::of(first * (1 - part)));
      narrow_to(Dyadic::of(first * (1 + part)));
    }
  // Times of contact are an interval, so the first one is the only root between a time of disjoint and one of
  // overlapping bodies where there is only one root.
  constexpr int kMostHalvings = 200;
  for (int halvings = 0; halvings < kMostHalvings; ++halvings) {
    if (lo.numerator != 0 && sign_at(discriminant, lo) != 0 && sign_at(discriminant, hi) != 0 &&
        descartes_bound(discriminant, lo, hi) == 1)
      return scaled_root(discriminant, lo, hi, unit);
    narrow_to(middle(lo, hi));
  }
  return by_all_roots();
}

/// A guess of a time at which they overlap: half way between the first and the last contact.
double time_inside(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& w, double first) {
  const double far =
      4 * ((b.center() - a.center()).norm() + a.factor().norm() + b.factor().norm()) / w.stableNorm();
  if (!(far * w).allFinite() || !std::isfinite(far)) return first;
  const double last = far - vericone::contact_time(a.translated(far * w), b, -w);
  return 0.5 * (first + last);
}

}  // namespace

ContactTime contact_time(const ConeOracle& oracle, const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) {
  using When = ContactTime::When;
  const Verdict verdict = oracle.verdict(v_a, v_b);
  if (verdict == Verdict::overlapping || verdict == Verdict::touching) return {When::now, {}};
  if (verdict == Verdict::out) return {When::never, {}};
  const PairOnGrid<3> pair(oracle.a(), oracle.b());
  const VelocityOnGrid velocity(v_a, v_b);
  // A length of 2^a and a speed of 2^b make a time of 2^(a - b).
  const int unit = length_exponent(pair, oracle.a(), oracle.b()) - velocity.exponent;
  if (verdict == Verdict::on) return {When::later, grazing_time(pair, velocity.w, unit)};
  const Eigen::Vector3d w = v_a - v_b;
  const double first = vericone::contact_time(oracle.a(), oracle.b(), w),
               inside = time_inside(oracle.a(), oracle.b(), w, first);
  const double passing = w.allFinite() ? clearance(oracle.a(), oracle.b(), w).time : first;
  return {When::later, entry_time(
                           MovingContact(pair, velocity.w), std::ldexp(first, -unit),
                           {std::ldexp(inside, -unit), std::ldexp(passing, -unit)},
                           [&] { return nearly_grazing_time(pair, velocity.w); }, unit)};
}

int compare(ContactTime& x, ContactTime& y) {
  if (x.when != y.when) return x.when < y.when ? -1 : 1;
  return x.when == ContactTime::When::later ? compare(*x.root, *y.root) : 0;
}

}  // namespace vericone::exact
