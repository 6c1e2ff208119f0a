// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/exact_predicates.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/testing/random_bodies.h>

#include <iostream>

#include <vericone/testing/laws.h>

namespace vericone::sector_oracle_test {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using testing::moved_by_ulps;
using testing::RandomBodies;

const Vector2d kStill(0, 0);

void expect_membership(const SectorOracle& oracle, const Vector2d& w, Membership expected, Rung by) {
  Rung rung{};
  EXPECT_EQ(oracle.membership(w, &rung), expected) << w.transpose();
  EXPECT_EQ(rung, by) << to_string(rung) << " for " << w.transpose();
  EXPECT_EQ(oracle.exact_membership(w, kStill), expected);
  for (const auto& answer : {oracle.triage_membership(w), oracle.interval_membership(w, kStill)})
    if (answer) {
      EXPECT_EQ(*answer, expected);
    }
}

/// Circles of radius 1 and 2, centres 5 apart: the grazing direction is (4, 3).
TEST(SectorOracle, EveryRungOnTwoCircles) {
  const SectorOracle oracle(Ellipse::from_axes({0, 0}, {1, 1}), Ellipse::from_axes({5, 0}, {2, 2}));
  ASSERT_EQ(oracle.relation(), Relation::disjoint);
  expect_membership(oracle, {1, 0}, Membership::in, Rung::triage);
  expect_membership(oracle, {0, 1}, Membership::out, Rung::triage);
  expect_membership(oracle, {-1, 0}, Membership::out, Rung::triage);
  expect_membership(oracle, {0, 0}, Membership::out, Rung::triage);
  expect_membership(oracle, {4, 3}, Membership::on, Rung::exact);
  expect_membership(oracle, {4, -3}, Membership::on, Rung::exact);
  expect_membership(oracle, {-4, -3}, Membership::out, Rung::triage);
  for (int k = 1; k <= 8; ++k) {
    expect_membership(oracle, {4, moved_by_ulps(3, k)}, Membership::out, Rung::exact);
    expect_membership(oracle, {4, moved_by_ulps(3, -k)}, Membership::in, Rung::exact);
  }
}

/// Far apart, c - u c_k cancels: the bound fixed by the formula gives up, the one carried along does not.
TEST(SectorOracle, IntervalRungDecidesDistantPairs) {
  const double d = 1e7;
  const SectorOracle oracle(Ellipse::from_axes({0, 0}, {1, 2}), Ellipse::from_axes({d, 3 * d}, {2, 1}));
  expect_membership(oracle, {1, 3}, Membership::in, Rung::triage);
  expect_membership(oracle, {1, 3 + 4e-6}, Membership::out, Rung::interval);
}

TEST(SectorOracle, ScalesToTheEndsOfTheRange) {
  for (int e : {-498, -200, 0, 200, 498}) {
    const double s = std::ldexp(1.0, e);
    const SectorOracle oracle(Ellipse::from_axes({0, 0}, {s, s}),
                              Ellipse::from_axes({5 * s, 0}, {2 * s, 2 * s}));
    for (int f : {-1000, -300, 0, 300, 1000}) {
      const double v = std::ldexp(1.0, f);
      expect_membership(oracle, {v, 0}, Membership::in, Rung::triage);
      expect_membership(oracle, {4 * v, 3 * v}, Membership::on, Rung::exact);
      expect_membership(oracle, {4 * v, 3.5 * v}, Membership::out, Rung::triage);
    }
  }
}

TEST(SectorOracle, OverlapAndTouchingAreAnswers) {
  const Ellipse a = Ellipse::from_axes({0, 0}, {1, 1});
  EXPECT_EQ(SectorOracle(a, Ellipse::from_axes({3, 0}, {2, 2})).verdict({1, 0}, kStill), Verdict::touching);
  EXPECT_EQ(SectorOracle(a, Ellipse::from_axes({2, 0}, {2, 2})).verdict({1, 0}, kStill),
            Verdict::overlapping);
}

TEST(SectorOracle, RefusesVelocitiesThatAreNotNumbers) {
  const SectorOracle oracle(Ellipse::from_axes({0, 0}, {1, 1}), Ellipse::from_axes({5, 0}, {2, 2}));
  try {
    oracle.membership({1, std::numeric_limits<double>::infinity()}, kStill);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), "agent_velocity[1]");
  }
  EXPECT_THROW(oracle.membership(kStill, {std::nan(""), 0}), InputError);
}

/// Grazing pairs in general position, all numbers integers: as tests/cones/ellipsoids/exact_tangency.h in
/// space.
struct PlanarTangency {
  Ellipse a, b;
  Vector2d w, inner_normal;

