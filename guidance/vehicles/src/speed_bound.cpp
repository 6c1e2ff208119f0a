// SPDX-License-Identifier: BSD-3-Clause
#include "speed_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone::vehicles {
namespace {

constexpr double kUp = 1 + 1e-9;  // over what some hundred operations round

struct Tail {
  double rate, acceleration;  // the most of |alpha_1'| and |alpha_1''|
};

Tail most_of(const FishParameters& fish) {
  // Of 10 x^3 - 15 x^4 + 6 x^5: slope at most 15/8, curvature at most 10 / sqrt(3).
  const double slope = 15.0 / 8 / fish.blend, curvature = 10 / std::sqrt(3.0) / (fish.blend * fish.blend);
  const double omega = 2 * std::numbers::pi * fish.frequency, a = fish.most_amplitude;
  const double changes = 2 * fish.most_bias + a;
  return {slope * changes + a * omega, curvature * changes + 2 * slope * a * omega + a * omega * omega};
}

/// Up to which energy the tail may do more work than drag takes.
class Balance {
 public:
  explicit Balance(const FishParameters& fish) : fish_(fish), tail_(most_of(fish)) {
    plate_ = std::numbers::pi * fish.density * fish.tail_span * fish.tail_chord;
    gamma_ = plate_ * fish.tail_chord * fish.tail_chord / 8 * tail_.acceleration;
    const double angular = 0.5 * fish.tail_chord * tail_.rate;
    constant_ = 0.5 * fish.density * fish.drag_plate * fish.tail_span * fish.tail_chord * 4 / 27 * angular *
                angular * angular;
  }

  /// Whether drag takes more than the tail gives at all states of this energy, proved.
  bool drag_wins(double energy) const {
    const double right = std::numbers::pi / 2;
    return wins(energy, 0, right, 0, right, 0);
  }

 private:
  bool wins(double energy, double t0, double t1, double p0, double p1, int level) const {
    if (power(energy, t0, t1, p0, p1) < 0) return true;
    constexpr int kLevels = 9;
    if (level == kLevels) return false;
    const double t = 0.5 * (t0 + t1), p = 0.5 * (p0 + p1);
    return wins(energy, t0, t, p0, p, level + 1) && wins(energy, t0, t, p, p1, level + 1) &&
           wins(energy, t, t1, p0, p, level + 1) && wins(energy, t, t1, p, p1, level + 1);
  }

  /// Not below dE/dt where u : v : r, in parts of the energy, have angles in these ranges.
  double power(double energy, double t0, double t1, double p0, double p1) const {
    const double x = std::sqrt(2 * energy / (fish_.mass + fish_.added_x)),
                 y = std::sqrt(2 * energy / (fish_.mass + fish_.added_y)),
                 r = std::sqrt(2 * energy / (fish_.inertia + fish_.added_inertia));
    const double u1 = x * std::cos(t0), u0 = x * std::max(0.0, std::cos(t1));
    const double v1 = y * std::sin(t1) * std::cos(p0), v0 = y * std::sin(t0) * std::max(0.0, std::cos(p1));
    const double r1 = r * std::sin(t1) * std::sin(p1), r0 = r * std::sin(t0) * std::sin(p0);
    const double chord = fish_.tail_chord;
    const double hinge = std::hypot(u1, v1 + fish_.hinge * r1),
                 middle = std::hypot(u1, v1 + (fish_.hinge + 0.5 * chord) * r1);
    const double beta = 0.25 * chord * r1 + chord * tail_.rate, flow = plate_ * hinge;
    const double given =
        std::max(gamma_ * middle, flow * beta * beta / 4 + beta * gamma_ / 2 + gamma_ * gamma_ / (4 * flow)) +
        constant_;
    const double taken =
        0.5 * fish_.density *
            (fish_.drag_x * fish_.area_x * u0 * u0 * u0 + fish_.drag_y * fish_.area_y * v0 * v0 * v0) +
        fish_.drag_turn * r0 * r0 * r0;
    return given * kUp - taken;
  }

  FishParameters fish_;
  Tail tail_;
  double plate_ = 0, gamma_ = 0, constant_ = 0;
};

}  // namespace

double most_swimming_speed(const FishParameters& fish, double start) {
  const Balance balance(fish);
  constexpr double kNone = 1e6;  // J
  double high = 1e-3;
  while (!balance.drag_wins(high)) {
    high *= 2;
    if (high > kNone) return std::numeric_limits<double>::infinity();
  }
  double low = high / 2;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    (balance.drag_wins(middle) ? high : low) = middle;
  }
  const double heavy = fish.mass + std::max(fish.added_x, fish.added_y),
               light = fish.mass + std::min(fish.added_x, fish.added_y);
  return std::sqrt(2 * std::max(high, 0.5 * heavy * start * start) / light) * kUp;
}

}  // namespace vericone::vehicles
