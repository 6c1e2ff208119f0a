// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/pair.h>

#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/any_body.h>
#include <vericone/testing/laws.h>
#include <cmath>
#include <string>
#include <thread>
#include <tuple>

#include "cones/pairs/sampled_body.h"
#include "support/campaign.h"

namespace vericone::pair_test {
namespace {

using Eigen::Vector3d;
using testing::any_body;
using testing::any_pose;
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

class EveryPair : public ::testing::TestWithParam<std::tuple<BodyKind, BodyKind>> {};

TEST_P(EveryPair, AgreesWithSampledSweepsAndItsMirrorImage) {
  const auto [first, second] = GetParam();
  RandomBodies random(1600 + 7 * static_cast<std::uint64_t>(first) + static_cast<std::uint64_t>(second));
  SCOPED_TRACE(random.trace());
  int decided = 0, asked = 0, clear = 0;
  for (int i = 0; i < share(1000); ++i) {
    const auto a = stand(sampled(any_body(random, first)), any_pose(random, 0.5));
    const auto b = stand(sampled(any_body(random, second)), any_pose(random, random.uniform(4, 9)));
    const Pair pair(a.placed, b.placed), mirrored(b.placed, a.placed);
    const Vector3d w = aimed(random, a, b), v_b = random.direction(), v_a = w + v_b;
    const Verdict verdict = pair.verdict(v_a, v_b);
    ASSERT_EQ(mirrored.verdict(v_b, v_a), verdict) << "pair " << i;
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
