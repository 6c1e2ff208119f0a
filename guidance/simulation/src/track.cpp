// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/simulation/track.h>
#include <algorithm>
#include <utility>

#include "level_frame.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

/// The arc that a time lies in, at a common end the later one.
std::vector<Arc>::const_iterator arc_at(const std::vector<Arc>& arcs, double t) {
  if (t >= arcs.back().from()) return arcs.end() - 1;  // the present is asked for most
  const auto after = std::upper_bound(arcs.begin(), arcs.end(), t,
                                      [](double time, const Arc& arc) { return time < arc.from(); });
  return after == arcs.begin() ? after : after - 1;
}

}  // namespace

Track::Track(ShapeInTime shape, const Motion& start, Orientation orientation, double appears)
    : shape_(std::move(shape)), start_(start), orientation_(orientation), appears_(appears) {
  if (orientation_ == Orientation::level) start_.rotation = level_frame(start_.velocity, start_.rotation);
}

void Track::advance(const Vector3d& acceleration, double to) {
  const double from = end();
  if (!arcs_.empty() && !arcs_.back().accelerated() && acceleration.isZero(0) && to > from) {
    arcs_.back() = Arc(arcs_.back().start(), acceleration, orientation_, arcs_.back().from(), to);
    return;
  }
  arcs_.emplace_back(arcs_.empty() ? start_ : arcs_.back().end(), acceleration, orientation_, from, to);
}

Motion Track::motion(double t) const { return arcs_.empty() ? start_ : arc_at(arcs_, t)->at(t); }

Vector3d Track::acceleration(double t) const {
  return arcs_.empty() ? Vector3d::Zero() : arc_at(arcs_, t)->acceleration(t);
}

guidance::BodyState Track::state(double t) const {
  const Motion m = motion(t);
  guidance::BodyState state;
  state.shape = shape_at(shape_, t, m.position, m.rotation);
  state.position = m.position;
  state.velocity = m.velocity;
  if (orientation_ != Orientation::fixed && m.velocity.norm() > kRestSpeed)
    state.turning = guidance::Turning::with_heading;
  state.rate = shape_rate_at(shape_, t, m.rotation);
  return state;
}

Track::Bounds Track::bounds(double from, double to) const {
  Bounds bounds;
  if (arcs_.empty()) return bounds;
  auto arc = arc_at(arcs_, from);
  do {
    bounds.acceleration = std::max(bounds.acceleration, arc->most_acceleration());
    bounds.turn_rate = std::max(bounds.turn_rate, arc->most_turn_rate());
    bounds.turn_acceleration = std::max(bounds.turn_acceleration, arc->most_turn_acceleration());
    const Vector3d& before = arc->last_turn();
    ++arc;
    if (arc == arcs_.end() || !(arc->from() < to)) break;
    bounds.turn_jumps += (arc->first_turn() - before).norm();
  } while (true);
  return bounds;
}

}  // namespace vericone::simulation
