// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/guidance/orifice_function.h>
#include <vericone/simulation/reach.h>
#include <vericone/simulation/scenario.h>
#include <algorithm>
#include <cmath>

#include "names.h"
#include "pilots/homing.h"
#include "pilots/kinds.h"
#include "tracks/level_frame.h"
#include "tracks/sign_change.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;
using guidance::BodyState;

/// The largest circle about an opening's centre that its rim holds: R_B of the source's law.
double circle_within(const Opening& opening) { return std::max(0.0, opening.depth(Eigen::Vector2d::Zero())); }

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

void require_above_zero(double value, const char* field, const char* unit) {
  if (!(value > 0)) throw InputError(field, to_text(value), std::string("positive") + unit);
}

/// w of (2.4), which is not reached otherwise: no y is below -(R_B - R_A)^2, and none above 0 passes.
void check_reference(const Through& through, const Body& self, const MovingOrifice& orifice) {
  const double opening = circle_within(orifice.opening), agent = reach(self.shape);
  if (!(agent < opening))
    throw InputError("through", orifice.name,
                     "an orifice whose inner circle, " + to_text(opening) +
                         " m, is larger than the ball about " + self.name + ", " + to_text(agent) +
                         " m: (2.2) knows these alone");
  const double least = -(opening - agent) * (opening - agent), w = through.source.reference;
  if (!(w > least && w < 0))
    throw InputError("reference", to_text(w),
                     "between -(R_B - R_A)^2 = " + to_text(least) + " and 0 m^2, for " + orifice.name);
}

class FlyingThrough : public FlyingPilot {
 public:
  FlyingThrough(const Through& through, const Scenario& scenario, std::size_t self)
      : through_(through), scenario_(scenario), self_(self) {
    for (const std::string& name : through.orifices) order_.push_back(index_of(scenario.orifices, name));
  }

  void command(const Instant& now, std::span<VehicleCommand> commands, Run& run) override {
    said_.reset();
    VehicleCommand& command = commands[self_];
    if (sees(now.t)) {
      said_ = steer(now.own(), now.t);
      command.acceleration = said_->acceleration;
      if (scenario_.bodies[self_].vehicle) command.aim = aim(now.own(), now.t);
    } else if (now.goal != nullptr) {
      homing_.fly(now, command, run);
    }
  }

  void log(const Instant& now, Run& run) override {
    if (said_) run.orifices.push_back(sample(now.own(), now.t));
  }

  /// Whether its reference point has crossed the plane, and where; whether all of it is through.
  void moved(const Instant& now, Run& run) override {
    if (!sees(now.t)) return;
    const Track& track = now.tracks[self_];
    const auto seen = [&](double t) {
      return seen_from(heading_for().at(t).opening, track.motion(t).position);
    };
    const double before = seen(now.t).z(), after = seen(now.until).z();
    if ((before < 0) != (after < 0)) {
      const double sign = before < 0 ? 1 : -1;
      const double when = sign_change([&](double t) { return sign * seen(t).z(); }, now.t, now.until);
      const Vector3d at = seen(when);
      inside_ = heading_for().opening.depth(at.head<2>()) > 0;
      run.events.push_back({when, inside_ ? EventKind::goes_through : EventKind::goes_beside, self_,
                            order_[next_], at.norm()});
    }
    if (!inside_) return;
    const Vector3d normal = heading_for().at(now.until).opening.normal();
    if (std::abs(seen(now.until).z()) > half_width(track.state(now.until), normal)) {
      ++next_;
      inside_ = false;
      last_state_.reset();
    }
  }

  [[nodiscard]] bool passed_all() const override { return next_ == order_.size(); }
  [[nodiscard]] bool goal_opens(std::optional<std::size_t> after) const override {
    return passed_all() && !after;
  }

 private:
  /// There is one that it heads for, and that one is there.
  bool sees(double t) const { return !passed_all() && heading_for().appears <= t; }
  const MovingOrifice& heading_for() const { return scenario_.orifices[order_[next_]]; }
  bool by_outlines() const { return through_.law == Through::Law::passage; }

  /// To hold on the way to the next one, m/s.
  std::optional<double> speed() const {
    const std::vector<double>& speeds = through_.speeds;
    if (speeds.empty()) return std::nullopt;
    return speeds[std::min(next_, speeds.size() - 1)];
  }

  guidance::OrificeCommand steer(const BodyState& body, double t) const {
    const guidance::OrificeState orifice = heading_for().at(t);
    guidance::OrificeCommand command =
        by_outlines()
            ? guidance::passage_law(body, orifice, through_.passage)
            : guidance::orifice_law({body.position, body.velocity, orifice.opening.center, orifice.velocity},
                                    circle_within(orifice.opening.opening),
                                    reach(scenario_.bodies[self_].shape), through_.source);
    if (const auto wanted = speed()) {
      Vector3d along = body.velocity;
      if (scenario_.bodies[self_].vehicle) along.z() = 0;
      if (const double now = along.norm(); now > 0)
        command.acceleration += through_.gain_speed * (*wanted - now) / now * along;
    }
    return command;
  }

  VehicleCommand::Aim aim(const BodyState& body, double t) const {
    std::optional<double> margin;
    if (by_outlines()) margin = through_.passage.margin;
    const guidance::OrificeAim aim = guidance::orifice_aim(body, heading_for().at(t), speed(), margin);
    return {aim.point - aim.seconds * aim.velocity, aim.velocity, aim.seconds};
  }

