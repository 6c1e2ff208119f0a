// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/uncertain/robust.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/run_tables.h>
#include <vericone/simulation/run_tables.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace vericone::simulation::sensor_test {
namespace {

using Eigen::Vector3d;

Body ball(const std::string& name, double radius, const Vector3d& position, const Vector3d& velocity) {
  Body body;
  body.name = name;
  body.shape =
      RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), Vector3d::Constant(radius)))};
  body.start = {position, velocity, Eigen::Matrix3d::Identity()};
  body.orientation = Orientation::fixed;
  return body;
}

/// Two balls on a collision course 20 m apart.
Scenario meeting(const std::optional<Sensor>& sensor, Estimator estimator = Estimator::none) {
  Scenario scenario;
  scenario.duration = 4;
  scenario.step = 0.02;
  scenario.bodies = {ball("A", 1, {0, 0, 0}, {5, 0, 0}), ball("B", 1, {20, 0.3, 0.1}, {-5, 0, 0})};
  Pilot& pilot = scenario.bodies[0].pilot.emplace();
  pilot.manner = Manner::source;
  pilot.guide.inversion = {2, 0.05, 15, 0, 1, 1e-9};
  pilot.sensor = sensor;
  pilot.estimator = estimator;
  return scenario;
}

Sensor sensor_of(Noise noise, double position, double velocity) {
  Sensor sensor;
  sensor.noise = noise;
  sensor.position = position;
  sensor.velocity = velocity;
  return sensor;
}

TEST(Sensors, DrawsAreNormalAndDependOnAllThatTheyAreFor) {
  double sum = 0, squares = 0, fourth = 0;
  const int n = 200'000;
  for (int i = 0; i < n; ++i) {
    const double x = Draw{7, std::uint64_t(i), 0, 0}.normal(3);
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
  }
  EXPECT_NEAR(sum / n, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 4 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth / n, 3, 4 * std::sqrt(96.0 / n));
  std::set<double> values;
  for (std::uint64_t i = 0; i < 4; ++i)
    for (std::uint64_t j = 0; j < 4; ++j)
      for (std::uint64_t k = 0; k < 4; ++k)
        for (std::uint64_t l = 0; l < 4; ++l)
          for (std::uint64_t m = 0; m < 4; ++m) values.insert(Draw{i, j, k, l}.uniform(m));
  EXPECT_EQ(values.size(), 1024u);
  // Neighbours do not go together.
  double product = 0;
  for (int i = 0; i < n; ++i)
    product += Draw{7, 0, 0, std::uint64_t(i)}.normal(3) * Draw{7, 0, 0, std::uint64_t(i) + 1}.normal(3);
  EXPECT_NEAR(product / n, 0, 4 / std::sqrt(n));
}

guidance::BodyState at_rest(const Vector3d& position, const Vector3d& velocity) {
  guidance::BodyState state;
  state.shape = CombinedEllipsoid(Ellipsoid::from_axes(position, Vector3d::Ones()));
  state.position = position;
  state.velocity = velocity;
  return state;
}

/// Root mean squares of the errors along each axis, in parts of what the sensor says of them.
struct Spread {
  Vector3d position = Vector3d::Zero(), velocity = Vector3d::Zero();
  double together = 0;  // correlation of the first two components of the position
};
Spread spread_of(const Sensor& sensor, const guidance::BodyState& a, const guidance::BodyState& b) {
  Spread spread;
  const int n = 20'000;
  for (int i = 0; i < n; ++i) {
    const Measurement m = measure(sensor, a, b, Draw{1, 0, 0, std::uint64_t(i)});
    const Vector3d dp = m.position - b.position, dv = m.velocity - b.velocity;
    spread.position += dp.cwiseAbs2() / n;
    spread.velocity += dv.cwiseAbs2() / n;
    spread.together += dp.x() * dp.y() / n;
  }
  spread.together /= std::sqrt(spread.position.x() * spread.position.y());
  spread.position = spread.position.cwiseSqrt();
  spread.velocity = spread.velocity.cwiseSqrt();
  return spread;
}

