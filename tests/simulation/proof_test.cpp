// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/times/contact_time_enclosure.h>
#include <vericone/simulation/proof.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "moving_pairs.h"

namespace vericone::simulation::proof_test {
namespace {

const Ellipsoid& ellipsoid_of(const guidance::BodyState& state) { return state.shape.quadric()->ellipsoid(); }

TEST(Proof, StraightMotionAgreesWithExactMembershipAndContactTimes) {
  SCOPED_TRACE("seed 31");
  Random random(31);
  std::array<int, 3> counts{};
  constexpr double kEnd = 10;
  for (int i = 0; i < 2000; ++i) {
    const auto body = [&] {
      return ellipsoid({random.uniform(0.5, 5), random.uniform(0.5, 5), random.uniform(0.5, 5)});
    };
    const auto make = [&] {
      const Vector3d position = random.vector(25);
      return straight(body(), position, towards(random, position, kEnd, 8), kEnd, random.rotation());
    };
    const Track a = make(), b = make();
    const guidance::BodyState sa = a.state(0), sb = b.state(0);
    const ConeOracle oracle(ellipsoid_of(sa), ellipsoid_of(sb));
    const PairProof proof = prove(a, b, 0, kEnd);
    ++counts[static_cast<std::size_t>(proof.verdict)];
    if (oracle.relation() != Relation::disjoint) {
      EXPECT_EQ(proof.verdict, ProofVerdict::touched);
      EXPECT_EQ(proof.to, 0);
      continue;
    }
    const auto contact = enclose_time_to_contact(oracle, sa.velocity, sb.velocity);
    EXPECT_EQ(contact.has_value(), oracle.membership(sa.velocity, sb.velocity) != Membership::out);
    if (!contact || contact->lo() > kEnd) {
      EXPECT_EQ(proof.verdict, ProofVerdict::avoided) << i;
      EXPECT_GT(proof.least_distance, 0);
      // In straight motion the least distance is known.
      const double miss = clearance_ahead(oracle, sa.velocity, sb.velocity);
      EXPECT_GE(proof.least_distance, 0.98 * miss - 2e-6) << i;
      for (int j = 0; j <= 20; ++j) {
        const double t = kEnd * j / 20;
        const double now = separation(ellipsoid_of(a.state(t)), ellipsoid_of(b.state(t))).distance;
        EXPECT_LE(proof.least_distance, now);
      }
    } else {
      ASSERT_EQ(proof.verdict, ProofVerdict::touched) << i;
      EXPECT_LE(proof.from, contact->hi());
      EXPECT_GE(proof.to, contact->lo());
      EXPECT_LE(proof.to - proof.from, 1e-6);
      const CombinedEllipsoid at_a = *a.state(proof.to).shape.quadric();
      const CombinedEllipsoid at_b = *b.state(proof.to).shape.quadric();
      EXPECT_LE(at_a.gauge(proof.place - at_a.center()), 1 + 1e-3);
      EXPECT_LE(at_b.gauge(proof.place - at_b.center()), 1 + 1e-3);
    }
  }
  EXPECT_GT(counts[0], 300);
  EXPECT_GT(counts[1], 300);
}

TEST(Proof, CircleAroundABall) {
  // Radius v^2 / a = 20 about (0, 20, 0).
  for (const double miss : {3.0, 0.3, 1e-3, 1e-6}) {
    // At the angle 2 the centre of B is 2 + miss outside of the circle.
    const Vector3d outwards(std::sin(2.0), -std::cos(2.0), 0);
    Track a(ball(1), {{0, 0, 0}, {10, 0, 0}, Matrix3d::Identity()}, Orientation::heading, 0);
    for (int i = 1; i <= 600; ++i) {
      const Vector3d v = a.motion(a.end()).velocity;
      a.advance(Vector3d(-v.y(), v.x(), 0) * 0.5, 0.01 * i);
    }
    const Track b = straight(ball(1), Vector3d(0, 20, 0) + (22 + miss) * outwards, {0, 0, 0}, 6);
    const PairProof proof = prove(a, b, 0, 6);
    ASSERT_EQ(proof.verdict, ProofVerdict::avoided) << miss;
    EXPECT_LE(proof.least_distance, miss + 1e-9);
    EXPECT_GE(proof.least_distance, 0.98 * miss - 1.1e-6);
    EXPECT_NEAR(proof.least_time, 4, 0.2);  // of the angle 2
    const Track nearer = straight(ball(1), Vector3d(0, 20, 0) + (22 - miss) * outwards, {0, 0, 0}, 6);
    const PairProof hit = prove(a, nearer, 0, 6);
    ASSERT_EQ(hit.verdict, ProofVerdict::touched) << miss;
    // The centres are 2 apart where the cosine of the angle between them, from the circle's centre, is this.
    const double d = 22 - miss, when = (2 - std::acos((400 + d * d - 4) / (40 * d))) / 0.5;
    EXPECT_LE(hit.from, when + 1e-7);
    EXPECT_GE(hit.to, when - 1e-7);
    EXPECT_LE(hit.to - hit.from, 1e-4);
  }
}

TEST(Proof, GrazingWithinThePaddingIsUndecided) {
  for (const double miss : {1e-12, 1e-9, 1.5e-8}) {
    const Track a = straight(ball(1), {-10, 0, 0}, {5, 0, 0}, 4);
    const Track b = straight(ball(2), {0, 3 + miss, 0}, {0, 0, 0}, 4);
    const PairProof proof = prove(a, b, 0, 4);
    EXPECT_EQ(proof.verdict, ProofVerdict::undecided) << miss;
    EXPECT_NEAR(proof.from, 2, 1e-3);
    EXPECT_TRUE(proof.place.isApprox(Vector3d(0, 1, 0), 1e-2)) << proof.place.transpose();
    EXPECT_EQ(prove(a, b, 0, 4, {miss / 3, 1e-9}).verdict, ProofVerdict::avoided) << miss;
  }
}

// At 1e12 m places are known to 1e-4 m. In fact they touch after 10 s; in doubles A never moves.
TEST(Proof, FarFromTheOriginRoundingIsNoDistance) {
  for (const double far : {1e9, 1e12}) {
    const Track a = straight(ellipsoid({1, 1, 1}), {far, 0, 0}, {1e-6, 0, 0}, 30);
    const Track b = straight(ellipsoid({0.99999, 1, 1}), {far + 2, 0, 0}, {0, 0, 0}, 30);
    EXPECT_NE(prove(a, b, 0, 30).verdict, ProofVerdict::avoided) << far;
  }
}

// From far off to the origin, where what is flown and where it began cancel: in fractions of the numbers
// given each overlaps.
TEST(Proof, WhatComesFromFarOffIsRoundedNearTheOriginToo) {
  const auto verdict = [](const Vector3d& from, const Vector3d& velocity, const Vector3d& other) {
    return prove(straight(ball(1), from, velocity, 20), straight(ball(1), other, {0, 0, 0}, 20), 0, 20)
        .verdict;
  };
  EXPECT_NE(verdict({-340948798.94208676, -296397433.51598173, 0}, {33095819.12082906, 28771229.34811255, 0},
                    {-9.008303148616418, 2.1552619560037813, 0}),
            ProofVerdict::avoided);
  EXPECT_NE(verdict({-371857689930.164, -255931798861.90527, 0}, {37685893329.73551, 25937391461.049618, 0},
                    {-8.876496329952214, -5.7196582486635625, 0}),
            ProofVerdict::avoided);
}

TEST(Proof, DriftOfAConstantCurrent) {
  // Balls that pass at t = 4 with a gap of 0.5, carried towards each other by at most 4 C until then.
  const Track a = straight(ball(1), {-20, 0, 0}, {5, 0, 0}, 10),
              b = straight(ball(1), {0, 2.5, 0}, {0, 0, 0}, 10);
  const auto with = [&](double drift, double to) { return prove(a, b, 0, to, {1e-8, 1e-7, drift}); };
  EXPECT_EQ(with(0.12, 4.5).verdict, ProofVerdict::avoided);
  EXPECT_EQ(with(0.13, 4.5).verdict, ProofVerdict::undecided);
  // At t the distance is hypot(20 - 5 t, 2.5) - 2 at least, less t C.
  const double least = with(0.1, 10).least_distance;
  EXPECT_LE(least, 0.1);
  EXPECT_GE(least, 0.09);
  // Only one of them is carried, either way.
  for (const double sign : {-1.0, 1.0}) {
    const Track carried = straight(ball(1), {0, 2.5, 0}, {0, 0.1 * sign, 0}, 10);
    EXPECT_GE(prove(a, carried, 0, 10).least_distance * 1.0102 + 1e-6, least);
  }
  // The time counts from when the first of them set out, not from the beginning of the question.
  EXPECT_EQ(prove(a, b, 3.5, 4.5, {1e-8, 1e-7, 0.13}).verdict, ProofVerdict::undecided);
}

TEST(Proof, TurningEllipsoids) {
  SCOPED_TRACE("seed 32");
  Random random(32);
  std::array<int, 3> counts{};
  for (int i = 0; i < 150; ++i) {
    const auto make = [&] {
      const Vector3d position = random.vector(18);
      const Motion start{position, towards(random, position, 4, 5), random.rotation()};
      return turning(random,
                     ellipsoid({random.uniform(0.5, 5), random.uniform(0.5, 5), random.uniform(0.5, 5)}),
                     start, 10, 4);
    };
    const Track a = make(), b = make();
    const PairProof proof = prove(a, b, 0, 4);
    ++counts[static_cast<std::size_t>(proof.verdict)];
    expect_sampled(proof, 4, [&](double t) {
      return relation<3>(ellipsoid_of(a.state(t)), ellipsoid_of(b.state(t))) != Relation::disjoint;
    });
    if (proof.verdict != ProofVerdict::avoided) continue;
    double nearest = 1e9;
    for (int j = 0; j <= 1000; ++j) {
      const double t = 4 * j / 1000.0;
      nearest = std::min(nearest, separation(ellipsoid_of(a.state(t)), ellipsoid_of(b.state(t))).distance);
    }
    EXPECT_LE(proof.least_distance, nearest);
    EXPECT_GE(proof.least_distance, 0.95 * nearest - 1e-6) << i;
  }
  EXPECT_GT(counts[0], 30);
  EXPECT_GT(counts[1], 30);
  EXPECT_EQ(counts[2], 0);
}

/// x -> M x of a motion.
Motion mirrored(const Motion& m, const Matrix3d& mirror) {
  return {mirror * m.position, mirror * m.velocity, mirror * m.rotation * mirror};
}

TEST(Proof, MirroredAndExchangedBodiesHaveTheSameVerdict) {
  SCOPED_TRACE("seed 36");
  Random random(36);
  const Matrix3d mirror = Vector3d(1, 1, -1).asDiagonal();
  for (int i = 0; i < 60; ++i) {
    const ShapeInTime shape_a =
        ellipsoid({random.uniform(0.5, 5), random.uniform(0.5, 5), random.uniform(0.5, 5)});
    const ShapeInTime shape_b = DentedQuadric{{3, 2, 1}, {0.4, 0, 0, 0, false}};
    const Motion start_a{random.vector(15), random.vector(10), random.rotation()};
    const Motion start_b{random.vector(15), random.vector(10), random.rotation()};
    std::array<Track, 4> tracks{Track(shape_a, start_a, Orientation::heading, 0),
                                Track(shape_b, start_b, Orientation::heading, 0),
                                Track(shape_a, mirrored(start_a, mirror), Orientation::heading, 0),
                                Track(shape_b, mirrored(start_b, mirror), Orientation::heading, 0)};
    for (int j = 1; j <= 20; ++j) {
      const Vector3d a = random.vector(6), b = random.vector(6);
      tracks[0].advance(a, 0.15 * j);
      tracks[1].advance(b, 0.15 * j);
      tracks[2].advance(mirror * a, 0.15 * j);
      tracks[3].advance(mirror * b, 0.15 * j);
    }
    const double end = tracks[0].end();
    const PairProof proof = prove(tracks[0], tracks[1], 0, end);
    EXPECT_EQ(prove(tracks[1], tracks[0], 0, end).verdict, proof.verdict);
    const PairProof image = prove(tracks[2], tracks[3], 0, end);
    EXPECT_EQ(image.verdict, proof.verdict);
    if (proof.verdict == ProofVerdict::avoided) {
      EXPECT_NEAR(image.least_distance, proof.least_distance, 0.05 * proof.least_distance + 1e-5);
    }
  }
}

TEST(Proof, ATurnThatIsReversedWithinAPieceCounts) {
  // Nearly in place: 2 rad/s to the left for 0.25 s, then to the right. The tip comes nearest in between, and
  // is farther away at both ends and in the middle of the time.
  const double first = std::numbers::pi / 2 - 0.8;
  Track a(ellipsoid({3, 0.5, 0.5}), {{0, 0, 0}, {0.01, 0, 0}, rotation_from_heading(first, 0)},
          Orientation::heading, 0);
  a.advance({0, 0.02, 0}, 0.25);
  const Vector3d v = a.motion(0.25).velocity;
  a.advance(2 * Vector3d(v.y(), -v.x(), 0), 0.6);
  for (const auto& [gap, verdict] :
       {std::pair(0.70, ProofVerdict::touched), std::pair(0.77, ProofVerdict::avoided)}) {
    const double start = std::hypot(3 * std::cos(0.8), 0.5 * std::sin(0.8));
    const Track b = straight(ball(100), {0, start + 100 + gap, 0}, {0, 0, 0}, 0.6);
    const PairProof proof = prove(a, b, 0, 0.6);
    ASSERT_EQ(proof.verdict, verdict) << gap;
    const double when = verdict == ProofVerdict::touched ? proof.to : proof.least_time;
    EXPECT_NEAR(when, 0.23, 0.04);
  }
}

TEST(Proof, LevelBodiesOverTheTop) {
  // The frame turns about at the top: only a ball around the body tells, which is enough here and not there.
  for (const auto& [height, verdict] :
       {std::pair(9.0, ProofVerdict::avoided), std::pair(5.5, ProofVerdict::undecided)}) {
    Track a(ellipsoid({2, 3, 1}), {{0, 0, 0}, {0, 0, 10}, Matrix3d::Identity()}, Orientation::level, 0);
    a.advance({1, 0, 0}, 1);
    a.advance({0, -1, 0}, 2);
    const Track b = straight(ball(3), {height, 0, 9}, {0, 0, 0}, 2);
    EXPECT_EQ(prove(a, b, 0, 2).verdict, verdict) << height;
  }
}

TEST(Proof, RefusesWhatItCannotProve) {
  const Track dented = straight(DentedQuadric{{3, 2, 1}, {0.4, 0, 0, 0, false}}, {9, 0, 0}, {0, 0, 0}, 1);
  const Track flat = straight(DentedConic{3, 2, {}}, {9, 0, 0}, {0, 0, 0}, 1);
  const auto field = [](const Track& a, const Track& b, double from, double to) -> std::string {
    try {
      prove(a, b, from, to);
    } catch (const InputError& error) {
      return error.field();
    }
    return "";
  };
  EXPECT_EQ(field(flat, dented, 0, 1), "bodies");
  EXPECT_EQ(field(dented, dented, -1, 1), "from");
  EXPECT_EQ(field(dented, dented, 0, 1.5), "to");
  EXPECT_EQ(field(dented, dented, 0, 1), "");
}

}  // namespace
}  // namespace vericone::simulation::proof_test
