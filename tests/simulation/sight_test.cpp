// SPDX-License-Identifier: BSD-3-Clause
//
// When a sensor measures, and what it sees.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/run.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace vericone::simulation::sight_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

Body body_of(const std::string& name, const ShapeInTime& shape, const Vector3d& position,
             const Vector3d& velocity) {
  Body body;
  body.name = name;
  body.shape = shape;
  body.start.position = position;
  body.start.velocity = velocity;
  body.orientation = Orientation::fixed;
  return body;
}

ShapeInTime ball(double radius) {
  return RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), Vector3d::Constant(radius)))};
}

ShapeInTime disc(double radius) {
  return RigidShape{CombinedEllipse(Ellipse::from_axes(Vector2d::Zero(), Vector2d::Constant(radius)))};
}

/// Errors: none.
Sensor exact() {
  Sensor sensor;
  sensor.noise = Noise::isotropic;
  return sensor;
}

/// A, with a sensor, by the source's law: it commands nothing as long as nothing is on a collision course.
Scenario of(std::vector<Body> bodies, const Sensor& sensor, double duration) {
  Scenario scenario;
  scenario.duration = duration;
  scenario.step = 0.02;
  scenario.bodies = std::move(bodies);
  Pilot& pilot = scenario.bodies[0].pilot.emplace();
  pilot.manner = Manner::source;
  pilot.sensor = sensor;
  return scenario;
}

/// B, which turns, passes A far aside.
Scenario turning(const Sensor& sensor, double duration = 4) {
  Scenario scenario =
      of({body_of("A", ball(0.5), {0, 0, 0}, {1, 0, 0}), body_of("B", ball(1), {30, 200, 3}, {-5, 0, 0})},
         sensor, duration);
  scenario.bodies[1].pilot.emplace().own = pilot_by([](double, const guidance::BodyState& own, const auto&) {
    return Vector3d(0.2 * Vector3d::UnitZ().cross(own.velocity));
  });
  return scenario;
}

Run flown(const Scenario& scenario, std::uint64_t trial = 0) {
  RunOptions options;
  options.prove = false;
  options.trial = trial;
  return simulate(scenario, options);
}

double first_command_from(double t, double step) { return std::ceil(t / step) * step; }

TEST(Sight, BetweenMeasurementsABodyGoesOnAsMeasured) {
  Sensor sensor = exact();
  sensor.period = 0.1;
  sensor.delay = 0.25;
  const Scenario scenario = turning(sensor);
  const auto run = flown(scenario);
  const Track& truth = run.tracks[1];
  double late = 0, first = 1e9;
  for (const SightSample& sample : run.sights) {
    first = std::min(first, sample.t);
    // The last that was measured 0.25 s ago, every fifth command.
    const auto number = std::uint64_t(std::floor((sample.t - 0.25 + 1e-9) / 0.1));
    const double at = time_of_step(scenario, 5 * number);
    const Motion then = truth.motion(at);
    EXPECT_EQ(sample.measurement.position, then.position) << sample.t;
    EXPECT_EQ(sample.believed_velocity, then.velocity) << sample.t;
    EXPECT_EQ(sample.believed_position, then.position + (sample.t - at) * then.velocity) << sample.t;
    late = std::max(late, (sample.believed_position - truth.motion(sample.t).position).norm());
  }
  // Nothing is known before the first has arrived.
  EXPECT_NEAR(first, 0.26, 1e-9);
  // a dt^2 / 2, of 1 m/s^2 and up to 0.34 s.
  EXPECT_NEAR(late, 0.5 * 0.34 * 0.34, 2e-3);
}

TEST(Sight, ADelayIsMadeUpForOfABodyThatKeepsItsVelocity) {
  for (const Estimator estimator : {Estimator::none, Estimator::state}) {
    Sensor sensor = exact();
    sensor.period = 0.1;
    sensor.delay = 0.25;
    Scenario scenario = turning(sensor);
    scenario.bodies[1].pilot.reset();
    scenario.bodies[0].pilot->estimator = estimator;
    const auto run = flown(scenario);
    ASSERT_FALSE(run.sights.empty());
    for (const SightSample& sample : run.sights)
      EXPECT_LT((sample.believed_position - run.tracks[1].motion(sample.t).position).norm(), 1e-9);
  }
}