  OrificeSample sample(const BodyState& body, double t) {
    const guidance::OrificeState orifice = heading_for().at(t);
    const guidance::Cartesian<3> engagement{body.position, body.velocity, orifice.opening.center,
                                            orifice.velocity};
    OrificeSample sample{t, self_, order_[next_], {}, *said_, 0};
    // At the very centre there is no line of sight: the one before stands.
    if (orifice.opening.center == body.position) {
      sample.state = last_state_.value_or(guidance::SpatialState{});
      sample.state.r = 0;
    } else {
      sample.state = guidance::spatial_state(engagement, last_state_ ? &*last_state_ : nullptr);
    }
    last_state_ = sample.state;
    sample.from_plane = seen_from(orifice.opening, body.position).z();
    if (by_outlines())
      sample.command.y = guidance::orifice_function(engagement, circle_within(orifice.opening.opening),
                                                    reach(scenario_.bodies[self_].shape))
                             .y;
    else
      sample.command.m = std::numeric_limits<double>::quiet_NaN();
    return sample;
  }

  const Through& through_;
  const Scenario& scenario_;
  std::size_t self_;
  std::vector<std::size_t> order_;
  std::size_t next_ = 0;
  bool inside_ = false;  // has crossed the plane inside the rim, and is not clear of it yet
  std::optional<guidance::OrificeCommand> said_;
  std::optional<guidance::SpatialState> last_state_;
  Homing homing_;
};

/// Through orifices, one after the other; then to its goal. It sees no bodies.
class ThroughPilot : public PilotModel {
 public:
  explicit ThroughPilot(const Pilot& pilot) : pilot_(pilot), through_(*pilot.through) {}

  void check(const Scenario& scenario, const Body& self) const override {
    if (through_.orifices.empty()) throw InputError("through", "nothing", "names of orifices");
    for (std::size_t i = 0; i < through_.orifices.size(); ++i) {
      const std::size_t orifice = index_of(scenario.orifices, through_.orifices[i]);
      if (orifice == scenario.orifices.size())
        throw InputError("through[" + std::to_string(i) + "]", through_.orifices[i],
                         "the name of an orifice");
      if (through_.law == Through::Law::orifice) check_reference(through_, self, scenario.orifices[orifice]);
    }
    require_above_zero(through_.source.gain, "gain", " (1/s)");
    require_above_zero(through_.passage.gain, "gain", " (1/s)");
    require_above_zero(std::min(through_.source.most, through_.passage.most), "most", " (m/s^2)");
    require_above_zero(through_.gain_speed, "gain_speed", " (1/s)");
    for (const double speed : through_.speeds) require_above_zero(speed, "speed", " (m/s)");
    if (through_.speeds.size() > 1 && through_.speeds.size() != through_.orifices.size())
      throw InputError("speed", std::to_string(through_.speeds.size()) + " numbers",
                       "one, or one for each of " + std::to_string(through_.orifices.size()) + " orifices");
    if (!(through_.passage.margin >= 0) || !std::isfinite(through_.passage.margin))
      throw InputError("margin", to_text(through_.passage.margin), "a finite number, 0 or more (m)");
    if (!(through_.passage.beyond >= 0) || !std::isfinite(through_.passage.beyond))
      throw InputError("beyond", to_text(through_.passage.beyond), "a finite number, 0 or more (m)");
    if (scenario.bodies.size() > 1 && !through_.minds_none)
      throw InputError("minds", "nothing",
                       "[] beside other bodies: the law " + std::string(to_string(through_.law)) +
                           " sees none of them, and may meet them");
  }

  std::unique_ptr<FlyingPilot> launch(const Scenario& scenario, std::size_t self,
                                      const RunOptions&) const override {
    return std::make_unique<FlyingThrough>(through_, scenario, self);
  }
  double most() const override {
    return through_.law == Through::Law::passage ? through_.passage.most : through_.source.most;
  }
  std::vector<std::string> orifices() const override { return through_.orifices; }

  ReachLimits limits(const Body& body, double step) const override {
    ReachLimits limits;
    const bool turns_only = through_.law == Through::Law::passage && !through_.passage.longitudinal;
    double most = this->most();
    for (const Goal& goal : pilot_.goals) most = std::max(most, goal.most);
    double slowest = body.start.velocity.norm(), fastest = slowest;
    for (const double speed : through_.speeds) {
      slowest = std::min(slowest, speed);
      fastest = std::max(fastest, speed);
    }
    // What holds a speed adds to what is commanded, and goes beyond it only if its steps do.
    if (through_.speeds.empty()) limits.acceleration = most;
    const bool holds = through_.speeds.empty() || through_.gain_speed * step <= 1;
    // A body at rest has no velocity to turn: what its law commands moves it.
    if (!turns_only || !holds || slowest <= 2 * kRestSpeed) return limits;
    limits.speed = fastest * (1 + 1e-12);
    limits.turn_rate = most / slowest * (1 + 1e-12);
    return limits;
  }

 private:
  const Pilot& pilot_;
  const Through& through_;
};

}  // namespace

const char* to_string(Through::Law law) { return law == Through::Law::orifice ? "orifice" : "passage"; }

std::shared_ptr<const PilotModel> through_pilot(const Pilot& pilot) {
  return std::make_shared<ThroughPilot>(pilot);
}

}  // namespace vericone::simulation
