// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/predicates/truth.h>

#include <stdexcept>

#include "predicates/algebra.h"

namespace vericone::verify {
namespace {

using namespace algebra;

/// Shapes and centre line of a pair in one unit of length.
template <int D>
struct Pair {
  Matrix<D> a, b;
  Vector<D> c;

  Pair(const BasicEllipsoid<D>& body_a, const BasicEllipsoid<D>& body_b)
      : Pair(body_a, body_b, unit_of(body_a, body_b)) {}

  Pair(const BasicEllipsoid<D>& body_a, const BasicEllipsoid<D>& body_b, int unit) {
    a = shape_on_unit<D>(body_a, unit);
    b = shape_on_unit<D>(body_b, unit);
    const auto pa = on_unit<D>(body_a.center(), unit), pb = on_unit<D>(body_b.center(), unit);
    for (int i = 0; i < D; ++i) c[i] = pb[i] - pa[i];
  }

 private:
  static int unit_of(const BasicEllipsoid<D>& body_a, const BasicEllipsoid<D>& body_b) {
    Unit unit;
    unit.body<D>(body_a);
    unit.body<D>(body_b);
    return unit.e;
  }
};

/// The quadric of the body with shape S about p, times det S: negative inside.
template <int D>
Matrix<D + 1> quadric(const Matrix<D>& s, const Vector<D>& p) {
  const Matrix<D> adj = adjugate<D>(s);
  const Vector<D> g = times<D>(adj, p);
  Matrix<D + 1> q;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) q[i][j] = adj[i][j];
    q[i][D] = q[D][i] = -g[i];
  }
  q[D][D] = dot<D>(g, p) - determinant<D>(s);
  return q;
}

template <int N>
bool positive_definite(const Matrix<N>& m) {
  std::vector<int> leading;
  for (int k = 0; k < N; ++k) {
    leading.push_back(k);
    if (sgn(minor_determinant<N, Integer>(m, leading, leading)) <= 0) return false;
  }
  return true;
}

/// x.num P + x.den Q.
template <int N>
Matrix<N> combined(const Matrix<N>& p, const Matrix<N>& q, const Rational& x) {
  Matrix<N> m;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) m[i][j] = x.get_num() * p[i][j] + x.get_den() * q[i][j];
  return m;
}

/// What lambda P + Q can be for lambda > 0.
struct Definiteness {
  std::optional<Rational> definite_at;
  bool semidefinite = false;
  int positive_roots = 0;  // distinct ones of det(lambda P + Q)
  unsigned largest_multiplicity = 0;
};

template <int N>
Definiteness definiteness(const Matrix<N>& p, const Matrix<N>& q) {
  std::array<std::array<Form, N>, N> m;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) m[i][j] = Form({q[i][j], p[i][j]});
  const auto all = without<N>(-1);
  const Roots roots(minor_determinant<N, Form>(m, all, all));

  Definiteness r;
  std::size_t first = 0;
  while (first < roots.size() && roots.sign_of_root(first) <= 0) ++first;
  r.positive_roots = static_cast<int>(roots.size() - first);
  for (std::size_t i = first; i < roots.size(); ++i)
    r.largest_multiplicity = std::max(r.largest_multiplicity, roots.multiplicity(i));

  // Gaps of (0, infinity): the numbers between roots, the first of them positive.
  std::vector<Rational> samples = roots.between();
  samples.erase(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(first));
  if (sgn(samples.front()) <= 0) {
    if (first == roots.size()) {
      samples.front() = 1;
    } else {
      // A number in (0, first positive root): halve until the root is above.
      Rational x = 1;
      const auto below = [&](const Rational& y) {
        return roots.sign_at(Form({-y.get_num(), y.get_den()}), first) > 0;
      };
      while (!below(x)) x /= 1 << 16;
      samples.front() = x;
    }
  }
  for (const Rational& x : samples)
    if (positive_definite<N>(combined<N>(p, q, x))) {
      r.definite_at = x;
      r.semidefinite = true;
      return r;
    }
  // At a root: the sums of all principal minors of each size are the coefficients of the characteristic
  // polynomial; no eigenvalue is negative iff no sum is.
  std::vector<Form> sums;
  for (int size = 1; size < N; ++size) {
    Form sum;
    for (unsigned subset = 0; subset < 1u << N; ++subset) {
      std::vector<int> rows;
      for (int i = 0; i < N; ++i)
        if (subset >> i & 1) rows.push_back(i);
      if (static_cast<int>(rows.size()) == size) sum = sum + minor_determinant<N, Form>(m, rows, rows);
    }
    sums.push_back(sum);
  }
  for (std::size_t i = first; i < roots.size() && !r.semidefinite; ++i) {
    r.semidefinite = true;
    for (const Form& sum : sums)
      if (roots.sign_at(sum, i) < 0) {
        r.semidefinite = false;
        break;
      }
  }
  return r;
}