TEST(Sight, AShareOfMeasurementsDropsOut) {
  Sensor sensor = exact();
  sensor.position = 0.1;
  const Scenario all = turning(sensor, 60);
  sensor.dropout = 0.3;
  const Scenario some = turning(sensor, 60);
  const auto complete = flown(all), run = flown(some);
  ASSERT_EQ(complete.sights.size(), 3000u);
  std::size_t fresh = 0;
  Vector3d before = Vector3d::Constant(1e9);
  for (const SightSample& sample : run.sights) {
    if (sample.measurement.position == before) continue;
    before = sample.measurement.position;
    ++fresh;
    // What arrives is what would have been measured without: its noise does not depend on it.
    const auto k = std::size_t(std::lround(sample.t / some.step));
    EXPECT_EQ(before, complete.sights[k].measurement.position) << sample.t;
  }
  EXPECT_NEAR(double(fresh) / 3000, 0.7, 4 * std::sqrt(0.3 * 0.7 / 3000));
  EXPECT_TRUE(std::none_of(run.events.begin(), run.events.end(), [](const Event& e) {
    return e.kind == EventKind::sees || e.kind == EventKind::loses;
  }));
}

TEST(Sight, ABiasIsOneForAPairAndATrial) {
  Sensor sensor = exact();
  sensor.bias = 0.7;
  const auto off = [](const simulation::Run& run, const SightSample& sample) {
    return Vector3d(sample.measurement.position - run.tracks[1].motion(sample.t).position);
  };
  const auto run = flown(turning(sensor)), other = flown(turning(sensor), 1);
  const Vector3d bias = off(run, run.sights.front());
  EXPECT_NEAR(bias.norm(), 0.7, 1e-12);
  for (const SightSample& sample : run.sights) EXPECT_LT((off(run, sample) - bias).norm(), 1e-12);
  EXPECT_GT((off(other, other.sights.front()) - bias).norm(), 1e-3);
  EXPECT_EQ(sensor.times(2).bias, 1.4);
}

TEST(Sight, OfABallWithinRange) {
  // |(30 - 6 t, 10)| - 1 = 12.
  Sensor sensor = exact();
  sensor.range = 12;
  const Scenario scenario =
      of({body_of("A", ball(0.5), {0, 0, 0}, {1, 0, 0}), body_of("B", ball(1), {30, 10, 0}, {-5, 0, 0})},
         sensor, 9);
  const auto run = flown(scenario);
  const auto sees = find_event(scenario, run, EventKind::sees, "A", "B"),
             loses = find_event(scenario, run, EventKind::loses, "A", "B");
  ASSERT_TRUE(sees && loses);
  EXPECT_NEAR(sees->t, first_command_from((30 - std::sqrt(69)) / 6, 0.02), 1e-9);
  EXPECT_NEAR(loses->t, first_command_from((30 + std::sqrt(69)) / 6, 0.02), 1e-9);
  // Known since it was seen, and from when it is lost as it was measured last.
  ASSERT_FALSE(run.sights.empty());
  EXPECT_EQ(run.sights.front().t, sees->t);
  EXPECT_NEAR(run.sights.back().t, 9 - 0.02, 1e-9);
  for (const SightSample& sample : run.sights)
    EXPECT_LT(
        (sample.measurement.position - run.tracks[1].motion(std::min(sample.t, loses->t - 0.02)).position)
            .norm(),
        1e-9);
}

/// The nearest of a box, and not its ball, is within range.
TEST(Sight, OfABoxByItsNearest) {
  Sensor sensor = exact();
  sensor.range = std::hypot(4, 2.98);  // of the corner from 12.51 s on
  const auto seen = [&](const ShapeInTime& box) {
    const Scenario scenario =
        of({body_of("A", ball(0.5), {0, 0, 0}, {1, 0, 0}), body_of("box", box, {5, 30, 0}, {1, -2, 0})},
           sensor, 13);
    return find_event(scenario, flown(scenario), EventKind::sees, "A", "box").value().t;
  };
  const Vector3d half(1, 2, 1);
  EXPECT_NEAR(seen(RigidShape{HullBody::box(-half, half)}), 12.52, 1e-9);
  EXPECT_NEAR(seen(RigidShape{Placed(vericone::Body(Assembly::boxes({{-half, half}})))}), 12.52, 1e-9);
}

TEST(Sight, WithinView) {
  Sensor sensor = exact();
  sensor.view = std::numbers::pi / 3;
  const Scenario scenario =
      of({body_of("A", ball(0.5), {0, 0, 0}, {1, 0, 0}), body_of("B", ball(1), {30, 10, 0}, {-5, 0, 0})},
         sensor, 9);
  const auto run = flown(scenario);
  const auto sees = find_event(scenario, run, EventKind::sees, "A", "B"),
             loses = find_event(scenario, run, EventKind::loses, "A", "B");
  ASSERT_TRUE(sees && loses);
  EXPECT_EQ(sees->t, 0);
  // The ball touches the edge of the view, the line (cos 60, sin 60) s, from beyond: 10 cos 60 - x sin 60
  // = 1.
  const double x = (10 * 0.5 - 1) / std::sin(sensor.view);
  EXPECT_NEAR(loses->t, first_command_from((30 - x) / 6, 0.02), 1e-9);
}

