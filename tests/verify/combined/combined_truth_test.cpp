// SPDX-License-Identifier: GPL-3.0-or-later
//
// The polyhedra between which the cones of combined quadrics are held: against CGAL's exact programs, against
// the exact cones of ellipsoids, and against the bodies themselves.
#include <gtest/gtest.h>
#include <vericone/internal/verify/combined/families.h>
#include <vericone/internal/verify/combined/sweep.h>
#include <vericone/internal/verify/combined/truth.h>
#include <vericone/internal/verify/predicates/hull_truth.h>
#include <vericone/internal/verify/seeded_random.h>

#include <Eigen/Geometry>
#include <cmath>

namespace vericone::verify::combined_truth_test {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kSeed = 1;

StarPolyhedron tetrahedron(SeededRandom& random, const GridVector& at, std::int64_t size) {
  for (;;) {
    StarPolyhedron p{at, {}, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
    Vector3d sum = Vector3d::Zero();
    Eigen::Matrix<double, 3, 4> v;
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 3; ++k) v(k, i) = std::round(random.uniform(-1, 1) * static_cast<double>(size));
      sum += v.col(i);
    }
    // The vertices counter-clockwise, and the centre inside.
    if ((v.col(1) - v.col(0)).cross(v.col(2) - v.col(0)).dot(v.col(3) - v.col(0)) > 0)
      v.col(1).swap(v.col(2));
    for (int i = 0; i < 4; ++i)
      p.vertices.push_back({at[0] + std::llround(v(0, i) - sum(0) / 4),
                            at[1] + std::llround(v(1, i) - sum(1) / 4),
                            at[2] + std::llround(v(2, i) - sum(2) / 4)});
    const Vector3d flat = (v.col(1) - v.col(0)).cross(v.col(2) - v.col(0));
    if (std::abs(flat.dot(v.col(3) - v.col(0))) > 0.05 * std::pow(static_cast<double>(size), 3)) return p;
  }
}

HullBody hull(const StarPolyhedron& p) {
  std::vector<Vector3d> points;
  for (const GridVector& v : p.vertices) points.push_back(as_vector(v));
  return HullBody(points);
}

TEST(CombinedTruth, TetrahedraAgreeWithTheLinearProgramsOfCgal) {
  int apart = 0, in = 0, out = 0;
  for (std::uint64_t index = 0; index < 400; ++index) {
    SCOPED_TRACE(index);
    SeededRandom random(760, kSeed, index);
    const StarPolyhedron p = tetrahedron(random, {}, 1 << 20);
    const Vector3d e = random.direction<3>() * random.uniform(0.2, 3) * (1 << 20);
    const StarPolyhedron q =
        tetrahedron(random, {std::llround(e(0)), std::llround(e(1)), std::llround(e(2))}, 1 << 19);
    const HullTruth truth(hull(p), hull(q));
    EXPECT_EQ(surely_apart(p, q), truth.relation() == Relation::disjoint);
    EXPECT_EQ(surely_apart(q, p), truth.relation() == Relation::disjoint);
    if (truth.relation() != Relation::disjoint) continue;
    ++apart;
    for (int k = 0; k < 10; ++k) {
      const Vector3d toward = k < 6 ? Vector3d(e.normalized() + random.uniform(0, 1) * random.direction<3>())
                                    : random.direction<3>();
      const GridVector w = grid_direction(toward);
      const Membership m = truth.membership(as_vector(w));
      EXPECT_EQ(surely_meets(p, q, w), m == Membership::in);
      EXPECT_EQ(surely_misses(p, q, w), m == Membership::out);
      (m == Membership::in ? in : out) += 1;
    }
  }
  EXPECT_GT(apart, 200);
  EXPECT_GT(in, 500);
  EXPECT_GT(out, 500);
}

TEST(CombinedTruth, DegenerateDirectionsAreNeverCalledWrong) {
  // Cubes as star polyhedra with many aligned edges; w along axes and diagonals.
  const auto cube = [](const GridVector& at) {
    StarPolyhedron p{at, {}, {}};
    for (int i = 0; i < 8; ++i)
      p.vertices.push_back({at[0] + (i & 1 ? 8 : -8), at[1] + (i & 2 ? 8 : -8), at[2] + (i & 4 ? 8 : -8)});
    p.facets = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return p;
  };
  for (std::int64_t x = 16; x <= 40; x += 4)
    for (std::int64_t y = 0; y <= 20; y += 4) {
      const StarPolyhedron p = cube({0, 0, 0}), q = cube({x, y, 0});
      const HullTruth truth(hull(p), hull(q));
      if (surely_apart(p, q)) {
        EXPECT_EQ(truth.relation(), Relation::disjoint);
      }
      if (truth.relation() != Relation::disjoint) continue;
      EXPECT_TRUE(surely_apart(p, q));
      for (std::int64_t i = -2; i <= 2; ++i)
        for (std::int64_t j = -2; j <= 2; ++j)
          for (std::int64_t k = -1; k <= 1; ++k) {
            if (i == 0 && j == 0 && k == 0) continue;
            const GridVector w = {i, j, k};
            const Membership m = truth.membership(as_vector(w));
            if (surely_meets(p, q, w)) {
              EXPECT_NE(m, Membership::out);
            }
            if (surely_misses(p, q, w)) {
              EXPECT_EQ(m, Membership::out);
            }
          }
    }
}