template <int N>
Matrix<N> negated(Matrix<N> m) {
  for (auto& row : m)
    for (Integer& x : row) x = -x;
  return m;
}

struct Apart {
  Relation relation;
  std::optional<Rational> definite_at;
};

template <int D>
Apart apart(const Pair<D>& pair) {
  const Vector<D> origin{};
  const Definiteness d = definiteness<D + 1>(quadric<D>(pair.a, origin), quadric<D>(pair.b, pair.c));
  const Relation relation = d.definite_at    ? Relation::disjoint
                            : d.semidefinite ? Relation::touching
                                             : Relation::overlapping;
  const Relation by_roots = d.positive_roots == 2   ? Relation::disjoint
                            : d.positive_roots == 1 ? Relation::touching
                                                    : Relation::overlapping;
  if (relation != by_roots)
    throw std::logic_error(std::string("definiteness says ") + vericone::to_string(relation) +
                           ", the roots " + vericone::to_string(by_roots));
  return {relation, d.definite_at};
}

/// n.c, q_A, q_B of g(n) > 0 <=> n.c > 0, G > 0 and F > 0.
template <int D>
bool separates_strictly(const Pair<D>& pair, const Vector<D>& n) {
  const Integer nc = dot<D>(n, pair.c), qa = form<D>(pair.a, n, n), qb = form<D>(pair.b, n, n),
                g = nc * nc - qa - qb;
  return sgn(nc) > 0 && sgn(g) > 0 && g * g > 4 * qa * qb;
}

template <int D>
Vector<D> velocity(const Eigen::Matrix<double, D, 1>& v_a, const Eigen::Matrix<double, D, 1>& v_b) {
  Unit unit;
  unit.vector<D>(v_a);
  unit.vector<D>(v_b);
  auto w = on_unit<D>(v_a, unit.e);
  const auto b = on_unit<D>(v_b, unit.e);
  for (int i = 0; i < D; ++i) w[i] -= b[i];
  return w;
}

template <int N>
bool is_zero(const Vector<N>& v) {
  for (const Integer& x : v)
    if (x != 0) return false;
  return true;
}

}  // namespace

const char* to_string(TruePosition position) {
  switch (position) {
    case TruePosition::disjoint:
      return "disjoint";
    case TruePosition::touching:
      return "touching";
    case TruePosition::crossing:
      return "crossing";
    case TruePosition::a_inside_b:
      return "a inside b";
    case TruePosition::a_inside_b_touching:
      return "a inside b, touching";
    case TruePosition::b_inside_a:
      return "b inside a";
    case TruePosition::b_inside_a_touching:
      return "b inside a, touching";
    case TruePosition::equal:
      return "equal";
  }
  return "";
}

template <int D>
Relation relation_truth(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b) {
  return apart<D>(Pair<D>(a, b)).relation;
}
template Relation relation_truth<2>(const Ellipse&, const Ellipse&);
template Relation relation_truth<3>(const Ellipsoid&, const Ellipsoid&);

