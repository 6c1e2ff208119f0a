// SPDX-License-Identifier: BSD-3-Clause
#include "through.h"
#include <vericone/internal/guidance/orifice_function.h>

#include <algorithm>
#include <cmath>

#include "run_events.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

/// In the orifice's own frame.
Vector3d seen_from(const PlacedOpening& opening, const Vector3d& point) {
  const Vector3d c = point - opening.center;
  return {opening.axes.col(0).dot(c), opening.axes.col(1).dot(c), opening.normal().dot(c)};
}

/// Half of the body's extent along the normal, at most.
double half_width(const guidance::BodyState& body, const Vector3d& normal) {
  const Ellipsoid around = body.shape.containing_ellipsoid();
  return around.radius(normal) + std::abs(normal.dot(around.center() - body.position));
}

}  // namespace

const char* to_string(Through::Law law) { return law == Through::Law::orifice ? "orifice" : "passage"; }

double circle_within(const Opening& opening) { return std::max(0.0, opening.depth(Eigen::Vector2d::Zero())); }

ThroughFlight::ThroughFlight(std::size_t agent, const Pilot& pilot, const Scenario& scenario)
    : agent_(agent), through_(&*pilot.through), scenario_(&scenario) {
  for (const std::string& name : through_->orifices) {
    const auto it = std::find_if(scenario.orifices.begin(), scenario.orifices.end(),
                                 [&](const MovingOrifice& orifice) { return orifice.name == name; });
    order_.push_back(std::size_t(it - scenario.orifices.begin()));
  }
}

guidance::OrificeCommand ThroughFlight::command(const guidance::BodyState& body, double t) const {
  guidance::OrificeCommand command = steer(body, t);
  if (const auto wanted = speed()) {
    Vector3d along = body.velocity;
    if (scenario_->bodies[agent_].vehicle) along.z() = 0;
    if (const double now = along.norm(); now > 0)
      command.acceleration += through_->gain_speed * (*wanted - now) / now * along;
  }
  return command;
}

std::optional<double> ThroughFlight::speed() const {
  const std::vector<double>& speeds = through_->speeds;
  if (speeds.empty()) return std::nullopt;
  return speeds[std::min(next_, speeds.size() - 1)];
}

guidance::OrificeCommand ThroughFlight::steer(const guidance::BodyState& body, double t) const {
  const guidance::OrificeState orifice = heading_for().at(t);
  if (through_->law == Through::Law::passage) return guidance::passage_law(body, orifice, through_->passage);
  return guidance::orifice_law({body.position, body.velocity, orifice.opening.center, orifice.velocity},
                               circle_within(orifice.opening.opening), reach(scenario_->bodies[agent_].shape),
                               through_->source);
}

guidance::OrificeAim ThroughFlight::aim(const guidance::BodyState& body, double t) const {
  std::optional<double> margin;
  if (through_->law == Through::Law::passage) margin = through_->passage.margin;
  return guidance::orifice_aim(body, heading_for().at(t), speed(), margin);
}

OrificeSample ThroughFlight::sample(const guidance::BodyState& body, double t,
                                    const guidance::OrificeCommand& command) {
  const guidance::OrificeState orifice = heading_for().at(t);
  OrificeSample sample{t, agent_, this->orifice(), {}, command, 0};
  // At the very centre there is no line of sight: the one before stands.
  if (orifice.opening.center == body.position) {
    sample.state = last_state_.value_or(guidance::SpatialState{});
    sample.state.r = 0;
  } else {
    sample.state =
        guidance::spatial_state({body.position, body.velocity, orifice.opening.center, orifice.velocity},
                                last_state_ ? &*last_state_ : nullptr);
  }
  last_state_ = sample.state;
  sample.from_plane = seen_from(orifice.opening, body.position).z();
  if (through_->law == Through::Law::passage)
    sample.command.y = guidance::orifice_function(
                           {body.position, body.velocity, orifice.opening.center, orifice.velocity},
                           circle_within(orifice.opening.opening), reach(scenario_->bodies[agent_].shape))
                           .y;
  return sample;
}

std::optional<Event> ThroughFlight::fly(const Track& track, double from, double to) {
  if (!sees(from)) return std::nullopt;
  const auto seen = [&](double t) {
    return seen_from(heading_for().at(t).opening, track.motion(t).position);
  };
  std::optional<Event> crossed;
  const double before = seen(from).z(), after = seen(to).z();
  if ((before < 0) != (after < 0)) {
    const double sign = before < 0 ? 1 : -1;
    const double when = sign_change([&](double t) { return sign * seen(t).z(); }, from, to);
    const Vector3d at = seen(when);
    inside_ = heading_for().opening.depth(at.head<2>()) > 0;
    crossed = {when, inside_ ? EventKind::goes_through : EventKind::goes_beside, agent_, orifice(),
               at.norm()};
  }
  if (!inside_) return crossed;
  const PlacedOpening opening = heading_for().at(to).opening;
  if (std::abs(seen(to).z()) > half_width(track.state(to), opening.normal())) {
    ++next_;
    inside_ = false;
    last_state_.reset();
  }
  return crossed;
}

}  // namespace vericone::simulation