TEST(CombinedTruth, EllipsoidsAgreeWithTheirExactCone) {
  int in = 0, out = 0, unknown = 0;
  for (std::uint64_t index = 0; index < 20; ++index) {
    SCOPED_TRACE(index);
    const CombinedPair pair = combined_pair(CombinedFamily::biconcave, kSeed, index);
    const Ellipsoid &a = pair.a.ellipsoid(), &b = pair.b.ellipsoid();
    const CombinedTruth truth(a, b, 2);
    const ConeOracle oracle(a, b);
    ASSERT_EQ(truth.relation(), Relation::disjoint);
    ASSERT_EQ(oracle.relation(), Relation::disjoint);
    SeededRandom random(761, kSeed, index);
    const Vector3d c = (b.center() - a.center()).normalized();
    for (int k = 0; k < 100; ++k) {
      const double off = random.uniform(0, 1.5);
      const GridVector w = grid_direction(c + off * random.direction<3>());
      const Truth t = truth.direction(w);
      const Membership m = oracle.membership(as_vector(w));
      if (t == Truth::in) {
        EXPECT_NE(m, Membership::out);
      }
      if (t == Truth::out) {
        EXPECT_EQ(m, Membership::out);
      }
      (t == Truth::in ? in : t == Truth::out ? out : unknown) += 1;
    }
  }
  EXPECT_GT(in, 400);
  EXPECT_GT(out, 400);
  EXPECT_LT(unknown, 200);
}

