// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>
#include <vericone/internal/verify/predicates/hull_truth.h>

#include <stdexcept>
#include <vector>

#include "gmpz.h"
#include "predicates/algebra.h"

namespace vericone::verify {
namespace {

using namespace algebra;
using Program = CGAL::Quadratic_program<CGAL::Gmpz>;
using Solution = CGAL::Quadratic_program_solution<CGAL::Gmpz>;

/// All lower bounds 0, no upper ones, all relations equalities.
Program program() { return Program(CGAL::EQUAL, true, CGAL::Gmpz(0), false, CGAL::Gmpz(0)); }

Rational rational(const CGAL::Quotient<CGAL::Gmpz>& q) {
  Rational r(Integer(q.numerator().mpz()), Integer(q.denominator().mpz()));
  r.canonicalize();
  return r;
}

template <int D>
struct Nearest {
  Rational squared;  // y^T M y at the nearest point
  std::array<Rational, D> y;
};

/// The point of the hull of `points` with the least y^T M y; M positive definite.
template <int D>
Nearest<D> nearest(const std::vector<Vector<D>>& points, const Matrix<D>& m) {
  Program qp = program();
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i) {
    qp.set_a(i, 0, CGAL::Gmpz(1));
    for (int j = 0; j <= i; ++j) qp.set_d(i, j, gmpz(2 * form<D>(m, points[i], points[j])));
  }
  qp.set_b(0, CGAL::Gmpz(1));
  const Solution s = CGAL::solve_quadratic_program(qp, CGAL::Gmpz());
  if (!s.is_optimal()) throw std::logic_error("no nearest point");
  Nearest<D> r;
  r.squared = rational(s.objective_value());
  auto weight = s.variable_values_begin();
  for (int i = 0; i < n; ++i, ++weight) {
    const Rational x = rational(*weight);
    for (int k = 0; k < D; ++k) r.y[k] += x * points[i][k];
  }
  return r;
}

int rank(std::vector<Vector<3>> rows) {
  int rank = 0;
  for (int column = 0; column < 3; ++column) {
    std::size_t pivot = rank;
    while (pivot < rows.size() && rows[pivot][column] == 0) ++pivot;
    if (pivot == rows.size()) continue;
    std::swap(rows[pivot], rows[rank]);
    for (std::size_t i = rank + 1; i < rows.size(); ++i) {
      const Integer f = rows[i][column], g = rows[rank][column];
      for (int k = 0; k < 3; ++k) rows[i][k] = rows[i][k] * g - rows[rank][k] * f;
    }
    ++rank;
  }
  return rank;
}

Vector<3> difference(const Vector<3>& x, const Vector<3>& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}

}  // namespace

struct HullTruth::Exact {
  int unit = 0;  // of length: 2^unit
  // The ellipsoid, if there is one: its centre is the origin of the points of b.
  bool ellipsoid = false;
  bool reversed = false;  // the ellipsoid is the obstacle
  Matrix<3> s;
  std::vector<Vector<3>> a, b;
  std::array<Rational, 3> normal;