template <int D>
TruePosition position_truth(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b) {
  const Pair<D> pair(a, b);
  const Relation relation = apart<D>(pair).relation;
  if (relation == Relation::disjoint) return TruePosition::disjoint;
  if (relation == Relation::touching) return TruePosition::touching;
  const Matrix<D + 1> qa = quadric<D>(pair.a, Vector<D>{}), qb = quadric<D>(pair.b, pair.c);
  const Definiteness a_holds_b = definiteness<D + 1>(qb, negated<D + 1>(qa)),
                     b_holds_a = definiteness<D + 1>(qa, negated<D + 1>(qb));
  if (a_holds_b.definite_at) return TruePosition::b_inside_a;
  if (b_holds_a.definite_at) return TruePosition::a_inside_b;
  if (a_holds_b.semidefinite && b_holds_a.semidefinite) return TruePosition::equal;
  if (a_holds_b.semidefinite) return TruePosition::b_inside_a_touching;
  if (b_holds_a.semidefinite) return TruePosition::a_inside_b_touching;
  return TruePosition::crossing;
}
template TruePosition position_truth<2>(const Ellipse&, const Ellipse&);
template TruePosition position_truth<3>(const Ellipsoid&, const Ellipsoid&);

namespace {

/// A pair as it stands, A moving along w != 0.
struct Encounter {
  Pair<3> pair;
  Relation relation = Relation::disjoint;
  Vector<3> normal;  // of disjoint bodies: separates them strictly

  explicit Encounter(const Pair<3>& given) : pair(given) {
    const Apart found = apart<3>(pair);
    relation = found.relation;
    if (found.definite_at) find_normal(*found.definite_at);
  }

  /// The least value of lambda q_A + q_B is positive, so the tangent plane of lambda q_A at that point, which
  /// is also that of -q_B, leaves A on one side and B on the other.
  void find_normal(const Rational& lambda) {
    const Matrix<4> q = combined<4>(quadric<3>(pair.a, Vector<3>{}), quadric<3>(pair.b, pair.c), lambda);
    Matrix<3> m;
    Vector<3> rest;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m[i][j] = q[i][j];
      rest[i] = -q[i][3];
    }
    normal = times<3>(adjugate<3>(pair.a), times<3>(adjugate<3>(m), rest));
    if (!separates_strictly<3>(pair, normal)) throw std::logic_error("a definite pencil without a plane");
  }

  /// Of disjoint bodies.
  Membership membership(const Vector<3>& w) const {
    // Two integer vectors across w.
    const int k = w[0] != 0 ? 0 : w[1] != 0 ? 1 : 2;
    std::array<Vector<3>, 2> e;
    for (int i = 0; i < 2; ++i) {
      const int other = (k + 1 + i) % 3;
      e[i][other] = w[k];
      e[i][k] = -w[other];
    }
    const auto quadratic = [&](const Matrix<3>& s) {
      return Form({form<3>(s, e[0], e[0]), 2 * form<3>(s, e[0], e[1]), form<3>(s, e[1], e[1])});
    };
    const Form line({dot<3>(e[0], pair.c), dot<3>(e[1], pair.c)}),
        qa = quadratic(pair.a), qb = quadratic(pair.b), g = line * line - qa - qb,
        f = g * g - Integer(4) * (qa * qb);

    bool grazes = false;
    if (!f.is_zero()) {  // where it is, G = -2 q_A < 0: similar shadows about one centre
      if (sgn(f.c[4]) >= 0 && sgn(g.c[2]) > 0) {  // n = e2
        if (f.c[4] != 0) return Membership::out;
        grazes = true;
      }
      const Roots roots(f);
      for (const Rational& t : roots.between())
        if (sign_at(f, t) > 0 && sign_at(g, t) > 0) return Membership::out;
      for (std::size_t i = 0; i < roots.size() && !grazes; ++i) grazes = roots.sign_at(g, i) > 0;
    }
    if (sgn(dot<3>(normal, w)) < 0) return Membership::out;
    return grazes ? Membership::on : Membership::in;
  }

