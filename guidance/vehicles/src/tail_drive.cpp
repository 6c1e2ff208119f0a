// SPDX-License-Identifier: BSD-3-Clause
#include "tail_drive.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace vericone::vehicles {

TailDrive::TailDrive(double frequency, double blend, double t, double amplitude, double bias)
    : TailDrive(frequency, blend, t) {
  amplitude_[0] = amplitude_[1] = amplitude;
  bias_[0] = bias_[1] = bias;
}

void TailDrive::set(double t, double amplitude, double bias) {
  amplitude_[0] = std::exchange(amplitude_[1], amplitude);
  bias_[0] = std::exchange(bias_[1], bias);
  changed_ = t;
}

TailAngle TailDrive::at(double t) const {
  // 10 x^3 - 15 x^4 + 6 x^5: no jump of the angle's acceleration, which the added mass feels.
  const double x = std::clamp((t - changed_) / blend_, 0.0, 1.0), rest = 1 - x;
  const double share = x * x * x * (10 + x * (6 * x - 15));
  const double share_rate = 30 * x * x * rest * rest / blend_;
  const double share_acceleration = 60 * x * rest * (1 - 2 * x) / (blend_ * blend_);
  const double more = amplitude_[1] - amplitude_[0], aside = bias_[1] - bias_[0];
  const double a = amplitude_[0] + share * more, da = share_rate * more, dda = share_acceleration * more;
  const double omega = 2 * std::numbers::pi * frequency_, phase = omega * (t - begin_);
  const double s = std::sin(phase), c = std::cos(phase);
  return {bias_[0] + share * aside + a * s, share_rate * aside + da * s + a * omega * c,
          share_acceleration * aside + dda * s + 2 * da * omega * c - a * omega * omega * s};
}

}  // namespace vericone::vehicles