  static PlanarTangency random(RandomBodies& random) {
    for (;;) {
      Matrix2d m, ga, gb;
      for (int i = 0; i < 4; ++i) m(i) = random.integer(-9, 9);
      const int ka = random.integer(1, 9), kb = random.integer(1, 9);
      ga << random.integer(-9, 9), random.integer(-9, 9), 0, ka;
      gb << random.integer(-9, 9), random.integer(-9, 9), 0, kb;
      const double det = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
      if (det == 0 || ga(0, 0) == 0 || gb(0, 0) == 0) continue;
      const Vector2d n(0, 1), c(random.integer(-99, 99), ka + kb);
      const Matrix2d sa = ga * ga.transpose(), sb = gb * gb.transpose();
      const Vector2d w = ka * kb * c - kb * (sa * n) - ka * (sb * n);
      if (w.isZero(0)) continue;
      const Vector2d home(random.integer(-999, 999), random.integer(-999, 999));
      return {Ellipse::from_shape(m * home, m * sa * m.transpose()),
              Ellipse::from_shape(m * (home + c), m * sb * m.transpose()), m * w,
              std::copysign(1.0, det) * Vector2d(-m(1, 0), m(0, 0))};
    }
  }
};

TEST(SectorOracle, ExactTangenciesAndTheirNeighbours) {
  RandomBodies random(401);
  SCOPED_TRACE(random.trace());
  int naive_wrong = 0, cases = 0;
  for (int i = 0; i < 3000; ++i) {
    const PlanarTangency t = PlanarTangency::random(random);
    const SectorOracle oracle(t.a, t.b);
    ASSERT_EQ(oracle.relation(), Relation::disjoint) << i;
    ASSERT_EQ(oracle.membership(t.w), Membership::on) << i;
    ASSERT_EQ(oracle.membership(-t.w), Membership::out) << i;
    ASSERT_EQ(exact::membership(exact::RationalBody<2>(t.a), exact::RationalBody<2>(t.b),
                                exact::to_rational<2>(t.w)),
              Membership::on);
    naive_wrong += oracle.naive_membership(t.w) != Membership::on;
    ++cases;
    // Across the edge: the sign of the step decides, for it is a step in general position off a line.
    for (int k = 1; k <= 8; ++k) {
      Vector2d w = t.w;
      const int axis = random.integer(0, 1);
      w(axis) = moved_by_ulps(w(axis), random.coin() ? k : -k);
      // The change is exact: w is an integer vector and the step a power of two times k.
      const double side = t.inner_normal(axis) * (w(axis) - t.w(axis));
      const Membership expected = side > 0 ? Membership::in : side < 0 ? Membership::out : Membership::on;
      ASSERT_EQ(oracle.membership(w), expected) << i << " step " << k;
      naive_wrong += oracle.naive_membership(w) != expected;
      ++cases;
    }
  }
  std::cout << "[ rates    ] tangent and within 8 ulps: naive double wrong in " << 100. * naive_wrong / cases
            << " %\n";
  EXPECT_GT(naive_wrong, cases / 20);
}

/// The boundary found here is that of sector_by_support, and the laws hold.
TEST(SectorOracle, LawsAndTheSectorsEdges) {
  RandomBodies random(402);
  SCOPED_TRACE(random.trace());
  int decided[3] = {};
  for (int i = 0; i < 20'000; ++i) {
    const double low = i % 4 == 0 ? 1e-6 : 1,
                 far = i % 4 == 1 ? random.log_uniform(10, 1e9) : random.uniform(1.01, 3);
    const Ellipse a = random.ellipse(Vector2d(random.uniform(-9, 9), random.uniform(-9, 9)), low, 10);
    const Vector2d d = random.direction_2d();
    Ellipse b = random.ellipse({0, 0}, low, 10);
    b = b.translated(a.center() + d * far * (a.radius(d) + b.radius(d)));
    const SectorOracle ab(a, b), ba(b, a);
    if (ab.relation() != Relation::disjoint) continue;
    const Sector sector = sector_by_support(a, b);
    const SectorEdge& edge = random.coin() ? sector.left : sector.right;
    const double step = (random.coin() ? 1 : -1) * random.log_uniform(1e-17, 1);
    const Vector2d w = edge.direction + step * edge.normal;
    Rung rung{};
    Membership m{};
    ASSERT_EQ(testing::broken_velocity_law(ab, ba, w, true), "") << i;
    m = ab.membership(w, &rung);
    ++decided[static_cast<int>(rung)];
    // The edges of sector_by_support are right to a few units in the last place.
    if (std::abs(step) > 1e-14 && step < 0.5 * sector.psi) {
      ASSERT_EQ(m, step > 0 ? Membership::in : Membership::out) << i;
    }
    // v_A and v_B: the exact difference counts, whatever is added to both.
    const Vector2d drift(random.integer(-8, 8), random.integer(-8, 8));
    ASSERT_EQ(ab.membership(w, drift), ab.exact_membership(w, drift));
  }
  std::cout << "[ rates    ] near edges: triage " << decided[0] << ", interval " << decided[1] << ", exact "
            << decided[2] << '\n';
  EXPECT_GT(decided[0], 5000);
  EXPECT_GT(decided[1], 100);
  EXPECT_GT(decided[2], 100);
}

}  // namespace
}  // namespace vericone::sector_oracle_test
