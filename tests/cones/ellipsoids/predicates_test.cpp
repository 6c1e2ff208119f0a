// SPDX-License-Identifier: BSD-3-Clause
//
// The laws in predicates.h and the agreement of the rungs, on random velocities and on velocities within a
// few roundings of the boundary.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/testing/random_bodies.h>

#include <array>
#include <iostream>

#include <vericone/testing/laws.h>
#include "support/campaign.h"

namespace vericone::predicates_test {
namespace {

using Eigen::Vector3d;
using testing::RandomBodies, testing::share;

/// How a pair is drawn: ordinary, nearly touching, thin, of very different sizes, far apart.
RandomBodies::Pair draw_pair(RandomBodies& random, int kind) {
  switch (kind % 5) {
    case 0:
      return random.scaled_from_touching(1, 10, random.uniform(1.01, 3));
    case 1:
      return random.scaled_from_touching(1, 10, 1 + random.log_uniform(1e-15, 1e-3));
    case 2:
      return random.scaled_from_touching(1e-6, 1, random.uniform(1.01, 2));
    case 3:
      return random.scaled_from_touching(1e-3, 1e3, random.uniform(1.01, 3));
    default:
      return random.scaled_from_touching(1, 10, random.log_uniform(10, 1e9));
  }
}

/// A boundary direction moved by a few roundings, or inwards or outwards by up to `farthest`.
Vector3d near_boundary(RandomBodies& random, const TrueCone& cone, double farthest) {
  const auto& s = cone.boundary[random.integer(0, static_cast<int>(cone.boundary.size()) - 1)];
  Vector3d w = random.log_uniform(0.1, 10) * s.direction;
  if (random.coin()) {
    w = random.ulps(w, 3);
  } else {
    w += (random.coin() ? 1 : -1) * random.log_uniform(1e-17, farthest) * w.norm() * s.normal;
  }
  return w;
}

constexpr const char* kKinds[] = {"ordinary", "nearly touching", "axes 1e-6..1", "axes 1e-3..1e3", "distant"};

struct Answers {
  int cases = 0, undecided = 0, exact = 0, naive_wrong = 0;
  void print(const std::string& what) const {
    std::cout << "[ rates    ] " << what << ": " << cases << " cases, triage undecided "
              << 100. * undecided / cases << " %, exact rung " << 100. * exact / cases << " %, naive wrong "
              << 100. * naive_wrong / cases << " %\n";
  }
};
using AnswersByKind = std::array<Answers, 5>;

Answers total(const AnswersByKind& kinds, const std::string& what) {
  Answers sum;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    kinds[i].print(what + ", " + kKinds[i]);
    sum.cases += kinds[i].cases;
    sum.undecided += kinds[i].undecided;
    sum.exact += kinds[i].exact;
    sum.naive_wrong += kinds[i].naive_wrong;
  }
  return sum;
}

/// Every rung and every law for one velocity.
void check(const ConeOracle& ab, const ConeOracle& ba, const ConeOracle& moved, const Vector3d& w,
           Answers& answers) {
  Membership exact{};
  Rung rung{};
  ASSERT_EQ(testing::broken_velocity_law(ab, ba, w, true), "");
  exact = ab.membership(w, &rung);
  ++answers.cases;
  answers.undecided += rung != Rung::triage;
  answers.exact += rung == Rung::exact;
  answers.naive_wrong += ab.naive_membership(w) != exact;
  ASSERT_EQ(moved.membership(w), exact) << "law (5)";
  ASSERT_EQ(ab.passage(w), static_cast<Passage>(4 - static_cast<int>(ab.passage(-w)))) << "law (6)";
}

/// The pair with centres on a grid, so that a common move is exact, and the moved pair.
struct MovedPair {
  Ellipsoid a, b, moved_a, moved_b;
  MovedPair(const RandomBodies::Pair& pair, const Vector3d& by)
      : a(on_grid(pair.first)),
        b(on_grid(pair.second)),
        moved_a(a.translated(by)),
        moved_b(b.translated(by)) {}
  static Ellipsoid on_grid(const Ellipsoid& body) {
    Vector3d p = body.center();
    for (int i = 0; i < 3; ++i) p(i) = std::ldexp(std::round(std::ldexp(p(i), 40)), -40);
    Ellipsoid origin = body.translated(-body.center());
    return origin.translated(p);
  }
  bool exact() const {
    const Vector3d by = moved_a.center() - a.center();
    return by == moved_b.center() - b.center() && Vector3d(moved_a.center() - by) == a.center() &&
           Vector3d(moved_b.center() - by) == b.center();
  }
};

void check_laws(std::uint64_t seed, int pairs, int velocities, double near, AnswersByKind& answers) {
  RandomBodies random(seed);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < pairs; ++i) {
    const MovedPair pair(draw_pair(random, i), random.integer(-100, 100) * Vector3d(1, -2, 3));
    const bool exact_move = pair.exact();
    const ConeOracle ab(pair.a, pair.b), ba(pair.b, pair.a);
    const ConeOracle moved = exact_move ? ConeOracle(pair.moved_a, pair.moved_b) : ab;
    ASSERT_EQ(ab.relation(), ba.relation()) << "law (1), pair " << i;
    ASSERT_EQ(ab.relation(), moved.relation()) << "law (5), pair " << i;
    if (ab.relation() != Relation::disjoint) continue;
    const TrueCone cone = true_cone(pair.a, pair.b, 24);
    for (int j = 0; j < velocities; ++j) {
      const Vector3d w =
          near > 0 ? near_boundary(random, cone, near)
          : random.coin()
              ? random.direction()
              : Vector3d(cone.axis + random.uniform(0, 2) * (cone.boundary[j % 24].direction - cone.axis));
      check(ab, ba, moved, w, answers[i % 5]);
      ASSERT_FALSE(::testing::Test::HasFatalFailure())
          << "pair " << i << " velocity " << j << ": " << w.transpose();
    }
  }
}

