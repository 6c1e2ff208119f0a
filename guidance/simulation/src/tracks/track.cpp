// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/simulation/track.h>
#include <algorithm>
#include <utility>

#include "tracks/level_frame.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

using Legs = std::vector<std::shared_ptr<const Leg>>;

/// The leg that a time lies in, at a common end the later one.
Legs::const_iterator leg_at(const Legs& legs, double t) {
  if (t >= legs.back()->from()) return legs.end() - 1;  // the present is asked for most
  const auto after = std::upper_bound(legs.begin(), legs.end(), t,
                                      [](double time, const auto& leg) { return time < leg->from(); });
  return after == legs.begin() ? after : after - 1;
}

}  // namespace

Track::Track(ShapeInTime shape, const Motion& start, Orientation orientation, double appears)
    : shape_(std::move(shape)), start_(start), orientation_(orientation), appears_(appears) {
  if (orientation_ == Orientation::level) start_.rotation = level_frame(start_.velocity, start_.rotation);
}

void Track::advance(const Vector3d& acceleration, double to) {
  const double from = end();
  // A body that follows its velocity may turn at once, but only arcs carry it.
  const auto straight = [this](const Leg& leg) {
    return !leg.accelerated() && (orientation_ != Orientation::fixed || leg.most_turn_rate() == 0);
  };
  if (!legs_.empty() && straight(*legs_.back()) && acceleration.isZero(0) && to > from) {
    legs_.back() =
        std::make_shared<Arc>(legs_.back()->start(), acceleration, orientation_, legs_.back()->from(), to);
    return;
  }
  legs_.push_back(std::make_shared<Arc>(legs_.empty() ? start_ : legs_.back()->end(), acceleration,
                                        orientation_, from, to));
}

void Track::append(const Curve& curve) {
  constexpr double kJoin = 1e-12;
  const Motion& reached = legs_.empty() ? start_ : legs_.back()->end();
  if (orientation_ != Orientation::fixed)
    throw InputError("orientation", "along the velocity", "fixed: a curve says itself how it turns");
  if (curve.from() != end()) throw InputError("from", to_text(curve.from()), to_text(end()) + " s");
  const double apart = (curve.start().position - reached.position).norm();
  // Times are rounded too, and with them where fast bodies are.
  const double by_time =
      0x1p-50 * std::abs(end()) * (reached.velocity.norm() + curve.start().velocity.norm());
  if (!(apart <= kJoin * (1 + reached.position.norm()) + by_time))
    throw InputError("position", to_text(apart) + " m off", "where the track ends");
  if (!((curve.start().rotation - reached.rotation).norm() <= kJoin))
    throw InputError("rotation", "another one", "that of the track's end");
  legs_.push_back(std::make_shared<Curve>(curve));
}

Motion Track::motion(double t) const { return legs_.empty() ? start_ : (*leg_at(legs_, t))->at(t); }

Vector3d Track::acceleration(double t) const {
  return legs_.empty() ? Vector3d::Zero() : (*leg_at(legs_, t))->acceleration(t);
}

guidance::BodyState Track::state(double t) const {
  const Motion m = motion(t);
  guidance::BodyState state;
  state.shape = shape_at(shape_, t, m.position, m.rotation);
  state.position = m.position;
  state.velocity = m.velocity;
  if (orientation_ != Orientation::fixed && m.velocity.norm() > kRestSpeed)
    state.turning = guidance::Turning::with_heading;
  if (!legs_.empty()) state.omega = (*leg_at(legs_, t))->turn(t);
  state.rate = shape_rate_at(shape_, t, m.rotation);
  return state;
}

double Track::most_acceleration() const {
  double most = 0;
  for (const auto& leg : legs_) most = std::max(most, leg->most_acceleration());
  return most;
}

Track::Bounds Track::bounds(double from, double to) const {
  Bounds bounds;
  if (legs_.empty()) return bounds;
  auto leg = leg_at(legs_, from);
  do {
    const Leg& now = **leg;
    bounds.acceleration = std::max(bounds.acceleration, now.most_acceleration());
    bounds.turn_rate = std::max(bounds.turn_rate, now.most_turn_rate());
    bounds.turn_acceleration = std::max(bounds.turn_acceleration, now.most_turn_acceleration());
    ++leg;
    if (leg == legs_.end() || !((*leg)->from() < to)) break;
    bounds.velocity_jumps += ((*leg)->start().velocity - now.end().velocity).norm();
    bounds.turn_jumps += ((*leg)->first_turn() - now.last_turn()).norm();
  } while (true);
  return bounds;
}

}  // namespace vericone::simulation
