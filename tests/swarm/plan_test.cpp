// SPDX-License-Identifier: BSD-3-Clause
//
// Of the private header: plans in closed form, and what is proved of two of them against samples.
#include "plan.h"

#include <gtest/gtest.h>
#include <vericone/internal/cones/random_engagement.h>
#include <algorithm>
#include <cmath>

namespace vericone::swarm {
namespace {

using Eigen::Vector3d;
using engagements::Random;

/// Accelerates for `seconds`, then brakes to rest: written anew.
struct Flying {
  Vector3d p, v, a;
  double seconds, most;

  Vector3d at(double t) const {
    const double s = std::min(t, seconds);
    const Vector3d x = p + s * v + 0.5 * s * s * a, w = v + seconds * a;
    const double speed = w.norm(), b = std::min(std::max(0.0, t - seconds), speed / most);
    return speed > 0 ? Vector3d(x + (b - 0.5 * most * b * b / speed) * w) : x;
  }
};

Flying any(Random& random, double near) {
  const double seconds = random.uniform() < 0.5 ? 0 : random.uniform(0.1, 1);
  const Vector3d p = near * random.direction(), v = random.uniform(0, 2) * random.direction();
  return {p, v, random.uniform(0, 2) * random.direction(), seconds, random.uniform(0.5, 3)};
}

Plan plan_of(const Flying& way) { return {way.p, way.v, way.a, way.seconds, way.most}; }

TEST(SwarmPlan, IsTheMotionInClosedForm) {
  for (std::uint64_t k = 0; k < 2000; ++k) {
    Random random(441, k);
    const Flying way = any(random, 3);
    const Plan plan = plan_of(way);
    const double speed = (way.v + way.seconds * way.a).norm();
    EXPECT_NEAR(plan.end(), way.seconds + speed / way.most, 1e-12);
    EXPECT_LT((plan.last() - way.at(1e3)).norm(), 1e-12);
    for (int draw = 0; draw < 20; ++draw) {
      const double t = random.uniform(0, 1.2 * plan.end());
      const auto after = std::find_if(plan.legs().begin(), plan.legs().end(),
                                      [&](const PlanLeg& leg) { return leg.begin > t; });
      EXPECT_LT(((after - 1)->at(t) - way.at(t)).norm(), 1e-12) << k;
      EXPECT_LE((way.at(t) - plan.middle()).norm(), plan.radius() + 1e-12) << k;
    }
  }
}

TEST(SwarmPlan, IsProvedApartOnlyWhereItIsAndNearlyAlwaysThere) {
  int apart_by_samples = 0, proved = 0, near = 0;
  for (std::uint64_t k = 0; k < 6000; ++k) {
    Random random(442, k);
    const double p = random.uniform(0.3, 0.8), q = random.uniform(0.3, 0.8);
    const Flying one = any(random, 1), other = any(random, 1);
    const Prepared a(Solid::ball(p)), b(Solid::ball(q));
    double least = 1e9;
    for (int i = 0; i <= 4000; ++i)
      least = std::min(least, (one.at(0.0015 * i) - other.at(0.0015 * i)).norm() - p - q);
    const bool said = apart(a, plan_of(one), b, plan_of(other));
    if (said) {
      ASSERT_GT(least, 0) << k;
      near += least < 0.02;
    }
    if (least > 0.01) {
      ++apart_by_samples;
      proved += said;
    }
  }
  EXPECT_GT(apart_by_samples, 1000);
  EXPECT_GT(proved, 0.99 * apart_by_samples);
  EXPECT_GT(near, 10);
}

}  // namespace
}  // namespace vericone::swarm