  Relation hull_relation() const {
    // Weights of the points: each at least eps times the number of pairs it is in, so that all differences
    // have a positive weight iff eps > 0. Points of b, of a, eps.
    Program lp = program();
    const int n = static_cast<int>(b.size()), m = static_cast<int>(a.size());
    const Vector<3> u = all_differences();
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < n; ++j) lp.set_a(j, k, gmpz(b[j][k]));
      for (int i = 0; i < m; ++i) lp.set_a(n + i, k, gmpz(-a[i][k]));
      lp.set_a(n + m, k, gmpz(u[k]));
    }
    for (int j = 0; j < n; ++j) lp.set_a(j, 3, CGAL::Gmpz(1));
    for (int i = 0; i < m; ++i) lp.set_a(n + i, 4, CGAL::Gmpz(1));
    for (int row : {3, 4}) {
      lp.set_a(n + m, row, CGAL::Gmpz(n * m));
      lp.set_b(row, CGAL::Gmpz(1));
    }
    lp.set_c(n + m, CGAL::Gmpz(-1));
    const Solution found = CGAL::solve_linear_program(lp, CGAL::Gmpz());
    if (found.is_infeasible()) return Relation::disjoint;
    if (CGAL::sign(found.objective_value()) == CGAL::ZERO) return Relation::touching;
    std::vector<Vector<3>> edges;
    for (const auto& x : a) edges.push_back(difference(x, a.front()));
    for (const auto& x : b) edges.push_back(difference(x, b.front()));
    return rank(edges) == 3 ? Relation::overlapping : Relation::touching;
  }

  Vector<3> all_differences() const {
    Vector<3> u{};
    const int n = static_cast<int>(b.size()), m = static_cast<int>(a.size());
    for (int k = 0; k < 3; ++k) {
      for (const auto& x : b) u[k] += m * x[k];
      for (const auto& x : a) u[k] -= n * x[k];
    }
    return u;
  }

  void refine(int finer) {
    if (finer >= unit) return;
    const auto by = static_cast<unsigned long>(unit - finer);
    for (auto* points : {&a, &b})
      for (auto& x : *points)
        for (Integer& entry : x) entry <<= by;
    for (auto& row : s)
      for (Integer& entry : row) entry <<= 2 * by;
    unit = finer;
  }

  /// More than twice what any two points are apart.
  Integer size() const {
    Integer sum = 1;
    for (const auto* points : {&a, &b})
      for (const auto& x : *points)
        for (const Integer& entry : x) sum += abs(entry);
    for (const auto& row : s)
      for (const Integer& entry : row) sum += abs(entry);
    return 4 * sum;
  }

  /// The body whose points move, once where it starts and once where it ends, and the other one.
  Membership within(const Vector<3>& start, const Vector<3>& end) {
    std::vector<Vector<3>>& moving = ellipsoid ? b : a;
    const bool backwards = ellipsoid && !reversed;
    std::vector<Vector<3>> swept;
    for (const Vector<3>& way : {start, end})
      for (Vector<3> x : moving) {
        for (int k = 0; k < 3; ++k) x[k] += backwards ? Integer(-way[k]) : way[k];
        swept.push_back(x);
      }
    moving = swept;
    switch (ellipsoid ? ellipsoid_relation() : hull_relation()) {
      case Relation::overlapping:
        return Membership::in;
      case Relation::touching:
        return Membership::on;
      case Relation::disjoint:
        break;
    }
    return Membership::out;
  }

  Membership hull_membership(const Vector<3>& w) const {
    Program lp = program();
    const int n = static_cast<int>(b.size()), m = static_cast<int>(a.size());
    const Vector<3> u = all_differences();
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < n; ++j) lp.set_a(j, k, gmpz(b[j][k]));
      for (int i = 0; i < m; ++i) lp.set_a(n + i, k, gmpz(-a[i][k]));
      lp.set_a(n + m, k, gmpz(u[k]));
      lp.set_b(k, gmpz(w[k]));
    }
    for (int j = 0; j < n; ++j) lp.set_a(j, 3, CGAL::Gmpz(1));
    for (int i = 0; i < m; ++i) lp.set_a(n + i, 3, CGAL::Gmpz(-1));
    lp.set_c(n + m, CGAL::Gmpz(-1));
    const Solution found = CGAL::solve_linear_program(lp, CGAL::Gmpz());
    if (found.is_infeasible()) return Membership::out;
    if (!found.is_optimal()) throw std::logic_error("a cone that is not pointed");
    if (CGAL::sign(found.objective_value()) == CGAL::ZERO) return Membership::on;
    std::vector<Vector<3>> generators;
    for (const auto& y : b) generators.push_back(difference(y, a.front()));
    for (const auto& x : a) generators.push_back(difference(b.front(), x));
    return rank(generators) == 3 ? Membership::in : Membership::on;
  }

  Relation ellipsoid_relation() {
    const Nearest<3> y = nearest<3>(b, adjugate<3>(s));
    const int far = cmp(y.squared, Rational(determinant<3>(s)));
    if (far == 0) return Relation::touching;
    if (far < 0) return Relation::overlapping;
    const Matrix<3> adj = adjugate<3>(s);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) normal[i] += adj[i][k] * y.y[k];
    return Relation::disjoint;
  }

  Membership ellipsoid_membership(const Vector<3>& w) const {
    // Coordinates across w: x -> (w_k x_i - w_i x_k, w_k x_j - w_j x_k).
    const int k = w[0] != 0 ? 0 : w[1] != 0 ? 1 : 2;
    const auto across = [&](const Vector<3>& x) {
      Vector<2> r;
      for (int i = 0; i < 2; ++i) r[i] = w[k] * x[(k + 1 + i) % 3] - w[(k + 1 + i) % 3] * x[k];
      return r;
    };
    Matrix<2> shadow;
    std::array<Vector<3>, 2> rows{};
    for (int i = 0; i < 2; ++i) {
      rows[i][(k + 1 + i) % 3] = w[k];
      rows[i][k] = -w[(k + 1 + i) % 3];
    }
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) shadow[i][j] = form<3>(s, rows[i], rows[j]);
    std::vector<Vector<2>> points;
    for (const auto& x : b) points.push_back(across(x));
    const int far = cmp(nearest<2>(points, adjugate<2>(shadow)).squared, Rational(determinant<2>(shadow)));
    if (far > 0) return Membership::out;
    Rational ahead = 0;
    for (int i = 0; i < 3; ++i) ahead += normal[i] * w[i];
    if (sgn(ahead) < 0) return Membership::out;
    return far == 0 ? Membership::on : Membership::in;
  }
};

