// SPDX-License-Identifier: GPL-3.0-or-later
//
// All coordinates below are relative to the centre of A, moved there exactly. A line n.x + w = 0 has the
// homogeneous coordinates (n, w). With the quadratic forms
//   alpha(n) = n^T S_A n,  beta(n) = n^T S_B n,  s(n) = n.c,  c = p_B - p_A,
// the lines that touch A or B are the points of the two dual conics
//   w^2 = alpha(n),   (s(n) + w)^2 = beta(n).                                               (1)
//
// Relation. Primal conics: f(lambda) = det(lambda M_A + M_B), M negative inside. The bodies are separated iff
// f has two distinct positive roots and touch from outside iff it has one positive root, a double one (Wang,
// Wang, Kim, "An algebraic condition for the separation of two ellipsoids", CAGD 18 (2001); in the plane f is
// a cubic). For two unit circles at distance d, f = -(lambda + 1)(lambda^2 - (d^2 - 2) lambda + 1), which
// fixes the signs.
//
// Tangents. The difference of the two equations (1) is linear in w:
//   s^2 + 2 s w = beta - alpha,                                                             (2)
// so the resultant with respect to w is the binary quartic
//   R(n) = (s^2 + alpha - beta)^2 - 4 s^2 alpha.                                            (3)
// Its real roots n are the normals of the common tangents. A line has the centres on opposite sides iff
// w (s + w) < 0, and by (1), (2)
//   w (s + w) = w^2 + s w = (alpha + beta - s^2) / 2,
// so a root belongs to inner tangents iff alpha + beta - s^2 < 0 there. This also holds at s = 0, where (2)
// does not fix w: there alpha = beta, w = +-sqrt(alpha), and both lines are outer ones, as the sign says. At
// an inner root s != 0, so that w is unique: the inner tangents are in one-to-one correspondence with the
// inner roots, no coordinates need to be turned, and a normal along the y axis is a root at infinity of R(1,
// t).
#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/CORE_BigInt.h>
#include <CGAL/CORE_BigRat.h>
#include <vericone/internal/verify/predicates/exact_tangents.h>

#include <stdexcept>
#include <utility>
#include <vector>

#include "mp_interval.h"

