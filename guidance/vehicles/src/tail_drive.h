// SPDX-License-Identifier: BSD-3-Clause
//
// The tail's servo: alpha_1 = bias + amplitude sin(2 pi f t), and how both get to new values.
#pragma once

#include <vericone/vehicles/fish.h>

namespace vericone::vehicles {

class TailDrive {
 public:
  /// At rest at time t, at the bias 0.
  TailDrive(double frequency, double blend, double t) : frequency_(frequency), blend_(blend), begin_(t) {}
  /// As if it had had these all the time.
  TailDrive(double frequency, double blend, double t, double amplitude, double bias);

  /// From t on towards these; the last change has to be over.
  void set(double t, double amplitude, double bias);

  TailAngle at(double t) const;
  double amplitude() const { return amplitude_[1]; }
  double bias() const { return bias_[1]; }
  /// When the k-th cycle begins, s.
  double cycle(long k) const { return begin_ + double(k) / frequency_; }

 private:
  double frequency_, blend_, begin_;
  double changed_ = -1e300;
  double amplitude_[2] = {0, 0}, bias_[2] = {0, 0};  // from, to
};

}  // namespace vericone::vehicles
