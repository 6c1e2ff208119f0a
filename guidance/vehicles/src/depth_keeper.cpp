// SPDX-License-Identifier: BSD-3-Clause
#include "depth_keeper.h"
#include <vericone/internal/vehicles/fish_water.h>

#include <algorithm>
#include <cmath>

namespace vericone::vehicles {
namespace {

/// Parts of what the limits allow that a plan takes: the rest is for the loop.
constexpr double kOfJerk = 0.8, kOfLift = 0.8, kOfClimb = 0.95;

double jerk_of(const FishParameters& fish, double rate, double depth) {
  return fish.density * fish.gravity / fish.mass * rate * compression(fish, depth);
}

std::array<double, 6> quintic(const Height& a, const Height& b, double h) {
  const double z = b.z - a.z - h * (a.w + 0.5 * h * a.a), w = h * (b.w - a.w - h * a.a);
  const double c = h * h * (b.a - a.a), h3 = h * h * h;
  return {a.z,
          a.w,
          0.5 * a.a,
          (10 * z - 4 * w + 0.5 * c) / h3,
          (-15 * z + 7 * w - c) / (h3 * h),
          (6 * z - 3 * w + 0.5 * c) / (h3 * h * h)};
}

Height at(const std::array<double, 6>& p, double t) {
  return {p[0] + t * (p[1] + t * (p[2] + t * (p[3] + t * (p[4] + t * p[5])))),
          p[1] + t * (2 * p[2] + t * (3 * p[3] + t * (4 * p[4] + t * 5 * p[5]))),
          2 * p[2] + t * (6 * p[3] + t * (12 * p[4] + t * 20 * p[5]))};
}

double jerk_at(const std::array<double, 6>& p, double t) {
  return 6 * p[3] + t * (24 * p[4] + t * 60 * p[5]);
}

}  // namespace

double gas_for(const FishParameters& fish, double depth, double w, double up) {
  return (fish.neutral_gas +
          (fish.mass * up + fish.drag_z * w * std::abs(w)) / (fish.density * fish.gravity)) /
         compression(fish, depth);
}

Height DepthKeeper::planned(double t) const {
  if (t < to_) return at(way_, t - from_);
  return {after_.z + (t - to_) * after_.w, after_.w, 0};
}

bool DepthKeeper::feasible(const std::array<double, 6>& way, double seconds, double depth) const {
  const double up = kOfJerk * jerk_of(fish_, fish_.gas_rate, depth),
               down = kOfJerk * jerk_of(fish_, fish_.valve_rate, depth);
  const double volume = fish_.density * fish_.gravity / fish_.mass;
  constexpr int kPlaces = 16;
  for (int i = 0; i <= kPlaces; ++i) {
    const double t = seconds * i / kPlaces, jerk = jerk_at(way, t);
    const Height now = at(way, t);
    // Buoyancy changes with depth too, and with the drag.
    const double lift = now.a + fish_.drag_z / fish_.mass * now.w * std::abs(now.w);
    const double demanded = jerk + 2 * fish_.drag_z / fish_.mass * std::abs(now.w) * now.a;
    if (demanded > up || demanded < -down || std::abs(now.w) > kOfClimb * climb_) return false;
    if (lift > kOfLift * volume * (fish_.chamber - fish_.neutral_gas) ||
        lift < -kOfLift * volume * fish_.neutral_gas)
      return false;
  }
  return true;
}

void DepthKeeper::plan(const FishState& state, double surface, double t, double water_climb,
                       const Height& goal, double seconds) {
  const double depth = depth_of(state, surface);
  const FishForces forces = fish_forces(fish_, state, {}, surface);
  const Height now{state.position.z(), state.w + water_climb, (forces.lift - forces.drag_z) / fish_.mass};
  // Plans go on from where the last one is, unless the fish is somewhere else by now.
  Height start = begun_ ? planned(t) : now;
  constexpr double kLost = 0.1;
  if (std::abs(start.z - now.z) > kLost) start = now;
  constexpr double kShortest = 1, kLonger = 1.08;
  double h = std::max(seconds, kShortest);
  std::array<double, 6> way{};
  for (int i = 0; i < 80; ++i, h *= kLonger) {
    way = quintic(start, {goal.z + goal.w * h, goal.w, 0}, h);
    if (feasible(way, h, depth)) break;
  }
  begun_ = true;
  way_ = way;
  from_ = t;
  to_ = t + h;
  after_ = {goal.z + goal.w * h, goal.w, 0};
}

// Wanted: z''' = jerk planned - 3 p (a - a_r) - 3 p^2 (w - w_r) - p^3 (z - z_r). The equations give
// m z''' = rho g (c gas' + c' gas depth') - 2 C |w| a with depth' = -w.
double DepthKeeper::rate(const FishState& state, double surface, double t, double water_climb) const {
  const double depth = depth_of(state, surface), c = compression(fish_, depth);
  const FishForces forces = fish_forces(fish_, state, {}, surface);
  const double a = (forces.lift - forces.drag_z) / fish_.mass, w = state.w + water_climb;
  const Height r = planned(t);
  const double planned_jerk = t < to_ ? jerk_at(way_, t - from_) : 0, p = pole_;
  const double jerk =
      planned_jerk - 3 * p * (a - r.a) - 3 * p * p * (w - r.w) - p * p * p * (state.position.z() - r.z);
  const double weight = fish_.density * fish_.gravity;
  const double c_rate = depth > 0 ? c * c * weight / fish_.pressure * w : 0;  // dc/dt
  const double rate =
      ((fish_.mass * jerk + 2 * fish_.drag_z * std::abs(state.w) * a) / weight - c_rate * state.gas) / c;
  return std::clamp(rate, -fish_.valve_rate, fish_.gas_rate);
}

}  // namespace vericone::vehicles