  /// Of bodies that touch: the sign of n.w, n the outer normal of A where they do. The common point spans the
  /// kernel of the semidefinite lambda Q_A + Q_B: a column of its adjugate.
  int entering(const Vector<3>& w) const {
    const Matrix<4> qa = quadric<3>(pair.a, Vector<3>{}), qb = quadric<3>(pair.b, pair.c);
    std::array<std::array<Form, 4>, 4> m;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) m[i][j] = Form({qb[i][j], qa[i][j]});
    const auto all = without<4>(-1);
    const Roots roots(minor_determinant<4, Form>(m, all, all));
    std::size_t i = 0;
    while (i < roots.size() && roots.sign_of_root(i) <= 0) ++i;
    std::array<Form, 4> point;
    for (int j = 0; j < 4; ++j) {
      point[j] = minor_determinant<4, Form>(m, without<4>(j), without<4>(3));
      if (j % 2 == 0) point[j] = Form() - point[j];
    }
    Form along;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 4; ++j) along = along + Integer(w[k] * qa[k][j]) * point[j];
    const int weight = roots.sign_at(point[3], i);
    if (weight == 0) throw std::logic_error("touching bodies without a common point");
    return weight * roots.sign_at(along, i);
  }
};

/// The pair after A has moved for `time` seconds.
Encounter later(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& v_a,
                const Eigen::Vector3d& v_b, double time) {
  const Way way(v_a, v_b, time);
  Unit unit;
  unit.body<3>(a);
  unit.body<3>(b);
  unit.e = std::min(unit.e, way.e);
  Pair<3> pair(a, b, unit.e);
  for (int i = 0; i < 3; ++i) pair.c[i] -= way.on(i, unit.e);
  return Encounter(pair);
}

}  // namespace

struct ConeTruth::Exact : Encounter {
  Ellipsoid a, b;

  Exact(const Ellipsoid& body_a, const Ellipsoid& body_b)
      : Encounter(Pair<3>(body_a, body_b)), a(body_a), b(body_b) {}
};

ConeTruth::ConeTruth(const Ellipsoid& a, const Ellipsoid& b)
    : exact_(std::make_shared<Exact>(a, b)), relation_(exact_->relation) {}

Membership ConeTruth::membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const {
  if (relation_ != Relation::disjoint) throw std::logic_error("the cone of bodies that are not disjoint");
  const Vector<3> w = velocity<3>(v_a, v_b);
  return is_zero<3>(w) ? Membership::out : exact_->membership(w);
}

Membership ConeTruth::within(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                             const Horizon& horizon) const {
  const auto standing = [](Relation relation) {
    return relation == Relation::disjoint   ? Membership::out
           : relation == Relation::touching ? Membership::on
                                            : Membership::in;
  };
  const Vector<3> w = velocity<3>(v_a, v_b);
  if (is_zero<3>(w)) return standing(relation_);
  const Encounter start = later(exact_->a, exact_->b, v_a, v_b, horizon.from);
  if (start.relation == Relation::overlapping || horizon.until == horizon.from)
    return standing(start.relation);
  if (start.relation == Relation::touching) {
    if (start.entering(w) > 0) return Membership::in;
    const bool ends = std::isfinite(horizon.until);
    const bool overlap =
        ends && later(exact_->a, exact_->b, v_a, v_b, horizon.until).relation != Relation::disjoint;
    if (overlap) throw std::logic_error("bodies that part and meet again");
    return Membership::on;
  }
  const Membership ahead = start.membership(w);
  if (ahead == Membership::out || std::isinf(horizon.until)) return ahead;
  const Encounter end = later(exact_->a, exact_->b, v_a, v_b, horizon.until);
  if (end.relation == Relation::overlapping) return Membership::in;
  if (end.relation == Relation::touching) return end.entering(w) < 0 ? Membership::in : Membership::on;
  // Apart at both ends: they meet between iff they do forwards from one and backwards from the other.
  Vector<3> back;
  for (int i = 0; i < 3; ++i) back[i] = -w[i];
  const Membership behind = end.membership(back);
  if (behind != Membership::out && behind != ahead) throw std::logic_error("two answers about one line");
  return behind;
}

