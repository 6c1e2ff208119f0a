// SPDX-License-Identifier: BSD-3-Clause
//
// Questions asked of two bodies once say what a prepared pair says.
#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/cones/plane_cones.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/may_meet.h>
#include <vericone/testing/random_bodies.h>
#include <cmath>

#include "support/campaign.h"

namespace vericone::world_test {
namespace {

using Eigen::Vector3d;
using testing::any_body;
using testing::any_pose;
using testing::campaign_size;
using testing::RandomBodies;

WorldBody world_body(RandomBodies& random, BodyKind kind, double distance) {
  const Placed placed(any_body(random, kind), any_pose(random, distance));
  if (placed.body.quadric()) return in_world(*placed.body.quadric(), placed.pose);
  if (placed.body.hull()) return in_world(*placed.body.hull(), placed.pose);
  return placed;
}

TEST(AskedOnce, SaysWhatThePairSays) {
  RandomBodies random(1901);
  SCOPED_TRACE(random.trace());
  int apart = 0, meeting = 0, missing = 0, overlapping = 0;
  for (const BodyKind first : kBodyKinds)
    for (const BodyKind second : kBodyKinds)
      for (int i = 0; i < campaign_size(4, 40); ++i) {
        const WorldBody a = world_body(random, first, 0.5), b = world_body(random, second, 1.5 * (i + 1));
        const Pair pair = pair_of(a, b);
        const std::optional<Relation> once = relation_of(a, b, 1e-6), prepared = pair.relation();
        if (!once || !prepared) continue;
        EXPECT_EQ(*once, *prepared) << to_string(first) << " " << to_string(second) << " " << i;
        const Vector3d v_a = pair.obstacle().middle() - pair.agent().middle() + random.in_box(4),
                       v_b = random.direction();
        const std::optional<bool> course = may_meet(a, b, v_a, v_b);
        ASSERT_EQ(course.has_value(), *prepared == Relation::disjoint);
        overlapping += !course;
        if (!course) continue;
        ++apart;
        const Verdict verdict = pair.verdict(v_a, v_b);
        EXPECT_TRUE(verdict == Verdict::undecided || *course == (verdict != Verdict::out))
            << to_string(first) << " " << to_string(second);
        (*course ? meeting : missing) += 1;
      }
  EXPECT_GT(overlapping, apart / 20);
  EXPECT_GT(meeting, apart / 10);
  EXPECT_GT(missing, apart / 10);
}

TEST(AskedOnce, PlanarBodies) {
  RandomBodies random(1902);
  SCOPED_TRACE(random.trace());
  int apart = 0;
  const int count = campaign_size(200, 2000);
  for (int i = 0; i < count; ++i) {
    const auto dented = [&](const Vector3d& at) {
      return dented_conic(at.head<2>(), random.uniform(1, 3), random.uniform(1, 3),
                          i % 3 ? random.uniform(0.1, 0.9) : 0, random.uniform(0, 3));
    };
    const CombinedEllipse a = dented(random.in_box(1)), b = dented(random.in_box(6));
    const auto once = relation_of(a, b, 1e-6), prepared = Pair(a, b).relation();
    if (!once || !prepared) continue;
    EXPECT_EQ(*once, *prepared) << i;
    apart += *once == Relation::disjoint;
  }
  EXPECT_GT(apart, count / 5);
  EXPECT_LT(apart, count * 4 / 5);
}

TEST(AskedOnce, RefusesThePlaneAgainstSpace) {
  const WorldBody flat = CombinedEllipse(), solid = CombinedEllipsoid(Ellipsoid());
  for (const auto& [a, b] : {std::pair(flat, solid), std::pair(solid, flat)}) {
    EXPECT_FALSE(has_sectors(a, b, SectorMethod::true_cone));
    EXPECT_FALSE(PlaneCones(a, b, {0, 0, 0}, {1, 0, 0}, SectorMethod::true_cone).on({1, 0, 0}, {0, 1, 0}));
    EXPECT_THROW(static_cast<void>(pair_of(a, b)), InputError);
    EXPECT_THROW(static_cast<void>(relation_of(a, b, 1e-6)), InputError);
    EXPECT_THROW(static_cast<void>(may_meet(a, b, {1, 0, 0}, {0, 0, 0})), InputError);
  }
}

}  // namespace
}  // namespace vericone::world_test
