// SPDX-License-Identifier: BSD-3-Clause
//
// The last rung of round bodies on lattices where a closed form knows the answer and touches are the rule,
// and against the exact oracles of hulls and of ellipsoids, which decide by other means.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/exact_predicates.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <algorithm>
#include <initializer_list>

#include "round/exact.h"
#include "support/random.h"

namespace vericone::testing {
namespace {

using exact::Integer;
using exact::IntegerVector;
using round::ExactBody;
using round::ExactPiece;

ExactPiece piece(IntegerVector<3> center, int a = 0, int b = 0, int c = 0) {
  ExactPiece p{std::move(center), {}};
  p.shape[0][0] = a * a;
  p.shape[1][1] = b * b;
  p.shape[2][2] = c * c;
  return p;
}

/// Axis z, half the height h.
ExactBody cylinder(int x, int y, int z, int r, int h) {
  return {{piece({x, y, z - h}, r, r), piece({x, y, z + h}, r, r)}};
}
ExactBody disc(int x, int y, int z, int r) { return {{piece({x, y, z}, r, r)}}; }
ExactBody segment(int x, int y, int z, int h) { return {{piece({x, y, z - h}), piece({x, y, z + h})}}; }
ExactBody point(int x, int y, int z) { return {{piece({x, y, z})}}; }

Membership by_sign(int s) { return s < 0 ? Membership::in : s == 0 ? Membership::on : Membership::out; }
Relation relation_by_sign(int s) {
  return s < 0 ? Relation::overlapping : s == 0 ? Relation::touching : Relation::disjoint;
}
int sign_of(int x) { return (x > 0) - (x < 0); }

/// Of boxes in several dimensions: outside one is outside, at the border of one at most at the border.
int farthest(std::initializer_list<int> signs) { return std::max(signs); }

TEST(ExactLattice, ParallelCylindersAcrossAndAlongTheirAxis) {
  const ExactBody agent = cylinder(0, 0, 0, 2, 1);
  for (int y = -6; y <= 6; ++y)
    for (int z = -5; z <= 5; ++z) {
      const ExactBody obstacle = cylinder(20, y, z, 3, 2);
      const Membership expected = by_sign(farthest({sign_of(std::abs(y) - 5), sign_of(std::abs(z) - 3)}));
      ASSERT_EQ(exact_membership(agent, obstacle, 0, {1, 0, 0}), expected) << y << " " << z;
      ASSERT_EQ(exact_membership(agent, obstacle, 0, {-1, 0, 0}), Membership::out);
      ASSERT_EQ(exact_membership(obstacle, agent, 0, {-7, 0, 0}), expected);
    }
  for (int x = -6; x <= 6; ++x)
    for (int y = -6; y <= 6; ++y)
      ASSERT_EQ(exact_membership(agent, cylinder(x, y, -9, 3, 2), 0, {0, 0, -1}),
                by_sign(sign_of(x * x + y * y - 25)));
}

TEST(ExactLattice, CylindersOfCrossedAxes) {
  const ExactBody agent = cylinder(0, 0, 0, 2, 7);
  for (int y = -12; y <= 12; ++y)
    for (int z = -12; z <= 12; ++z) {
      // Axis y, seen along x: a rectangle as the agent's.
      const ExactBody obstacle{{piece({30, y - 4, z}, 3, 0, 3), piece({30, y + 4, z}, 3, 0, 3)}};
      ASSERT_EQ(exact_membership(agent, obstacle, 0, {5, 0, 0}),
                by_sign(farthest({sign_of(std::abs(y) - 6), sign_of(std::abs(z) - 10)})));
    }
}

TEST(ExactLattice, DiscsInTheirPlaneNeverOverlap) {
  const ExactBody agent = disc(0, 0, 0, 2);
  for (int y = -7; y <= 7; ++y)
    for (int z = -1; z <= 1; ++z) {
      const bool meets = z == 0 && std::abs(y) <= 5;
      EXPECT_EQ(exact_membership(agent, disc(9, y, z, 3), 0, {1, 0, 0}),
                meets ? Membership::on : Membership::out);
    }
  for (int x = -6; x <= 6; ++x)
    for (int y = -6; y <= 6; ++y) {
      EXPECT_EQ(exact_relation(agent, disc(x, y, 0, 3), 0),
                x * x + y * y <= 25 ? Relation::touching : Relation::disjoint);
      EXPECT_EQ(exact_relation(agent, disc(x, y, 1, 3), 0), Relation::disjoint);
    }
}

TEST(ExactLattice, ParallelCapsulesByTheirSegments) {
  const ExactBody agent = segment(0, 0, 0, 2);
  for (int y = -6; y <= 6; ++y)
    for (int z = -12; z <= 12; ++z) {
      const int beyond = std::max(std::abs(z) - 5, 0);
      const int s = sign_of(y * y + beyond * beyond - 25);
      ASSERT_EQ(exact_membership(agent, segment(40, y, z, 3), 5, {2, 0, 0}), by_sign(s)) << y << " " << z;
      for (int x = 0; x <= 4; x += 4)
        ASSERT_EQ(exact_relation(agent, segment(x, y, z, 3), 5),
                  relation_by_sign(sign_of(x * x + y * y + beyond * beyond - 25)));
    }
}

TEST(ExactLattice, BallsAndCylindersByTheDistance) {
  const ExactBody tower = cylinder(0, 0, 0, 5, 4);
  for (int k = -4; k <= 4; ++k)
    for (int z = -10; z <= 10; ++z) {
      const int out = std::max(5 * std::abs(k) - 5, 0), above = std::max(std::abs(z) - 4, 0);
      const Relation expected = relation_by_sign(sign_of(out * out + above * above - 25));
      // The ball as a margin, as an ellipsoid, and as both.
      ASSERT_EQ(exact_relation(point(3 * k, 4 * k, z), tower, 5), expected) << k << " " << z;
      ASSERT_EQ(exact_relation({{piece({3 * k, 4 * k, z}, 5, 5, 5)}}, tower, 0), expected);
      ASSERT_EQ(exact_relation({{piece({3 * k, 4 * k, z}, 2, 2, 2)}}, tower, 3), expected);
    }
}

TEST(ExactLattice, ABallIsOneHoweverItIsWritten) {
  Random random(11);
  SCOPED_TRACE(random.trace());
  int on = 0;
  for (int i = 0; i < share(1200); ++i) {
    const int r = random.integer(1, 4), h = random.integer(1, 3);
    const ExactBody cone{{piece({0, 0, h}), piece({0, 0, -h}, r, r)}};
    const int x = random.integer(-4, 4), y = random.integer(-4, 4), z = random.integer(-6, 6);
    const IntegerVector<3> w{random.integer(-2, 2), random.integer(-2, 2), random.integer(-1, 1)};
    if (w[0] == 0 && w[1] == 0 && w[2] == 0) continue;
    const int size = random.integer(0, 4), part = random.integer(0, size);
    const Membership as_margin = line_meets(cone, point(x, y, z), size, w);
    ASSERT_EQ(line_meets(cone, {{piece({x, y, z}, size, size, size)}}, 0, w), as_margin);
    ASSERT_EQ(line_meets(cone, {{piece({x, y, z}, part, part, part)}}, size - part, w), as_margin);
    ASSERT_EQ(line_meets(point(x, y, z), cone, size, {-w[0], -w[1], -w[2]}), as_margin);
    on += as_margin == Membership::on;
  }
  EXPECT_GT(on, 0);
}

TEST(ExactLattice, SilhouetteEdgesWithIrrationalNormals) {
  // The edge between two ellipses whose normal is (0, sqrt(2), 1) passes through the ray.
  const ExactBody hull{{piece({10, 3, 0}, 0, 1, 4), piece({12, 0, 3}, 0, 2, 1)}};
  EXPECT_EQ(exact_membership(point(0, 0, 0), hull, 0, {1, 0, 0}), Membership::on);
  const Integer fine = Integer(1) << 50;
  for (const int side : {-1, 0, 1}) {
    ExactBody near = hull;
    for (ExactPiece& p : near.pieces) {
      for (int k = 0; k < 3; ++k) p.center[k] *= fine;
      for (int k = 0; k < 3; ++k) p.shape[k][k] *= fine * fine;
      p.center[1] += side;
      p.center[2] += side;
    }
    EXPECT_EQ(exact_membership(point(0, 0, 0), near, 0, {1, 0, 0}), side < 0    ? Membership::in
                                                                    : side == 0 ? Membership::on
                                                                                : Membership::out);
  }
}

TEST(ExactLattice, EllipsoidsAsTheirOwnOracleSays) {
  Random random(12);
  SCOPED_TRACE(random.trace());
  int seen[3] = {};
  for (int i = 0; i < share(400); ++i) {
    exact::RationalBody<3> bodies[2];
    ExactBody pieces[2];
    for (int b = 0; b < 2; ++b) {
      int f[3][3];
      do
        for (auto& row : f)
          for (int& x : row) x = random.integer(-3, 3);
      while (f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) -
                 f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0]) +
                 f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]) ==
             0);
      ExactPiece p;
      for (int r = 0; r < 3; ++r) {
        p.center[r] = random.integer(-4, 4) + (b == 1 && r == 0 ? 6 : 0);
        for (int c = 0; c < 3; ++c) p.shape[r][c] = f[r][0] * f[c][0] + f[r][1] * f[c][1] + f[r][2] * f[c][2];
      }
      for (int r = 0; r < 3; ++r) {
        bodies[b].center[r] = exact::Rational(p.center[r]);
        for (int c = 0; c < 3; ++c) bodies[b].shape[r][c] = exact::Rational(p.shape[r][c]);
      }
      pieces[b].pieces.push_back(std::move(p));
    }
    const Relation expected = exact::relation<3>(bodies[0], bodies[1]);
    ++seen[static_cast<int>(expected)];
    ASSERT_EQ(exact_relation(pieces[0], pieces[1], 0), expected);
    if (expected != Relation::disjoint) continue;
    for (int k = 0; k < 4; ++k) {
      const int w[3] = {random.integer(-2, 6), random.integer(-3, 3), random.integer(-3, 3)};
      if (w[0] == 0 && w[1] == 0 && w[2] == 0) continue;
      ASSERT_EQ(exact_membership(pieces[0], pieces[1], 0, {w[0], w[1], w[2]}),
                exact::membership(bodies[0], bodies[1],
                                  {exact::Rational(w[0]), exact::Rational(w[1]), exact::Rational(w[2])}));
    }
  }
  EXPECT_GT(seen[0], share(50));
  EXPECT_GT(seen[2], share(50));
}

