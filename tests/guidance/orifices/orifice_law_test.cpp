// SPDX-License-Identifier: BSD-3-Clause
//
// (2.2)-(2.4): y and its rate along Cartesian motion, the law against the printed form and its correction,
// and where it stands still. The passage law against finite differences of the clearance.
#include <gtest/gtest.h>
#include <vericone/cones/opening/opening.h>
#include <vericone/guidance/orifice_law.h>
#include <vericone/internal/guidance/directions.h>
#include <vericone/internal/guidance/orifice_function.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/allocations.h"

namespace vericone::guidance::orifice_law_test {
namespace {

using Eigen::Vector3d;
using testing::RandomBodies;

constexpr int kStates = 1000;

Vector3d vector(RandomBodies& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Closing, and not within 2 degrees of the centre nor of flying past it.
Cartesian<3> closing(RandomBodies& random) {
  for (;;) {
    const Cartesian<3> motion{vector(random, 4), vector(random, 1), vector(random, 4), vector(random, 0.5)};
    const Vector3d c = motion.p_b - motion.p_a, w = motion.v_a - motion.v_b;
    const double cosine = c.dot(w) / (c.norm() * w.norm());
    if (cosine > 0.04 && cosine < 0.999) return motion;
  }
}

/// (2.2), from the states as the source writes it.
double equation_2_2(const Cartesian<3>& motion, double room) {
  const SpatialState s = spatial_state(motion);
  const double across = s.v_theta * s.v_theta + s.v_phi * s.v_phi;
  return s.r * s.r * across / (across + s.v_r * s.v_r) - room * room;
}

enum class Form { printed, corrected };

/// (2.4), term by term.
double equation_2_4(const SpatialState& s, double gain, double w, double y, const Direction& along,
                    Form form) {
  const double cg = std::cos(along.elevation), sg = std::sin(along.elevation);
  const double cd = std::cos(along.azimuth - s.theta), sd = std::sin(along.azimuth - s.theta);
  const double cp = std::cos(s.phi), sp = std::sin(s.phi);
  const double across = s.v_theta * s.v_theta + s.v_phi * s.v_phi, all = across + s.v_r * s.v_r;
  const double third = form == Form::printed ? cg * cp * sd + sg * sp : cg * cp * cd + sg * sp;
  const double bracket = -s.v_r * s.v_r * s.v_theta * cg * sd +
                         s.v_r * s.v_r * s.v_phi * (cg * sp * cd - sg * cp) + s.v_r * across * third;
  return gain * (w - y) * all * all / (2 * s.r * s.r * bracket);
}

/// y' by central differences with A accelerated.
double rate_of_y(const Cartesian<3>& motion, const Vector3d& a, double room) {
  const double h = 1e-5;
  const auto at = [&](double t) {
    return equation_2_2({motion.p_a + t * motion.v_a + 0.5 * t * t * a, motion.v_a + t * a,
                         motion.p_b + t * motion.v_b, motion.v_b},
                        room);
  };
  return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
}

TEST(OrificeLaw, TheFunctionIsThatOfTheSource) {
  RandomBodies random(2201);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < kStates; ++i) {
    const Cartesian<3> motion{vector(random, 4), vector(random, 1), vector(random, 4), vector(random, 1)};
    const double r_b = random.uniform(0.5, 2), r_a = random.uniform(0.1, 0.5);
    const OrificeFunction f = orifice_function(motion, r_b, r_a);
    EXPECT_NEAR(f.y, equation_2_2(motion, r_b - r_a), 1e-10);
    EXPECT_NEAR(f.v_r, spatial_state(motion).v_r, 1e-12);
    const Vector3d a = vector(random, 1);
    EXPECT_NEAR(rate_of_y(motion, a, r_b - r_a), f.by_acceleration.dot(a),
                1e-6 * (1 + f.by_acceleration.norm() * a.norm()));
    EXPECT_NEAR(rate_of_y(motion, Vector3d::Zero(), 1), 0, 1e-6);  // constant without acceleration
  }
}

/// The corrected law gives y' = -K (y - w); the printed one does not.
TEST(OrificeLaw, DoesWhatItPromisesAndThePrintDoesNot) {
  RandomBodies random(2401);
  SCOPED_TRACE(random.trace());
  double worst = 0, best = 0, least_printed = 1e300;
  std::vector<double> printed;
  for (int i = 0; i < kStates; ++i) {
    const Cartesian<3> motion = closing(random);
    const double room = random.uniform(0.3, 1.5), gain = random.uniform(0.05, 2),
                 w = -random.uniform(0.05, 0.9) * room * room;
    const SpatialState s = spatial_state(motion);
    const double y = equation_2_2(motion, room), wanted = -gain * (y - w);
    const auto error = [&](const Vector3d& a) {
      return std::abs(rate_of_y(motion, a, room) - wanted) / std::abs(wanted);
    };
    const Direction along{random.uniform(-std::numbers::pi, std::numbers::pi), random.uniform(-1.5, 1.5)};
    const double size = equation_2_4(s, gain, w, y, along, Form::corrected);
    if (!(std::abs(size) < 20)) continue;  // along inputs that hardly change y differences see nothing
    worst = std::max(worst, error(size * unit_vector(along)));
    printed.push_back(error(equation_2_4(s, gain, w, y, along, Form::printed) * unit_vector(along)));

    OrificeLawOptions options;
    options.gain = gain;
    options.reference = w;
    options.direction = along;
    const OrificeCommand command = orifice_law(motion, 5 + room, 5, options);
    if (command.status == OrificeStatus::coasting) continue;
    EXPECT_LT((command.acceleration - size * unit_vector(along)).norm(), 1e-9 * std::abs(size));
    options.direction.reset();
    const OrificeCommand least = orifice_law(motion, 5 + room, 5, options);
    best = std::max(best, error(least.acceleration));
    EXPECT_LE(least.demanded, command.demanded * (1 + 1e-12));
    // Errata 1.4: a = K (w - y) V^3 / (2 r^2 |V_r| sqrt(V_theta^2 + V_phi^2)).
    const double across = std::hypot(s.v_theta, s.v_phi);
    const double all = across * across + s.v_r * s.v_r;
    EXPECT_NEAR(least.demanded,
                std::abs(wanted) * std::pow(all, 1.5) / (2 * s.r * s.r * std::abs(s.v_r) * across),
                1e-9 * least.demanded);
  }
  std::sort(printed.begin(), printed.end());
  for (const double e : printed) least_printed = std::min(least_printed, e);
  std::printf(
      "(2.4) corrected: worst relative error of y' %.1e, along the best direction %.1e; printed: median %.2g "
      "over %zu\n",
      worst, best, printed[printed.size() / 2], printed.size());
  EXPECT_GT(printed.size(), 500u);
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(best, 1e-6);
  EXPECT_GT(printed[printed.size() / 2], 0.1);
}

TEST(OrificeLaw, TurnsTowardsAnOpeningThatRecedesAndCoastsWithinIt) {
  OrificeLawOptions options;
  options.reference = -0.3;
  options.most = 0.5;
  // Flying away: across the velocity, to the side of the opening.
  const OrificeCommand away =
      orifice_law({Vector3d::Zero(), {1, 0, 0}, {-3, 1, 0}, Vector3d::Zero()}, 1, 0.2, options);
  EXPECT_EQ(away.status, OrificeStatus::turning);
  EXPECT_NEAR(away.acceleration.x(), 0, 1e-15);
  EXPECT_NEAR(away.acceleration.y(), 0.5, 1e-15);
  EXPECT_GT(away.demanded, 0.5);
  // Straight away from it there is no side: still a turn, and a level one.
  const OrificeCommand straight =
      orifice_law({Vector3d::Zero(), {1, 0, 0}, {-3, 0, 0}, Vector3d::Zero()}, 1, 0.2, options);
  EXPECT_EQ(straight.status, OrificeStatus::turning);
  EXPECT_NEAR(straight.acceleration.norm(), 0.5, 1e-15);
  EXPECT_EQ(straight.acceleration.z(), 0);
  // Within the opening's ball and on course.
  const OrificeCommand within =
      orifice_law({{-0.3, 0.4, 0}, {1, 0, 0}, Vector3d::Zero(), Vector3d::Zero()}, 1, 0.2, options);
  EXPECT_EQ(within.status, OrificeStatus::coasting);
  EXPECT_TRUE(within.acceleration.isZero(0));
  // Aimed at the centre y has no gradient.
  EXPECT_EQ(orifice_law({{-3, 0, 0}, {1, 0, 0}, Vector3d::Zero(), Vector3d::Zero()}, 1, 0.2, options).status,
            OrificeStatus::no_effect);
  // At rest to each other.
  EXPECT_EQ(
      orifice_law({{-3, 0, 0}, Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()}, 1, 0.2, options).status,
      OrificeStatus::no_relative_velocity);
}

/// Errata 4.2: the engagement of 2.4 at t = 0.
TEST(OrificeLaw, TheEngagementOfSection24) {
  const double degree = std::numbers::pi / 180;
  const Cartesian<3> motion{Vector3d::Zero(),
                            0.054 * unit_vector({-38.35 * degree, 15.8 * degree}),
                            {4, 0.2, -0.5},
                            0.051 * unit_vector({-84.29 * degree, 11.25 * degree})};
  EXPECT_NEAR(orifice_function(motion, 1.725, 0.16).y, 0.92, 0.005);
  EXPECT_NEAR(orifice_function(motion, 0, 0).y, 3.369, 0.001);
  EXPECT_NEAR(orifice_function(motion, 0, 0).v_r, -0.0357, 5e-5);
}

BodyState ellipsoid_state(RandomBodies& random, const Vector3d& position, const Vector3d& velocity) {
  BodyState state;
  const Vector3d axes(random.uniform(0.1, 0.4), random.uniform(0.05, 0.2), random.uniform(0.05, 0.2));
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1.5)
          .normalized();
  state.shape = CombinedEllipsoid(Ellipsoid::from_axes(position, axes, turn.toRotationMatrix()));
  state.position = position;
  state.velocity = velocity;
  return state;
}

/// m' = -K (m - margin - beyond) along the motion, the opening as it will be turned on arrival.
TEST(PassageLaw, DrivesTheClearanceAsItPromises) {
  RandomBodies random(2501);
  SCOPED_TRACE(random.trace());
  std::vector<double> errors;
  int steered = 0;
  for (int i = 0; i < kStates; ++i) {
    OrificeState orifice;
    orifice.opening.opening = i % 3 == 0   ? Opening::circle(1)
                              : i % 3 == 1 ? Opening::ellipse({1.2, 0.8})
                                           : Opening::polygon({{1, -0.8}, {1.1, 0.9}, {-1, 0.8}, {-0.9, -1}});
    orifice.opening.center = vector(random, 0.5);
    orifice.velocity = vector(random, 0.1);
    const BodyState agent = ellipsoid_state(
        random, {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), -random.uniform(1.5, 3)},
        {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(0.5, 1)});
    PassageLawOptions options;
    options.margin = 0.1;
    options.beyond = 0.05;
    options.gain = 0.8;
    options.longitudinal = i % 2 == 0;
    const OrificeCommand command = passage_law(agent, orifice, options);
    if (command.status != OrificeStatus::steering || command.m > options.margin) continue;
    ++steered;
    const auto m_at = [&](double t) {
      BodyState moved = agent;
      const Vector3d to = agent.position + t * agent.velocity + 0.5 * t * t * command.acceleration;
      moved.shape = agent.shape.moved(agent.position, to, Vector3d::Zero(), {}, 0);
      moved.position = to;
      moved.velocity += t * command.acceleration;
      PlacedOpening there = orifice.opening;
      there.center += t * orifice.velocity;
      return opening_clearance(moved.shape, there, moved.velocity - orifice.velocity).distance;
    };
    const double h = 1e-4, rate = (m_at(h) - m_at(-h)) / (2 * h);
    const double wanted = -options.gain * (command.m - options.margin - options.beyond);
    errors.push_back(std::abs(rate - wanted) / (std::abs(wanted) + 0.01));
  }
  std::sort(errors.begin(), errors.end());
  // Corners of the nearest feature are kinks: a few per cent of random states lie within a step of one.
  EXPECT_GT(steered, 300);
  EXPECT_LT(errors[errors.size() * 97 / 100], 1e-3);
}

