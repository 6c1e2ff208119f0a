// SPDX-License-Identifier: BSD-3-Clause
#include "tail_control.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone::vehicles {
namespace {

double most_amplitude(const FishOptions& options, const CycleMeans& means) {
  // Changes of amplitude and bias may overshoot what steady swimming reaches.
  constexpr double kOvershoot = 0.97;
  return options.most_speed ? means.amplitude_below(kOvershoot * *options.most_speed)
                            : options.parameters.most_amplitude;
}

}  // namespace

TailSetting source_tail(const FishOptions& options, const CycleMeans& means, const FishState& state,
                        const TailDrive& tail, const simulation::VehicleCommand& command, double t, long k) {
  const FishParameters& fish = options.parameters;
  // Without amplitude alpha_1 is the bias.
  if (k % 2 != 0) return {0, tail.bias() - options.gain_alpha * tail.bias()};
  const double c = std::cos(state.heading), s = std::sin(state.heading);
  const double force = fish.mass * (command.acceleration.x() * c + command.acceleration.y() * s);
  double bias = 0;
  if (command.aim) {
    // A positive bias turns clockwise. Print has no sign: swimming back along x, the same one would turn
    // away.
    const Eigen::Vector3d to_aim = command.aim->point - state.position;
    const double ahead = c * to_aim.x() + s * to_aim.y(), left = c * to_aim.y() - s * to_aim.x();
    const double aside = (state.position.y() - command.aim->point.y()) * (c < 0 ? -1 : 1);
    bias = std::clamp(options.gain_y * aside, -fish.most_bias, fish.most_bias);
    // Nor does it say how to turn round, which an error in y alone cannot: ours, as hard as it can be.
    if (ahead < 0) bias = left > 0 ? -fish.most_bias : fish.most_bias;
  }
  return {amplitude_for_force(fish, state, tail, t, bias, force, most_amplitude(options, means)), bias};
}

TailSetting our_tail(const FishOptions& options, const CycleMeans& means, const CyclePast& past,
                     const Eigen::Vector2d& wanted) {
  const FishParameters& fish = options.parameters;
  const double speed = wanted.norm(), most = most_amplitude(options, means);
  TailSetting set;
  set.amplitude = std::min(most, means.amplitude_of(speed + options.gain_speed * (speed - past.speed)));
  constexpr double kStill = 1e-3;  // m/s
  if (!(speed > kStill)) return {};
  using std::numbers::pi;
  const double error = std::remainder(std::atan2(wanted.y(), wanted.x()) - past.heading, 2 * pi);
  // Turning needs a tail that beats.
  constexpr double kOff = 0.2, kTurning = 0.35;
  if (std::abs(error) > kOff) set.amplitude = std::max(set.amplitude, std::min(most, kTurning));
  if (!(set.amplitude > 0) || means.turn_gain() == 0) return set;
  double rate = options.gain_heading * error;
  if (options.most_turn_rate) {
    const double within = 0.8 * *options.most_turn_rate;
    rate = std::clamp(rate, -within, within);
  }
  // A tail set aside turns the body at once, by a third of the bias. With small amplitudes, which turn
  // slowly, that would be more than the turn wanted, and the loop would swing.
  constexpr double kLeast = 0.26;
  set.bias = std::clamp(rate / (means.turn_gain() * std::max(set.amplitude, kLeast)), -fish.most_bias,
                        fish.most_bias);
  return set;
}

}  // namespace vericone::vehicles
