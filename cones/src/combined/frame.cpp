// SPDX-License-Identifier: BSD-3-Clause
#include "combined/frame.h"

#include <algorithm>
#include <cmath>

#include <vericone/internal/geometry/decompositions.h>

namespace vericone {
namespace {

IntervalMatrix3 enclosed(const Eigen::Matrix3d& m) {
  IntervalMatrix3 r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] = m(i, j);
  return r;
}

IntervalMatrix3 product(const IntervalMatrix3& x, const IntervalMatrix3& y) {
  IntervalMatrix3 r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] = x[i][0] * y[0][j] + x[i][1] * y[1][j] + x[i][2] * y[2][j];
  return r;
}

IntervalMatrix3 transposed(const IntervalMatrix3& m) {
  IntervalMatrix3 r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] = m[j][i];
  return r;
}

/// adj(M) / det(M), for entries of ordinary size. Infinite radii where M may be singular.
IntervalMatrix3 inverse(const IntervalMatrix3& m) {
  IntervalMatrix3 adjugate;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
      adjugate[i][j] = m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
    }
  const Interval det = m[0][0] * adjugate[0][0] + m[0][1] * adjugate[1][0] + m[0][2] * adjugate[2][0];
  for (auto& row : adjugate)
    for (Interval& x : row) x = x / det;
  return adjugate;
}

bool finite(const IntervalMatrix3& m) {
  for (const auto& row : m)
    for (const Interval& x : row)
      if (!x.finite()) return false;
  return true;
}

/// Mirror entries made the same interval.
IntervalMatrix3 symmetric(IntervalMatrix3 m) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j) m[i][j] = m[j][i];
  return m;
}

EnclosedQuadric quadric(const IntervalMatrix3& m, double level) {
  EnclosedQuadric q{symmetric(m), level, 0};
  Eigen::Matrix3d middles;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) middles(i, j) = q.matrix[i][j].mid();
  if (middles.allFinite()) {
    const double least = symmetric_eigenvalues<3>(middles)(0);
    q.least_eigenvalue = std::min(least, 0.0) - 1e-14 * middles.norm();
  }
  return q;
}

/// T^T S^{-1} T of the ellipsoid, by the matrix that defines it. Lengths are in units of `unit`, a power of
/// two.
IntervalMatrix3 ellipsoid_matrix(const Ellipsoid& body, const IntervalMatrix3& t, double unit) {
  if (body.defined_by_factor()) {
    const IntervalMatrix3 g = product(inverse(enclosed(body.factor() / unit)), t);
    return product(transposed(g), g);
  }
  const IntervalMatrix3 s = inverse(enclosed(body.shape() / (unit * unit)));
  return product(transposed(t), product(s, t));
}

}  // namespace

Eigen::Vector3d middle(const IntervalVector3& v) { return {v[0].mid(), v[1].mid(), v[2].mid()}; }

CombinedFrame::CombinedFrame(const CombinedEllipsoid& a, const CombinedEllipsoid& b) {
  // A power of two is the unit of length: dividing by it is exact for lengths between 1e-140 and 1e140.
  const double largest =
      std::max(a.ellipsoid().factor().cwiseAbs().maxCoeff(), b.ellipsoid().factor().cwiseAbs().maxCoeff());
  if (!(largest > 1e-140) || !(largest < 1e140)) return;
  const double unit = unit_ = std::ldexp(1.0, std::ilogb(largest));
  const Eigen::Matrix3d factor = a.ellipsoid().factor() / unit;
  const IntervalMatrix3 t = enclosed(factor);
  factor_a_ = factor;
  inverse_a_ = inverse(t);
  IntervalVector3 c;
  for (int i = 0; i < 3; ++i) c[i] = Interval(b.center()(i) / unit) - Interval(a.center()(i) / unit);
  center_ = inverse_a_ * c;

  /// The surfaces of a body, positions about its centre being m z.
  const auto surfaces = [&](const CombinedEllipsoid& body, const IntervalMatrix3& m, bool round) {
    std::vector<EnclosedQuadric> list;
    list.push_back(quadric(
        round ? enclosed(Eigen::Matrix3d::Identity()) : ellipsoid_matrix(body.ellipsoid(), m, unit), 1));
    for (const Delimiter<3>& d : body.delimiters())
      list.push_back(
          quadric(product(transposed(m), product(enclosed(d.matrix * (unit * unit)), m)), d.level));
    return list;
  };
  const IntervalMatrix3 own = enclosed(b.ellipsoid().factor() / unit);
  a_ = surfaces(a, t, a.ellipsoid().defined_by_factor());
  b_ = surfaces(b, t, false);
  own_b_ = surfaces(b, own, b.ellipsoid().defined_by_factor());
  columns_b_ = transposed(product(inverse_a_, own));
  if (!a.ellipsoid().defined_by_factor()) {
    // |N - I| <= e in every entry: n^T N^{-1} n and x^T N x are those of the ball up to 3 e / (1 - 3 e).
    double e = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        e = std::max(e, (a_[0].matrix[i][j] - Interval(i == j ? 1.0 : 0.0)).magnitude());
    defect_ = 4 * e;
  }
  usable_ = finite(inverse_a_) && finite(columns_b_) && defect_ < 1e-3;
  for (const auto* list : {&a_, &b_, &own_b_})
    for (const EnclosedQuadric& q : *list) usable_ = usable_ && finite(q.matrix);
  for (const Interval& x : center_) usable_ = usable_ && x.finite();
}

IntervalVector3 CombinedFrame::covector(const Eigen::Vector3d& n) const {
  return transposed(enclosed(factor_a_)) * IntervalVector3{Interval(n(0)), Interval(n(1)), Interval(n(2))};
}

