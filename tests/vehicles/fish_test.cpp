// SPDX-License-Identifier: BSD-3-Clause
//
// The fish's equations: the figures that the source prints, in open loop, against equations written anew, and
// where the work of the tail goes.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/vehicles/fish_water.h>
#include <vericone/simulation/track.h>
#include <vericone/vehicles/fish.h>
#include <algorithm>
#include <cmath>
#include <random>

#include "swimming.h"
#include "vector_fish.h"

namespace vericone::vehicles::fish_test {
namespace {

using Eigen::Vector3d;
using simulation::Motion;

TEST(Fish, SpeedsAreThoseOfTheTable) {
  for (const auto& [amplitude, speed] : {std::pair{20.0, 0.130}, {30.0, 0.197}, {35.0, 0.231}}) {
    const double mean = fly(trial(amplitude, 0), 60).mean_speed(50, 60);
    EXPECT_NEAR(mean / speed, 1, 0.01) << amplitude;
    RecordProperty("u at " + std::to_string(int(amplitude)), std::to_string(mean));
  }
}

TEST(Fish, TurnsAreThoseOfTheTable) {
  for (const auto& [amplitude, bias] : {std::pair{20.0, 50.8}, {25.0, 40.7}, {30.0, 33.8}}) {
    const double rate = fly(trial(amplitude, bias), 60).mean_turn(40, 60) / kDegree;
    EXPECT_NEAR(rate / -30.6, 1, 0.01) << amplitude;
    RecordProperty("turn at " + std::to_string(int(amplitude)), std::to_string(rate));
  }
  // The other way round it turns the other way.
  EXPECT_NEAR(fly(trial(20, -50.8), 30).mean_turn(20, 30) / kDegree / 30.6, 1, 0.01);
}

/// When it is first `way` metres above or below its start.
double time_of(const FishOptions& options, double way) {
  const Flown flown = fly(options, 60);
  const auto leg = std::find_if(flown.way.begin(), flown.way.end(), [&](const simulation::Curve& curve) {
    return std::abs(curve.end().position.z()) >= way;
  });
  if (leg == flown.way.end()) return -1;
  double low = leg->from(), high = leg->to();
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (std::abs(leg->at(middle).position.z()) < way ? low : high) = middle;
  }
  return low;
}

TEST(Fish, DivesAsPrintedAndRisesWithAnotherDragOnly) {
  FishOptions dive = trial(0, 0, -3e-5);
  dive.depth = 1e-9;
  EXPECT_NEAR(time_of(dive, 0.6), 5.00, 0.01);
  const auto rise = [](double drag, double rate) {
    FishOptions options = trial(0, 0, rate);
    options.parameters.gas_rate = rate;
    options.parameters.drag_z = drag;
    options.depth = 0.6 + 1e-9;
    return time_of(options, 0.6);
  };
  // With the drag of that dive; and with 3.70 kg/m, of which a dive takes longer.
  EXPECT_NEAR(rise(1.655, 1e-7), 15.86, 0.01);
  EXPECT_NEAR(rise(1.655, 5.9e-7), 9.32, 0.01);
  EXPECT_NEAR(rise(3.70, 1e-7), 17.69, 0.01);
  EXPECT_NEAR(rise(3.70, 5.9e-7), 10.73, 0.01);
  dive.parameters.drag_z = 3.70;
  EXPECT_GT(time_of(dive, 0.6), 5.9);
  // Neutral with a full chamber it could never rise.
  FishOptions full = trial(0, 0, 1e-7);
  full.parameters.neutral_gas = 9e-6;
  EXPECT_THROW(static_cast<void>(fish(full)), InputError);
}

TEST(Fish, AgreesWithEquationsWrittenAnew) {
  double most_place = 0, most_velocity = 0, most_between = 0;
  for (const auto& [amplitude, bias, gas_rate, u] : {std::array{20.0, 0.0, 0.0, 0.0},
                                                     {20.0, 50.8, 5e-8, 0.0},
                                                     {33.0, -20.0, -4e-8, 0.2},
                                                     {30.0, 33.8, 0.0, 0.1},
                                                     {10.0, 5.0, 1e-7, 0.05}}) {
    const Motion start{{0, 0, 0}, {u, 0, 0}, Eigen::Matrix3d::Identity()};
    const Flown flown = fly(trial(amplitude, bias, gas_rate), 20, start);
    VectorFish other(FishParameters{}, amplitude * kDegree, bias * kDegree, gas_rate, 3, u);
    std::size_t leg = 0;
    for (std::size_t k = 1; k <= 2 * (flown.log.size() - 1); ++k) {
      other.advance(flown.step / 2, 8);
      const double t = double(k) * flown.step / 2;
      while (leg + 1 < flown.way.size() && flown.way[leg].to() < t) ++leg;
      const Motion now = flown.way[leg].at(t);
      const double apart = (now.position - other.position()).norm();
      (k % 2 == 0 ? most_place : most_between) = std::max(k % 2 == 0 ? most_place : most_between, apart);
      most_velocity = std::max(most_velocity, (now.velocity - other.velocity()).norm());
      if (k % 2 != 0) continue;
      const auto& log = flown.log[k / 2];
      most_place = std::max(most_place, std::abs(log[kHeading] - other.heading()));
      most_velocity = std::max(most_velocity, std::abs(log[kR] - other.turn()));
    }
  }
  EXPECT_LT(most_place, 1e-6);
  EXPECT_LT(most_between, 1e-6);
  EXPECT_LT(most_velocity, 1e-6);
  RecordProperty("metres and radians", std::to_string(most_place * 1e9) + "e-9");
  RecordProperty("between steps", std::to_string(most_between * 1e9) + "e-9");
  RecordProperty("rates", std::to_string(most_velocity * 1e9) + "e-9");
}

TEST(Fish, WorkOfTheTailIsDragAndKineticEnergy) {
  for (const auto& [amplitude, bias, u] :
       {std::array{20.0, 0.0, 0.0}, {35.0, 10.0, 0.0}, {20.0, 50.8, 0.3}, {5.0, 0.0, 0.4}}) {
    const Motion start{{0, 0, 0}, {u, 0, 0}, Eigen::Matrix3d::Identity()};
    const FishParameters fish;
    const Flown flown = fly(trial(amplitude, bias), 20, start);
    const double omega = 2 * std::numbers::pi * fish.frequency, a = amplitude * kDegree;
    double body = 0, drag = 0, servo = 0, water = 0, last_turn = 0;
    std::array<double, 2> energy{};
    for (std::size_t k = 0; k < flown.log.size(); ++k) {
      const auto& log = flown.log[k];
      FishState state{{0, 0, 0}, log[kHeading], log[kU], log[kV], log[kR], log[kW], 0};
      const double phase = omega * double(k) * flown.step;
      const TailAngle tail{log[kAngle], a * omega * std::cos(phase), -a * omega * omega * std::sin(phase)};
      const FishForces f = fish_forces(fish, state, tail, 3);
      // Simpson's rule.
      const double weight = flown.step / 3 * (k == 0 || k + 1 == flown.log.size() ? 1 : k % 2 ? 4 : 2);
      body += weight * (f.tail_x * state.u + f.tail_y * state.v + f.tail_n * state.r);
      drag += weight * (f.drag_x * state.u + f.drag_y * state.v + f.drag_n * state.r);
      // The servo turns the plate about its hinge against the force at half its chord; the plate moves that
      // point through the water.
      servo += weight * f.tail_normal * 0.5 * fish.tail_chord * -tail.rate;
      const double c = std::cos(tail.angle), s = std::sin(tail.angle);
      const double plate =
          -s * state.u + c * (state.v - state.r * fish.hinge) - 0.5 * fish.tail_chord * (state.r + tail.rate);
      water += weight * f.tail_normal * -plate;
      if (k == 0) energy[0] = swimming_energy(fish, state);
      energy[1] = swimming_energy(fish, state);
      last_turn = state.r;
    }
    EXPECT_TRUE(std::isfinite(last_turn));
    EXPECT_NEAR((drag + energy[1] - energy[0]) / body, 1, 1e-4) << amplitude;
    // Where it comes from: what the servo does goes to the body and to the water.
    EXPECT_NEAR((-servo - body) / water, 1, 1e-9) << amplitude;
    // The water would give back energy at large amplitudes: the model's force is not that of a passive plate.
    EXPECT_EQ(water > 0, amplitude < 35) << amplitude;
  }
}

TEST(Fish, GasStaysWithinItsChamber) {
  FishOptions options = trial(0, 0, 1e-7);
  options.depth = 2;
  const Flown rising = fly(options, 60);
  const FishParameters fish;
  bool full = false;
  for (const auto& log : rising.log) {
    EXPECT_LE(log[kGas], fish.chamber * (1 + 1e-12));
    EXPECT_LE(log[kV3] + fish.neutral_gas / compression(fish, 2), most_gas(fish, log[kDepth]) * (1 + 1e-9));
    full |= log[kGas] > 0.999 * fish.chamber;
  }
  EXPECT_TRUE(full);
  options.trial.gas_rate = -3e-5;
  const Flown sinking = fly(options, 5);
  for (const auto& log : sinking.log) EXPECT_GE(log[kGas], 0);
  EXPECT_EQ(sinking.log.back()[kGas], 0);
  EXPECT_GT(rising.broken.has_value(), 0);  // through the surface
  EXPECT_EQ(rising.broken->limit, "top");
}

TEST(Fish, ItsBodyContainsTrunkAndTail) {
  for (int variant = 0; variant < 3; ++variant) {
    FishParameters fish;
    if (variant == 1) fish.tail_span = 0.12, fish.most_bias = 30 * kDegree;
    if (variant == 2) fish.length = 0.5, fish.hinge = 0.2, fish.tail_chord = 0.05;
    const Vector3d axes = ellipsoid_of(fish);
    const double radius = sphere_of(fish);
    ASSERT_TRUE(axes.allFinite() && axes.minCoeff() > 0);
    double most = 0, farthest = 0;
    const double angle = most_tail_angle(fish);
    for (int i = -500; i <= 500; ++i)
      for (const double s : {0.0, 0.3, 0.7, 1.0})
        for (const double z : {-0.5, 0.0, 0.5}) {
          const double at = angle * i / 500, d = s * fish.tail_chord;
          const Vector3d x(-fish.hinge - d * std::cos(at), -d * std::sin(at), z * fish.tail_span);
          most = std::max(most, x.cwiseQuotient(axes).norm());
          farthest = std::max(farthest, x.norm());
        }
    EXPECT_LE(most, 1);
    EXPECT_GT(most, 0.9);
    const Trunk trunk = trunk_of(fish);
    const Ellipsoid body = Ellipsoid::from_axes({trunk.ahead, 0, 0}, trunk.semi_axes);
    EXPECT_EQ(position(body, Ellipsoid::from_axes(Vector3d::Zero(), axes)), Position::a_inside_b);
    EXPECT_EQ(position(body, Ellipsoid::from_axes(Vector3d::Zero(), Vector3d::Constant(radius))),
              Position::a_inside_b);
    EXPECT_LE(farthest, radius);
    EXPECT_LE(std::max(farthest, trunk.ahead + trunk.semi_axes.x()), radius);
  }
  EXPECT_NEAR(sphere_of({}), 0.1825, 1e-4);
}

TEST(Fish, NoMotionIsFasterThanItsLimit) {
  FishOptions options;
  const auto model = fish(options);
  const double limit = model->limits({}).speed;
  EXPECT_NEAR(limit, 6.89, 0.02);
  // Above the energy of that speed the tail, however it moves, does not keep up with drag.
  const FishParameters& p = options.parameters;
  const double swimming = std::sqrt(limit * limit - std::pow(model->limits({}).climb, 2));
  const double energy = 0.5 * (p.mass + std::min(p.added_x, p.added_y)) * swimming * swimming;
  const double slope = 15.0 / 8 / p.blend, omega = 2 * std::numbers::pi * p.frequency, a = p.most_amplitude;
  const double changes = 2 * p.most_bias + a, curvature = 10 / std::sqrt(3.0) / (p.blend * p.blend);
  std::mt19937 engine(51);
  std::uniform_real_distribution<double> part(-1, 1);
  double nearest = -1e9;
  for (int i = 0; i < 200000; ++i) {
    const Vector3d direction = Vector3d(part(engine), part(engine), part(engine)).normalized();
    const double e = energy * (1 + std::abs(part(engine)));
    FishState state;
    state.u = direction.x() * std::sqrt(2 * e / (p.mass + p.added_x));
    state.v = direction.y() * std::sqrt(2 * e / (p.mass + p.added_y));
    state.r = direction.z() * std::sqrt(2 * e / (p.inertia + p.added_inertia));
    const TailAngle tail{part(engine) * most_tail_angle(p), part(engine) * (slope * changes + a * omega),
                         part(engine) * (curvature * changes + 2 * slope * a * omega + a * omega * omega)};
    const FishState rate = fish_rates(p, state, tail, 0, 3, {}, 0);
    const double power = (p.mass + p.added_x) * state.u * rate.u + (p.mass + p.added_y) * state.v * rate.v +
                         (p.inertia + p.added_inertia) * state.r * rate.r;
    EXPECT_LT(power, 0);
    nearest = std::max(nearest, power);
  }
  EXPECT_GT(nearest, -1e3);
  // Up and down: nowhere faster than the terminal speed, nor with more jerk than the limit; the valve comes
  // near.
  const simulation::VehicleLimits limits = model->limits({});
  for (const double rate : {-3e-5, 1e-7}) {
    const Flown vertical = fly(trial(0, 0, rate), 40);
    double jerk = 0;
    for (std::size_t k = 0; k + 1 < vertical.way.size(); ++k) {
      const simulation::Curve& curve = vertical.way[k];
      EXPECT_LE(std::abs(curve.end().velocity.z()), limits.climb);
      jerk =
          std::max(jerk, std::abs(curve.acceleration(curve.to()).z() - curve.acceleration(curve.from()).z()) /
                             (curve.to() - curve.from()));
    }
    EXPECT_LE(jerk, limits.climb_jerk);
    if (rate < 0) {
      EXPECT_GT(jerk, 0.5 * limits.climb_jerk);
    }
  }
  // Nor does one that is driven as hard as can be.
  options.control = FishControl::source;
  options.gain_y = 10;
  const Flown flown = fly(options, 30, [](double t, const Motion&) {
    simulation::VehicleCommand command{Vector3d(10, 0, 0), {}};
    command.aim =
        simulation::VehicleCommand::Aim{{0, std::fmod(t, 4) < 2 ? 9.0 : -9.0, 0}, Vector3d::Zero(), 1};
    return command;
  });
  for (const auto& log : flown.log) EXPECT_LT(std::hypot(log[kU], log[kV], log[kW]), limit);
}

TEST(Fish, BadParametersAreNamed) {
  const auto refused = [](auto change) -> std::string {
    FishOptions options;
    change(options);
    try {
      static_cast<void>(fish(options));
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  EXPECT_EQ(refused([](FishOptions& o) { o.parameters.mass = -1; }), "mass");
  EXPECT_EQ(refused([](FishOptions& o) { o.parameters.blend = 2; }), "blend");
  EXPECT_EQ(refused([](FishOptions& o) { o.parameters.hinge = 0.3; }), "hinge");
  EXPECT_EQ(refused([](FishOptions& o) { o.parameters.most_bias = 2; }), "most_bias");
  EXPECT_EQ(refused([](FishOptions& o) { o.depth = -1; }), "depth");
  EXPECT_EQ(refused([](FishOptions& o) { o.gas = 1e-5; }), "gas");
  EXPECT_EQ(refused([](FishOptions& o) { o.most_speed = 0; }), "limits.speed");
  EXPECT_EQ(refused([](FishOptions&) {}), "");
}

}  // namespace
}  // namespace vericone::vehicles::fish_test
