// SPDX-License-Identifier: BSD-3-Clause
//
// What the tests of HullOracle share: every rung held against the expected answer, and bodies on lattices.
#pragma once

#include <gtest/gtest.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/testing/random_bodies.h>
#include <vector>

#include "cones/hulls/hull_reference.h"
#include "support/campaign.h"

namespace vericone::testing {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

inline const Vector3d kRest = Vector3d::Zero();

struct RungTally {
  int triage = 0, interval = 0, exact = 0;
  void count(Rung rung) { ++(rung == Rung::triage ? triage : rung == Rung::interval ? interval : exact); }
};

/// The expected answer from every rung that answers, and from the ladder; returns the rung that decided.
inline Rung expect_membership(const HullOracle& oracle, const Vector3d& v_a, const Vector3d& v_b,
                              Membership expected) {
  EXPECT_EQ(oracle.exact_membership(v_a, v_b), expected);
  if (v_b.isZero(0)) {
    EXPECT_EQ(oracle.triage_membership(v_a).value_or(expected), expected);
    EXPECT_EQ(oracle.membership(v_a), expected);
  }
  EXPECT_EQ(oracle.interval_membership(v_a, v_b).value_or(expected), expected);
  Rung rung{};
  EXPECT_EQ(oracle.membership(v_a, v_b, &rung), expected);
  if (expected == Membership::on) {
    EXPECT_EQ(rung, Rung::exact);
  }
  return rung;
}

inline Points lattice_points(RandomBodies& random, int count, int reach, const Vector3d& middle) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const int x = random.integer(-reach, reach), y = random.integer(-reach, reach);
    points.push_back(middle + Vector3d(x, y, random.integer(-reach, reach)));
  }
  return points;
}

inline Vector3d lattice_vector(RandomBodies& random, int reach) {
  return lattice_points(random, 1, reach, kRest)[0];
}

inline Matrix3d lattice_map(RandomBodies& random) {
  for (;;) {
    Matrix3d m;
    for (int i = 0; i < 9; ++i) m(i) = random.integer(-2, 2);
    if (m.col(0).dot(m.col(1).cross(m.col(2))) != 0) return m;
  }
}

inline Vector3d to_double(const Vector& x) {
  return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}

/// The ellipsoid is the image of a ball under an integer matrix m; the reference works where it is a ball,
/// after multiplication by adj(m) = det(m) m^{-1}, so that nothing is rounded.
struct MappedBall {
  Matrix3d m, adjugate;
  double radius;
  Vector3d center;

  explicit MappedBall(RandomBodies& random)
      : m(lattice_map(random)), radius(random.integer(1, 3)), center(lattice_vector(random, 9)) {
    adjugate.row(0) = m.col(1).cross(m.col(2));
    adjugate.row(1) = m.col(2).cross(m.col(0));
    adjugate.row(2) = m.col(0).cross(m.col(1));
  }
  Ellipsoid ellipsoid() const { return Ellipsoid::from_shape(center, radius * radius * m * m.transpose()); }
  Vector back(const Vector& x) const {
    Vector r;
    for (int i = 0; i < 3; ++i) r[i] = dot(rational(adjugate.row(i)), x);
    return r;
  }
  Rational reference_radius() const { return radius * std::abs(m.col(0).dot(m.col(1).cross(m.col(2)))); }
};

}  // namespace vericone::testing