IntervalVector3 CombinedFrame::direction(const Eigen::Vector3d& w) const {
  const double largest = w.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !std::isfinite(largest)) return {Interval(0), Interval(0), Interval(0)};
  const int e = std::ilogb(largest);
  IntervalVector3 v;
  for (int i = 0; i < 3; ++i) {
    const double x = std::ldexp(w(i), -e);
    v[i] = Interval(x, std::abs(x) < 0x1p-1000 ? Interval::kTiny : 0);
  }
  return direction(v);
}

IntervalVector3 CombinedFrame::direction(IntervalVector3 v) const {
  v = inverse_a_ * v;
  // Any positive factor will do.
  const Interval scale(1 / middle(v).norm());
  for (Interval& x : v) x = x * scale;
  return v;
}

bool surely_contains(const CombinedEllipsoid& body, const Ellipsoid& ellipsoid) {
  if (body.center() != ellipsoid.center()) return false;
  const double largest = ellipsoid.factor().cwiseAbs().maxCoeff();
  if (!(largest > 1e-140) || !(largest < 1e140)) return false;
  const double unit = std::ldexp(1.0, std::ilogb(largest));
  const IntervalMatrix3 t = enclosed(ellipsoid.factor() / unit);
  const IntervalMatrix3 own = ellipsoid_matrix(ellipsoid, t, unit);
  const auto above = [&](const IntervalMatrix3& m, double level) {
    IntervalMatrix3 d;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) d[i][j] = own[i][j] * Interval(level) - m[i][j];
    d = symmetric(d);
    const Interval minor = d[0][0] * d[1][1] - square(d[0][1]);
    const Interval det = d[0][0] * (d[1][1] * d[2][2] - square(d[1][2])) -
                         d[0][1] * (d[0][1] * d[2][2] - d[1][2] * d[0][2]) +
                         d[0][2] * (d[0][1] * d[1][2] - d[1][1] * d[0][2]);
    return d[0][0].positive() && minor.positive() && det.positive();
  };
  if (!above(ellipsoid_matrix(body.ellipsoid(), t, unit), 1)) return false;
  return std::all_of(body.delimiters().begin(), body.delimiters().end(), [&](const Delimiter<3>& d) {
    return above(product(transposed(t), product(enclosed(d.matrix * (unit * unit)), t)), d.level);
  });
}

template <int N>
QuadraticConstraint<N> quadratic_constraint(const IntervalMatrix3& m,
                                            const std::array<IntervalVector3, N>& columns,
                                            const IntervalVector3& k, const Interval& level, double concavity,
                                            const Eigen::Matrix<double, N, 1>& extent) {
  QuadraticConstraint<N> q;
  std::array<IntervalVector3, N> images;
  for (int j = 0; j < N; ++j) images[j] = m * columns[j];
  double slack = 0, magnitude = 0, uncertain = 0;
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j <= i; ++j) {
      const Interval x = dot(columns[i], images[j]);
      uncertain += 2 * x.rad();
      q.h(i, j) = q.h(j, i) = x.mid();
      const double terms = (i == j ? 1 : 2) * extent(i) * extent(j);
      slack += x.rad() * terms;
      magnitude += std::abs(x.mid()) * terms;
    }
    const Interval g = dot(images[i], k);
    q.g(i) = g.mid();
    slack += 2 * g.rad() * extent(i);
    magnitude += 2 * std::abs(g.mid()) * extent(i);
  }
  const Interval c = dot(k, m * k) - level;
  q.c = c.mid();
  q.concavity = concavity * (1 + 1e-12) + uncertain + 1e-14 * q.h.norm();
  magnitude += std::abs(q.c) + q.concavity * extent.squaredNorm();
  q.slack = (slack + c.rad() + 0x1p-46 * magnitude) * 1.001;
  return q;
}

template <int N>
QuadraticConstraint<N> linear_constraint(const std::array<Interval, N>& l, const Interval& l0,
                                         const Eigen::Matrix<double, N, 1>& extent) {
  QuadraticConstraint<N> q;
  double slack = l0.rad(), magnitude = std::abs(l0.mid());
  for (int j = 0; j < N; ++j) {
    q.g(j) = 0.5 * l[j].mid();
    slack += l[j].rad() * extent(j);
    magnitude += std::abs(l[j].mid()) * extent(j);
  }
  q.c = l0.mid();
  q.slack = (slack + 0x1p-46 * magnitude) * 1.001;
  return q;
}

void add_side(QuadraticConstraint<3>& constraint, const IntervalVector3& u, const Interval& u0,
              const Eigen::Vector3d& extent) {
  double off = u0.rad(), size = std::abs(u0.mid());
  for (int j = 0; j < 3; ++j) {
    constraint.u(j) = u[j].mid();
    off += u[j].rad() * extent(j);
    size += std::abs(u[j].mid()) * extent(j);
  }
  constraint.u0 = u0.mid();
  constraint.slack += ((2 * size + off) * off + 0x1p-46 * size * size) * 1.001;
}

#define VERICONE_INSTANTIATE(N)                                                                         \
  template QuadraticConstraint<N> quadratic_constraint<N>(                                              \
      const IntervalMatrix3&, const std::array<IntervalVector3, N>&, const IntervalVector3&,            \
      const Interval&, double, const Eigen::Matrix<double, N, 1>&);                                     \
  template QuadraticConstraint<N> linear_constraint<N>(const std::array<Interval, N>&, const Interval&, \
                                                       const Eigen::Matrix<double, N, 1>&);
VERICONE_INSTANTIATE(3)
VERICONE_INSTANTIATE(4)
#undef VERICONE_INSTANTIATE

}  // namespace vericone
