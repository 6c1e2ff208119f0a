// SPDX-License-Identifier: BSD-3-Clause
//
// Pairs of general ellipsoids that touch, or graze under a velocity, exactly: all numbers are small integers.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/LU>
#include <cmath>

namespace vericone::testing {

/// In the coordinates where the common normal is n = (0, 0, 1) a body with an integer factor whose last row
/// is (0, 0, k) has the rational half width rho(n) = k. Then c = (x, y, k_A + k_B) makes the plane normal to
/// n a common supporting plane that separates the bodies, and
///
///   w = k_A k_B c - k_B S_A n - k_A S_B n
///
/// is the direction that carries A's supporting point to B's: it grazes. Any integer matrix M maps all of it
/// to a general position, with the normal M^{-T} n.
struct ExactTangency {
  Ellipsoid a, b;          // grazing pair: disjoint unless w = 0
  Eigen::Vector3d w;       // on the boundary of its cone
  Eigen::Vector3d normal;  // inner normal of the cone at w, not normalised
  Ellipsoid touching_b;    // touches touching_a from outside, with the same normal
  Ellipsoid touching_a;

  /// `stretch`: a power of two by which the first axis is stretched before M mixes the axes; gives thin
  /// bodies. `scale`: a power of two for all lengths.
  static ExactTangency random(RandomBodies& random, double stretch = 1, double scale = 1) {
    using Eigen::Matrix3d;
    using Eigen::Vector3d;
    for (;;) {
      Matrix3d m, ga, gb;
      for (int i = 0; i < 9; ++i) m(i) = random.integer(-3, 3);
      for (Matrix3d* g : {&ga, &gb})
        for (int i = 0; i < 9; ++i) (*g)(i) = random.integer(-4, 4);
      const int ka = random.integer(1, 4), kb = random.integer(1, 4);
      ga.row(2) = Vector3d(0, 0, ka).transpose();
      gb.row(2) = Vector3d(0, 0, kb).transpose();
      const auto det2 = [](const Matrix3d& g) { return g(0, 0) * g(1, 1) - g(0, 1) * g(1, 0); };
      if (determinant(m) == 0 || det2(ga) == 0 || det2(gb) == 0) continue;
      m.col(0) *= stretch;
      const Vector3d n(0, 0, 1), c(random.integer(-20, 20), random.integer(-20, 20), ka + kb);
      const Matrix3d sa = ga * ga.transpose(), sb = gb * gb.transpose();
      const Vector3d w = ka * kb * c - kb * (sa * n) - ka * (sb * n);
      if (w.isZero(0)) continue;
      ExactTangency t;
      const auto body = [&](const Matrix3d& s, const Vector3d& center, double length) {
        // Exact: integers below 2^53 throughout.
        return Ellipsoid::from_shape(scale * length * (m * center),
                                     scale * scale * length * length * (m * s * m.transpose()));
      };
      const Vector3d home(random.integer(-9, 9), random.integer(-9, 9), random.integer(-9, 9));
      t.a = body(sa, home, 1);
      t.b = body(sb, home + c, 1);
      t.w = m * w;
      t.normal = std::copysign(1.0, determinant(m)) * m.col(0).cross(m.col(1));  // cofactor matrix times n
      t.touching_a = body(sa, home, ka * kb);
      t.touching_b =
          body(sb, Vector3d(home), ka * kb).translated(scale * (m * (kb * (sa * n) + ka * (sb * n))));
      return t;
    }
  }

 private:
  static double determinant(const Eigen::Matrix3d& m) { return m.col(0).dot(m.col(1).cross(m.col(2))); }
};

}  // namespace vericone::testing
