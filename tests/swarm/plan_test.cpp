// SPDX-License-Identifier: BSD-3-Clause
//
// Of the private header: plans in closed form, and what is proved of two of them against samples.
#include "plan.h"

#include <gtest/gtest.h>
#include <vericone/internal/cones/random_engagement.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

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
    const Plan of_a = plan_of(one), of_b = plan_of(other);
    const bool said = apart({of_a, &a}, {of_b, &b});
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

/// An ellipsoid that flies, and turns from the start until its step ends.
struct Turning {
  Flying way;
  Solid solid;
  Vector3d turn;

  Solid at(double t) const {
    return turned(solid, std::min(1.0, way.seconds > 0 ? t / way.seconds : 0.0) * turn);
  }
};

Turning any_turning(Random& random) {
  Turning one{any(random, 1.5), {}, Vector3d::Zero()};
  one.solid.half = Vector3d(random.uniform(0.3, 1.2), random.uniform(0.1, 0.5), random.uniform(0.1, 0.5));
  one.solid.rotation = random.rotation();
  if (one.way.seconds > 0) one.turn = random.uniform(0, 1.5) * random.direction();
  return one;
}

/// Whether a point on the surface of `a`, of many, is in `b`.
bool meet(const Solid& a, const Vector3d& at_a, const Solid& b, const Vector3d& at_b,
          const std::vector<Vector3d>& points) {
  return std::any_of(points.begin(), points.end(), [&](const Vector3d& u) {
    const Vector3d x = at_a + a.rotation * a.half.cwiseProduct(u);
    return (b.rotation.transpose() * (x - at_b)).cwiseQuotient(b.half).norm() < 1;
  });
}

TEST(SwarmPlan, OfBodiesThatTurnIsProvedApartOnlyWhereItIs) {
  std::vector<Vector3d> points;
  for (std::uint64_t k = 0; k < 300; ++k) points.push_back(Random(443, k).direction());
  int said_apart = 0, turn_matters = 0;
  for (std::uint64_t k = 0; k < 3000; ++k) {
    Random random(444, k);
    const Turning one = any_turning(random), other = any_turning(random);
    const std::array<Prepared, 2> a{Prepared(one.solid), Prepared(turned(one.solid, one.turn))},
        b{Prepared(other.solid), Prepared(turned(other.solid, other.turn))};
    const Plan of_a = plan_of(one.way), of_b = plan_of(other.way);
    const bool said = apart({of_a, a.data(), one.turn.norm()}, {of_b, b.data(), other.turn.norm()});
    bool met = false, met_without_turn = false;
    for (int i = 0; i <= 24; ++i) {
      const double t = 0.1 * i;
      const Vector3d p = one.way.at(t), q = other.way.at(t);
      met = met || meet(one.at(t), p, other.at(t), q, points);
      met_without_turn = met_without_turn || meet(one.solid, p, other.solid, q, points);
    }
    ASSERT_FALSE(said && met) << k;
    said_apart += said;
    turn_matters += met && !met_without_turn;
  }
  EXPECT_GT(said_apart, 500);
  EXPECT_GT(turn_matters, 20);
}

}  // namespace
}  // namespace vericone::swarm