/// Boundary samples of a body about its centre, on the grid of the polyhedra, are below the outer facets,
/// random points of the inner facets are in the body, and both approach it with the level.
TEST(CombinedTruth, PolyhedraEncloseTheBody) {
  constexpr int kUnit = -20;
  for (const CombinedFamily family : kAllCombinedFamilies)
    for (std::uint64_t index = 0; index < 4; ++index) {
      SCOPED_TRACE(std::string(name(family)) + " " + std::to_string(index));
      const CombinedPair pair = combined_pair(family, kSeed, index);
      const CombinedSweep sweep(pair.a, pair.b, 400);
      double last = INFINITY;
      for (const int level : {1, 2, 3}) {
        const PolyhedralBounds bounds = polyhedral_bounds(pair.b, level, kUnit, {});
        SeededRandom random(762, kSeed, index);
        const auto volume = [](const StarPolyhedron& p) {
          double sum = 0;
          for (const auto& f : p.facets)
            sum += as_vector(p.vertices[f[0]])
                       .cross(as_vector(p.vertices[f[1]]))
                       .dot(as_vector(p.vertices[f[2]]));
          return sum / 6;
        };
        for (const auto& f : bounds.inner.facets) {
          Vector3d weights(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
          weights /= weights.sum();
          Vector3d y = Vector3d::Zero();
          for (int i = 0; i < 3; ++i)
            y += weights(i) * std::ldexp(1.0, kUnit) * as_vector(bounds.inner.vertices[f[i]]);
          const double gauge = sweep.b().gauge_squared(y);
          if (pair.b.delimiters().empty() || pair.b.delimiters().front().level > 0) {
            EXPECT_LE(gauge, 1 + 1e-9);
          }
        }
        if (!bounds.outer || bounds.inner.facets.empty()) continue;
        for (const Vector3d& y : sweep.b().boundary) {
          bool below = false;
          for (const auto& f : bounds.outer->facets) {
            const Vector3d v0 = as_vector(bounds.outer->vertices[f[0]]),
                           v1 = as_vector(bounds.outer->vertices[f[1]]),
                           v2 = as_vector(bounds.outer->vertices[f[2]]), x = y / std::ldexp(1.0, kUnit);
            const double whole = v0.cross(v1).dot(v2);
            const double s0 = x.cross(v1).dot(v2) / whole, s1 = v0.cross(x).dot(v2) / whole,
                         s2 = v0.cross(v1).dot(x) / whole;
            if (std::min({s0, s1, s2}) >= -1e-12 && s0 + s1 + s2 <= 1 + 1e-12) below = true;
          }
          EXPECT_TRUE(below);
        }
        const double gap = volume(*bounds.outer) / volume(bounds.inner) - 1;
        EXPECT_GT(gap, 0);
        EXPECT_LT(gap, last);
        last = gap;
      }
    }
}

/// Directions a little off the symmetries of the geodesic spheres.
GridVector about(const Vector3d& w) { return grid_direction(w + Vector3d(0.0013, 0.0029, 0.0017)); }

TEST(CombinedTruth, SeesDentsAndWaists) {
  // With x^2 - (y^2 + z^2)/4 <= 1 the ball of radius 4 ends at the rim, x = 2; the bottom of the dent is
  // at 1.
  const Ellipsoid ball = Ellipsoid::from_axes({16, 0, 0}, {4, 4, 4});
  const CombinedEllipsoid dented(ball, {hyperboloid(2, {1, 2, 2}, Eigen::Matrix3d::Identity())});
  const auto small = [](const Vector3d& p) {
    return CombinedEllipsoid(Ellipsoid::from_axes(p, {0.125, 0.125, 0.125}));
  };
  // Across the axis at x = 3.5 and at 1.5, behind the rim.
  EXPECT_EQ(CombinedTruth(small({19.5, 16, 0}), ball, 3).direction(about({0, -1, 0})), Truth::in);
  EXPECT_EQ(CombinedTruth(small({19.5, 16, 0}), dented, 3).direction(about({0, -1, 0})), Truth::out);
  EXPECT_EQ(CombinedTruth(small({17.5, 16, 0}), dented, 3).direction(about({0, -1, 0})), Truth::in);
  // A waist lets a velocity pass that its hull blocks.
  const CombinedEllipsoid waist(ball, {hyperboloid(1, {1, 0.5, 0.5}, Eigen::Matrix3d::Identity())});
  EXPECT_EQ(CombinedTruth(small({16, 2, -16}), ball, 3).direction(about({0, 0, 1})), Truth::in);
  EXPECT_EQ(CombinedTruth(small({16, 2, -16}), waist, 3).direction(about({0, 0, 1})), Truth::out);
}

TEST(CombinedTruth, InsideADent) {
  // The dent's bottom is at x = 1, its rim at 6.28 with a radius of 4.96, its wall at (4, 3.10).
  const Ellipsoid ball = Ellipsoid::from_axes({0, 0, 0}, {8, 8, 8});
  const CombinedEllipsoid dented(ball, {hyperboloid(2, {1, 0.8, 0.8}, Eigen::Matrix3d::Identity())});
  const CombinedEllipsoid small(Ellipsoid::from_axes({4, 0, 0}, {0.5, 0.5, 0.5}));
  const CombinedTruth truth(small, dented, 3);
  ASSERT_EQ(truth.relation(), Relation::disjoint);
  EXPECT_EQ(truth.direction(about({-1, 0, 0})), Truth::in);
  EXPECT_EQ(truth.direction(about({0, 1, 0})), Truth::in);
  EXPECT_EQ(truth.direction(about({1, 4, 0})), Truth::in);  // more than a right angle off the centre
  EXPECT_EQ(truth.direction(about({1, 0, 0})), Truth::out);
  EXPECT_EQ(truth.direction(about({4, 1, 0})), Truth::out);
}

TEST(CombinedTruth, OverlapIsSeen) {
  const CombinedPair pair = combined_pair(CombinedFamily::mixed, kSeed, 0);
  const Vector3d back = pair.a.center() - pair.b.center();
  const CombinedEllipsoid on_top = pair.b.translated(back);
  EXPECT_EQ(CombinedTruth(pair.a, on_top, 1).relation(), Relation::overlapping);
}

TEST(CombinedTruth, ExactMeeting) {
  const CombinedEllipsoid a(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}));
  const CombinedEllipsoid b(Ellipsoid::from_axes({4, 0, 0}, {1, 1, 1}));
  EXPECT_TRUE(exactly_meets(a, b, {1, 0, 0}, {1, 0, 0}, 2));
  EXPECT_FALSE(exactly_meets(a, b, {1, 0, 0}, {1, 0, 0}, std::nextafter(2.0, 0.0)));
  EXPECT_FALSE(exactly_meets(a, b, {std::nextafter(1.0, 2.0), 0, 0}, {1, 0, 0}, 2));
  EXPECT_FALSE(exactly_meets(a, b, {1, 0, 0}, {-1, 0, 0}, -2));
}

TEST(CombinedFamilies, AreReplayedAndMostlyDisjoint) {
  for (const CombinedFamily family : kAllCombinedFamilies) {
    SCOPED_TRACE(name(family));
    const CombinedPair first = combined_pair(family, kSeed, 7), again = combined_pair(family, kSeed, 7),
                       next = combined_pair(family, kSeed, 8), other = combined_pair(family, kSeed + 1, 7);
    EXPECT_EQ(first.b.center(), again.b.center());
    EXPECT_EQ(first.b.ellipsoid().shape(), again.b.ellipsoid().shape());
    EXPECT_NE(first.b.center(), next.b.center());
    EXPECT_NE(first.b.center(), other.b.center());
    EXPECT_FALSE(first.a.is_ellipsoid() && first.b.is_ellipsoid());
    int apart = 0;
    for (std::uint64_t index = 0; index < 20; ++index) {
      const CombinedPair pair = combined_pair(family, kSeed, index);
      if (!CombinedSweep(pair.a, pair.b, 300).march(Vector3d::Zero(), 0, 1)) ++apart;
    }
    EXPECT_GE(apart, family == CombinedFamily::nearly_touching ? 18 : 20);
  }
}

}  // namespace
}  // namespace vericone::verify::combined_truth_test