namespace vericone::verify {
namespace {

using Integer = CORE::BigInt;
using Rational = CORE::BigRat;
using Kernel = CGAL::Algebraic_kernel_d_1<Integer>;
using Polynomial = Kernel::Polynomial_1;
using Root = Kernel::Algebraic_real_1;

/// Coefficients from the constant term up. A binary form in n = (n1, n2) is kept as its value at (1, t).
using Coefficients = std::vector<Rational>;

Coefficients operator*(const Coefficients& a, const Coefficients& b) {
  Coefficients r(a.size() + b.size() - 1, Rational(0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) r[i + j] += a[i] * b[j];
  return r;
}

Coefficients combine(const Coefficients& a, int factor, const Coefficients& b) {
  Coefficients r = a;
  for (std::size_t i = 0; i < b.size(); ++i) r[i] += Rational(factor) * b[i];
  return r;
}
Coefficients operator+(const Coefficients& a, const Coefficients& b) { return combine(a, 1, b); }
Coefficients operator-(const Coefficients& a, const Coefficients& b) { return combine(a, -1, b); }

/// A positive multiple of `c` with integer coefficients.
Polynomial with_integers(const Coefficients& c) {
  Integer common(1);
  for (const Rational& x : c) mpz_lcm(common.get_mp(), common.get_mp(), mpq_denref(x.get_mp()));
  std::vector<Integer> z;
  for (const Rational& x : c) {
    Integer factor, value;
    mpz_divexact(factor.get_mp(), common.get_mp(), mpq_denref(x.get_mp()));
    mpz_mul(value.get_mp(), factor.get_mp(), mpq_numref(x.get_mp()));
    z.push_back(value);
  }
  return Polynomial(z.begin(), z.end());
}

struct SymmetricMatrix {
  Rational xx, xy, yy;
};

SymmetricMatrix defining_matrix(const Ellipse& body) {
  if (!body.defined_by_factor()) {
    const Eigen::Matrix2d& s = body.shape();
    return {Rational(s(0, 0)), Rational(s(0, 1)), Rational(s(1, 1))};
  }
  const Rational f00(body.factor()(0, 0)), f01(body.factor()(0, 1)), f10(body.factor()(1, 0)),
      f11(body.factor()(1, 1));
  return {f00 * f00 + f01 * f01, f00 * f10 + f01 * f11, f10 * f10 + f11 * f11};
}

/// The pair in the coordinates of this file.
struct Pair {
  SymmetricMatrix a, b;
  Rational cx, cy;

  Pair(const Ellipse& body_a, const Ellipse& body_b)
      : a(defining_matrix(body_a)),
        b(defining_matrix(body_b)),
        cx(Rational(body_b.center().x()) - Rational(body_a.center().x())),
        cy(Rational(body_b.center().y()) - Rational(body_a.center().y())) {}
};

struct Solver {
  Kernel kernel;

  /// Distinct real roots in increasing order, with multiplicities. `p` must not be the zero polynomial.
  std::vector<std::pair<Root, unsigned>> roots(const Polynomial& p) const {
    std::vector<std::pair<Root, unsigned>> r;
    if (CGAL::degree(p) > 0) kernel.solve_1_object()(p, std::back_inserter(r));
    return r;
  }
  CGAL::Sign sign_at(const Coefficients& c, const Root& x) const {
    return kernel.sign_at_1_object()(with_integers(c), x);
  }
};

PlanarRelation relation_by_pencil(const Pair& p, const Solver& solver) {
  // Times det S, the conic (x - c)^T S^{-1} (x - c) - 1 has the matrix [adj S, -adj S c; ., c^T adj S c - det
  // S].
  using Row = std::array<Coefficients, 3>;
  const auto conic = [](const SymmetricMatrix& s, const Rational& x, const Rational& y) {
    const Rational gx = s.yy * x - s.xy * y, gy = s.xx * y - s.xy * x;
    return std::array<Rational, 6>{s.yy, -s.xy, s.xx,
                                   -gx,  -gy,   gx * x + gy * y - (s.xx * s.yy - s.xy * s.xy)};
  };
  const auto m_a = conic(p.a, Rational(0), Rational(0)), m_b = conic(p.b, p.cx, p.cy);
  const auto entry = [&](int k) { return Coefficients{m_b[k], m_a[k]}; };
  const std::array<Row, 3> m{Row{entry(0), entry(1), entry(3)}, Row{entry(1), entry(2), entry(4)},
                             Row{entry(3), entry(4), entry(5)}};
  const auto minor = [&](int i, int j) { return m[1][i] * m[2][j] - m[1][j] * m[2][i]; };
  const Coefficients f = m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1);

  int positive = 0;
  for (const auto& [root, multiplicity] : solver.roots(with_integers(f)))
    if (CGAL::sign(root) == CGAL::POSITIVE) ++positive;
  return positive == 2   ? PlanarRelation::separated
         : positive == 1 ? PlanarRelation::touching
                         : PlanarRelation::overlapping;
}

/// The normal (1, t) of an inner tangent, or (0, 1) where there is no root; `side` = sign of s(n).
struct Normal {
  std::optional<Root> t;
  int side;
};

/// The quartic (3) and its inner roots, t increasing, infinity last.
class InnerNormals {
 public:
  InnerNormals(const Pair& p, const Solver& solver) : solver_(solver) {
    alpha_ = {p.a.xx, Rational(2) * p.a.xy, p.a.yy};
    beta_ = {p.b.xx, Rational(2) * p.b.xy, p.b.yy};
    const Coefficients s{p.cx, p.cy}, s2 = s * s, l = s2 + alpha_ - beta_;
    resultant_ = l * l - Coefficients{Rational(4)} * s2 * alpha_;
    const Coefficients centers = alpha_ + beta_ - s2;

    const Polynomial r = with_integers(resultant_);
    if (CGAL::is_zero(r)) return;  // the same conic twice: every tangent is common, none is inner
    roots_ = solver.roots(r);
    for (const auto& [root, multiplicity] : roots_)
      if (solver.sign_at(centers, root) == CGAL::NEGATIVE)
        normals_.push_back({root, static_cast<int>(solver.sign_at(s, root))});
    if (resultant_[4] == Rational(0) && centers[2] < Rational(0))
      normals_.push_back({std::nullopt, p.cy > Rational(0) ? 1 : -1});
  }

  const std::vector<Normal>& normals() const { return normals_; }

  /// Whether x = -y, exactly, for two roots of R(1, t): -y is a root of R(1, -t).
  bool opposite(const Root& x, const Root& y) const {
    Coefficients mirrored = resultant_;
    for (std::size_t i = 1; i < mirrored.size(); i += 2) mirrored[i] = -mirrored[i];
    const auto mirrored_roots = solver_.roots(with_integers(mirrored));
    const auto compare = solver_.kernel.compare_1_object();
    for (std::size_t i = 0; i < roots_.size(); ++i)
      if (compare(roots_[i].first, y) == CGAL::EQUAL)
        return compare(mirrored_roots[roots_.size() - 1 - i].first, x) == CGAL::EQUAL;
    return false;
  }