TEST(ExactLattice, HullsAsTheirOwnOracleSays) {
  Random random(13);
  SCOPED_TRACE(random.trace());
  int relations[3] = {}, memberships[3] = {};
  for (int i = 0; i < share(3200); ++i) {
    const int reach = random.integer(1, 2), off = i % 2 ? 1 : 3;
    std::vector<Eigen::Vector3d> points[2];
    ExactBody bodies[2];
    for (int b = 0; b < 2; ++b)
      for (int n = random.integer(1, 4); n > 0; --n) {
        int x[3];
        for (int& e : x) e = random.integer(-reach, reach) + b * off;
        points[b].emplace_back(x[0], x[1], x[2]);
        bodies[b].pieces.push_back(piece({x[0], x[1], x[2]}));
      }
    const HullOracle oracle{HullBody(points[0]), HullBody(points[1])};
    ++relations[static_cast<int>(oracle.relation())];
    ASSERT_EQ(exact_relation(bodies[0], bodies[1], 0), oracle.relation()) << i;
    if (oracle.relation() != Relation::disjoint) continue;
    for (int k = 0; k < 4; ++k) {
      // Through the middle of an edge or a corner of their difference, and any.
      const auto drawn = [&](int b) {
        return points[b][random.integer(0, static_cast<int>(points[b].size()) - 1)];
      };
      Eigen::Vector3d w = drawn(1) + drawn(1) - drawn(0) - drawn(0);
      if (k % 2 == 0)
        w = Eigen::Vector3d(random.integer(-1, 4), random.integer(-1, 4), random.integer(-1, 4));
      if (w.isZero(0)) continue;
      const Membership expected = oracle.membership(w);
      ++memberships[static_cast<int>(expected)];
      ASSERT_EQ(exact_membership(bodies[0], bodies[1], 0, exact::direction_on_grid<3>(w)), expected) << i;
    }
  }
  for (const int n : relations) EXPECT_GT(n, share(40));
  for (const int n : memberships) EXPECT_GT(n, share(40));
}

}  // namespace
}  // namespace vericone::testing
