// SPDX-License-Identifier: BSD-3-Clause
//
// HullOracle where bodies graze, touch or are flat, and beside it; laws; hulls against ConeOracle.
#include <gtest/gtest.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <vericone/testing/laws.h>
#include "cones/hulls/hull_oracle_checks.h"
#include "support/campaign.h"

namespace vericone::testing::hull_oracle_degenerate_test {
namespace {

// The ball of radius 3 flies along z past bodies whose nearest feature is at x = 3.
struct Grazing {
  const char* name;
  Points points;
};

std::vector<Grazing> grazing_bodies(double x) {
  return {{"vertex", {{x, 0, 10}, {7, 1, 12}, {9, -2, 11}, {8, 0, 15}}},
          {"edge", {{x, -5, 10}, {x, 7, 12}, {8, 0, 11}, {9, 2, 14}}},
          {"edge along the line", {{x, 0, 10}, {x, 0, 15}, {8, 4, 11}, {9, -2, 14}}},
          {"face seen edge-on", {{x, -5, 10}, {x, 7, 12}, {x, 1, 17}, {9, 2, 14}}},
          {"box", HullBody::box({x, -2, 10}, {x + 3, 1, 14}).points()},
          {"point", {{x, 0, 10}}},
          {"repeated point", {{x, 0, 10}, {x, 0, 10}, {x, 0, 10}}},
          {"segment", {{x, -5, 10}, {x, 7, 12}}}};
}

TEST(HullOracle, GrazedFeaturesAndTheirNeighbours) {
  const Vector3d along(0, 0, 1);
  RungTally near;
  for (const bool by_factor : {true, false}) {
    const Ellipsoid ball = by_factor ? Ellipsoid::from_axes(kRest, {3, 3, 3})
                                     : Ellipsoid::from_shape(kRest, 9 * Matrix3d::Identity());
    for (const Grazing& body : grazing_bodies(3)) {
      SCOPED_TRACE(body.name);
      EXPECT_EQ(expect_membership({ball, HullBody(body.points)}, along, kRest, Membership::on), Rung::exact);
      EXPECT_EQ(expect_membership({HullBody(body.points), ball}, -along, kRest, Membership::on), Rung::exact);
      EXPECT_EQ(expect_membership({ball, HullBody(body.points)}, -along, kRest, Membership::out),
                Rung::triage);
    }
    for (int ulps = 1; ulps <= 64; ++ulps)
      for (const int side : {-1, 1})
        for (const Grazing& body : grazing_bodies(moved_by_ulps(3, side * ulps))) {
          SCOPED_TRACE(body.name);
          const Rung rung = expect_membership({ball, HullBody(body.points)}, along, kRest,
                                              side < 0 ? Membership::in : Membership::out);
          near.count(rung);
          if (ulps == 1) {
            EXPECT_NE(rung, Rung::triage);
          }
        }
    for (const double x : {2.0, 4.0})
      for (const Grazing& body : grazing_bodies(x)) {
        SCOPED_TRACE(body.name);
        EXPECT_EQ(expect_membership({ball, HullBody(body.points)}, along, kRest,
                                    x < 3 ? Membership::in : Membership::out),
                  Rung::triage);
      }
  }
  EXPECT_GT(near.interval, 100);
  EXPECT_GT(near.exact, 20);
}

/// In general position: a vertex, an edge or a face on the plane x_k = r of a ball of radius r, whose line of
/// motion lies in that plane, all under an integer map; then a few last places beside.
TEST(HullOracle, NeighboursOfGrazedEllipsoids) {
  RandomBodies random(309);
  SCOPED_TRACE(random.trace());
  RungTally tally;
  int on = 0, neighbours[3] = {};
  for (int i = 0; i < share(1500); ++i) {
    const MappedBall ball(random);
    const int k = random.integer(0, 2);
    Vector3d along = lattice_vector(random, 9), off = kRest;
    along(k) = 0;
    if (along.isZero(0)) continue;
    off(k) = ball.radius;
    Points v;
    const int grazed = random.integer(1, 3);
    for (int t = 0; t < grazed; ++t) {  // the first on the line, the others in the plane
      Vector3d x = off + random.integer(4, 9) * along;
      if (t > 0) x += lattice_vector(random, 5);
      x(k) = ball.radius;
      v.push_back(x);
    }
    for (int t = random.integer(0, 4); t > 0; --t) {  // and the rest beyond it
      Vector3d x = 5 * along + lattice_vector(random, 5);
      x(k) = ball.radius + random.integer(1, 9);
      v.push_back(x);
    }
    for (Vector3d& x : v) x = ball.m * x + ball.center;
    const Vector3d w = ball.m * along;
    const HullOracle oracle(ball.ellipsoid(), HullBody(v)), swapped(HullBody(v), ball.ellipsoid());
    if (oracle.relation() != Relation::disjoint) continue;
    expect_membership(oracle, w, kRest, Membership::on);
    expect_membership(swapped, -w, kRest, Membership::on);
    ++on;
    for (const int most : {1, 8, 64}) {
      for (Vector3d& x : v) x = random.ulps(x, most);
      // The centre too, so that its differences from the points are rounded.
      Vector3d center = ball.center;
      for (int c = 0; c < 3; ++c)
        if (center(c) != 0) center(c) = moved_by_ulps(center(c), random.integer(-most, most));
      const HullOracle near(Ellipsoid::from_shape(center, ball.ellipsoid().shape()), HullBody(v));
      if (near.relation() != Relation::disjoint) continue;
      const Vector3d u = random.ulps(w, most);
      const Membership expected = near.exact_membership(u, kRest);
      ++neighbours[static_cast<int>(expected)];
      tally.count(expect_membership(near, u, kRest, expected));
    }
  }
  EXPECT_GT(on, share(700));
  EXPECT_GT(neighbours[0], 350);
  EXPECT_GT(neighbours[2], 350);
  EXPECT_GT(tally.interval, 40);
  EXPECT_GT(tally.exact, 350);
}

TEST(HullOracle, GrazingBoxesAndTheirNeighbours) {
  const Vector3d along(0, 0, 1);
  const HullBody agent = HullBody::box({-1, -2, -3}, {3, 4, 1});
  RungTally near;
  for (const Grazing& body : grazing_bodies(3)) {
    SCOPED_TRACE(body.name);
    EXPECT_EQ(expect_membership({agent, HullBody(body.points)}, along, kRest, Membership::on), Rung::exact);
    EXPECT_EQ(expect_membership({HullBody(body.points), agent}, -along, kRest, Membership::on), Rung::exact);
  }
  for (int ulps = 1; ulps <= 64; ++ulps)
    for (const int side : {-1, 1})
      for (const Grazing& body : grazing_bodies(moved_by_ulps(3, side * ulps))) {
        SCOPED_TRACE(body.name);
        near.count(expect_membership({agent, HullBody(body.points)}, along, kRest,
                                     side < 0 ? Membership::in : Membership::out));
      }
  EXPECT_GT(near.triage + near.interval, 100);
  EXPECT_GT(near.exact, 0);
}

TEST(HullOracle, RelationOfNeighboursOfTouchingBodies) {
  // The ball of radius 3 against a vertex, an edge and a face at x = 3.
  const Ellipsoid ball = Ellipsoid::from_axes(kRest, {3, 3, 3});
  const auto bodies = [](double x) {
    return std::vector<Points>{{{x, 0, 0}, {5, 1, 1}, {6, -1, 2}},
                               {{x, -1, -1}, {x, 2, 2}, {7, 0, 0}},
                               {{x, -1, -1}, {x, 2, -1}, {x, 0, 3}, {7, 0, 0}}};
  };
  for (int ulps = -8; ulps <= 8; ++ulps)
    for (const Points& points : bodies(moved_by_ulps(3, ulps))) {
      const Relation expected = ulps < 0    ? Relation::overlapping
                                : ulps == 0 ? Relation::touching
                                            : Relation::disjoint;
      const HullOracle oracle(ball, HullBody(points));
      EXPECT_EQ(oracle.relation(), expected);
      EXPECT_EQ(oracle.exact_relation(), expected);
      if (ulps == 0) {
        EXPECT_EQ(oracle.relation_rung(), Rung::exact);
      }
      const HullOracle hulls(HullBody::box({-3, -3, -3}, {3, 3, 3}), HullBody(points));
      EXPECT_EQ(hulls.relation(), expected);
    }
  EXPECT_EQ(HullOracle(ball, HullBody({{9, 9, 9}})).relation_rung(), Rung::triage);
  EXPECT_EQ(HullOracle(ball, HullBody({{1, 1, 1}})).relation_rung(), Rung::interval);
}

TEST(HullOracle, FlatBodies) {
  using B = HullBody;
  const auto relation = [](const B& a, const B& b) { return HullOracle(a, b).relation(); };
  const B triangle({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}), segment({{1, 1, -1}, {1, 1, 1}}), point({{1, 1, 0}});
  EXPECT_EQ(relation(triangle, segment), Relation::overlapping);  // crosses it
  EXPECT_EQ(relation(triangle, point), Relation::touching);
  EXPECT_EQ(relation(triangle, triangle), Relation::touching);
  EXPECT_EQ(relation(point, point), Relation::touching);
  EXPECT_EQ(relation(segment, B({{0, 1, 0}, {2, 1, 0}})), Relation::touching);    // crossing segments
  EXPECT_EQ(relation(triangle, B({{4, 0, -1}, {4, 0, 1}})), Relation::touching);  // through a corner
  EXPECT_EQ(relation(triangle, B({{2, 2, -1}, {2, 2, 1}})), Relation::touching);  // through an edge
  EXPECT_EQ(relation(triangle, B({{3, 3, -1}, {3, 3, 1}})), Relation::disjoint);
  EXPECT_EQ(relation(B({{0, 0, 0}, {0, 0, 0}}), B({{0, 0, 0}})), Relation::touching);
  // Point against point, segment, plate: a ray, a plane sector, a solid cone.
  const HullOracle ray(B({{1, 1, 1}}), B({{2, 3, 4}}));
  expect_membership(ray, {1, 2, 3}, kRest, Membership::on);
  expect_membership(ray, {-1, -2, -3}, kRest, Membership::out);
  expect_membership(ray, {1, 2, moved_by_ulps(3, 1)}, kRest, Membership::out);
  const HullOracle sector(B({{0, 0, 0}}), B({{2, 1, 0}, {2, -1, 0}}));
  expect_membership(sector, {1, 0, 0}, kRest, Membership::on);
  expect_membership(sector, {2, 1, 0}, kRest, Membership::on);
  expect_membership(sector, {1, 0, 5e-324}, kRest, Membership::out);
  const HullOracle edge_on(B({{9, 2, 0}}), triangle);  // in the plane of the triangle
  expect_membership(edge_on, {-8, -1, 0}, kRest, Membership::on);
  expect_membership(edge_on, {8, 1, 0}, kRest, Membership::out);
  const HullOracle plate(B({{1, 1, 5}}), triangle);
  expect_membership(plate, {0, 0, -1}, kRest, Membership::in);
  expect_membership(plate, {-1, 0, -5}, kRest, Membership::on);
  expect_membership(plate, {1, 1, -5}, kRest, Membership::on);
  expect_membership(plate, {1, 1, -4}, kRest, Membership::out);
}

TEST(HullOracle, DifferenceOfVelocitiesIsNotRounded) {
  const HullOracle oracle(Ellipsoid::from_axes(kRest, {3, 3, 3}), HullBody({{3, 0, 8}}));
  const double tiny = 0x1p-80;
  expect_membership(oracle, {0, 0, 1}, {0, 0, 0}, Membership::on);
  expect_membership(oracle, {1 + 0x1p-30, 0, 1}, {1 + 0x1p-30, 0, -1}, Membership::on);
  expect_membership(oracle, {0, 0, 1}, {tiny, 0, 0}, Membership::out);
  expect_membership(oracle, {0, 0, 1}, {-tiny, 0, 0}, Membership::in);
  expect_membership(oracle, {1, 0, 1}, {1, 0, 1}, Membership::out);
  expect_membership(oracle, {1, 2, 3e200}, {1, 2, -3e200}, Membership::on);
  expect_membership(oracle, {0, 0, 1.5e308}, {0, 0, -1.5e308}, Membership::on);
  expect_membership(oracle, {0, 0, 5e-324}, {0, 0, 0}, Membership::on);
  expect_membership(oracle, {5e-324, 0, 5e-324}, kRest, Membership::out);
  expect_membership(oracle, {5e-324, 0, 1.5e-323}, kRest, Membership::in);
}

TEST(HullOracle, IntervalsOfVelocities) {
  const HullOracle oracle(Ellipsoid::from_axes(kRest, {1, 1, 1}), HullBody::box({-1, -1, 8}, {1, 1, 9}));
  using I = Interval;
  EXPECT_EQ(oracle.interval_membership({I(0, 0.01), I(0, 0.01), I(1, 0.01)}), Membership::in);
  EXPECT_EQ(oracle.interval_membership({I(1, 0.01), I(0, 0.01), I(1, 0.01)}), Membership::out);
  EXPECT_EQ(oracle.interval_membership({I(0, 0.01), I(0, 0.01), I(-1, 0.01)}), Membership::out);
  EXPECT_EQ(oracle.interval_membership({I(0.25, 0.1), I(0, 0.01), I(1, 0.01)}), std::nullopt);
  EXPECT_EQ(oracle.interval_membership({I(0, 0.1), I(0, 0.1), I(0, 0.1)}), std::nullopt);
  EXPECT_EQ(oracle.interval_membership({I(0), I(0), I(0)}), Membership::out);
}

/// Laws of predicates.h, on bodies of ordinary size, and the three kinds of oracle.
TEST(HullOracle, Laws) {
  RandomBodies random(304);
  SCOPED_TRACE(random.trace());
  RungTally tally;
  for (int i = 0; i < 400; ++i) {
    // On a grid of 2^-20, so that moving both bodies is exact.
    const auto points = [&](const Vector3d& middle, int count) {
      Points v;
      for (int k = 0; k < count; ++k)
        v.push_back(middle + (random.in_box(3) * 0x1p20).array().round().matrix() * 0x1p-20);
      return HullBody(v);
    };
    const Vector3d middle = (8 * random.direction() * 0x1p20).array().round() * 0x1p-20;
    const bool round = i % 2 == 0;
    const HullBody a = points(kRest, random.integer(1, 12)), b = points(middle, random.integer(1, 12));
    const Ellipsoid e = random.ellipsoid(kRest, 0.5, 4);
    const auto make = [&](const Vector3d& by, double scale) {
      const HullBody far = b.translated(by).scaled(scale);
      return round ? HullOracle(e.translated(by).scaled(scale), far)
                   : HullOracle(a.translated(by).scaled(scale), far);
    };
    const HullOracle oracle = make(kRest, 1), swapped = round ? HullOracle(b, e) : HullOracle(b, a),
                     moved = make({1024, -3, 77}, 1), large = make(kRest, 0x1p498),
                     small = make(kRest, 0x1p-498);
    for (const HullOracle* other : {&swapped, &moved, &large, &small})
      ASSERT_EQ(other->relation(), oracle.relation());
    ASSERT_EQ(oracle.exact_relation(), oracle.relation());
    for (int k = 0; k < 6; ++k) {
      const Vector3d w = middle + random.in_box(6);
      const Membership answer = oracle.exact_membership(w, kRest);
      tally.count(expect_membership(oracle, w, kRest, answer));
      if (oracle.relation() == Relation::disjoint) {
        ASSERT_EQ(testing::broken_velocity_law(oracle, swapped, w, true), "");
      }
      expect_membership(moved, w, kRest, answer);
      tally.count(expect_membership(large, w, kRest, answer));
      tally.count(expect_membership(small, w * 0x1p-300, kRest, answer));
      const Verdict verdict = oracle.verdict(w, kRest);
      if (oracle.relation() == Relation::overlapping) {
        EXPECT_EQ(verdict, Verdict::overlapping);
      }
      if (oracle.relation() == Relation::disjoint) {
        EXPECT_STREQ(to_string(verdict), to_string(answer));
      }
      if (answer == Membership::in && oracle.relation() == Relation::disjoint) {
        EXPECT_EQ(oracle.passage(w), Passage::ahead);
        EXPECT_EQ(oracle.passage(-w), Passage::behind);
      }
    }
  }
  EXPECT_GT(tally.triage, 7000);
  EXPECT_LT(tally.exact, 20);
}

TEST(HullOracle, OrderAndRepetitionOfPointsDoNotCount) {
  RandomBodies random(305);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 100; ++i) {
    Points v;
    for (int k = 0; k < 30; ++k) v.push_back(Vector3d(9, 0, 0) + random.in_box(3));
    Points more(v.rbegin(), v.rend());
    for (int k = 0; k < 10; ++k) more.push_back(v[3 * k]);
    more.push_back(v[0]);
    const Ellipsoid e = random.ellipsoid(kRest, 1, 3);
    const HullOracle one(e, HullBody(v)), other(e, HullBody(more));
    ASSERT_EQ(one.relation(), other.relation());
    for (int k = 0; k < 20; ++k) {
      const Vector3d w = Vector3d(9, 0, 0) + random.in_box(7);
      EXPECT_EQ(one.membership(w), other.membership(w));
      EXPECT_EQ(one.exact_membership(w, kRest), other.exact_membership(w, kRest));
    }
  }
}

TEST(HullOracle, OutsideTheRangeOfTheLowerRungs) {
  const double huge = 0x1p700;
  const HullBody a({{0, 0, 0}}), b({{huge, huge, huge}, {huge, -huge, huge}, {huge, 0, -huge}});
  const HullOracle oracle(a, b);
  EXPECT_EQ(oracle.relation(), Relation::disjoint);
  EXPECT_EQ(expect_membership(oracle, {1, 0, 0}, kRest, Membership::in), Rung::exact);
  EXPECT_EQ(expect_membership(oracle, {1, 1, 1}, kRest, Membership::on), Rung::exact);
  EXPECT_EQ(expect_membership(oracle, {1, 2, 1}, kRest, Membership::out), Rung::exact);
  // One body with coordinates from one end of the range to the other.
  const HullOracle mixed(HullBody({{0, 0, 0}, {1e-150, -1e-150, 0}}), HullBody({{1e150, 1, 1e-150}}));
  EXPECT_EQ(mixed.relation(), Relation::disjoint);
  expect_membership(mixed, {1e150, 1, 1e-150}, kRest, Membership::on);
  expect_membership(mixed, {1e150, 1, 2e-150}, kRest, Membership::out);
}

/// A lattice point one step above a triangle: the gap is 1 / |normal|, about 2^-50, at a size of 2^26, and
/// the normals that separate them need more than 53 bits.
TEST(HullOracle, BodiesCloserThanRounding) {
  __extension__ typedef __int128 Wide;
  RandomBodies random(306);
  SCOPED_TRACE(random.trace());
  int uncertified = 0, tried = 0;
  while (tried < 60) {
    std::int64_t u[3], v[3];
    for (int k = 0; k < 3; ++k) {
      u[k] = random.integer(-(1 << 26), 1 << 26);
      v[k] = random.integer(-(1 << 26), 1 << 26);
    }
    const Wide n[3] = {Wide(u[1]) * v[2] - Wide(u[2]) * v[1], Wide(u[2]) * v[0] - Wide(u[0]) * v[2],
                       Wide(u[0]) * v[1] - Wide(u[1]) * v[0]};
    // s n_0 + t n_1 = 1 by Euclid.
    Wide r0 = n[0], r1 = n[1], s0 = 1, s1 = 0, t0 = 0, t1 = 1;
    while (r1 != 0) {
      const Wide q = r0 / r1, r2 = r0 - q * r1, s2 = s0 - q * s1, t2 = t0 - q * t1;
      r0 = r1, r1 = r2, s0 = s1, s1 = s2, t0 = t1, t1 = t2;
    }
    if (r0 != 1) continue;
    // x = (s, t, 0) brought above the parallelogram of u and v: x - [alpha] u - [beta] v.
    const Vector x{Rational(static_cast<std::int64_t>(s0)), Rational(static_cast<std::int64_t>(t0)),
                   Rational(0)};
    const Vector ru{Rational(u[0]), Rational(u[1]), Rational(u[2])},
        rv{Rational(v[0]), Rational(v[1]), Rational(v[2])};
    const Vector m = cross(ru, rv);
    const auto floor_of = [](const Rational& f) {
      auto q = numerator(f) / denominator(f);
      if (q * denominator(f) > numerator(f)) --q;
      return Rational(q);
    };
    const Rational alpha = dot(cross(x, rv), m) / dot(m, m), beta = dot(cross(ru, x), m) / dot(m, m);
    Vector y = x - times(floor_of(alpha), ru) - times(floor_of(beta), rv);
    int above = 1;
    if (alpha - floor_of(alpha) + beta - floor_of(beta) > 1) {
      y = ru + rv - y;
      above = -1;
    }
    ASSERT_EQ(dot(m, y), above);
    ++tried;
    const Vector3d du = to_double(ru), dv = to_double(rv), point = to_double(y);
    ASSERT_EQ(rational(point), y);
    const HullOracle oracle(HullBody({point}), HullBody({kRest, du, dv}));
    ASSERT_EQ(oracle.relation(), Relation::disjoint);
    EXPECT_EQ(oracle.relation_rung(), Rung::exact);
    uncertified += !oracle.normal_certified();
    // Towards a point of the triangle, away from it, and beside it.
    const auto d = differences({kRest, du, dv}, {point});
    for (const Vector3d& w :
         {Vector3d(-point), Vector3d(du - point), Vector3d(point), Vector3d(du + dv - 3 * point),
          Vector3d(point - du), Vector3d(to_double(m) * -above), Vector3d(to_double(m) * above)})
      expect_membership(oracle, w, kRest, cone_of_points(d, rational(w)));
  }
  EXPECT_GT(uncertified, 20);
}

/// Points on an ellipsoid: their hull lies inside it, and around a slightly smaller one.
TEST(HullOracle, SampledEllipsoidAgreesWithConeOracle) {
  RandomBodies random(307);
  SCOPED_TRACE(random.trace());
  int in = 0, out = 0, between = 0;
  for (int i = 0; i < 15; ++i) {
    const auto [a, b] = random.separated_along_centers(1, 4, 1.3);
    constexpr int kCount = 3000;
    Points samples;
    for (int k = 0; k < kCount; ++k) {
      const double z = 1 - (2 * k + 1.0) / kCount, r = std::sqrt(1 - z * z),
                   angle = k * std::numbers::pi * (3 - std::sqrt(5.0));
      samples.push_back(b.center() + b.factor() * Vector3d(r * std::cos(angle), r * std::sin(angle), z));
    }
    // Neighbours are less than 0.11 apart on the unit sphere, hence the hull contains the ball of 0.99.
    const Ellipsoid less = Ellipsoid::from_shape(b.center(), Matrix3d(b.shape() * 0.98));
    const Ellipsoid more = Ellipsoid::from_shape(b.center(), Matrix3d(b.shape() * (1 + 1e-12)));
    const HullBody hull(samples);
    const HullOracle oracle(a, hull), swapped(hull, a);
    const ConeOracle inner(a, less), outer(a, more);
    ASSERT_EQ(oracle.relation(), Relation::disjoint);
    for (int k = 0; k < 300; ++k) {
      const Vector3d w = (b.center() - a.center()).normalized() + random.in_box(1);
      const Membership answer = oracle.membership(w);
      EXPECT_EQ(swapped.membership(-w), answer);
      if (inner.membership(w) != Membership::out) {
        EXPECT_EQ(answer, Membership::in);
        ++in;
      } else if (outer.membership(w) == Membership::out) {
        EXPECT_EQ(answer, Membership::out);
        ++out;
      } else {
        ++between;
      }
    }
  }
  EXPECT_GT(in, 500);
  EXPECT_GT(out, 500);
  EXPECT_LT(between, 200);
}

TEST(HullOracle, ManyPointsExactly) {
  RandomBodies random(308);
  SCOPED_TRACE(random.trace());
  Points far = lattice_points(random, 50000, 1000, {5000, 0, 0}),
         near = lattice_points(random, 20000, 900, kRest);
  // The steepest line in x and y from the one body to the other.
  far.emplace_back(5000, 9000, 0);
  near.emplace_back(0, -9000, 400);
  const HullOracle oracle{HullBody(near), HullBody(far)};
  EXPECT_EQ(oracle.relation_rung(), Rung::triage);
  EXPECT_EQ(oracle.size(), 70002U);
  expect_membership(oracle, {5000, 18000, -400}, kRest, Membership::on);
  expect_membership(oracle, {5000, moved_by_ulps(18000, 1), -400}, kRest, Membership::out);
  expect_membership(oracle, {5000, moved_by_ulps(18000, -1), -400}, kRest, Membership::in);
  EXPECT_EQ(expect_membership(oracle, {5000, 0, 0}, kRest, Membership::in), Rung::triage);
  EXPECT_EQ(expect_membership(oracle, {5000, 0, 9000}, kRest, Membership::out), Rung::triage);
  const HullOracle round(Ellipsoid::from_axes(kRest, {400, 500, 600}), HullBody(far));
  expect_membership(round, {5000, 2500, 0}, kRest, Membership::in);
  expect_membership(round, {1, 0, 0}, kRest, Membership::in);
  EXPECT_EQ(expect_membership(round, {0, 1, 0}, kRest, Membership::out), Rung::triage);
}

TEST(HullOracle, RefusesVelocitiesThatAreNotFinite) {
  const HullOracle oracle(Ellipsoid(), HullBody({{5, 0, 0}}));
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto field = [&](auto&& call) -> std::string {
    try {
      call();
    } catch (const InputError& error) {
      return error.field();
    }
    return "accepted";
  };
  EXPECT_EQ(field([&] { oracle.membership({1, nan, 0}); }), "agent_velocity[1]");
  EXPECT_EQ(field([&] { oracle.membership({1, 0, inf}, {0, 0, 0}); }), "agent_velocity[2]");
  EXPECT_EQ(field([&] { oracle.membership({1, 0, 0}, {-inf, 0, 0}); }), "obstacle_velocity[0]");
  EXPECT_EQ(field([&] { oracle.verdict({1, 0, 0}, {0, nan, 0}); }), "obstacle_velocity[1]");
  EXPECT_EQ(field([&] { oracle.membership({1, 0, 0}, {0, 0, 0}); }), "accepted");
  EXPECT_EQ(oracle.triage_membership({nan, 0, 0}), std::nullopt);
  EXPECT_EQ(oracle.interval_membership({inf, 0, 0}, {0, 0, 0}), std::nullopt);
}

TEST(HullOracle, BodiesThatMeetHaveTheWholeSpaceAsCone) {
  for (const double x : {2.0, 1.0}) {  // touching, overlapping
    const HullOracle oracle(Ellipsoid::from_axes(kRest, {2, 1, 1}), HullBody({{x, 0, 0}, {5, 0, 0}}));
    EXPECT_EQ(oracle.relation(), x == 2 ? Relation::touching : Relation::overlapping);
    expect_membership(oracle, {-1, 0, 0}, kRest, Membership::in);
    expect_membership(oracle, kRest, kRest, Membership::out);
    EXPECT_EQ(oracle.verdict({-1, 0, 0}, kRest), x == 2 ? Verdict::touching : Verdict::overlapping);
  }
}

}  // namespace
}  // namespace vericone::testing::hull_oracle_degenerate_test
