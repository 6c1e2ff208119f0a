// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies of flat, round and straight parts, alone and as unions, as agents and in the way, in every question
// that guidance asks: what only the round part meets is met. (Once a union of cylinders was taken for the
// hull of its pieces' middles, and colliding velocities were called free.)
#include <vericone/guidance/avoid.h>
#include <vericone/guidance/bands.h>
#include <vericone/guidance/barrier.h>
#include <vericone/guidance/navigator.h>
#include <vericone/guidance/velocity_map.h>

#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "guidance/decisions/balls.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector3d;

constexpr double kEast = std::numbers::pi / 2;

/// In each of these the flight along x, from the origin, hits a part that is round, 30 m ahead: some metres
/// from the axis or the middles, which it passes.
struct RoundCase {
  std::string name;
  Placed agent{Body()}, obstacle{Body()};
};

std::vector<RoundCase> round_cases() {
  const auto at = [](const Vector3d& x) { return Pose{x}; };
  const Convex can = Convex::cylinder(5, 4), pill = Convex::capsule(4, 6), plate = Convex::disc(6);
  const Convex hat = Convex::cone(6, 4), small = Convex::cylinder(0.1, 0.2);
  const auto tip = Convex::rounded(Ellipsoid::from_axes(Vector3d::Zero(), {1, 1, 1}), 4);
  std::vector<RoundCase> all;
  for (const auto& [name, body] :
       {std::pair("cylinder", can), {"capsule", pill}, {"cone", hat}, {"ball with a margin", tip}}) {
    const double up = body == hat ? 1 : -0.5;
    all.push_back({name, ball({0, 0, 0}, 0.5), {body, at({30, 3, up})}});
    all.push_back({std::string(name) + ", the agent", {body, at({0, 3, up})}, ball({30, 0, 0}, 0.5)});
    // Far apart from each other in a union, of which one is met.
    const auto both = Assembly::convexes({body, body.translated({0, 25, 0})});
    all.push_back({std::string("union of one ") + name, ball({0, 0, 0}, 0.5), {both, at({30, 3, up})}});
    all.push_back(
        {std::string("union, the agent, of one ") + name, {both, at({0, 3, up})}, ball({30, 0, 0}, 0.5)});
    all.push_back({std::string("cylinder and ") + name, {small, Pose{}}, {body, at({30, 3, up})}});
  }
  all.push_back({"disc that is flown past its middle",
                 ball({0, 0, 0}, 0.5),
                 {plate, {{30, 4, 0}, Eigen::AngleAxisd(0.3, Vector3d::UnitY()).toRotationMatrix()}}});
  return all;
}

bool is_among(const std::vector<Range>& ranges, double value) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [&](const Range& r) { return r.from <= value && value <= r.to; });
}

class RoundParts : public ::testing::TestWithParam<std::size_t> {
 protected:
  const RoundCase c = round_cases()[GetParam()];
  const std::vector<Intruder> others{{c.obstacle, Vector3d::Zero()}};
  const Vector3d v{5, 0, 0};
};

TEST_P(RoundParts, AreMetByBandsAvoidanceMapsAndBarriers) {
  SCOPED_TRACE(c.name);
  ASSERT_EQ(Pair(c.agent, c.obstacle).verdict(v, Vector3d::Zero(), {0, 10}), Verdict::in);
  for (const double margin : {0.0, 0.5}) {
    BandOptions options{.horizon = {0, 10}, .margin = margin};
    options.altitude = {-20, 20};
    const Bands found = bands(c.agent, v, others, options);
    for (const auto& [band, value] : {std::pair(&found.heading, kEast),
                                      {&found.speed, 5.0},
                                      {&found.climb, 0.0},
                                      {&found.altitude, 0.0}}) {
      EXPECT_FALSE(is_among(band->free, value));
      EXPECT_TRUE(is_among(band->conflict, value));
      EXPECT_FALSE(band->free.empty());
    }
    EXPECT_TRUE(found.time_to_violation);
    options.lateral = 1;  // with a turn
    EXPECT_FALSE(is_among(bands(c.agent, v, others, options).heading.free, kEast));
    const Avoidance away = avoid(c.agent, v, v, others, {.until = 10, .margin = margin});
    ASSERT_EQ(away.status, AvoidStatus::free);
    EXPECT_GT(away.distance, 0.1);
    EXPECT_LE(away.distance, 1.02 * away.lower);
    EXPECT_EQ(Pair(c.agent, c.obstacle).verdict(away.velocity, Vector3d::Zero(), {0, 10}), Verdict::out);
    VelocityMapOptions map;
    map.low = {4.9, -0.05, -0.05};
    map.high = {5.1, 0.05, 0.05};
    map.resolution = 0.05;
    map.until = 10;
    map.margin = margin;
    EXPECT_EQ(velocity_map(c.agent, others, map).colliding, 1);
  }
  const Pair pair(c.agent, c.obstacle);
  EXPECT_LT(barrier(pair, v, Vector3d::Zero(), 10).h, 0);
  EXPECT_GT(barrier(pair, {0, -5, 0}, Vector3d::Zero(), 10).least, 0);
}

TEST_P(RoundParts, AreMindedByNavigators) {
  SCOPED_TRACE(c.name);
  const auto state_of = [](const Placed& body, const Vector3d& velocity) {
    BodyState state;
    state.shape = WorldBody(body);
    state.position = body.pose.position;
    state.velocity = velocity;
    return state;
  };
  const std::vector<BodyState> minded{state_of(c.obstacle, Vector3d::Zero())};
  Navigator navigator({.required = 0.2, .most = 3});
  const NavigatorStep step = navigator.step(state_of(c.agent, v), minded,
                                            Destination{.point = Vector3d(80, 0, 0), .most = 3}, 0, 0.1);
  EXPECT_NE(step.status, NavigatorStatus::homing);
  EXPECT_NE(step.status, NavigatorStatus::straight);
}

INSTANTIATE_TEST_SUITE_P(All, RoundParts, ::testing::Range<std::size_t>(0, round_cases().size()));

}  // namespace
}  // namespace vericone::guidance
