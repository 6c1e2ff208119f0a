// SPDX-License-Identifier: BSD-3-Clause
//
// One agent on its way through orifices.
#pragma once

#include <vericone/simulation/run.h>

namespace vericone::simulation {

class ThroughFlight {
 public:
  ThroughFlight(std::size_t agent, const Pilot& pilot, const Scenario& scenario);

  std::size_t agent() const { return agent_; }
  /// All are behind it.
  bool done() const { return next_ == order_.size(); }
  /// There is one that it heads for, and that one is there.
  bool sees(double t) const { return !done() && heading_for().appears <= t; }
  /// The orifice that it heads for. Requires !done().
  std::size_t orifice() const { return order_[next_]; }

  guidance::OrificeCommand command(const guidance::BodyState& body, double t) const;
  guidance::OrificeAim aim(const guidance::BodyState& body, double t) const;
  OrificeSample sample(const guidance::BodyState& body, double t, const guidance::OrificeCommand& command);

  /// What happened between two commands: whether its reference point crossed the plane, and where.
  std::optional<Event> fly(const Track& track, double from, double to);

 private:
  guidance::OrificeCommand steer(const guidance::BodyState& body, double t) const;
  std::optional<double> speed() const;  // to hold on the way to the next one
  const MovingOrifice& heading_for() const { return scenario_->orifices[orifice()]; }

  std::size_t agent_;
  const Through* through_;
  const Scenario* scenario_;
  std::vector<std::size_t> order_;
  std::size_t next_ = 0;
  bool inside_ = false;  // has crossed the plane inside the rim, and is not clear of it yet
  std::optional<guidance::SpatialState> last_state_;
};

/// The largest circle about an opening's centre that its rim holds: R_B of the source's law.
double circle_within(const Opening& opening);

}  // namespace vericone::simulation