namespace {

/// Normals of the inner tangents, from A to B: side (1, t) with t a root, or side (0, 1).
struct InnerNormals {
  struct Normal {
    std::optional<std::size_t> root;
    int side;
  };
  Relation relation;
  std::optional<Roots> roots;
  std::vector<Normal> normals;

  InnerNormals(const Ellipse& a, const Ellipse& b) {
    // exact_tangents.cpp: R = (s^2 + alpha - beta)^2 - 4 s^2 alpha, inner where alpha + beta - s^2 < 0.
    const Pair<2> pair(a, b);
    relation = apart<2>(pair).relation;
    const auto quadratic = [](const Matrix<2>& m) { return Form({m[0][0], 2 * m[0][1], m[1][1]}); };
    const Form alpha = quadratic(pair.a), beta = quadratic(pair.b), s({pair.c[0], pair.c[1]}), s2 = s * s,
               difference = s2 + alpha - beta,
               resultant = difference * difference - Integer(4) * (s2 * alpha), inner = alpha + beta - s2;
    if (!resultant.is_zero()) {
      roots.emplace(resultant);
      for (std::size_t i = 0; i < roots->size(); ++i)
        if (roots->sign_at(inner, i) < 0) normals.push_back({i, roots->sign_at(s, i)});
      if (resultant.c[4] == 0 && sgn(inner.c[2]) < 0) normals.push_back({std::nullopt, sgn(pair.c[1])});
    }
    const std::size_t expected = relation == Relation::disjoint ? 2 : relation == Relation::touching ? 1 : 0;
    if (normals.size() != expected) throw std::logic_error("relation and inner tangents contradict");
  }

  /// Sign of the cross product of normal i with normal j of `other`.
  int cross(std::size_t i, const InnerNormals& other, std::size_t j) const {
    const Normal &n = normals[i], &m = other.normals[j];
    int turn = 0;
    if (n.root && m.root)
      turn = -roots->compare(*n.root, *other.roots, *m.root);
    else if (n.root || m.root)
      turn = n.root ? 1 : -1;
    return n.side * m.side * turn;
  }

  /// The left edge, of which B is to the right, runs along the clockwise normal turned left; the right edge
  /// along the other one turned right. Touching bodies have one normal for both.
  std::size_t edge(bool left) const {
    if (normals.empty()) throw std::logic_error("the tangents of overlapping bodies");
    if (normals.size() == 1) return 0;
    const bool first_clockwise = cross(0, *this, 1) > 0;
    return first_clockwise == left ? 0 : 1;
  }
};

}  // namespace

struct SectorTruth::Exact : InnerNormals {
  using InnerNormals::InnerNormals;
};

SectorTruth::SectorTruth(const Ellipse& a, const Ellipse& b) {
  auto exact = std::make_shared<Exact>(a, b);
  relation_ = exact->relation;
  exact_ = exact;
}

Sign turn_truth(const Ellipse& a, const Ellipse& b, bool left, const Ellipse& other_a, const Ellipse& other_b,
                bool other_left) {
  const InnerNormals p(a, b), q(other_a, other_b);
  const int cross = p.cross(p.edge(left), q, q.edge(other_left));
  return static_cast<Sign>(left == other_left ? cross : -cross);
}

