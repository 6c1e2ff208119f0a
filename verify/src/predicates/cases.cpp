// SPDX-License-Identifier: GPL-3.0-or-later
#include "predicates/cases.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace vericone::verify::cases {

double moved_by_ulps(double x, int count) {
  const double target = std::copysign(std::numeric_limits<double>::infinity(), count);
  for (int i = 0; i < std::abs(count); ++i) x = std::nextafter(x, target);
  return x;
}

double log_uniform(SeededRandom& random, double from, double to) {
  // A power of two times a number in [1, 2): needs no function that platforms round differently.
  const double e = std::floor(random.uniform(from * 3.3219280948873623, to * 3.3219280948873623));
  const double m = random.uniform(1, 2);
  return std::ldexp(m, static_cast<int>(e));
}

template <int D>
BasicEllipsoid<D> moved_to(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& center) {
  // From the origin the sum is the new centre itself.
  const BasicEllipsoid<D> home = body.center().isZero(0) ? body : body.translated(-body.center());
  return home.translated(center);
}
template Ellipse moved_to<2>(const Ellipse&, const Eigen::Vector2d&);
template Ellipsoid moved_to<3>(const Ellipsoid&, const Eigen::Vector3d&);

namespace {

template <int D>
using VectorD = Eigen::Matrix<double, D, 1>;
template <int D>
using MatrixD = Eigen::Matrix<double, D, D>;

template <int D>
MatrixD<D> rotation(SeededRandom& random) {
  if constexpr (D == 3) {
    return random.rotation();
  } else {
    const Eigen::Vector2d e = random.direction<2>();
    MatrixD<2> r;
    r << e.x(), -e.y(), e.y(), e.x();
    return r;
  }
}

/// About the origin. Every second body is handed over by its shape where that is surely definite.
template <int D>
BasicEllipsoid<D> body(SeededRandom& random, Kind kind, double size) {
  VectorD<D> axes;
  const double thin = random.uniform(0, 4);
  for (int i = 0; i < D; ++i)
    axes(i) = size * (kind == Kind::thin ? log_uniform(random, -thin, thin) : random.uniform(1, 10));
  const MatrixD<D> turn = random.integer(0, 7) ? rotation<D>(random) : MatrixD<D>(MatrixD<D>::Identity());
  const auto e = BasicEllipsoid<D>::from_axes(VectorD<D>::Zero(), axes, turn);
  if (random.coin() || kind == Kind::thin) return e;
  return BasicEllipsoid<D>::from_shape(VectorD<D>::Zero(), e.shape());
}

template <int D>
MatrixD<D> integers(SeededRandom& random, int most) {
  for (;;) {
    MatrixD<D> m;
    for (int i = 0; i < D * D; ++i) m(i) = random.integer(-most, most);
    if (std::abs(m.determinant()) > 0.5) return m;
  }
}

/// A map with integer entries, one axis perhaps stretched by a power of two, all lengths by another.
template <int D>
MatrixD<D> exact_map(SeededRandom& random, double& scale) {
  MatrixD<D> m = integers<D>(random, 3);
  if (random.integer(0, 3) == 0) m = MatrixD<D>::Identity();
  const int stretch = random.coin() ? random.integer(0, 12) : 0;
  m.col(0) *= std::ldexp(1.0, stretch);
  const int e = random.integer(0, 2) ? 0 : random.integer(-490, 470);
  scale = std::ldexp(1.0, e);
  return m;
}

/// The image of the body with shape s about p, all numbers integers below 2^53 before scaling.
template <int D>
BasicEllipsoid<D> image(const MatrixD<D>& m, double scale, const MatrixD<D>& s, const VectorD<D>& p) {
  return BasicEllipsoid<D>::from_shape(scale * (m * p), scale * (scale * (m * s * m.transpose())));
}

/// In coordinates where the normal is the last unit vector, a body with an integer factor whose last row is
/// (0, ..., 0, k) has the half width k along it and its support point there is p + the last column.
template <int D>
Tangency<D> exact_tangency(SeededRandom& random, bool touching, const MatrixD<D>& m, double scale) {
  for (;;) {
    Tangency<D> t;
    t.size = scale;
    MatrixD<D> ga = integers<D>(random, 4), gb = integers<D>(random, 4);
    const int ka = random.integer(1, 4), kb = random.integer(1, 4);
    ga.row(D - 1).setZero(), gb.row(D - 1).setZero();
    ga(D - 1, D - 1) = ka, gb(D - 1, D - 1) = kb;
    if (std::abs(ga.determinant()) < 0.5 || std::abs(gb.determinant()) < 0.5) continue;
    VectorD<D> home, slide;
    for (int i = 0; i < D; ++i) home(i) = random.integer(-9, 9), slide(i) = random.integer(-20, 20);
    slide(D - 1) = 0;
    if (touching) slide.setZero();
    if (!touching && slide.isZero(0)) continue;
    t.a = image<D>(m, t.size, ga * ga.transpose(), home);
    t.b = image<D>(m, t.size, gb * gb.transpose(), home + ga.col(D - 1) + gb.col(D - 1) + slide);
    t.grazing = m * slide;
    t.normal = m.inverse().transpose().col(D - 1);
    t.exact = true;
    return t;
  }
}

template <int D>
Tangency<D> exact_tangency(SeededRandom& random, bool touching) {
  double scale = 1;
  const MatrixD<D> m = exact_map<D>(random, scale);
  return exact_tangency<D>(random, touching, m, scale);
}

}  // namespace

