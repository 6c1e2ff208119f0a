// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/navigator.h>

#include <algorithm>
#include <cmath>

#include "pilots/kinds.h"
#include "pilots/law_pilot.h"

namespace vericone::simulation {
namespace {

guidance::NavigatorOptions courses_of(const Pilot& pilot) {
  guidance::NavigatorOptions options;
  options.most = pilot.guide.inversion.most;
  if (pilot.guide.law == guidance::Law::clearance) {
    options.required = pilot.guide.clearance.required;
    options.beyond = pilot.guide.clearance.beyond;
    options.most = pilot.guide.clearance.most;
  }
  options.longitudinal = pilot.guide.clearance.longitudinal;
  options.fastest = pilot.fastest;
  options.looks = pilot.looks;
  options.others_most = pilot.others_most;
  if (pilot.sensor) options.range = pilot.sensor->range;
  return options;
}

class FlyingGuarded : public FlyingLaw {
 public:
  FlyingGuarded(const Pilot& pilot, const Scenario& scenario, std::size_t self, const RunOptions& options)
      : FlyingLaw(pilot, scenario, self, options), options_(courses_of(pilot)), navigator_(options_) {
    for (const Body& body : scenario.bodies) {
      double most = pilot.others_most;
      for (const auto& [name, own] : pilot.others_most_of)
        if (name == body.name) most = own;
      swerves_of_.push_back(most);
    }
  }

  /// Of all that it minds, not of the one met first alone.
  void command(const Instant& now, std::span<VehicleCommand> commands, Run& run) override {
    attend(now);
    minded_.clear();
    indices_.clear();
    swerves_.clear();
    for (const Engagement& e : engagements_) {
      if (!e.known(now)) continue;
      minded_.push_back(e.believed(now));
      indices_.push_back(e.obstacle());
      swerves_.push_back(swerves_of_[e.obstacle()]);
    }
    std::optional<guidance::Destination> destination;
    if (now.goal != nullptr)
      destination = {now.goal->point, now.goal->most, now.goal->velocity, now.goal->stay > 0};
    if (now.goal != nullptr && std::isfinite(now.goal->corridor))
      destination->corridor = {*now.goal->from, now.goal->corridor};
    using enum guidance::NavigatorStatus;
    const guidance::NavigatorStep said =
        navigator_.step(now.own(), minded_, destination, now.t, now.until - now.t, swerves_);
    commands[now.self].acceleration = said.acceleration;
    note(now.self, said.proved && said.inside, run);
    if (said.status == homing || said.status == straight) attended_ = nullptr;
    const bool hopeless = said.status == cannot_avoid;
    if (hopeless && !hopeless_)
      run.events.push_back({now.t, EventKind::cannot_avoid, now.self, indices_[said.nearest], said.least});
    hopeless_ = hopeless;
    homing_.note(now, said.aligned, run);
  }

 private:
  void note(std::size_t self, bool proved, Run& run) {
    const auto at = std::lower_bound(run.plans.begin(), run.plans.end(), self,
                                     [](const PlansProved& plans, std::size_t i) { return plans.agent < i; });
    PlansProved& plans = at != run.plans.end() && at->agent == self
                             ? *at
                             : *run.plans.insert(at, {self, 0, 0, options_.others_most, options_.range});
    ++plans.commands;
    plans.proved += proved;
  }

  guidance::NavigatorOptions options_;
  guidance::Navigator navigator_;
  std::vector<guidance::BodyState> minded_;
  std::vector<std::size_t> indices_;
  std::vector<double> swerves_, swerves_of_;  // m/s^2, of those minded, and of all bodies
  bool hopeless_ = false;
};

/// On courses that no cone holds, of all bodies together.
class GuardedPilot : public LawPilot {
 public:
  using LawPilot::LawPilot;
  std::unique_ptr<FlyingPilot> launch(const Scenario& scenario, std::size_t self,
                                      const RunOptions& options) const override {
    return std::make_unique<FlyingGuarded>(pilot_, scenario, self, options);
  }
  bool may_rest() const override { return true; }

 protected:
  bool by_sector() const override { return false; }
};

}  // namespace

std::shared_ptr<const PilotModel> guarded_pilot(const Pilot& pilot) {
  return std::make_shared<GuardedPilot>(pilot);
}

}  // namespace vericone::simulation