TEST(Sensors, NoiseOfTheSourceDependsOnTheAxes) {
  // (7.27): 7.5 % of 30 m and of 40 m times a normal number of deviation 1/3; nothing where the difference is
  // 0.
  Sensor sensor = sensor_of(Noise::per_axis, 0.075, 0.15);
  sensor.deviation = 1.0 / 3;
  const auto a = at_rest({0, 0, 0}, {0, 0, 0}), b = at_rest({30, 40, 0}, {-6, 0, 9});
  const Spread along = spread_of(sensor, a, b);
  EXPECT_NEAR(along.position.x(), 0.75, 0.02);
  EXPECT_NEAR(along.position.y(), 1.0, 0.03);
  EXPECT_EQ(along.position.z(), 0);
  EXPECT_NEAR(along.velocity.x(), 0.3, 0.01);
  EXPECT_EQ(along.velocity.y(), 0);
  EXPECT_NEAR(along.velocity.z(), 0.45, 0.015);
  EXPECT_NEAR(along.together, 0, 0.03);
  // The same engagement seen in other axes has other noise: 50 m along x, and none across.
  const Spread turned = spread_of(sensor, a, at_rest({50, 0, 0}, {0, 0, 0}));
  EXPECT_NEAR(turned.position.x(), 1.25, 0.04);
  EXPECT_EQ(turned.position.y(), 0);
  // One m(t) for all: components go together.
  sensor.shared = true;
  EXPECT_NEAR(spread_of(sensor, a, b).together, 1, 1e-12);
}

TEST(Sensors, BoundedNoiseStaysWithinItsBallsAndFillsThem) {
  const Sensor sensor = sensor_of(Noise::bounded, 2, 0.5);
  const auto a = at_rest({0, 0, 0}, {0, 0, 0}), b = at_rest({30, 40, 5}, {-6, 0, 9});
  double farthest = 0, fastest = 0, half = 0;
  const int n = 20'000;
  for (int i = 0; i < n; ++i) {
    const Measurement m = measure(sensor, a, b, Draw{2, 0, 0, std::uint64_t(i)});
    farthest = std::max(farthest, (m.position - b.position).norm());
    fastest = std::max(fastest, (m.velocity - b.velocity).norm());
    half += (m.position - b.position).norm() < 1 ? 1.0 / n : 0;
  }
  EXPECT_LE(farthest, 2 * (1 + 1e-14));
  EXPECT_GT(farthest, 1.98);
  EXPECT_LE(fastest, 0.5 * (1 + 1e-14));
  EXPECT_NEAR(half, 0.125, 0.01);  // a ball of half the radius
}

TEST(Sensors, APerfectSensorChangesNothing) {
  const simulation::Run truth = simulate(meeting(std::nullopt)),
                        seen = simulate(meeting(sensor_of(Noise::isotropic, 0, 0)));
  ASSERT_EQ(truth.tracks[0].legs().size(), seen.tracks[0].legs().size());
  for (double t = 0; t <= 4; t += 0.1)
    EXPECT_EQ(truth.tracks[0].motion(t).position, seen.tracks[0].motion(t).position) << t;
  for (const SightSample& sample : seen.sights) {
    EXPECT_EQ(sample.measurement.position, seen.tracks[1].motion(sample.t).position);
    if (!sample.on_plane) continue;
    EXPECT_NEAR(sample.terms.a, 1, 1e-9);
    EXPECT_EQ(sample.reading.y, sample.y);
  }
}

TEST(Sensors, ALawSeesMeasurementsOnlyAndProofsTheTruth) {
  Scenario blind = meeting(sensor_of(Noise::isotropic, 0, 0));
  blind.bodies[1].start.position = {20, 0, 0};
  ASSERT_EQ(simulate(blind).verdict(), ProofVerdict::avoided);
  // Errors of a million times y and z: the obstacle is measured kilometres aside, the law has nothing to say,
  // and the proof says that they meet.
  Scenario far = blind;
  far.bodies[1].start.position = {20, 0.01, 0.01};
  Sensor& sensor = *far.bodies[0].pilot->sensor;
  sensor = sensor_of(Noise::per_axis, 1e6, 0);
  sensor.shared = true;
  const simulation::Run run = simulate(far);
  EXPECT_EQ(run.verdict(), ProofVerdict::touched);
  for (const SightSample& sample : run.sights)
    EXPECT_EQ(sample.measurement.velocity, run.tracks[1].motion(sample.t).velocity);
}

