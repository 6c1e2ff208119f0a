// SPDX-License-Identifier: BSD-3-Clause
//
// The fish under control: the source's and ours, alone and in moving water.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/run.h>
#include <vericone/vehicles/fish.h>
#include <algorithm>
#include <cmath>

#include "swimming.h"

namespace vericone::vehicles::fish_control_test {
namespace {

using Eigen::Vector3d;
using simulation::Current;
using simulation::Motion;
using simulation::VehicleCommand;

Motion still(const Vector3d& position = Vector3d::Zero()) {
  return {position, Vector3d::Zero(), Eigen::Matrix3d::Identity()};
}

void expect_within_chamber(const Flown& flown, const FishParameters& fish) {
  for (const auto& log : flown.log) {
    ASSERT_GE(log[kGas], 0);
    ASSERT_LE(log[kGas], fish.chamber * (1 + 1e-12));
    ASSERT_LE(log[kGasRate], fish.gas_rate);
    ASSERT_GE(log[kGasRate], -fish.valve_rate);
  }
}

double farthest(const Flown& flown, double depth) {
  double most = 0;
  for (const auto& log : flown.log) most = std::max(most, std::abs(log[kDepth] - depth));
  return most;
}

/// Gusts up and down of at most so many m/s.
Current heaving(double most) { return Current(Vector3d::Zero(), {}, {most, 8, 40, 5, false}); }

TEST(FishStation, DepthIsHeldToACentimetreForTenMinutes) {
  for (const double depth : {0.5, 3.0, 6.0}) {
    FishOptions options;
    options.depth = depth;
    EXPECT_LT(farthest(fly(options, 60, still()), depth), 1e-6);
    const Flown rough = fly(options, 600, still(), heaving(2e-3));
    EXPECT_LT(farthest(rough, depth), 0.01) << depth;
    EXPECT_GT(farthest(rough, depth), 1e-4);
    expect_within_chamber(rough, options.parameters);
    // Out of balance at the start.
    options.gas = 6.02e-6;
    const Flown light = fly(options, 200, still());
    EXPECT_LT(farthest(light, depth), 0.01) << depth;
    expect_within_chamber(light, options.parameters);
  }
}

TEST(FishStation, NotWithoutControlNorBeyondItsLimits) {
  FishOptions options = trial(0, 0);
  options.gas = 6.0001e-6;
  EXPECT_GT(farthest(fly(options, 600, still()), 3), 0.5);  // its buoyancy is unstable
  options = {};
  EXPECT_GT(farthest(fly(options, 600, still(), heaving(0.03)), 3), 0.01);  // more than the gas can follow
  options.parameters.gas_rate = 1e-10;
  EXPECT_GT(farthest(fly(options, 600, still(), heaving(2e-3)), 3), 0.01);  // a weak electrolyser
  options.parameters.gas_rate = 1e-7;
  options.parameters.chamber = 6.0005e-6;
  EXPECT_GT(farthest(fly(options, 600, still(), heaving(2e-3)), 3), 0.01);  // a small chamber
}

TEST(FishControls, OursIsThereInTimeAndAtTheDepth) {
  // Orifice 1 of the source's 2.4, at a time that the fish can keep.
  const Vector3d point(4, 0.2, -0.5), velocity(0.005, -0.05, 0.01);
  FishOptions options;
  const double azimuth = -38.35 * kDegree, elevation = 15.8 * kDegree;
  Motion start;
  start.velocity = 0.054 * Vector3d(std::cos(elevation) * std::cos(azimuth),
                                    std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  start.rotation = Eigen::AngleAxisd(azimuth, Vector3d::UnitZ()).toRotationMatrix();
  for (const Current& water :
       {Current(), Current({0.03, -0.02, 0}), Current({0.02, 0, 0.004}, {{0.02, 0}, 0})}) {
    const double seconds = 32;
    const Flown flown = fly(
        options, seconds,
        [&](double t, const Motion&) {
          VehicleCommand command;
          command.aim = VehicleCommand::Aim{point + t * velocity, velocity, seconds - t};
          return command;
        },
        start, water, 0.05);
    const Vector3d miss = flown.motions.back().position - (point + seconds * velocity);
    EXPECT_LT(miss.head<2>().norm(), 0.02);
    EXPECT_LT(std::abs(miss.z()), 0.005);
    expect_within_chamber(flown, options.parameters);
  }
}

TEST(FishControls, OursTurnsWithoutSwingingAtAnySpeed) {
  for (const double speed : {0.04, 0.09, 0.13, 0.2})
    for (const double turn : {-150.0, -20.0, 5.0, 90.0}) {
      const double course = turn * kDegree;
      const Vector3d wanted(speed * std::cos(course), speed * std::sin(course), 0);
      Motion start = still();
      start.velocity = {speed, 0, 0};
      const Flown flown = fly(
          {}, 60,
          [&](double t, const Motion&) {
            VehicleCommand command;
            if (t == 0) command.acceleration = (wanted - start.velocity) / 0.05;
            return command;
          },
          start, {}, 0.05);
      double heading = 0, latest = 0;
      for (std::size_t i = flown.index(40); i < flown.index(60); ++i) {
        heading += flown.log[i][kHeading] / double(flown.index(60) - flown.index(40));
        latest = std::max(latest, std::abs(flown.log[i][kBias]));
      }
      EXPECT_NEAR(heading / kDegree, turn, 1.5) << speed;
      EXPECT_LT(latest, 5 * kDegree) << speed << " " << turn;
      EXPECT_NEAR(flown.mean_speed(40, 60) / speed, 1, 0.15) << speed;
    }
}

TEST(FishControls, SourceInvertsTheIntegratedCycle) {
  FishOptions options;
  options.control = FishControl::source;
  const double ahead = 0.004;
  const Flown flown = fly(
      options, 12,
      [&](double, const Motion&) {
        return VehicleCommand{Vector3d(ahead, 0, 0), {}};
      },
      Motion{{0, 0, 0}, {0.05, 0, 0}, Eigen::Matrix3d::Identity()});
  const FishParameters fish;
  // Every second cycle: the mean of the force is m a_x; print's F_x = m (a_x - v r) counts v r twice.
  for (int cycle = 0; cycle < 12; cycle += 2) {
    const std::size_t from = flown.index(cycle), to = flown.index(cycle + 1);
    EXPECT_GT(flown.log[from + 100][kAmplitude], 0.05);
    EXPECT_EQ(flown.log[to + 100 < flown.log.size() ? to + 100 : to][kAmplitude] * (cycle < 11), 0);
    double coriolis = 0;
    for (std::size_t i = from; i < to; ++i)
      coriolis += flown.log[i][kV] * flown.log[i][kR] / double(to - from);
    const double force = (fish.mass + fish.added_x) * (flown.log[to][kU] - flown.log[from][kU]) -
                         (fish.mass + fish.added_y) * coriolis;
    const double heading = flown.log[from][kHeading];
    EXPECT_NEAR(force / (fish.mass * ahead * std::cos(heading)), 1, 0.02) << cycle;
  }
}

TEST(FishControls, SourceSteersByTheErrorInYAndLetsTheBiasGo) {
  FishOptions options;
  options.control = FishControl::source;
  options.gain_alpha = 0.5;
  const Flown flown = fly(
      options, 8.5,
      [&](double, const Motion&) {
        VehicleCommand command{Vector3d(0.002, 0, 0), {}};
        command.aim = VehicleCommand::Aim{{4, 0.3, 0}, Vector3d::Zero(), 30};
        return command;
      },
      Motion{{0, 0, 0}, {0.05, 0, 0}, Eigen::Matrix3d::Identity()});
  EXPECT_NEAR(flown.log[flown.index(0.5)][kBias], -0.3, 1e-9);   // K_y (0 - 0.3)
  EXPECT_NEAR(flown.log[flown.index(1.5)][kBias], -0.15, 1e-9);  // half is left
  EXPECT_GT(flown.mean_turn(0, 8), 0);                           // towards it
  EXPECT_GT(flown.motions.back().position.y(), 0);
}

TEST(FishControls, SourcesGasKeepsTheRatePrinted) {
  FishOptions options;
  options.control = FishControl::source;
  const Flown flown = fly(options, 20, [&](double t, const Motion&) {
    return VehicleCommand{Vector3d(0, 0, t < 10 ? 0.01 : -0.02), {}};
  });
  double most = 0;
  for (const auto& log : flown.log) {
    EXPECT_LE(std::abs(log[kGasRate]), 1e-7);
    most = std::max(most, log[kV3]);
  }
  EXPECT_GT(most, 5e-7);
  expect_within_chamber(flown, options.parameters);
}

TEST(FishLimits, AreKeptByOursAndSaidWhereBroken) {
  FishOptions options;
  options.most_speed = 0.145;
  options.most_climb = 0.02;
  options.most_turn_rate = 15 * kDegree;
  const auto far = [](double t, const Motion&) {
    VehicleCommand command;
    const Vector3d point = t < 40 ? Vector3d(20, 5, 2) : Vector3d(-20, 5, -2);
    command.aim = VehicleCommand::Aim{point, Vector3d::Zero(), std::max(1.0, 60 - t)};
    return command;
  };
  const Flown flown = fly(options, 120, far, still(), {}, 0.05);
  EXPECT_FALSE(flown.broken) << flown.broken->limit << " " << flown.broken->value;
  double most = 0;
  for (const auto& log : flown.log) most = std::max(most, Vector3d(log[kU], log[kV], log[kW]).norm());
  EXPECT_LE(most, 0.145);
  EXPECT_GT(most, 0.13);
  FishOptions fast = trial(30, 0);
  fast.most_speed = 0.145;
  const Flown beyond = fly(fast, 20);
  ASSERT_TRUE(beyond.broken);
  EXPECT_EQ(beyond.broken->limit, "speed");
  EXPECT_GT(beyond.broken->value, 0.145);
  EXPECT_LT(beyond.broken->value, 0.147);
}

TEST(FishInCurrents, AUniformCurrentIsAnotherFrame) {
  const Vector3d current(0.07, -0.11, 0);
  for (const auto& options : {trial(25, 20, 3e-8), trial(30, 0)}) {
    const Motion start{{0, 0, 0}, {0.1, 0.02, 0.01}, Eigen::Matrix3d::Identity()};
    Motion carried = start;
    carried.velocity += current;
    const Flown a = fly(options, 30, start), b = fly(options, 30, carried, Current(current));
    double most = 0;
    for (std::size_t k = 0; k < a.motions.size(); ++k)
      most = std::max(most,
                      (b.motions[k].position - a.motions[k].position - double(k) * a.step * current).norm());
    EXPECT_LT(most, 1e-9);
  }
}

TEST(FishInCurrents, CurvesFollowTheEquationsInGustsAndShear) {
  const Current water({0.02, 0.01, 0}, {{0.05, -0.03}, 0.2}, {0.02, 2, 9, 3, false});
  const Flown flown =
      fly(trial(25, 20, 3e-8), 20, {{0, 0, 0}, {0.1, 0, 0}, Eigen::Matrix3d::Identity()}, water);
  double jump = 0, bend = 0;
  for (std::size_t k = 0; k + 1 < flown.way.size(); ++k) {
    jump = std::max(jump, (flown.way[k].end().velocity - flown.way[k + 1].start().velocity).norm());
    bend = std::max(bend, (flown.way[k].acceleration(flown.way[k].to()) -
                           flown.way[k + 1].acceleration(flown.way[k].to()))
                              .norm());
  }
  EXPECT_LT(jump, 1e-12);
  EXPECT_LT(bend, 1e-6);
}

TEST(FishInCurrents, WithoutATailItComesToMoveWithTheWater) {
  const Current water({0.05, 0.02, 0}, {{0.03, 0}, 0});
  const Flown flown = fly(trial(0, 0), 800, still({0, 0, 0.5}), water);
  EXPECT_NEAR(flown.motions.back().velocity.x(), 0.05 + 0.015, 2e-3);
  EXPECT_NEAR(flown.motions.back().velocity.y(), 0.02, 2e-3);
}

TEST(FishInCurrents, WithoutDragItKeepsItsVelocityWhileItRisesThroughAShear) {
  FishOptions options = trial(0, 0, 1e-7);
  options.parameters.drag_x = options.parameters.drag_y = 1e-12;
  options.parameters.added_x = options.parameters.added_y = 0;
  const Current water(Vector3d::Zero(), {{0.05, 0}, 0});
  const Flown flown = fly(options, 20, still(), water);
  EXPECT_GT(water.velocity(flown.motions.back().position.z(), 20).x(), 0.03);
  EXPECT_NEAR(flown.motions.back().velocity.x(), 0, 1e-6);
}

TEST(FishRuns, AreProvedWithinASecondAMinute) {
  simulation::Scenario scenario;
  scenario.duration = 60;
  scenario.step = 0.05;
  FishOptions options;
  simulation::Body body;
  body.name = "fish";
  body.vehicle = fish(options);
  body.shape = simulation::RigidShape{
      CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), ellipsoid_of(options.parameters)))};
  body.start.velocity = {0.13, 0, 0};
  simulation::Body rock;
  rock.name = "rock";
  rock.shape =
      simulation::RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), {1, 0.3, 0.4}))};
  rock.start.position = {4, 0.45, 0};
  scenario.bodies = {body, rock};
  simulation::Run run = simulate(scenario);
  EXPECT_EQ(run.verdict(), simulation::ProofVerdict::avoided);
  EXPECT_GT(run.proofs[0].proof.least_distance, 0.005);
  EXPECT_EQ(run.vehicles.size(), 1200u);
  EXPECT_EQ(run.vehicles[0].values.size(), body.vehicle->channels().size());
  EXPECT_TRUE(run.limits_broken.empty());
  // A limit that is declared and not kept.
  options.control = FishControl::none;
  options.trial.amplitude = 30 * kDegree;
  options.most_speed = 0.15;
  scenario.bodies[0].vehicle = fish(options);
  simulation::RunOptions unproved;
  unproved.prove = false;
  run = simulate(scenario, unproved);
  ASSERT_EQ(run.limits_broken.size(), 1u);
  EXPECT_EQ(run.limits_broken[0].body, 0u);
  EXPECT_EQ(run.limits_broken[0].broken.limit, "speed");
  scenario.bodies[0].vehicle = body.vehicle;
  // Exact predicates at many times.
  scenario.bodies[1].start.position = {4, 0.3, 0};
  run = simulate(scenario);
  ASSERT_EQ(run.verdict(), simulation::ProofVerdict::touched);
  const auto overlap = [&](double t) {
    return pair_of(run.tracks[0].state(t).shape, run.tracks[1].state(t).shape).relation() !=
           Relation::disjoint;
  };
  EXPECT_TRUE(overlap(run.proofs[0].proof.to));
  for (int i = 0; i < 2000; ++i) EXPECT_FALSE(overlap(run.proofs[0].proof.from * i / 2000));
}

}  // namespace
}  // namespace vericone::vehicles::fish_control_test