 private:
  const Solver& solver_;
  Coefficients alpha_, beta_, resultant_;
  std::vector<std::pair<Root, unsigned>> roots_;
  std::vector<Normal> normals_;
};

/// Interval with rational ends: no rounding, all width comes from the algebraic root.
struct RationalInterval {
  Rational lo, hi;

  RationalInterval(const Rational& x) : lo(x), hi(x) {}
  RationalInterval(const Rational& l, const Rational& h) : lo(l), hi(h) {}

  friend RationalInterval operator+(const RationalInterval& a, const RationalInterval& b) {
    return {a.lo + b.lo, a.hi + b.hi};
  }
  friend RationalInterval operator-(const RationalInterval& a, const RationalInterval& b) {
    return {a.lo - b.hi, a.hi - b.lo};
  }
  friend RationalInterval operator*(const RationalInterval& a, const RationalInterval& b) {
    const std::array<Rational, 4> p{a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi};
    return {*std::min_element(p.begin(), p.end()), *std::max_element(p.begin(), p.end())};
  }
  bool reaches_zero() const { return lo <= Rational(0) && hi >= Rational(0); }
  /// Precondition: !b.reaches_zero().
  friend RationalInterval operator/(const RationalInterval& a, const RationalInterval& b) {
    return a * RationalInterval{Rational(1) / b.hi, Rational(1) / b.lo};
  }
};

/// The tangents with roots refined to `bits`, or nothing where that does not yet give what is promised.
class Construction {
 public:
  Construction(const Pair& pair, const Ellipse& a, const InnerNormals& inner, const Solver& solver, int bits)
      : pair_(pair), a_(a), inner_(inner), solver_(solver), bits_(bits) {}

  std::optional<InnerTangents> run() const {
    // With s(n) > 0 the normals N = side * n point from A to B and the sector is { v : N_i.v >= 0 }. Let N_1
    // be the clockwise one. The edge on the line of N_1 has N_2.v > 0, which is N_1 turned left: the left
    // edge. The right edge is N_2 turned right.
    const Normal* clockwise = &inner_.normals()[0];
    const Normal* counter = &inner_.normals()[1];
    if (clockwise->side * counter->side < 0) std::swap(clockwise, counter);

    const MpInterval right = angle(*counter, -counter->side), left = angle(*clockwise, clockwise->side);
    MpInterval psi = left - right;
    if (psi.certain_sign() == 0) return {};
    if (psi.certain_sign() < 0) psi = psi + MpInterval::pi(bits_).scaled(1);
    const std::optional<MpInterval> theta = bisector(right, psi, *counter, *clockwise);
    if (!theta) return {};
    for (const MpInterval& x : {right, left, psi, *theta})
      if (!x.adjacent() || !x.precise()) return {};

    InnerTangents r;
    r.right.direction = right.enclosed();
    r.left.direction = left.enclosed();
    r.psi = psi.enclosed();
    r.theta_b = theta->enclosed();
    if (!contacts(*counter, r.right) || !contacts(*clockwise, r.left)) return {};
    return r;
  }

 private:
  RationalInterval refined(const Root& t) const {
    const auto bounds = solver_.kernel.approximate_relative_1_object()(t, bits_);
    return {bounds.first, bounds.second};
  }

  /// Angle of turn * (-t, 1), or of turn * (-1, 0) at infinity, turn = +-1. Increasing in t.
  MpInterval angle(const Normal& normal, int turn) const {
    if (!normal.t) return turn > 0 ? MpInterval::pi(bits_) : MpInterval(bits_);
    const RationalInterval t = refined(*normal.t);
    MpInterval x(t.lo.get_mp(), t.hi.get_mp(), bits_), r(bits_);
    Mp y(bits_);
    mpfr_set_si(y.get(), turn, MPFR_RNDN);
    if (turn > 0) {
      mpfr_neg(x.lo.get(), x.lo.get(), MPFR_RNDN);
      mpfr_neg(x.hi.get(), x.hi.get(), MPFR_RNDN);
    }
    mpfr_atan2(r.lo.get(), y.get(), x.lo.get(), MPFR_RNDD);
    mpfr_atan2(r.hi.get(), y.get(), x.hi.get(), MPFR_RNDU);
    return r;
  }