TEST(Sensors, NoiseIsTheSameForEveryLawAndOtherInEveryTrial) {
  Scenario first = meeting(sensor_of(Noise::isotropic, 0.5, 0.2)), second = first;
  second.bodies[0].pilot->guide.law = guidance::Law::clearance;
  second.bodies[0].pilot->guide.clearance.most = 5;
  RunOptions options;
  options.trial = 4;
  const simulation::Run a = simulate(first, options), b = simulate(second, options);
  ASSERT_FALSE(a.sights.empty());
  // The bodies fly elsewhere, the errors are the same numbers.
  for (std::size_t k = 0; k < std::min(a.sights.size(), b.sights.size()); ++k) {
    const double t = a.sights[k].t;
    const Vector3d error = a.sights[k].measurement.position - a.tracks[1].motion(t).position;
    EXPECT_LT((error - (b.sights[k].measurement.position - b.tracks[1].motion(t).position)).norm(), 1e-12);
  }
  options.trial = 5;
  const simulation::Run c = simulate(first, options);
  EXPECT_GT((c.sights[0].measurement.position - a.sights[0].measurement.position).norm(), 1e-3);
  EXPECT_EQ(simulate(first, options).sights.back().measurement.position,
            c.sights.back().measurement.position);
}

TEST(Sensors, SetMembershipHoldsTheTruthInEveryRun) {
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    RunOptions options;
    options.trial = trial;
    const simulation::Run run =
        simulate(meeting(sensor_of(Noise::bounded, 0.5, 0.2), Estimator::set_membership), options);
    for (const SightSample& sample : run.sights) {
      const Vector3d off = sample.believed_position - run.tracks[1].motion(sample.t).position;
      EXPECT_LE(off.cwiseAbs().maxCoeff(), 0.5 + 1e-12);
    }
    // Later it knows better than one measurement.
    const SightSample& last = run.sights.back();
    EXPECT_LT((last.believed_position - run.tracks[1].motion(last.t).position).norm(), 0.25);
  }
}

