// SPDX-License-Identifier: BSD-3-Clause
#include "pilots/law_pilot.h"

#include <vericone/geometry/error.h>
#include <vericone/guidance/plane_view.h>
#include <vericone/internal/guidance/plane_view.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <algorithm>
#include <cmath>

#include "names.h"
#include "pilots/kinds.h"

namespace vericone::simulation {
namespace {

bool minds(const Pilot& pilot, const std::string& name) {
  return pilot.minds.empty() || contains(pilot.minds, name);
}

bool cooperates(guidance::Law law) {
  return law == guidance::Law::cooperative_avoidance || law == guidance::Law::cooperative_rendezvous;
}

guidance::BodyState first_state(const Body& body) {
  guidance::BodyState at;
  at.shape = shape_at(body.shape, body.appears, body.start.position, body.start.rotation);
  return at;
}

void require_from_zero(double value, const char* field, const char* unit) {
  if (!(value >= 0) || !std::isfinite(value))
    throw InputError(field, to_text(value), std::string("a finite number, 0 or more") + unit);
}

}  // namespace

std::shared_ptr<const PilotModel> law_pilot(const Pilot& pilot) { return std::make_shared<LawPilot>(pilot); }

std::unique_ptr<FlyingPilot> LawPilot::launch(const Scenario& scenario, std::size_t self,
                                              const RunOptions& options) const {
  return std::make_unique<FlyingLaw>(pilot_, scenario, self, options);
}

double LawPilot::most() const {
  return in_metres() ? pilot_.guide.clearance.most : pilot_.guide.inversion.most;
}

double LawPilot::required(const std::string& other) const {
  return in_metres() && minds(pilot_, other) ? pilot_.guide.clearance.required : 0;
}

void LawPilot::check(const Scenario& scenario, const Body& self) const {
  guidance::check(pilot_.guide);
  if (!pilot_.partners.empty() && !cooperates(pilot_.guide.law))
    throw InputError("partners", pilot_.partners.front(), "no partners with this law, or a cooperative one");
  check_courses();
  for (const auto& each : pilot_.others_most_of)
    if (each.first == self.name || std::none_of(scenario.bodies.begin(), scenario.bodies.end(),
                                                [&](const Body& body) { return body.name == each.first; }))
      throw InputError("others_most", each.first, "the name of another body");
  check_kinds(scenario, self);
  check_sensing(scenario.step);
}

/// What only guarded pilots read.
void LawPilot::check_courses() const {
  if (!(pilot_.fastest > 0)) throw InputError("fastest", to_text(pilot_.fastest), "positive (m/s)");
  require_from_zero(pilot_.others_most, "others_most", " (m/s^2)");
  for (const auto& [name, most] : pilot_.others_most_of)
    require_from_zero(most, ("others_most." + name).c_str(), " (m/s^2)");
  if (!guarded(pilot_) && !pilot_.others_most_of.empty())
    throw InputError("others_most", "of each", "left out: only a guarded pilot reads it");
  if (!guarded(pilot_) && pilot_.others_most > 0)
    throw InputError("others_most", to_text(pilot_.others_most), "left out: only a guarded pilot reads it");
  const bool limited = std::isfinite(pilot_.fastest);
  if (!guarded(pilot_) && (limited || pilot_.looks > 0))
    throw InputError(limited ? "fastest" : "looks",
                     limited ? to_text(pilot_.fastest) : std::to_string(pilot_.looks),
                     "left out: only a guarded pilot reads it");
  if (limited && !pilot_.guide.clearance.longitudinal)
    throw InputError("fastest", to_text(pilot_.fastest),
                     "left out, or given with clearance.longitudinal: true: else it keeps its speed");
}

/// What the law can see; and whether meetings of the kinds can be proved.
void LawPilot::check_kinds(const Scenario& scenario, const Body& self) const {
  const guidance::BodyState agent = first_state(self);
  for (const Body& other : scenario.bodies) {
    if (other.name == self.name || !minds(pilot_, other.name) || planar(other.shape) != planar(self.shape))
      continue;
    const guidance::BodyState obstacle = first_state(other);
    if (guidance::has_sectors(agent, obstacle, guidance::SectorMethod::slice)) continue;
    if (by_sector() && !guidance::has_sectors(agent, obstacle, pilot_.guide.sector))
      throw InputError("law",
                       std::string(guidance::to_string(pilot_.guide.law)) + " by slices, which " + self.name +
                           " and " + other.name + " do not have",
                       "exact sectors, clearance, or avoidance with the manner guarded");
    try {
      static_cast<void>(pair_of(agent.shape, obstacle.shape));
    } catch (const InputError& e) {
      throw InputError("minds", other.name + " (" + e.value() + ")",
                       "bodies of kinds that are certified against that of " + self.name);
    }
  }
}

void LawPilot::check_sensing(double step) const {
  const guidance::GuideOptions& guide = pilot_.guide;
  const bool inverts = guide.law == guidance::Law::avoidance && by_sector();
  const auto of_inversion = [&](const char* field) {
    if (!inverts)
      throw InputError(field, guidance::to_string(guide.law),
                       "the law avoidance with the manner source: no other has it");
  };
  if (guide.filter.any()) of_inversion("filter");
  if (guide.robust) {
    of_inversion("robust");
    if (!std::isfinite(guide.inversion.most))
      throw InputError("most", "without limit", "a number (m/s^2): the outer loop shares it");
    guidance::RobustModel model = guide.robust->model;
    model.gain = guide.inversion.gain;
    if (model.dt != step)
      throw InputError("robust.dt", to_text(model.dt), "the scenario's step, " + to_text(step) + " s");
    try {
      guidance::check(model, guide.robust->options);
    } catch (const InputError& e) {
      throw e.within("robust");
    }
  }
  require_from_zero(pilot_.estimator_intensity, "estimator.intensity", " (m^2/s^3)");
  require_from_zero(pilot_.obstacle_most, "estimator.most", " (m/s^2)");
  if (!pilot_.sensor) {
    if (pilot_.estimator != Estimator::none)
      throw InputError("estimator", to_string(pilot_.estimator), "left out without a sensor: all is known");
    return;
  }
  try {
    simulation::check(*pilot_.sensor);
  } catch (const InputError& e) {
    throw e.within("sensor");
  }
  if (pilot_.sensor->noise != Noise::engagement) return;
  of_inversion("sensor");
  if (pilot_.estimator != Estimator::none)
    throw InputError("estimator", to_string(pilot_.estimator),
                     "left out: the sensor engagement measures no position and velocity");
}

FlyingLaw::FlyingLaw(const Pilot& pilot, const Scenario& scenario, std::size_t self,
                     const RunOptions& options)
    : pilot_(pilot), scenario_(scenario), log_(options.log) {
  const std::vector<Body>& bodies = scenario.bodies;
  // What laws see of a map takes 0.3 s to find, and is kept: no decision is to wait for it.
  const auto prepare = [&](std::size_t i) {
    if (!planar(bodies[i].shape)) static_cast<void>(first_state(bodies[i]).shape.containing_ellipsoid());
  };
  for (std::size_t j = 0; j < bodies.size(); ++j) {
    if (j == self || !minds(pilot, bodies[j].name)) continue;
    const Draw draw{scenario.seed, options.trial, self * bodies.size() + j, 0};
    engagements_.emplace_back(self, j, pilot, draw);
    prepare(j);
  }
  if (!engagements_.empty()) prepare(self);
}

void FlyingLaw::look(const Instant& now) {
  for (Engagement& e : engagements_) e.look(now);
}

void FlyingLaw::report(const Instant& now, Run& run) {
  for (Engagement& e : engagements_) e.report(now, log_, run);
}

void FlyingLaw::attend(const Instant& now) {
  attended_ = nullptr;
  for (const Engagement& e : engagements_)
    if (e.there(now) && e.demands() && (attended_ == nullptr || e.time_to_go() < attended_->time_to_go()))
      attended_ = &e;
}

void FlyingLaw::command(const Instant& now, std::span<VehicleCommand> commands, Run& run) {
  attend(now);
  if (attended_ != nullptr) {
    commands[now.self].acceleration = attended_->step()->a;
    const std::size_t other = attended_->obstacle();
    if (contains(pilot_.partners, scenario_.bodies[other].name))
      commands[other].acceleration = attended_->step()->b;
    homing_.lose();
  } else if (now.goal != nullptr) {
    homing_.fly(now, commands[now.self], run);
  }
}

void FlyingLaw::log(const Instant& now, Run& run) {
  for (Engagement& e : engagements_) e.log(now, &e == attended_, scenario_.planes_logged, run);
}

void FlyingLaw::moved(const Instant& now, Run& run) {
  for (Engagement& e : engagements_) e.moved(now, run);
}

bool FlyingLaw::passed_all() const {
  return std::all_of(engagements_.begin(), engagements_.end(),
                     [](const Engagement& e) { return e.has_passed(); });
}

bool FlyingLaw::goal_opens(std::optional<std::size_t> after) const {
  return !after || std::any_of(engagements_.begin(), engagements_.end(), [&](const Engagement& e) {
    return e.obstacle() == *after && e.known_passed();
  });
}

}  // namespace vericone::simulation
