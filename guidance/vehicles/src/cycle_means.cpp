// SPDX-License-Identifier: BSD-3-Clause
#include "cycle_means.h"

#include <algorithm>
#include <cmath>

#include "swim.h"

namespace vericone::vehicles {
namespace {

constexpr double kStepsOfACycle = 100;

struct Steady {
  double mean, highest, turn_rate;
};

/// After 30 cycles, over 4 more.
Steady steady(const FishParameters& fish, double amplitude, double bias, double speed) {
  const TailDrive tail(fish.frequency, fish.blend, 0, amplitude, bias);
  FishState state;
  state.gas = fish.neutral_gas;
  state.u = speed;
  const double cycle = 1 / fish.frequency, step = cycle / kStepsOfACycle;
  foresee(fish, state, tail, 0, 30 * cycle, step, [](const FishState&, double) {});
  Steady found{0, 0, 0};
  const double heading = state.heading;
  double count = 0;
  foresee(fish, state, tail, 30 * cycle, 34 * cycle, step, [&](const FishState& now, double) {
    found.mean += now.u;
    found.highest = std::max(found.highest, std::hypot(now.u, now.v));
    ++count;
  });
  found.mean /= count;
  found.turn_rate = (state.heading - heading) / (4 * cycle);
  return found;
}

}  // namespace

CycleMeans::CycleMeans(const FishParameters& fish) : amplitudes_{0}, means_{0}, highest_{0} {
  constexpr int kAmplitudes = 8;
  for (int i = 1; i <= kAmplitudes; ++i) {
    const double amplitude = fish.most_amplitude * i / kAmplitudes;
    const Steady now = steady(fish, amplitude, 0, means_.back());
    amplitudes_.push_back(amplitude);
    means_.push_back(std::max(now.mean, means_.back()));
    highest_.push_back(std::max(now.highest, highest_.back()));
  }
  const double amplitude = 0.6 * fish.most_amplitude, bias = 0.5 * fish.most_bias;
  if (bias > 0) turn_gain_ = steady(fish, amplitude, bias, 0).turn_rate / (amplitude * bias);
}

double CycleMeans::amplitude_of(double speed) const {
  if (!(speed > 0)) return 0;
  for (std::size_t i = 1; i < means_.size(); ++i)
    if (speed <= means_[i])
      return amplitudes_[i - 1] +
             (amplitudes_[i] - amplitudes_[i - 1]) * (speed - means_[i - 1]) / (means_[i] - means_[i - 1]);
  return amplitudes_.back();
}

double CycleMeans::amplitude_below(double highest) const {
  for (std::size_t i = 1; i < highest_.size(); ++i)
    if (highest < highest_[i])
      return amplitudes_[i - 1] + (amplitudes_[i] - amplitudes_[i - 1]) *
                                      std::max(0.0, highest - highest_[i - 1]) /
                                      (highest_[i] - highest_[i - 1]);
  return amplitudes_.back();
}

double amplitude_for_force(const FishParameters& fish, const FishState& state, const TailDrive& tail,
                           double t, double bias, double force, double most) {
  const double cycle = 1 / fish.frequency;
  const auto mean = [&](double amplitude) {
    TailDrive tried = tail;
    tried.set(t, amplitude, bias);
    FishState now = state;
    double sum = 0, count = 0;
    foresee(fish, now, tried, t, t + cycle, cycle / kStepsOfACycle, [&](const FishState& at, double when) {
      const FishForces forces = fish_forces(fish, at, tried.at(when), at.position.z());
      sum += forces.tail_x - forces.drag_x;
      ++count;
    });
    return sum / count;
  };
  double low = 0, high = most;
  if (mean(high) <= force) return high;
  if (mean(low) >= force) return low;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    (mean(middle) < force ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace vericone::vehicles