TEST(Sensors, WhatIsCalledRobustlyOutIsNeverTouched) {
  // Bounded noise: the agent measures, is told that no error collides, and flies straight on. The exact
  // predicate of the true bodies never says that they collide.
  const Sensor sensor = sensor_of(Noise::bounded, 0.5, 0.3);
  const RelativeErrors errors{ErrorSet::ball(0.5), ErrorSet::ball(0.3)};
  int out = 0, collide = 0;
  for (std::uint64_t run = 0; run < 100'000; ++run) {
    const Draw draw{3, run, 0, 0};
    const auto between = [&](std::uint64_t channel, double low, double high) {
      return low + (high - low) * draw.uniform(100 + channel);
    };
    const Vector3d place(between(0, 8, 30), between(1, -5, 5), between(2, -5, 5)),
        velocity(between(3, -12, -2), between(4, -3, 3), between(5, -3, 3));
    const Ellipsoid agent =
        Ellipsoid::from_axes(Vector3d::Zero(), {between(6, 0.5, 3), between(7, 0.5, 2), between(8, 0.5, 2)});
    const Vector3d half(between(9, 0.5, 3), between(10, 0.5, 2), between(11, 0.5, 2));
    guidance::BodyState a, b;
    a.shape = CombinedEllipsoid(agent);
    b.shape = CombinedEllipsoid(Ellipsoid::from_axes(place, half));
    b.position = place;
    b.velocity = velocity;
    const Measurement seen = measure(sensor, a, b, draw);
    const bool truly =
        ConeOracle(agent, Ellipsoid::from_axes(place, half)).verdict(Vector3d::Zero(), velocity) ==
        Verdict::in;
    collide += truly;
    const RobustAnswer said = robust_verdict(agent, Ellipsoid::from_axes(seen.position, half),
                                             Vector3d::Zero(), seen.velocity, errors);
    if (said.verdict != RobustVerdict::out) continue;
    ++out;
    ASSERT_FALSE(truly) << run;
  }
  EXPECT_GT(out, 20'000);
  EXPECT_GT(collide, 5'000);
}

/// A table says of each column what it is: m of the bodies as they are, beside it what the law took it for.
TEST(Sensors, EncountersTellTheTruthAndWhatWasMeasured) {
  Scenario scenario = meeting(sensor_of(Noise::isotropic, 0.4, 0.3));
  scenario.bodies[0].pilot->guide.law = guidance::Law::clearance;
  scenario.bodies[0].pilot->guide.clearance.required = 0.5;
  scenario.bodies[0].pilot->guide.clearance.most = 15;
  const simulation::Run run = simulate(scenario);
  const Table table = encounters_table(scenario, run);
  const auto column = [](const Table& of, const std::string& name) {
    return std::find_if(of.columns.begin(), of.columns.end(),
                        [&](const Column& c) { return c.name == name; });
  };
  ASSERT_EQ(table.rows(), run.encounters.size());
  const auto truth = column(table, "m"), measured = column(table, "measured_m");
  ASSERT_TRUE(truth != table.columns.end() && measured != table.columns.end());
  double apart = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const EncounterSample& s = run.encounters[i];
    // Of two balls: how far the line of the relative velocity passes, less both radii.
    const Motion a = run.tracks[0].motion(s.t), b = run.tracks[1].motion(s.t);
    const Vector3d c = b.position - a.position, w = (a.velocity - b.velocity).normalized();
    const double miss = (c - c.dot(w) * w).norm();
    EXPECT_NEAR(truth->numbers[i], miss - 2, 1e-6) << s.t;
    EXPECT_EQ(measured->numbers[i], s.step.m);
    apart = std::max(apart, std::abs(truth->numbers[i] - measured->numbers[i]));
  }
  EXPECT_GT(apart, 0.1);
  // Entering says how near they would come, not how near is allowed.
  const auto enters = std::find_if(run.events.begin(), run.events.end(),
                                   [](const Event& e) { return e.kind == EventKind::enters_cone; });
  ASSERT_NE(enters, run.events.end());
  EXPECT_NEAR(enters->value, truth->numbers[0], 1e-12);
  EXPECT_LT(enters->value, 0);
  // Without a sensor both are one, and there is one column.
  scenario.bodies[0].pilot->sensor.reset();
  const Table plain = encounters_table(scenario, simulate(scenario));
  EXPECT_EQ(column(plain, "measured_m"), plain.columns.end());
}

void expect_refused(const Scenario& scenario, const std::string& field) {
  try {
    simulate(scenario);
    ADD_FAILURE() << "accepted: " << field;
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), field);
  }
}

TEST(Sensors, WhatCannotBeIsRefusedByName) {
  Scenario bad = meeting(sensor_of(Noise::isotropic, -1, 0));
  expect_refused(bad, "bodies[0].pilot.sensor.position");
  bad = meeting(sensor_of(Noise::isotropic, 1, std::nan("")));
  expect_refused(bad, "bodies[0].pilot.sensor.velocity");
  expect_refused(meeting(std::nullopt, Estimator::state), "bodies[0].pilot.estimator");
  bad = meeting(sensor_of(Noise::engagement, 0, 0), Estimator::state);
  expect_refused(bad, "bodies[0].pilot.estimator");
  bad = meeting(sensor_of(Noise::isotropic, 1, 1));
  bad.bodies[0].pilot->guide.law = guidance::Law::clearance;
  bad.bodies[0].pilot->guide.filter.y = true;
  expect_refused(bad, "bodies[0].pilot.filter");
  bad = meeting(sensor_of(Noise::isotropic, 1, 1));
  bad.bodies[0].pilot->guide.robust.emplace();
  bad.bodies[0].pilot->guide.robust->model.dt = 1;
  expect_refused(bad, "bodies[0].pilot.robust.dt");
  bad.bodies[0].pilot->guide.robust->model.dt = 0.02;
  bad.bodies[0].pilot->guide.robust->model.b_low = 2;
  expect_refused(bad, "bodies[0].pilot.robust.b_min");
}

}  // namespace
}  // namespace vericone::simulation::sensor_test
