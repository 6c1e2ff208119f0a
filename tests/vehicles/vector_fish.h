// SPDX-License-Identifier: BSD-3-Clause
//
// The same fish once more, from vectors: momenta in the world, points of the tail that move, a gas of
// constant mass; fixed steps of Runge and Kutta. Nothing of the library but its parameters.
#pragma once

#include <vericone/vehicles/fish.h>
#include <array>
#include <cmath>
#include <numbers>

namespace vericone::vehicles {

class VectorFish {
 public:
  /// In still water at the heading 0; the tail beats about `bias` all the time, the gas is made at
  /// `gas_rate`.
  VectorFish(const FishParameters& fish, double amplitude, double bias, double gas_rate, double depth,
             double u)
      : fish_(fish), amplitude_(amplitude), bias_(bias), gas_rate_(gas_rate), depth_(depth) {
    x_[kPx] = (fish.mass + fish.added_x) * u;
    // Moles times R T: what the gas has as pressure times volume.
    x_[kGasEnergy] = fish.neutral_gas * (fish.pressure + fish.density * fish.gravity * depth);
  }

  void advance(double seconds, int steps) {
    const double h = seconds / steps;
    for (int i = 0; i < steps; ++i) {
      const State a = rate(x_, t_), b = rate(plus(x_, h / 2, a), t_ + h / 2),
                  c = rate(plus(x_, h / 2, b), t_ + h / 2), d = rate(plus(x_, h, c), t_ + h);
      for (std::size_t k = 0; k < x_.size(); ++k) x_[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
      t_ += h;
    }
  }

  Eigen::Vector3d position() const { return {x_[kX], x_[kY], x_[kZ]}; }
  double heading() const { return x_[kPsi]; }
  Eigen::Vector3d velocity() const {
    const Plane v = velocity_of(x_);
    return {v.x, v.y, x_[kW]};
  }
  double turn() const { return x_[kH] / (fish_.inertia + fish_.added_inertia); }
  double gas() const { return x_[kGasEnergy] / fish_.pressure; }

 private:
  enum { kX, kY, kZ, kPsi, kPx, kPy, kH, kW, kGasEnergy, kSize };
  using State = std::array<double, kSize>;
  struct Plane {
    double x, y;
  };
  static double dot(Plane a, Plane b) { return a.x * b.x + a.y * b.y; }
  static Plane rotated(Plane a, double angle) {
    return {a.x * std::cos(angle) - a.y * std::sin(angle), a.x * std::sin(angle) + a.y * std::cos(angle)};
  }
  static State plus(const State& x, double h, const State& rate) {
    State sum = x;
    for (std::size_t k = 0; k < x.size(); ++k) sum[k] += h * rate[k];
    return sum;
  }

  /// Momentum is not along velocity: the added masses differ.
  Plane velocity_of(const State& x) const {
    Plane p = rotated({x[kPx], x[kPy]}, -x[kPsi]);
    p.x /= fish_.mass + fish_.added_x;
    p.y /= fish_.mass + fish_.added_y;
    return rotated(p, x[kPsi]);
  }
  double alpha(double t) const {
    return bias_ + amplitude_ * std::sin(2 * std::numbers::pi * fish_.frequency * t);
  }

  State rate(const State& x, double t) const {
    const Plane v = velocity_of(x);
    const double omega = x[kH] / (fish_.inertia + fish_.added_inertia), psi = x[kPsi];
    // The point of the tail at the distance s behind the hinge, from the centre of mass in the world, at a
    // time nearby for which the body goes on as it does, in its own axes.
    const auto point = [&](double s, double later) {
      const double angle = alpha(t + later);
      return Plane{-fish_.hinge - s * std::cos(angle), -s * std::sin(angle)};
    };
    const Plane own = rotated(v, -psi);
    const auto across = [&](double s, double later) {
      const double d = 1e-4;
      const Plane p = point(s, later), next = point(s, later + d), last = point(s, later - d),
                  far = point(s, later + 2 * d), back = point(s, later - 2 * d);
      const auto slope = [&](double a, double b, double c, double e) {
        return (8 * (b - a) - (e - c)) / (12 * d);
      };
      const Plane moving{own.x - omega * p.y + slope(last.x, next.x, back.x, far.x),
                         own.y + omega * p.x + slope(last.y, next.y, back.y, far.y)};
      return dot(moving, rotated({0, 1}, alpha(t + later)));
    };
    const double chord = fish_.tail_chord, span = fish_.tail_span, d = 1e-3;
    const double along =
        dot({own.x - omega * point(0, 0).y, own.y + omega * point(0, 0).x}, rotated({1, 0}, alpha(t)));
    const auto middle = [&](double later) { return across(chord / 2, later); };
    const double middle_rate = (8 * (middle(d) - middle(-d)) - (middle(2 * d) - middle(-2 * d))) / (12 * d);
    const double force = -std::numbers::pi * fish_.density * span * chord *
                         (across(0.75 * chord, 0) * std::abs(along) + chord / 4 * middle_rate);
    const Plane tail = rotated({0, force}, alpha(t)), at = point(chord / 2, 0);
    const auto drag = [&](double c, double area, double speed) {
      return -0.5 * fish_.density * c * area * speed * std::abs(speed);
    };
    const Plane sum = rotated(
        {tail.x + drag(fish_.drag_x, fish_.area_x, own.x), tail.y + drag(fish_.drag_y, fish_.area_y, own.y)},
        psi);
    State rate{};
    rate[kX] = v.x;
    rate[kY] = v.y;
    rate[kPsi] = omega;
    rate[kPx] = sum.x;
    rate[kPy] = sum.y;
    // About the moving centre: momentum that is not along the velocity turns.
    rate[kH] = at.x * tail.y - at.y * tail.x - fish_.drag_turn * omega * std::abs(omega) -
               (v.x * x[kPy] - v.y * x[kPx]);
    const double weight = fish_.density * fish_.gravity;
    const double displaced = fish_.mass / fish_.density - fish_.neutral_gas +
                             x[kGasEnergy] / (fish_.pressure + weight * (depth_ - x[kZ]));
    rate[kZ] = x[kW];
    rate[kW] = (weight * displaced - fish_.mass * fish_.gravity - fish_.drag_z * x[kW] * std::abs(x[kW])) /
               fish_.mass;
    rate[kGasEnergy] = gas_rate_ * fish_.pressure;
    return rate;
  }

  FishParameters fish_;
  double amplitude_, bias_, gas_rate_, depth_, t_ = 0;
  State x_{};
};

}  // namespace vericone::vehicles