  /// right + psi/2 brought into (-pi, pi]. The values 0 and pi, which no enclosure separates from their
  /// neighbours, are decided exactly: the edges are then mirror images in the x axis.
  std::optional<MpInterval> bisector(const MpInterval& right, const MpInterval& psi, const Normal& n_right,
                                     const Normal& n_left) const {
    const MpInterval pi = MpInterval::pi(bits_);
    MpInterval theta = right + psi.scaled(-1);
    const MpInterval beyond = theta - pi;
    const bool near_zero = theta.certain_sign() == 0, near_pi = beyond.certain_sign() == 0;
    if (near_zero || near_pi) {
      if (!n_right.t || !n_left.t || !inner_.opposite(*n_right.t, *n_left.t)) return {};
      return near_pi ? pi : MpInterval(bits_);
    }
    if (beyond.certain_sign() > 0) theta = theta - pi.scaled(1);
    return theta;
  }

  /// Points of contact: the pole of the line (n, w) is S_A n / (-w) for A; for B, as seen from its centre,
  /// where the line is (n, s + w), it is S_B n / -(s + w). By (2), w = (beta - alpha - s^2) / 2s.
  bool contacts(const Normal& normal, InnerTangent& out) const {
    const RationalInterval n1 = Rational(normal.t ? 1 : 0),
                           n2 = normal.t ? refined(*normal.t) : RationalInterval(Rational(1));
    const auto times = [&](const SymmetricMatrix& m) {
      return std::array<RationalInterval, 2>{RationalInterval(m.xx) * n1 + RationalInterval(m.xy) * n2,
                                             RationalInterval(m.xy) * n1 + RationalInterval(m.yy) * n2};
    };
    const auto sa = times(pair_.a), sb = times(pair_.b);
    const RationalInterval alpha = n1 * sa[0] + n2 * sa[1], beta = n1 * sb[0] + n2 * sb[1];
    const RationalInterval s = RationalInterval(pair_.cx) * n1 + RationalInterval(pair_.cy) * n2;
    if (s.reaches_zero()) return false;
    const RationalInterval w = (beta - alpha - s * s) / (RationalInterval(Rational(2)) * s), w_b = s + w;
    if (w.reaches_zero() || w_b.reaches_zero()) return false;
    const std::array<Rational, 2> c{pair_.cx, pair_.cy};
    for (int i = 0; i < 2; ++i) {
      const RationalInterval p_a = Rational(a_.center()(i));
      if (!enclose(p_a - sa[i] / w, out.point_on_a[i])) return false;
      if (!enclose(p_a + RationalInterval(c[i]) - sb[i] / w_b, out.point_on_b[i])) return false;
    }
    return true;
  }

  /// A coordinate may be an exact double, even 0: two steps of doubles, or a width of nearly nothing, will
  /// do.
  bool enclose(const RationalInterval& q, EnclosedReal& out) const {
    const MpInterval x(q.lo.get_mp(), q.hi.get_mp(), bits_);
    out = x.enclosed();
    const double l = out.lo(), h = out.hi();
    if (std::nextafter(std::nextafter(l, h), h) == h || l == h) return true;
    return x.certain_sign() == 0 && bits_ > kLeastBits;
  }

 public:
  static constexpr int kLeastBits = 256;

 private:
  const Pair& pair_;
  const Ellipse& a_;
  const InnerNormals& inner_;
  const Solver& solver_;
  int bits_;
};

}  // namespace

const char* name(PlanarRelation relation) {
  switch (relation) {
    case PlanarRelation::separated:
      return "separated";
    case PlanarRelation::touching:
      return "touching";
    case PlanarRelation::overlapping:
      return "overlapping";
  }
  return "?";
}

PlanarRelation exact_relation(const Ellipse& a, const Ellipse& b) {
  return relation_by_pencil(Pair(a, b), Solver{});
}

ExactTangents exact_inner_tangents(const Ellipse& a, const Ellipse& b) {
  const Pair pair(a, b);
  const Solver solver;
  const PlanarRelation relation = relation_by_pencil(pair, solver);
  const InnerNormals inner(pair, solver);
  const std::size_t expected = relation == PlanarRelation::separated  ? 2
                               : relation == PlanarRelation::touching ? 1
                                                                      : 0;
  if (inner.normals().size() != expected)
    throw std::logic_error(std::string("the pencil says that the ellipses are ") + name(relation) + ", but " +
                           std::to_string(inner.normals().size()) + " inner tangents were found");
  if (relation != PlanarRelation::separated) return {relation, std::nullopt};

  constexpr int kMostBits = 1 << 15;
  for (int bits = Construction::kLeastBits; bits <= kMostBits; bits *= 2)
    if (auto tangents = Construction(pair, a, inner, solver, bits).run()) return {relation, *tangents};
  throw std::logic_error("inner tangents not enclosed with 32768 bits");
}

}  // namespace vericone::verify
