// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/pair.h>

#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/laws.h>
#include <vericone/testing/random_bodies.h>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <tuple>

#include "cones/pairs/sampled_body.h"
#include "support/allocations.h"
#include "support/campaign.h"

namespace vericone::pair_test {
namespace {

using Eigen::Vector3d;
using testing::any_body;
using testing::any_pose;
using testing::campaign_size;
using testing::RandomBodies;
using testing::sampled;
using testing::SampledPlaced;
using testing::share;
using testing::Swept;

/// At the obstacle, or beside it by up to twice what both bodies measure.
Vector3d aimed(RandomBodies& random, const SampledPlaced& a, const SampledPlaced& b) {
  const Vector3d c = b.placed.pose.position - a.placed.pose.position;
  const Vector3d beside = random.direction();
  return (c + random.uniform(0, 5) * beside) * random.log_uniform(0.1, 10);
}

/// Pair as a family, for the laws that all families obey.
struct PairPredicate {
  const Pair& pair;
  std::optional<Relation> relation() const { return pair.relation(); }
  Verdict membership(const Vector3d& v_a, const Vector3d& v_b) const { return pair.verdict(v_a, v_b); }
  Verdict verdict(const Vector3d& v_a, const Vector3d& v_b) const { return pair.verdict(v_a, v_b); }
};

/// 8 m of a way that takes longer than the largest double says, or just not; s.
TEST(Pairs, ContactsPastTheLargestDoubleAreBracketed) {
  constexpr double kMost = std::numeric_limits<double>::max();
  const Body ball = Ellipsoid(), box = HullBody::box(Vector3d::Constant(-1), Vector3d::Constant(1)),
             capsule = Convex::capsule(1, 0), cloud = Assembly::cloud({Vector3d::Zero()}, 1);
  const Body waist =
      CombinedEllipsoid(Ellipsoid(), {{Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix(), 0.2}});
  const auto apart = [](const Body& body) {
    return Placed(body, {Vector3d(10, 0, 0), Eigen::Matrix3d::Identity()});
  };
  for (const Body* a : {&ball, &box, &capsule, &cloud, &waist})
    for (const Body* b : {&ball, &box, &capsule, &cloud, &waist})
      for (const double speed : {5e-324, 1e-308, 4.45e-308, 4.4502e-308}) {
        const Pair pair(*a, apart(*b));
        ASSERT_EQ(pair.verdict({speed, 0, 0}, Vector3d::Zero()), Verdict::in);
        const Contact contact = *pair.contact({speed, 0, 0}, Vector3d::Zero());
        const bool past = speed < 4.4501e-308;
        EXPECT_LE(contact.earliest, past ? kMost : 8 / speed);
        EXPECT_TRUE(a != &ball || b != &ball || contact.earliest > 0.999 * kMost) << contact.earliest;
        EXPECT_GE(contact.latest, past ? std::numeric_limits<double>::infinity() : 8 / speed);
        EXPECT_FALSE(past && std::isfinite(contact.time));
      }
}

class EveryPair : public ::testing::TestWithParam<std::tuple<BodyKind, BodyKind>> {};

TEST_P(EveryPair, AgreesWithSampledSweepsAndItsMirrorImage) {
  const auto [first, second] = GetParam();
  RandomBodies random(1600 + 7 * static_cast<std::uint64_t>(first) + static_cast<std::uint64_t>(second));
  SCOPED_TRACE(random.trace());
  int decided = 0, asked = 0, clear = 0, normals = 0, turned = 0;
  for (int i = 0; i < campaign_size(100, 1000); ++i) {
    const auto a = stand(sampled(any_body(random, first)), any_pose(random, 0.5));
    const auto b = stand(sampled(any_body(random, second)), any_pose(random, random.uniform(4, 9)));
    const Pair pair(a.placed, b.placed), mirrored(b.placed, a.placed);
    const Vector3d w = aimed(random, a, b), v_b = random.direction(), v_a = w + v_b;
    const Verdict verdict = pair.verdict(v_a, v_b);
    ASSERT_EQ(mirrored.verdict(v_b, v_a), verdict) << "pair " << i;
    ASSERT_EQ(pair.rung(v_a, v_b).has_value(), pair.guarantee().exact) << "pair " << i;
    ASSERT_EQ(testing::broken_velocity_law(PairPredicate{pair}, PairPredicate{mirrored}, w), "")
        << "pair " << i;
    ASSERT_EQ(mirrored.relation(), pair.relation());
    ASSERT_TRUE(!pair.guarantee().exact || verdict != Verdict::undecided);
    ++asked;
    decided += verdict != Verdict::undecided;
    const auto relation = pair.relation();
    if (!relation || *relation != Relation::disjoint) continue;
    const Swept truth = sweep(a, b, w);
    clear += truth != Swept::unclear;
    if (truth == Swept::meet) {
      ASSERT_NE(verdict, Verdict::out) << "pair " << i << " meets";
    }
    if (truth == Swept::miss) {
      ASSERT_TRUE(verdict == Verdict::out || verdict == Verdict::undecided) << "pair " << i << " misses";
    }
    // What hangs together with the verdict.
    const auto contact = pair.contact(v_a, v_b);
    ASSERT_EQ(contact.has_value(), verdict != Verdict::out);
    const Miss miss = pair.miss(v_a, v_b);
    ASSERT_LE(miss.least, miss.most) << "pair " << i;
    if (verdict == Verdict::in) {
      ASSERT_EQ(miss.most, 0);
      ASSERT_LE(contact->earliest, contact->latest);
      ASSERT_GT(contact->earliest, 0);
      ASSERT_TRUE(std::isnan(contact->time) ||
                  (contact->time >= contact->earliest && contact->time <= contact->latest));
      ASSERT_GE(miss.depth, 0);
      ASSERT_EQ(miss.distance, -miss.depth);
      // A shift by the depth is enough.
      Placed beside = a.placed;
      beside.pose.position -= (1.001 * miss.depth + 1e-6) * miss.normal;
      const Verdict shifted = Pair(beside, b.placed).verdict(v_a, v_b);
      ASSERT_TRUE(shifted == Verdict::out || shifted == Verdict::undecided) << "pair " << i;
    }
    if (verdict == Verdict::out) {
      ASSERT_GT(miss.most, 0);
    }
    const auto seen = mirrored.contact(v_b, v_a);
    if (contact && contact->normal && seen->normal && verdict == Verdict::in && contact->latest < 1e3) {
      // The same contact seen from the other body; pieces may be met at the same time, to the tolerance.
      turned += contact->normal->dot(*seen->normal) < 0;
      ++normals;
    }
    const Miss reversed = mirrored.miss(v_b, v_a);
    ASSERT_NEAR(reversed.least, miss.least, 1e-6 * (1 + miss.least)) << "pair " << i;
  }
  EXPECT_GE(decided, 0.95 * asked);
  EXPECT_GE(turned, 0.95 * normals);
  EXPECT_GE(clear, asked / 2);
}

std::string kinds_of(const ::testing::TestParamInfo<EveryPair::ParamType>& info) {
  return std::string(to_string(std::get<0>(info.param))) + "_and_" + to_string(std::get<1>(info.param));
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryPair,
                         ::testing::Combine(::testing::ValuesIn(kBodyKinds), ::testing::ValuesIn(kBodyKinds)),
                         kinds_of);

Placed ball(const Vector3d& center, double radius) {
  return Placed(Ellipsoid::from_axes(center, Vector3d::Constant(radius)));
}

TEST(PairAnswers, AGrazingContactsTimeIsWithinItsBracket) {
  RandomBodies random(7);
  const Vector3d still = Vector3d::Zero();
  int grazing = 0;
  while (grazing < 40) {
    const Ellipsoid a = random.ellipsoid({0, 0, 0}, 1, 4), b = random.ellipsoid({12, 0, 0}, 1, 4);
    const Pair pair{Placed(a), Placed(b)};
    if (pair.relation() != Relation::disjoint) continue;
    // Between the line of centers and a direction beside it, to the last double.
    Vector3d inside = b.center() - a.center(), outside = inside + random.in_box(30);
    if (pair.verdict(inside, still) != Verdict::in || pair.verdict(outside, still) != Verdict::out) continue;
    for (Vector3d middle = 0.5 * (inside + outside); middle != inside && middle != outside;
         middle = 0.5 * (inside + outside))
      (pair.verdict(middle, still) == Verdict::in ? inside : outside) = middle;
    const auto contact = pair.contact(inside, still);
    ASSERT_TRUE(contact);
    EXPECT_GE(contact->time, contact->earliest);
    EXPECT_LE(contact->time, contact->latest);
    ++grazing;
  }
}

TEST(PairAnswers, OfTwoBallsAreThoseOfTheClosedForms) {
  const Pair pair(ball({0, 0, 0}, 1), ball({10, 0, 0}, 2));
  EXPECT_TRUE(pair.guarantee().exact);
  const Vector3d still = Vector3d::Zero();
  const auto contact = pair.contact({3, 0, 0}, {1, 0, 0});
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->time, 3.5, 1e-12);
  EXPECT_LE(contact->earliest, 3.5);
  EXPECT_GE(contact->latest, 3.5);
  ASSERT_TRUE(contact->point && contact->normal);
  EXPECT_LT((*contact->point - Vector3d(11.5, 0, 0)).norm(), 1e-6);  // the obstacle moved by 3.5 m
  EXPECT_LT((*contact->normal - Vector3d(1, 0, 0)).norm(), 1e-6);
  const Miss hit = pair.miss({2, 0.2, 0}, still);
  EXPECT_EQ(hit.most, 0);
  const double off = 10 * 0.2 / std::sqrt(4.04);
  EXPECT_NEAR(hit.depth, 3 - off, 1e-12);
  EXPECT_NEAR(hit.distance, off - 3, 1e-12);
  const Miss past = pair.miss({2, 1, 0}, still);
  const double distance = 10 / std::sqrt(5.0) - 3;
  EXPECT_LE(past.least, distance);
  EXPECT_GE(past.most, distance);
  EXPECT_NEAR(past.distance, distance, 1e-12);
  EXPECT_NEAR(past.time, 4, 1e-9);  // 10 m ahead at 2 m/s, less what 1 m/s across takes: 20 / 5 s
  const Miss away = pair.miss({-1, 0, 0}, still);
  EXPECT_NEAR(away.distance, 7, 1e-12);
  EXPECT_EQ(away.time, 0);
  EXPECT_EQ(pair.passage({-1, 0, 0}, still), Passage::behind);
  EXPECT_EQ(pair.passage({1, 0, 0}, still), Passage::ahead);
  EXPECT_EQ(pair.passage({0, 1, 0}, still), Passage::never);
  EXPECT_EQ(pair.passage(still, still), Passage::never);
}

TEST(PairAnswers, GradientsAreThoseOfDifferences) {
  RandomBodies random(1901);
  SCOPED_TRACE(random.trace());
  int checked = 0;
  for (int i = 0; i < share(400); ++i) {
    const BodyKind kind = kBodyKinds[static_cast<std::size_t>(random.integer(0, 5))];
    if (kind == BodyKind::combined) continue;  // its miss is a bracket between ellipsoids
    const Placed a(any_body(random, BodyKind::ellipsoid), any_pose(random, 0.5));
    Placed b(any_body(random, kind), any_pose(random, 7));
    const Vector3d w = b.pose.position + random.in_box(8);
    const Miss here = Pair(a, b).miss(w, Vector3d::Zero());
    if (!(here.most > 0.05)) continue;
    const Vector3d by = random.direction();
    constexpr double kStep = 1e-5;
    const auto moved = [&](double h) {
      Placed other = b;
      other.pose.position += h * by;
      return Pair(a, other).miss(w, Vector3d::Zero()).distance;
    };
    const double slope = (moved(kStep) - moved(-kStep)) / (2 * kStep);
    // Where the nearest piece changes the distance has a kink.
    const double left = (here.distance - moved(-kStep)) / kStep,
                 right = (moved(kStep) - here.distance) / kStep;
    if (std::abs(left - right) > 1e-3) continue;
    ASSERT_NEAR(here.normal.dot(by), slope, 2e-3) << to_string(kind) << " " << i;
    ++checked;
  }
  EXPECT_GT(checked, share(400) / 4);
}

TEST(PairAnswers, OfPlanarBodiesAreTheirOwn) {
  const CombinedEllipse agent = Ellipse::from_axes({0, 0}, {1, 0.5}),
                        dented = dented_conic({6, 0}, 2, 1.5, 0.6, 0);
  const Pair pair(agent, dented);
  EXPECT_EQ(pair.relation(), Relation::disjoint);
  EXPECT_EQ(pair.verdict({1, 0, 0}, {0, 0, 0}), Verdict::in);
  EXPECT_EQ(pair.verdict({0, 1, 0}, {0, 0, 0}), Verdict::out);
  const Pair ellipses(agent, Ellipse::from_axes({5, 0}, {1, 1}));
  EXPECT_TRUE(ellipses.guarantee().exact);
  EXPECT_NEAR(ellipses.contact({1, 0, 0}, {0, 0, 0})->time, 3, 1e-12);
  // By the distance of the line of motion, 1.524 and 1.694 m, and the bodies' radii across it, 1.565
  // and 1.580 m.
  EXPECT_EQ(ellipses.verdict({5, 1.6, 0}, {0, 0, 0}), Verdict::in);
  EXPECT_EQ(ellipses.verdict({5, 1.8, 0}, {0, 0, 0}), Verdict::out);
}

TEST(PairAnswers, SeveralThreadsShareAPair) {
  RandomBodies random(1902);
  const Pair pair(Placed(any_body(random, BodyKind::combined)),
                  Placed(any_body(random, BodyKind::combined), {{5, 0, 0}}));
  std::vector<Vector3d> velocities;
  for (int i = 0; i < 200; ++i) velocities.push_back(Vector3d(5, 0, 0) + random.in_box(4));
  std::vector<Verdict> alone, first(velocities.size()), second(velocities.size());
  for (const Vector3d& w : velocities) alone.push_back(pair.verdict(w, Vector3d::Zero()));
  const auto ask = [&](std::vector<Verdict>& answers) {
    for (std::size_t i = 0; i < velocities.size(); ++i)
      answers[i] = pair.verdict(velocities[i], Vector3d::Zero());
  };
  std::thread one([&] { ask(first); }), two([&] { ask(second); });
  one.join();
  two.join();
  EXPECT_EQ(first, alone);
  EXPECT_EQ(second, alone);
}

TEST(PairAnswers, RefusesWhatIsNotFinite) {
  const auto field = [](const auto& ask) {
    try {
      ask();
    } catch (const InputError& e) {
      return e.field();
    }
    return std::string();
  };
  RandomBodies random(1903);
  for (const BodyKind kind : kBodyKinds) {
    const Pair pair(Placed(any_body(random, BodyKind::ellipsoid)),
                    Placed(any_body(random, kind), {{9, 0, 0}}));
    EXPECT_EQ(field([&] { pair.verdict({1, NAN, 0}, {0, 0, 0}); }), "agent_velocity[1]") << to_string(kind);
    EXPECT_EQ(field([&] {
                pair.verdict({1, 0, 0}, {0, 0, INFINITY});
              }),
              "obstacle_velocity[2]")
        << to_string(kind);
  }
  Pose bent;
  bent.rotation(0, 0) = 2;
  EXPECT_EQ(field([&] { Pair(Placed(Body(), bent), ball({5, 0, 0}, 1)); }), "pose.rotation");
  EXPECT_EQ(field([&] {
              Pair(any_body(random, BodyKind::combined), any_body(random, BodyKind::mesh), {.tolerance = 2});
            }),
            "tolerance");
}

TEST(PairAnswers, TheVerdictOfTwoEllipsoidsIsTheOracles) {
  const Pair pair(ball({0, 0, 0}, 1), ball({5, 0, 0}, 2));
  const ConeOracle oracle(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}),
                          Ellipsoid::from_axes({5, 0, 0}, {2, 2, 2}));
  EXPECT_EQ(pair.verdict({4, 3, 0}, {0, 0, 0}), oracle.verdict({4, 3, 0}, {0, 0, 0}));
  EXPECT_EQ(pair.verdict({4, 3, 0}, {0, 0, 0}), Verdict::on);
}

/// Of exact pairs where the first rungs decide: the control loop of a robot asks this.
TEST(PairAnswers, VerdictsDoNotAllocate) {
  RandomBodies random(1904);
  for (const BodyKind kind :
       {BodyKind::ellipsoid, BodyKind::hull, BodyKind::mesh, BodyKind::cloud, BodyKind::boxes}) {
    const Pair pair(Placed(any_body(random, BodyKind::ellipsoid)),
                    Placed(any_body(random, kind), {{9, 0, 0}}));
    const std::size_t before = testing::allocations();
    int meet = 0;
    for (int i = 0; i < 200; ++i)
      meet += pair.verdict(Vector3d(9, 0, 0) + random.in_box(5), Vector3d::Zero()) == Verdict::in;
    EXPECT_EQ(testing::allocations(), before) << to_string(kind);
    EXPECT_GT(meet, 0) << to_string(kind);
  }
}

}  // namespace
}  // namespace vericone::pair_test