/// A stands; B comes out from behind the wall. `shown`: until when what is looked for of it is hidden, s.
void expect_shown(const Body& wall, const Body& b, double shown, const ShapeInTime& agent) {
  Sensor sensor = exact();
  sensor.occluded = true;
  Scenario scenario = of({body_of("A", agent, {0, 0, 0}, {0, 0, 0}), wall, b}, sensor, 10);
  scenario.bodies[0].pilot->manner = Manner::guarded;
  const auto run = flown(scenario);
  const auto sees = find_event(scenario, run, EventKind::sees, "A", "B");
  ASSERT_TRUE(sees);
  EXPECT_NEAR(sees->t, first_command_from(shown, 0.02), 1e-9);
  EXPECT_TRUE(find_event(scenario, run, EventKind::sees, "A", "wall"));
  EXPECT_EQ(find_event(scenario, run, EventKind::sees, "A", "wall")->t, 0);
  // And without the wall at once.
  scenario.bodies.erase(scenario.bodies.begin() + 1);
  const auto alone = flown(scenario);
  EXPECT_EQ(find_event(scenario, alone, EventKind::sees, "A", "B").value().t, 0);
}

/// When a point 0.99 r beside the centre of a ball at (20, 2 t) is seen at an angle.
double when_at(double angle, double r) {
  double low = 0, high = 10;
  for (int i = 0; i < 60; ++i) {
    const double t = (low + high) / 2, away = std::hypot(20, 2 * t);
    (std::atan2(2 * t, 20) + std::atan2(0.99 * r, away) < angle ? low : high) = t;
  }
  return high;
}

TEST(Sight, NotBehindOthers) {
  const Vector3d low(5, -3, -3), high(5.5, 3, 3);
  const double corner = std::atan2(3, 5);  // the edge of the wall's near face
  const Body b = body_of("B", ball(0.5), {20, 0, 0}, {0, 2, 0});
  expect_shown(body_of("wall", RigidShape{HullBody::box(low, high)}, {0, 0, 0}, {0, 0, 0}), b,
               when_at(corner, 0.5), ball(0.2));
  expect_shown(body_of("wall", RigidShape{Placed(vericone::Body(Assembly::boxes({{low, high}})))}, {0, 0, 0},
                       {0, 0, 0}),
               b, when_at(corner, 0.5), ball(0.2));
  // Behind a ball, and a disc: the line of sight that touches it.
  expect_shown(body_of("wall", ball(3), {8, 0, 0}, {0, 0, 0}), b, when_at(std::asin(3 / 8.0), 0.5),
               ball(0.2));
  expect_shown(body_of("wall", disc(3), {8, 0, 0}, {0, 0, 0}), body_of("B", disc(0.5), {20, 0, 0}, {0, 2, 0}),
               when_at(std::asin(3 / 8.0), 0.5), disc(0.2));
}

TEST(Sight, MapsAreNeitherHiddenNorOutOfView) {
  Sensor sensor = exact();
  sensor.occluded = true;
  sensor.view = 0.5;
  sensor.range = 30;
  const auto box = [](const Vector3d& center) {
    return RigidShape{Placed(
        vericone::Body(Assembly::boxes({{center - Vector3d::Constant(1), center + Vector3d::Constant(1)}})))};
  };
  const Scenario scenario = of({body_of("A", ball(0.5), {0, 0, 0}, {1, 0, 0}),
                                body_of("behind", box({-10, 0, 0}), {0, 0, 0}, {0, 0, 0}),
                                body_of("screen", box({0, 10, 0}), {0, 0, 0}, {0, 0, 0}),
                                body_of("screened", box({0, 20, 0}), {0, 0, 0}, {0, 0, 0}),
                                body_of("moves", box({-10, 20, 0}), {0, 0, 0}, {0, 1, 0}),
                                body_of("far", box({0, 40, 0}), {0, 0, 0}, {0, 0, 0})},
                               sensor, 1);
  const auto run = flown(scenario);
  for (const char* name : {"behind", "screen", "screened"})
    EXPECT_TRUE(find_event(scenario, run, EventKind::sees, "A", name)) << name;
  for (const char* name : {"moves", "far"})
    EXPECT_FALSE(find_event(scenario, run, EventKind::sees, "A", name)) << name;
}

