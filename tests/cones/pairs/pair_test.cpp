// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/pair.h>

#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <cmath>
#include <string>
#include <thread>
#include <tuple>

#include "cones/pairs/sampled_body.h"
#include "support/campaign.h"
#include "support/random_bodies.h"

namespace vericone::pair_test {
namespace {

using Eigen::Vector3d;
using testing::RandomBodies;
using testing::SampledPlaced;
using testing::share;
using testing::Swept;

Pose random_pose(RandomBodies& random, double distance) {
  Pose pose;
  pose.rotation = random.rotation();
  pose.position = distance * random.direction();
  return pose;
}

/// At the obstacle, or beside it by up to twice what both bodies measure.
Vector3d aimed(RandomBodies& random, const SampledPlaced& a, const SampledPlaced& b) {
  const Vector3d c = b.placed.pose.position - a.placed.pose.position;
  const Vector3d beside = random.direction();
  return (c + random.uniform(0, 5) * beside) * random.log_uniform(0.1, 10);
}

class EveryPair : public ::testing::TestWithParam<std::tuple<BodyKind, BodyKind>> {};

TEST_P(EveryPair, AgreesWithSampledSweepsAndItsMirrorImage) {
  const auto [first, second] = GetParam();
  RandomBodies random(1600 + 7 * static_cast<std::uint64_t>(first) + static_cast<std::uint64_t>(second));
  SCOPED_TRACE(random.trace());
  int decided = 0, asked = 0, clear = 0;
  for (int i = 0; i < share(1000); ++i) {
    const auto a = stand(random_body(random, first), random_pose(random, 0.5));
    const auto b = stand(random_body(random, second), random_pose(random, random.uniform(4, 9)));
    const Pair pair(a.placed, b.placed), mirrored(b.placed, a.placed);
    const Vector3d w = aimed(random, a, b), v_b = random.direction(), v_a = w + v_b;
    const Verdict verdict = pair.verdict(v_a, v_b);
    ASSERT_EQ(mirrored.verdict(v_b, v_a), verdict) << "pair " << i;
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
    }
    if (verdict == Verdict::out) {
      ASSERT_GT(miss.most, 0);
    }
    const Miss reversed = mirrored.miss(v_b, v_a);
    ASSERT_NEAR(reversed.least, miss.least, 1e-6 * (1 + miss.least)) << "pair " << i;
  }
  EXPECT_GE(decided, 0.95 * asked);
  EXPECT_GE(clear, asked / 2);
}

std::string name_of(const ::testing::TestParamInfo<EveryPair::ParamType>& info) {
  return std::string(to_string(std::get<0>(info.param))) + "_and_" + to_string(std::get<1>(info.param));
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryPair,
                         ::testing::Combine(::testing::ValuesIn(kBodyKinds), ::testing::ValuesIn(kBodyKinds)),
                         name_of);

}  // namespace
}  // namespace vericone::pair_test
