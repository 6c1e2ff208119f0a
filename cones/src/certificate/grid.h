// SPDX-License-Identifier: BSD-3-Clause
//
// Convex bodies in integers, and what of a plane, a point and a touch is checked of them. Lengths are
// multiples of 2^grid m, velocities of 2^grid m/s.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/internal/geometry/exact/algebraic.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>
#include <utility>
#include <vector>

namespace vericone::certificates {

using exact::Dyadic;
using exact::Integer;
using exact::Rational;
using Vector = exact::IntegerVector<3>;
using Matrix = exact::IntegerMatrix<3>;

inline Integer dot(const Vector& x, const Vector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
inline Vector operator+(const Vector& x, const Vector& y) { return {x[0] + y[0], x[1] + y[1], x[2] + y[2]}; }
inline Vector operator-(const Vector& x, const Vector& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
template <std::same_as<Integer> Scale>  // of nothing that converts to one: Eigen has products too
Vector operator*(const Scale& s, const Vector& x) {
  return {s * x[0], s * x[1], s * x[2]};
}
inline Vector operator<<(const Vector& x, unsigned bits) {
  return {x[0] << bits, x[1] << bits, x[2] << bits};
}
inline Vector operator*(const Matrix& m, const Vector& x) {
  return {dot(m[0], x), dot(m[1], x), dot(m[2], x)};
}
inline bool is_zero(const Vector& x) { return x[0].is_zero() && x[1].is_zero() && x[2].is_zero(); }
inline Vector cross(const Vector& x, const Vector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

/// Without its common factor.
inline Vector primitive(Vector x) {
  const Integer common = gcd(gcd(x[0], x[1]), x[2]);
  if (common > 1)
    for (Integer& e : x) e /= common;
  return x;
}

Matrix adjugate(const Matrix& m);
Matrix transposed(const Matrix& m);

/// About x 2^exponent; infinite beyond the doubles.
double to_double(const Integer& x, int exponent = 0);
inline double to_double(const Dyadic& x) { return to_double(x.numerator, -static_cast<int>(x.exponent)); }
inline Eigen::Vector3d to_double(const Vector& v, int exponent) {
  return {to_double(v[0], exponent), to_double(v[1], exponent), to_double(v[2], exponent)};
}
inline Rational to_rational(const Dyadic& x) { return Rational(x.numerator, Integer(1) << x.exponent); }
/// 0 of what has none.
inline int log2_of(double x) { return x > 0 && std::isfinite(x) ? std::ilogb(x) : 0; }

/// The least grid that a number, or all of a matrix, needs.
inline constexpr int kNoGrid = 1 << 20;
template <typename Derived>
int grid_of(const Eigen::MatrixBase<Derived>& m) {
  int e = kNoGrid;
  for (Eigen::Index j = 0; j < m.cols(); ++j)
    for (Eigen::Index i = 0; i < m.rows(); ++i) e = std::min(e, exact::grid_exponent(m(i, j), kNoGrid));
  return e;
}
/// Of an ellipsoid's defining matrix alone.
int grid_of_matrix(const Ellipsoid& body);

inline Vector on_grid(const Eigen::Vector3d& v, int grid) {
  return {exact::on_grid(v.x(), grid), exact::on_grid(v.y(), grid), exact::on_grid(v.z(), grid)};
}

/// A time, numerator / 2^exponent s.
inline Dyadic time_of(double seconds) { return Dyadic::of(seconds); }

/// What rounds a body: an ellipsoid about 0, by the matrix that defines it.
class Round {
 public:
  Round(const Ellipsoid& body, int grid);
  /// A ball.
  Round(double radius, int grid);

  /// rho(n)^2.
  [[nodiscard]] Integer square(const Vector& n) const;
  [[nodiscard]] const Matrix& shape() const { return shape_; }
  /// Whether v / 2^finer is inside, not on the boundary.
  [[nodiscard]] bool holds(const Vector& v, unsigned finer) const;

 private:
  void finish();
  bool by_factor_ = true;
  Matrix matrix_, shape_, adjugate_;
  Integer determinant_;
};

/// The convex hull of points, widened by what rounds it.
struct Convex {
  std::vector<Vector> points;
  std::optional<Round> round = {};

  /// max n.v over the points.
  [[nodiscard]] Integer support(const Vector& n) const;
};

/// A plane's normal, from the agent towards the obstacle. `across`: n = a e_1 + b e_2 with e_1, e_2 across w,
/// by the index of the entry of w that is divided by.
struct Plane {
  Vector normal;
  struct Across {
    int k;
    Integer a, b;
  };
  std::optional<Across> across = {};
  /// Not below n.x of the agent, not above n.x of the obstacle, at t = 0, metres; where the format wants
  /// them.
  std::optional<std::pair<Rational, Rational>> levels = {};
};

/// A point of both bodies, point / 2^finer on the grid, at a time, strictly inside of one.
struct Meeting {
  Dyadic time;
  Vector point;
  unsigned finer;
};

/// Two bodies that move straight, and the part of the future that is asked about.
struct Motion {
  Vector v_a, v_b, w;
  Dyadic from;
  std::optional<Dyadic> until;  // none: for ever
  int grid;

  Motion(const Eigen::Vector3d& agent, const Eigen::Vector3d& obstacle, double t0, double t1, int on);
};

/// x[i], x[j] of the axes that follow k, where w_k is the largest: e_1 = w_k e_i - w_i e_k, e_2 likewise.
int largest_entry(const Vector& w);
Plane plane_across(const Vector& w, int k, const Integer& a, const Integer& b);

/// Whether the plane keeps the bodies apart, without touching, all the time.
bool separates(const Convex& a, const Convex& b, const Motion& motion, const Vector& n);
/// At one time.
bool separates_at(const Convex& a, const Convex& b, const Motion& motion, const Vector& n, const Dyadic& t);

}  // namespace vericone::certificates
