// SPDX-License-Identifier: BSD-3-Clause
#include "pilots/homing.h"

#include <vericone/cones/cone_geometry.h>
#include <algorithm>
#include <cmath>

namespace vericone::simulation {

using Eigen::Vector3d;

void Homing::fly(const Instant& now, VehicleCommand& command, Run& run) {
  const Goal& goal = *now.goal;
  const Motion motion = now.tracks[now.self].motion(now.t);
  const double step = now.until - now.t;
  const Vector3d v = motion.velocity, to_goal = goal.point - motion.position;
  const double speed = v.norm();
  const Vector3d aside = to_goal - v * (to_goal.dot(v) / (speed * speed));
  const double angle = std::atan2(aside.norm(), to_goal.dot(v) / speed);
  if (!(angle > 1e-9) || !(speed > 0)) return note(now, true, run);
  // Straight behind: any side is as good.
  const Vector3d side = aside.norm() > 1e-12 * to_goal.norm() ? Vector3d(aside.normalized())
                        : v.z() == 0 && goal.point.z() == 0   ? Vector3d(-v.y(), v.x(), 0) / speed
                                                              : AxisFrame(v).e1;
  const double missing = angle * speed / step;
  command.acceleration = std::min(goal.most, missing) * side;
  note(now, missing <= goal.most, run);
}

void Homing::note(const Instant& now, bool aligned, Run& run) {
  if (aligned && !aligned_) run.events.push_back({now.until, EventKind::aligned, now.self, now.self, 0});
  aligned_ = aligned;
}

}  // namespace vericone::simulation