/// What was never seen is not avoided.
TEST(Sight, AGuardedPilotMindsWhatItHasSeen) {
  Sensor sensor = exact();
  sensor.range = 8;
  Scenario scenario =
      of({body_of("A", ball(0.5), {0, 0, 0}, {5, 0, 0}), body_of("B", ball(1), {20, 0.1, 0}, {0, 0, 0})},
         sensor, 8);
  Pilot& pilot = *scenario.bodies[0].pilot;
  pilot.manner = Manner::guarded;
  pilot.guide.law = guidance::Law::clearance;
  pilot.guide.clearance.most = 8;
  const auto run = simulate(scenario);
  EXPECT_EQ(run.verdict(), ProofVerdict::avoided);
  const auto sees = find_event(scenario, run, EventKind::sees, "A", "B");
  ASSERT_TRUE(sees);
  const Track& way = run.tracks[0];
  EXPECT_EQ(way.motion(sees->t).velocity, Vector3d(5, 0, 0));
  EXPECT_GT((way.motion(sees->t + 0.1).velocity - Vector3d(5, 0, 0)).norm(), 0.1);
}

/// Before anything has arrived it sets off towards what it will have to avoid.
TEST(Sight, WhoStartsAtRestKnowsNothingAtFirst) {
  Sensor sensor = exact();
  sensor.delay = 0.06;
  Scenario scenario =
      of({body_of("A", ball(0.5), {0, 0, 0}, {0, 0, 0}), body_of("B", ball(1), {10, 0.1, 0}, {0, 0, 0})},
         sensor, 20);
  Pilot& pilot = *scenario.bodies[0].pilot;
  pilot.manner = Manner::guarded;
  pilot.guide.law = guidance::Law::clearance;
  pilot.guide.clearance.most = 4;
  pilot.guide.clearance.longitudinal = true;
  pilot.goals = {Goal{{20, 0, 0}, 3, "", 1, Vector3d::Zero(), ""}};
  const auto run = simulate(scenario);
  EXPECT_EQ(run.verdict(), ProofVerdict::avoided);
  EXPECT_NEAR(run.sights.front().t, 0.06, 1e-9);
}

TEST(Sight, WhatCannotBeIsRefusedByName) {
  const auto refused = [](const std::function<void(Pilot&)>& spoil) -> std::string {
    Scenario scenario = turning(exact(), 0.1);
    spoil(*scenario.bodies[0].pilot);
    try {
      static_cast<void>(flown(scenario));
      return "nothing";
    } catch (const InputError& e) {
      return e.field();
    }
  };
  const auto of_sensor = [&](void (*spoil)(Sensor&)) {
    return refused([&](Pilot& pilot) { spoil(*pilot.sensor); });
  };
  const std::string path = "bodies[0].pilot.", sensor = path + "sensor.";
  EXPECT_EQ(of_sensor([](Sensor& s) { s.period = -1; }), sensor + "period");
  EXPECT_EQ(of_sensor([](Sensor& s) { s.delay = std::nan(""); }), sensor + "delay");
  EXPECT_EQ(of_sensor([](Sensor& s) { s.dropout = 1; }), sensor + "dropout");
  EXPECT_EQ(of_sensor([](Sensor& s) { s.bias = -0.1; }), sensor + "bias");
  EXPECT_EQ(of_sensor([](Sensor& s) { s.range = 0; }), sensor + "range");
  EXPECT_EQ(of_sensor([](Sensor& s) { s.view = 4; }), sensor + "view");
  EXPECT_EQ(of_sensor([](Sensor& s) { s.view = std::numbers::pi; }), "nothing");
  EXPECT_EQ(of_sensor([](Sensor& s) {
              s.noise = Noise::engagement;
              s.occluded = true;
            }),
            sensor + "occluded");
  EXPECT_EQ(refused([](Pilot& pilot) { pilot.fastest = 3; }), path + "fastest");
  EXPECT_EQ(refused([](Pilot& pilot) { pilot.looks = 100; }), path + "looks");
  const auto guarded = [](double fastest, bool longitudinal) {
    return [=](Pilot& pilot) {
      pilot.manner = Manner::guarded;
      pilot.fastest = fastest;
      pilot.guide.clearance.longitudinal = longitudinal;
    };
  };
  EXPECT_EQ(refused(guarded(3, false)), path + "fastest");
  EXPECT_EQ(refused(guarded(-3, true)), path + "fastest");
  EXPECT_EQ(refused(guarded(3, true)), "nothing");
}

}  // namespace
}  // namespace vericone::simulation::sight_test
