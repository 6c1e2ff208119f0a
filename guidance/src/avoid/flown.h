// SPDX-License-Identifier: BSD-3-Clause
//
// Single velocities of an agent: whether it can fly them, and whether one keeps the margin from a part, the
// way there too.
#pragma once

#include <vericone/guidance/avoid.h>
#include <algorithm>
#include <cmath>

#include "bands/at_once.h"
#include "bands/delimited.h"
#include "bands/threats.h"

namespace vericone::guidance::avoiding {

using namespace banding;

class Flown {
 public:
  Flown(const Vector3d& velocity, const AvoidOptions& options) : velocity_(velocity), options_(options) {}

  /// To rounding: a range may be one value.
  bool can_fly(const Vector3d& v) const {
    constexpr double kRounded = 1e-12;
    const double speed = v.norm(), slack = kRounded * speed;
    return speed >= options_.speed.from - slack && speed <= options_.speed.to + slack &&
           v.z() >= options_.climb.from - slack && v.z() <= options_.climb.to + slack;
  }

  /// Proved, until then; `duration`: s, of the change of velocity.
  bool lets_pass(const Part& part, const Vector3d& v, double duration, double until) const {
    const Horizon horizon{0, until};
    const Vector3d ground = v + options_.wind;
    auto half = safe(part, ground, horizon, options_.margin);
    if (!half) {
      const double beside = options_.margin + 0.5 * duration * (v - velocity_).norm() * (1 + 1e-12);
      return part.truth && duration <= until &&
             AsTheyAre(*part.truth).apart(ground, part.velocity, horizon, beside);
    }
    if (duration == 0) return true;
    // The ramp is behind the straight flight by at most half its duration, along the change.
    if (!(duration <= until)) return false;
    const double behind = 0.5 * duration * std::max(0.0, -half->normal.dot(v - velocity_)),
                 along = std::max(0.0, until * half->normal.dot(ground - part.velocity));
    const double slack = 0x1p-46 * half->normal.norm() *
                         (until * (ground - part.velocity).norm() + duration * (v - velocity_).norm());
    if (along + behind + slack < half->room) return true;
    const Vector3d late = -0.5 * duration * (v - velocity_);
    // Another plane, of both straight ways.
    for (const Vector3d& shift : {Vector3d(0.5 * late), late}) {
      const auto n = part.pair.normal_along(shift, until * (ground - part.velocity) + shift);
      if (!n) return false;
      const double room = part.pair.gap(*n) - options_.margin * n->norm() * (1 + 0x1p-48);
      if (std::max(0.0, n->dot(late)) + std::max(0.0, until * n->dot(ground - part.velocity)) + slack < room)
        return true;
    }
    return false;
  }
  /// s, of the change to a velocity.
  double ramp(const Vector3d& v) const {
    if (options_.lateral == 0 && options_.longitudinal == 0) return 0;
    const Vector3d change = v - velocity_;
    const double speed = velocity_.norm();
    const double along = speed > 0 ? std::abs(change.dot(velocity_)) / speed : change.norm();
    const double across = std::sqrt(std::max(0.0, change.squaredNorm() - along * along));
    const auto duration = [](double of, double by) { return of <= 1e-12 ? 0 : by > 0 ? of / by : 0; };
    return std::max(duration(along, options_.longitudinal), duration(across, options_.lateral));
  }

  /// m, how far from the straight flight that change may be.
  double beside(const Vector3d& v) const { return 0.5 * ramp(v) * (v - velocity_).norm(); }

 private:
  const Vector3d velocity_;
  const AvoidOptions& options_;
};

}  // namespace vericone::guidance::avoiding