Membership SectorTruth::membership(const Eigen::Vector2d& v_a, const Eigen::Vector2d& v_b) const {
  if (relation_ != Relation::disjoint) throw std::logic_error("the sector of bodies that are not disjoint");
  const Vector<2> w = velocity<2>(v_a, v_b);
  if (is_zero<2>(w)) return Membership::out;
  int least = 1;
  for (const auto& n : exact_->normals)
    least =
        std::min(least, n.side * (n.root ? exact_->roots->sign_at(Form({w[0], w[1]}), *n.root) : sgn(w[1])));
  return least > 0 ? Membership::in : least == 0 ? Membership::on : Membership::out;
}

namespace {

/// Polynomial in lambda whose coefficients are polynomials in the time.
struct Bivariate {
  std::vector<Form> c;

  friend Bivariate operator*(const Bivariate& x, const Bivariate& y) {
    if (x.c.empty() || y.c.empty()) return {};
    Bivariate r{std::vector<Form>(x.c.size() + y.c.size() - 1)};
    for (std::size_t i = 0; i < x.c.size(); ++i)
      for (std::size_t j = 0; j < y.c.size(); ++j) r.c[i + j] = r.c[i + j] + x.c[i] * y.c[j];
    return r;
  }
  friend Bivariate operator+(Bivariate x, const Bivariate& y) {
    if (x.c.size() < y.c.size()) x.c.resize(y.c.size());
    for (std::size_t i = 0; i < y.c.size(); ++i) x.c[i] = x.c[i] + y.c[i];
    return x;
  }
  friend Bivariate operator-(Bivariate x, const Bivariate& y) {
    if (x.c.size() < y.c.size()) x.c.resize(y.c.size());
    for (std::size_t i = 0; i < y.c.size(); ++i) x.c[i] = x.c[i] - y.c[i];
    return x;
  }
};

/// When two bodies first touch: now, at a root, or never; nothing where they graze.
struct ContactRoot {
  enum { now, later, never } when = never;
  bool grazes = false;
  std::optional<Roots> roots;
  std::size_t index = 0;

  ContactRoot(const Ellipsoid& body_a, const Ellipsoid& body_b, const Eigen::Vector3d& velocity) {
    const ConeTruth cone(body_a, body_b);
    if (cone.relation() != Relation::disjoint) {
      when = now;
      return;
    }
    const Membership membership = cone.membership(velocity);
    grazes = membership == Membership::on;
    if (membership != Membership::in) return;
    when = later;

    Unit unit;
    unit.body<3>(body_a);
    unit.body<3>(body_b);
    unit.vector<3>(velocity);
    Pair<3> pair(body_a, body_b, unit.e);
    const Vector<3> w = on_unit<3>(velocity, unit.e);
    const Matrix<4> q_a = quadric<3>(pair.a, Vector<3>{});
    const Matrix<3> adj = adjugate<3>(pair.b);
    std::array<Form, 3> c, g;  // c - t w
    for (int i = 0; i < 3; ++i) c[i] = Form({pair.c[i], -w[i]});
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) g[i] = g[i] + adj[i][k] * c[k];
    std::array<std::array<Bivariate, 4>, 4> m;
    Form corner({-determinant<3>(pair.b)});
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m[i][j].c = {Form({adj[i][j]}), Form({q_a[i][j]})};
      m[i][3].c = m[3][i].c = {Form() - g[i], Form({q_a[i][3]})};
      corner = corner + g[i] * c[i];
    }
    m[3][3].c = {corner, Form({q_a[3][3]})};
    const auto all = without<4>(-1);
    roots.emplace(discriminant(minor_determinant<4, Bivariate>(m, all, all)));

