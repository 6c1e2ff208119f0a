// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/vehicles/fish_water.h>
#include <vericone/vehicles/fish.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone::vehicles {

using Eigen::Vector3d;
using simulation::Current;

double compression(const FishParameters& fish, double depth) {
  return fish.pressure / (fish.pressure + fish.density * fish.gravity * std::max(0.0, depth));
}

double gas_volume(const FishParameters& fish, double gas, double depth) {
  return std::min(compression(fish, depth) * gas, fish.chamber);
}

double most_gas(const FishParameters& fish, double depth) { return fish.chamber / compression(fish, depth); }

FishForces fish_forces(const FishParameters& fish, const FishState& state, const TailAngle& tail,
                       double surface) {
  FishForces forces;
  const double c = std::cos(tail.angle), s = std::sin(tail.angle), chord = fish.tail_chord;
  const double plate = std::numbers::pi * fish.density * fish.tail_span * chord;
  // Of the hinge, along the plate and across it; a point at the distance d behind the hinge has v_n less by
  // d (r + alpha_1').
  const double side = state.v - state.r * fish.hinge;
  const double along = c * state.u + s * side, across = -s * state.u + c * side;
  const double turning = state.r + tail.rate;
  const double three_quarters = across - 0.75 * chord * turning, middle = across - 0.5 * chord * turning;
  const double middle_rate = -along * tail.rate - 0.5 * chord * tail.acceleration;
  forces.tail_normal =
      -plate * (three_quarters * std::abs(along) + 0.25 * chord * middle_rate) -
      0.5 * fish.density * fish.drag_plate * fish.tail_span * chord * middle * std::abs(middle);
  forces.tail_x = -s * forces.tail_normal;
  forces.tail_y = c * forces.tail_normal;
  const double x = -fish.hinge - 0.5 * chord * c, y = -0.5 * chord * s;
  forces.tail_n = x * forces.tail_y - y * forces.tail_x;
  forces.drag_x = 0.5 * fish.density * fish.drag_x * fish.area_x * state.u * std::abs(state.u);
  forces.drag_y = 0.5 * fish.density * fish.drag_y * fish.area_y * state.v * std::abs(state.v);
  forces.drag_n = fish.drag_turn * state.r * std::abs(state.r);
  const double volume = gas_volume(fish, state.gas, depth_of(state, surface));
  forces.lift = fish.density * fish.gravity * (volume - fish.neutral_gas);
  forces.drag_z = fish.drag_z * state.w * std::abs(state.w);
  return forces;
}

Vector3d over_ground(const FishState& state, const Current& water, double t) {
  const double c = std::cos(state.heading), s = std::sin(state.heading);
  return Vector3d(state.u * c - state.v * s, state.u * s + state.v * c, state.w) +
         water.velocity(state.position.z(), t);
}

// A neutral body in water that accelerates is accelerated as the water is; what is left is that it crosses a
// shear: the water about it changes by w times the gradient.
FishState fish_rates(const FishParameters& fish, const FishState& state, const TailAngle& tail,
                     double gas_rate, double surface, const Current& water, double t) {
  const FishForces forces = fish_forces(fish, state, tail, surface);
  const double c = std::cos(state.heading), s = std::sin(state.heading);
  const Vector3d shear = -fish.mass * state.w * water.gradient();
  const double surge = fish.mass + fish.added_x, sway = fish.mass + fish.added_y;
  FishState rate;
  rate.position = over_ground(state, water, t);
  rate.heading = state.r;
  rate.u = (sway * state.v * state.r + forces.tail_x - forces.drag_x + c * shear.x() + s * shear.y()) / surge;
  rate.v =
      (-surge * state.u * state.r + forces.tail_y - forces.drag_y - s * shear.x() + c * shear.y()) / sway;
  rate.r = ((fish.added_x - fish.added_y) * state.u * state.v + forces.tail_n - forces.drag_n) /
           (fish.inertia + fish.added_inertia);
  rate.w = (forces.lift - forces.drag_z) / fish.mass;
  rate.gas = gas_rate;
  return rate;
}

double swimming_energy(const FishParameters& fish, const FishState& state) {
  return 0.5 *
         ((fish.mass + fish.added_x) * state.u * state.u + (fish.mass + fish.added_y) * state.v * state.v +
          (fish.inertia + fish.added_inertia) * state.r * state.r);
}

}  // namespace vericone::vehicles
