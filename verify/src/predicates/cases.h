// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of bodies for the campaign of the predicates.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/internal/verify/seeded_random.h>

#include <cstdint>
#include <utility>

namespace vericone::verify::cases {

enum class Kind {
  regular,  // semi-axes 1 to 10
  thin,     // axis ratios to 1e8
  far,      // up to 1e12 sizes from the origin
  scaled,   // everything times 1e-150 to 1e150
  mixed,    // one body up to 1e6 times the other, or far from it
  exact,    // integers: exactly degenerate
};
constexpr int kKinds = 6;
inline Kind kind_of(std::uint64_t block) { return static_cast<Kind>(block % kKinds); }

/// A pair with a common supporting plane: the plane normal to `normal` touches both bodies and has them on
/// opposite sides, exactly or to rounding.
template <int D>
struct Tangency {
  using Vector = Eigen::Matrix<double, D, 1>;
  BasicEllipsoid<D> a, b;  // disjoint unless `grazing` is 0
  Vector grazing;          // carries A's point of support to B's: on the boundary of the cone
  Vector normal;
  double size = 1;  // of the bodies
  bool exact = false;
};

/// `touching`: the points of support coincide, so that the bodies touch.
template <int D>
Tangency<D> tangency(SeededRandom& random, Kind kind, bool touching);

/// Two pairs of ellipses with parallel inner tangents, exactly.
std::pair<Tangency<2>, Tangency<2>> parallel_tangencies(SeededRandom& random);

/// B holds A and their surfaces touch, exactly or to rounding.
template <int D>
Tangency<D> nesting(SeededRandom& random, Kind kind);

/// x moved by `count` representable numbers.
double moved_by_ulps(double x, int count);

/// Every coordinate, or one, moved by up to `most` representable numbers.
template <int D>
Eigen::Matrix<double, D, 1> jittered(SeededRandom& random, Eigen::Matrix<double, D, 1> v, int most) {
  const int only = random.integer(-1, D - 1);
  for (int i = 0; i < D; ++i) {
    const int count = random.integer(-most, most);
    if (only < 0 || only == i) v(i) = moved_by_ulps(v(i), count);
  }
  return v;
}

/// The same body elsewhere; defined by the same matrix.
template <int D>
BasicEllipsoid<D> moved_to(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& center);

/// 10^x with x evenly in [from, to], to a rounding of the platform's pow: exact powers of two instead.
double log_uniform(SeededRandom& random, double from, double to);

}  // namespace vericone::verify::cases
