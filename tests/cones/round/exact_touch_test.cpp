// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cones/round/exact_touch.h"

namespace vericone::testing {
namespace {

const std::vector<std::pair<std::string, std::string>> kPairs{{"capsule", "capsule"},
                                                              {"cylinder", "ellipsoid"},
                                                              {"cylinder", "cylinder"},
                                                              {"cone", "ellipsoid"},
                                                              {"frustum", "cylinder"},
                                                              {"box", "capsule"},
                                                              {"ellipsoid + r", "ellipsoid"},
                                                              {"box + r", "ellipsoid"},
                                                              {"cylinder + r", "cylinder"},
                                                              {"cone", "cone"},
                                                              {"box", "box"},
                                                              {"disc", "ellipsoid + r"},
                                                              {"cylinder", "box + r"},
                                                              {"frustum", "capsule"}};

/// 2^-j
Rational small(int j) { return Rational(1, Integer(1) << j); }

TEST(ExactTouch, RaysAreOnTheBoundaryAndTheirNeighboursBesideIt) {
  Random random(7);
  SCOPED_TRACE(random.trace());
  for (const auto& [agent, obstacle] : kPairs)
    for (int i = 0; i < share(24); ++i) {
      SCOPED_TRACE(agent + ", " + obstacle + ", case " + std::to_string(i));
      const Touch t = Touch::random(agent, obstacle, random);
      // Ahead, beyond the reach of both bodies: they touch after a while.
      Rational longest = 0;
      for (const Rational& x : t.w) longest = std::max(longest, Rational(abs(x)));
      const TouchBody there = t.obstacle.moved(scaled(t.w, 128 / longest));
      const OnGrid touch(t.agent, there);
      EXPECT_EQ(touch.membership(t.w), Membership::on);
      EXPECT_EQ(touch.membership(scaled(t.w, -1)), Membership::out);
      for (const int j : {20, 40, 60}) {
        EXPECT_EQ(OnGrid(t.agent, there.moved(scaled(t.n, small(j)))).membership(t.w), Membership::out) << j;
        EXPECT_EQ(OnGrid(t.agent, there.moved(scaled(t.inwards, small(j)))).membership(t.w), Membership::in)
            << j;
      }
    }
}

TEST(ExactTouch, RelationsAreTouchingAndTheirNeighboursAreNot) {
  Random random(8);
  SCOPED_TRACE(random.trace());
  for (const auto& [agent, obstacle] : kPairs)
    for (int i = 0; i < share(12); ++i) {
      SCOPED_TRACE(agent + ", " + obstacle + ", case " + std::to_string(i));
      const Touch t = Touch::random(agent, obstacle, random);
      EXPECT_EQ(OnGrid(t.agent, t.obstacle).relation(), Relation::touching);
      for (const int j : {40, 60}) {
        EXPECT_EQ(OnGrid(t.agent, t.obstacle.moved(scaled(t.n, small(j)))).relation(), Relation::disjoint)
            << j;
        EXPECT_EQ(OnGrid(t.agent, t.obstacle.moved(scaled(t.inwards, small(j)))).relation(),
                  Relation::overlapping)
            << j;
      }
    }
}

}  // namespace
}  // namespace vericone::testing