HullTruth::HullTruth(const Ellipsoid& agent, const HullBody& obstacle) {
  auto exact = std::make_shared<Exact>();
  Unit unit;
  unit.body<3>(agent);
  for (const auto& x : obstacle.points()) unit.vector<3>(x);
  exact->unit = unit.e;
  exact->ellipsoid = true;
  exact->s = shape_on_unit<3>(agent, unit.e);
  const auto p = on_unit<3>(agent.center(), unit.e);
  for (const auto& x : obstacle.points()) exact->b.push_back(difference(on_unit<3>(x, unit.e), p));
  relation_ = exact->ellipsoid_relation();
  exact_ = exact;
}

HullTruth::HullTruth(const HullBody& agent, const Ellipsoid& obstacle) : HullTruth(obstacle, agent) {
  auto exact = std::make_shared<Exact>(*exact_);
  exact->reversed = true;
  exact_ = exact;
}

HullTruth::HullTruth(const HullBody& agent, const HullBody& obstacle) {
  auto exact = std::make_shared<Exact>();
  Unit unit;
  for (const HullBody* body : {&agent, &obstacle})
    for (const auto& x : body->points()) unit.vector<3>(x);
  exact->unit = unit.e;
  for (const auto& x : agent.points()) exact->a.push_back(on_unit<3>(x, unit.e));
  for (const auto& x : obstacle.points()) exact->b.push_back(on_unit<3>(x, unit.e));
  relation_ = exact->hull_relation();
  exact_ = exact;
}

Membership HullTruth::membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const {
  if (relation_ != Relation::disjoint) throw std::logic_error("the cone of bodies that are not disjoint");
  Unit unit;
  unit.vector<3>(v_a);
  unit.vector<3>(v_b);
  Vector<3> w = difference(on_unit<3>(v_a, unit.e), on_unit<3>(v_b, unit.e));
  if (w[0] == 0 && w[1] == 0 && w[2] == 0) return Membership::out;
  if (exact_->reversed)
    for (Integer& x : w) x = -x;
  return exact_->ellipsoid ? exact_->ellipsoid_membership(w) : exact_->hull_membership(w);
}

Membership HullTruth::within(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                             const Horizon& horizon) const {
  Exact exact = *exact_;
  const bool ends = std::isfinite(horizon.until);
  const Way first(v_a, v_b, horizon.from), last(v_a, v_b, ends ? horizon.until : 1);
  exact.refine(std::min(first.e, last.e));
  // One that never ends goes on until it has passed everything: w is at least one unit long.
  const Integer times = ends ? Integer(1) : exact.size();
  Vector<3> start, end;
  for (int k = 0; k < 3; ++k) {
    start[k] = first.on(k, exact.unit);
    end[k] = last.on(k, exact.unit) * times;
    if (!ends) end[k] += start[k];
  }
  return exact.within(start, end);
}

}  // namespace vericone::verify