    std::vector<Rational> samples = roots->between();
    for (index = 0; index < roots->size(); ++index) {
      const Rational& t = samples[index + 1];
      if (roots->sign_of_root(index) <= 0 || sgn(t) <= 0) continue;
      Pair<3> moved = pair;
      const Integer &num = t.get_num(), &den = t.get_den();
      for (int i = 0; i < 3; ++i) {
        moved.c[i] = den * pair.c[i] - num * w[i];
        for (int j = 0; j < 3; ++j) moved.a[i][j] *= den * den, moved.b[i][j] *= den * den;
      }
      if (apart<3>(moved).relation == Relation::overlapping) return;
    }
    throw std::logic_error("bodies that meet at no root");
  }

 private:
  /// Up to a constant factor.
  static Form discriminant(const Bivariate& f) {
    using Inner = CGAL::Polynomial<CORE::BigInt>;
    using Outer = CGAL::Polynomial<Inner>;
    Integer common = 0;
    for (const Form& x : f.c)
      for (const Integer& y : x.c) common = gcd(common, y);
    std::vector<Inner> coefficients;
    for (const Form& x : f.c) {
      std::vector<CORE::BigInt> z;
      for (const Integer& y : x.c) {
        CORE::BigInt value(0);
        mpz_divexact(value.get_mp(), y.get_mpz_t(), common.get_mpz_t());
        z.push_back(value);
      }
      coefficients.emplace_back(z.begin(), z.end());
    }
    const Outer p(coefficients.begin(), coefficients.end());
    const Inner r = CGAL::resultant(p, CGAL::differentiate(p));
    Form result;
    for (int i = 0; i <= CGAL::degree(r); ++i) {
      CORE::BigInt x = r[i];
      result.c.emplace_back(x.get_mp());
    }
    return result;
  }
};

}  // namespace

std::optional<Sign> earlier_truth(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& w,
                                  const Ellipsoid& other_a, const Ellipsoid& other_b,
                                  const Eigen::Vector3d& other_w) {
  const ContactRoot p(a, b, w), q(other_a, other_b, other_w);
  if (p.grazes || q.grazes) return std::nullopt;
  if (p.when != q.when) return p.when < q.when ? Sign::negative : Sign::positive;
  if (p.when != ContactRoot::later) return Sign::zero;
  return static_cast<Sign>(p.roots->compare(p.index, *q.roots, q.index));
}

template <int D>
Sign side_truth(const BasicQuadric<D>& quadric, const Eigen::Matrix<double, D, 1>& point) {
  Rational sum = 0;
  for (int i = 0; i <= D; ++i)
    for (int j = 0; j <= D; ++j)
      sum += Rational(quadric.matrix()(i, j)) * (i < D ? Rational(point(i)) : Rational(1)) *
             (j < D ? Rational(point(j)) : Rational(1));
  return static_cast<Sign>(sgn(sum));
}
template Sign side_truth<2>(const BasicQuadric<2>&, const Eigen::Vector2d&);
template Sign side_truth<3>(const BasicQuadric<3>&, const Eigen::Vector3d&);

template <int D>
Sign side_truth(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& point) {
  // S y = x - p by elimination in rationals; S is positive definite, so no pivot is 0.
  std::array<std::array<Rational, D + 1>, D> m;
  std::array<Rational, D> x;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) {
      if (!body.defined_by_factor()) {
        m[i][j] = Rational(body.shape()(i, j));
        continue;
      }
      for (int k = 0; k < D; ++k) m[i][j] += Rational(body.factor()(i, k)) * Rational(body.factor()(j, k));
    }
    m[i][D] = x[i] = Rational(point(i)) - Rational(body.center()(i));
  }
  for (int k = 0; k < D; ++k)
    for (int i = 0; i < D; ++i) {
      if (i == k) continue;
      const Rational f = m[i][k] / m[k][k];
      for (int j = k; j <= D; ++j) m[i][j] -= f * m[k][j];
    }
  Rational sum = -1;
  for (int i = 0; i < D; ++i) sum += x[i] * m[i][D] / m[i][i];
  return static_cast<Sign>(sgn(sum));
}
template Sign side_truth<2>(const Ellipse&, const Eigen::Vector2d&);
template Sign side_truth<3>(const Ellipsoid&, const Eigen::Vector3d&);

}  // namespace vericone::verify