std::pair<Tangency<2>, Tangency<2>> parallel_tangencies(SeededRandom& random) {
  double scale = 1;
  const MatrixD<2> m = exact_map<2>(random, scale);
  const Tangency<2> p = exact_tangency<2>(random, false, m, scale);
  return {p, exact_tangency<2>(random, false, m, scale)};
}

template <int D>
Tangency<D> tangency(SeededRandom& random, Kind kind, bool touching) {
  if (kind == Kind::exact) return exact_tangency<D>(random, touching);
  Tangency<D> t;
  if (kind == Kind::scaled) t.size = log_uniform(random, -149, 146);
  const double other = kind == Kind::mixed ? log_uniform(random, -6, 6) : 1;
  const BasicEllipsoid<D> a = body<D>(random, kind, t.size), b = body<D>(random, kind, t.size * other);
  t.normal = random.direction<D>();
  const VectorD<D> from_a = a.support_point(t.normal), from_b = b.support_point(t.normal);
  VectorD<D> home, slide;
  const double offset = kind == Kind::far ? log_uniform(random, 3, 12) : 10;
  for (int i = 0; i < D; ++i) home(i) = t.size * offset * random.uniform(-1, 1);
  const double reach = kind == Kind::mixed ? 1 + other * random.uniform(0, 10) : random.uniform(0.2, 3);
  for (int i = 0; i < D; ++i) slide(i) = 10 * t.size * reach * random.uniform(-1, 1);
  slide -= slide.dot(t.normal) * t.normal;
  if (touching) slide.setZero();
  t.grazing = slide;
  t.a = a.translated(home);
  t.b = b.translated(home + from_a + from_b + slide);
  return t;
}
template Tangency<2> tangency<2>(SeededRandom&, Kind, bool);
template Tangency<3> tangency<3>(SeededRandom&, Kind, bool);

template <int D>
Tangency<D> nesting(SeededRandom& random, Kind kind) {
  Tangency<D> t;
  if (kind == Kind::exact) {
    // The ball of radius k on the plane { z = 0 } and an ellipsoid with the semi-axis m there and p across:
    // it holds the ball iff m >= k and p^2 >= k m, and touches it at the origin. Equality: osculating.
    const MatrixD<D> map = exact_map<D>(random, t.size);
    const int k = random.integer(1, 4), m = random.integer(0, 3) ? k + random.integer(0, 6) : 4 * k;
    MatrixD<D> s = MatrixD<D>::Identity() * (m * m);
    for (int i = 0; i < D - 1; ++i) {
      int p = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(k * m))));
      if (random.coin()) p += random.integer(0, 3);
      s(i, i) = p * p;
    }
    VectorD<D> home;
    for (int i = 0; i < D; ++i) home(i) = random.integer(-9, 9);
    t.a = image<D>(map, t.size, MatrixD<D>::Identity() * (k * k), home + VectorD<D>::Unit(D - 1) * k);
    t.b = image<D>(map, t.size, s, home + VectorD<D>::Unit(D - 1) * m);
    t.grazing = map * VectorD<D>::Unit(D - 1);
    t.normal = t.grazing;
    t.exact = true;
    return t;
  }
  if (kind == Kind::scaled) t.size = log_uniform(random, -149, 146);
  const BasicEllipsoid<D> a = body<D>(random, kind, t.size);
  t.normal = random.direction<D>();
  const VectorD<D> contact = a.support_point(t.normal);
  const double ratio = 1 + log_uniform(random, -8, 1);
  VectorD<D> home;
  const double offset = kind == Kind::far ? log_uniform(random, 3, 9) : 10;
  for (int i = 0; i < D; ++i) home(i) = t.size * offset * random.uniform(-1, 1);
  t.a = a.translated(home);
  t.b = a.scaled(ratio).translated(home + (1 - ratio) * contact);
  t.grazing = contact;
  return t;
}
template Tangency<2> nesting<2>(SeededRandom&, Kind);
template Tangency<3> nesting<3>(SeededRandom&, Kind);

}  // namespace vericone::verify::cases