TEST(PassageLaw, LeavesAlonePassagesWithRoomAndTurnsBack) {
  OrificeState orifice;
  BodyState agent;
  agent.shape = CombinedEllipsoid(
      Ellipsoid::from_axes({0, 0, -2}, Vector3d::Constant(0.2), Eigen::Matrix3d::Identity()));
  agent.position = {0, 0, -2};
  agent.velocity = {0, 0, 0.5};
  PassageLawOptions options;
  EXPECT_EQ(passage_law(agent, orifice, options).status, OrificeStatus::clear);
  EXPECT_NEAR(passage_law(agent, orifice, options).m, 0.8, 1e-9);
  agent.velocity = {0.1, 0, -0.5};
  const OrificeCommand back = passage_law(agent, orifice, options);
  EXPECT_EQ(back.status, OrificeStatus::turning);
  EXPECT_NEAR(back.acceleration.dot(agent.velocity), 0, 1e-12);
  // A spinning opening as it will be on arrival: a quarter turn closes a slit, and another one opens it.
  orifice.opening.opening = Opening::ellipse({1, 0.25});
  agent.velocity = {0, 0, 0.5};
  agent.shape =
      CombinedEllipsoid(Ellipsoid::from_axes(agent.position, {0.6, 0.1, 0.1}, Eigen::Matrix3d::Identity()));
  EXPECT_GT(passage_law(agent, orifice, options).m, 0);
  orifice.spin = {0, 0, std::numbers::pi / 8};  // 4 s away
  EXPECT_LT(passage_law(agent, orifice, options).m, 0);
  orifice.spin = {0, 0, std::numbers::pi / 4};
  EXPECT_GT(passage_law(agent, orifice, options).m, 0);
}

TEST(PassageLaw, EllipsoidsAndRoundOpeningsAllocateNothing) {
  RandomBodies random(2601);
  SCOPED_TRACE(random.trace());
  std::vector<BodyState> agents;
  for (int i = 0; i < 50; ++i)
    agents.push_back(ellipsoid_state(random, vector(random, 2), vector(random, 1)));
  OrificeState orifice;
  orifice.spin = {0, 0.1, 0.2};
  int turning = 0, steering = 0;
  const auto before = vericone::testing::allocations();
  for (const BodyState& agent : agents) {
    const OrificeCommand command = passage_law(agent, orifice, {});
    turning += command.status == OrificeStatus::turning;
    steering += command.status == OrificeStatus::steering;
    static_cast<void>(
        orifice_law({agent.position, agent.velocity, orifice.opening.center, orifice.velocity}, 1, 0.4, {}));
    static_cast<void>(orifice_aim(agent, orifice, 1.0, 0.1));
  }
  EXPECT_EQ(vericone::testing::allocations(), before);
  EXPECT_GT(turning, 5);
  EXPECT_GT(steering, 5);
}

}  // namespace
}  // namespace vericone::guidance::orifice_law_test