TEST(PredicateLaws, OnRandomVelocities) {
  AnswersByKind kinds;
  check_laws(521, share(2000), 40, 0, kinds);
  const Answers answers = total(kinds, "random");
  EXPECT_GE(answers.cases, share(70000));
  // What the first rung is for.
  for (const int ordinary : {0, 1}) EXPECT_LT(kinds[ordinary].undecided, kinds[ordinary].cases / 100);
  EXPECT_LT(answers.undecided, answers.cases / 4);
  // What the second rung is for: distant pairs; of axes of 1 to a million it leaves a few in a hundred.
  for (const int plain : {0, 1, 4}) EXPECT_LT(kinds[plain].exact, kinds[plain].cases / 1000);
  for (const int thin : {2, 3}) EXPECT_LT(kinds[thin].exact, kinds[thin].cases / 10);
}

TEST(PredicateLaws, WithinRoundingsOfTheBoundary) {
  AnswersByKind kinds;
  check_laws(522, share(1500), 20, 1e-12, kinds);
  const Answers answers = total(kinds, "near boundary");
  EXPECT_GE(answers.cases, share(25000));
  // The set is hard, or the test would prove nothing.
  EXPECT_GT(answers.naive_wrong, answers.cases / 100);
}

TEST(PredicateLaws, WhereTheFirstRungStartsToAnswer) {
  AnswersByKind kinds;
  check_laws(524, share(1500), 20, 1, kinds);
  const Answers answers = total(kinds, "around the reach of triage");
  EXPECT_GE(answers.cases, share(25000));
  for (const Answers& a : kinds) {
    EXPECT_GT(a.undecided, a.cases / 20);
    EXPECT_GT(a.cases - a.undecided, a.cases / 50);
  }
}

/// g(n) of the contact plane certifies the answers of the oracle without its cubic: a w in the cone has
/// n.w >= 0 for every separating n, and a w out of it has a separating n with n.w < 0 or is behind.
TEST(PredicateLaws, AgreeWithSeparatingPlanes) {
  RandomBodies random(523);
  SCOPED_TRACE(random.trace());
  int seen_in = 0, seen_out = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto [a, b] = draw_pair(random, i);
    const ConeOracle oracle(a, b);
    if (oracle.relation() != Relation::disjoint) continue;
    const TrueCone cone = true_cone(a, b, 24);
    for (int j = 0; j < 20; ++j) {
      const auto& s = cone.boundary[random.integer(0, 23)];
      const Vector3d n = s.normal + random.log_uniform(1e-15, 1e-1) * oracle.separating_normal().normalized();
      const Vector3d w = s.direction + random.uniform(-1, 1) * random.log_uniform(1e-15, 1e-1) * s.normal;
      if (!separates<3>(a, b, n)) continue;
      const double nw = n.dot(w);
      if (std::abs(nw) < 1e-15 * n.norm() * w.norm()) continue;
      if (oracle.membership(w) != Membership::out) {
        ASSERT_GT(nw, 0) << "pair " << i;
        ++seen_in;
      } else {
        ++seen_out;
      }
    }
  }
  EXPECT_GT(seen_in, 5000);
  EXPECT_GT(seen_out, 5000);
}

}  // namespace
}  // namespace vericone::predicates_test
