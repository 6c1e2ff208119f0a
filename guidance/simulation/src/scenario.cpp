// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/guidance/plane_view.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/simulation/scenario.h>

#include <vericone/geometry/error.h>
#include <vericone/guidance/plane_view.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "check_orifices.h"

namespace vericone::simulation {
namespace {

std::string at(const char* list, std::size_t i) { return std::string(list) + "[" + std::to_string(i) + "]"; }

void require_positive(double value, const char* field, const char* unit) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(field, to_text(value), std::string("a positive finite number") + unit);
}

void require_not_negative(double value, const char* field, const char* unit) {
  if (!(value >= 0) || !std::isfinite(value))
    throw InputError(field, to_text(value), std::string("a finite number, 0 or more") + unit);
}

bool cooperates(guidance::Law law) {
  return law == guidance::Law::cooperative_avoidance || law == guidance::Law::cooperative_rendezvous;
}

/// What a law, or a guarded pilot, can see; and whether meetings of the kinds can be proved.
void check_kinds(const Pilot& pilot, const Body& self, const Scenario& scenario) {
  const auto state = [](const Body& body) {
    guidance::BodyState at;
    at.shape = shape_at(body.shape, body.appears, body.start.position, body.start.rotation);
    return at;
  };
  const bool by_sector = !guarded(pilot) && pilot.guide.law != guidance::Law::clearance;
  const guidance::BodyState agent = state(self);
  for (const Body& other : scenario.bodies) {
    const bool minded = pilot.minds.empty() ||
                        std::find(pilot.minds.begin(), pilot.minds.end(), other.name) != pilot.minds.end();
    if (other.name == self.name || !minded || planar(other.shape) != planar(self.shape)) continue;
    const guidance::BodyState obstacle = state(other);
    if (guidance::has_sectors(agent, obstacle, guidance::SectorMethod::slice)) continue;
    if (by_sector && !guidance::has_sectors(agent, obstacle, pilot.guide.sector))
      throw InputError("law",
                       std::string(guidance::to_string(pilot.guide.law)) + " by slices, which " + self.name +
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

void check_sensing(const Pilot& pilot, double step) {
  const guidance::GuideOptions& guide = pilot.guide;
  const bool inverts = guide.law == guidance::Law::avoidance && !guarded(pilot);
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
  require_not_negative(pilot.estimator_intensity, "estimator.intensity", " (m^2/s^3)");
  require_not_negative(pilot.obstacle_most, "estimator.most", " (m/s^2)");
  if (!pilot.sensor) {
    if (pilot.estimator != Estimator::none)
      throw InputError("estimator", to_string(pilot.estimator), "left out without a sensor: all is known");
    return;
  }
  try {
    check(*pilot.sensor);
  } catch (const InputError& e) {
    throw e.within("sensor");
  }
  if (pilot.sensor->noise != Noise::engagement) return;
  of_inversion("sensor");
  if (pilot.estimator != Estimator::none)
    throw InputError("estimator", to_string(pilot.estimator),
                     "left out: the sensor engagement measures no position and velocity");
}

void check_pilot(const Pilot& pilot, const Body& self, const Scenario& scenario) {
  if (pilot.through) check_through(*pilot.through, self, scenario);
  guidance::check(pilot.guide);
  const auto find = [&](const std::string& name) {
    return std::find_if(scenario.bodies.begin(), scenario.bodies.end(),
                        [&](const Body& body) { return body.name == name; });
  };
  const auto require_other = [&](const std::vector<std::string>& names, const char* field) {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == self.name || find(names[i]) == scenario.bodies.end())
        throw InputError(at(field, i), names[i], "the name of another body");
  };
  require_other(pilot.minds, "minds");
  require_other(pilot.partners, "partners");
  for (std::size_t i = 0; i < pilot.partners.size(); ++i)
    if (find(pilot.partners[i])->pilot)
      throw InputError(at("partners", i), pilot.partners[i],
                       "a body without a pilot of its own: it carries out what this law says");
  for (std::size_t i = 0; i < pilot.partners.size(); ++i)
    if (find(pilot.partners[i])->road)
      throw InputError(at("partners", i), pilot.partners[i],
                       "a body without a road, which leaves it no choice");
  if (!pilot.partners.empty() && !cooperates(pilot.guide.law))
    throw InputError("partners", pilot.partners.front(), "no partners with this law, or a cooperative one");
  if (!pilot.through) check_kinds(pilot, self, scenario);
  check_sensing(pilot, scenario.step);
  if (!pilot.goal) return;
  if (!pilot.goal->point.allFinite())
    throw InputError("goal.point", "a number that is not finite", "finite (m)");
  require_positive(pilot.goal->most, "goal.most", " (m/s^2)");
  require_positive(pilot.goal->reached, "goal.reached", " (m)");
  if (!pilot.goal->after.empty()) {
    const auto after = find(pilot.goal->after);
    if (pilot.goal->after == self.name || after == scenario.bodies.end())
      throw InputError("goal.after", pilot.goal->after, "the name of another body");
  }
}

void check_body(const Body& body, const Scenario& scenario) {
  const auto within = [](const char* field, auto make) {
    try {
      make();
    } catch (const InputError& e) {
      throw e.within(field);
    }
  };
  within("shape", [&] { check(body.shape); });
  if (!body.start.position.allFinite())
    throw InputError("position", "a number that is not finite", "finite (m)");
  if (!body.start.velocity.allFinite())
    throw InputError("velocity", "a number that is not finite", "finite (m/s)");
  if (planar(body.shape) && (body.start.position.z() != 0 || body.start.velocity.z() != 0))
    throw InputError("position", "out of the plane", "z = 0 for planar bodies, of position and velocity");
  if (planar(body.shape) != planar(scenario.bodies.front().shape))
    throw InputError("shape", planar(body.shape) ? "planar" : "spatial", "all planar or all spatial");
  require_not_negative(body.appears, "appears", " (s)");
  if (!(body.appears < scenario.duration))
    throw InputError("appears", to_text(body.appears),
                     "before the end, duration = " + to_text(scenario.duration));
  if (body.vehicle) {
    if (planar(body.shape)) throw InputError("vehicle", "of a planar body", "a body in space");
    static_cast<void>(body.vehicle->launch(body.start, body.appears, scenario.water));
  }
  if (body.road) {
    if (body.pilot || body.vehicle)
      throw InputError("road", "that of a body with a pilot or a vehicle", "left out: these move the body");
    const Motion first = start_of(*body.road, body.start.position.z());
    if (!first.position.isApprox(body.start.position, 1e-12) &&
        (first.position - body.start.position).norm() > 1e-9)
      throw InputError("road", "one that begins elsewhere", "one that begins at the body's position");
  }
  if (!body.pilot) return;
  if (!body.start.velocity.any() && !guarded(*body.pilot))
    throw InputError("velocity", "0", "a heading: only a guarded pilot may start at rest");
  within("pilot", [&] { check_pilot(*body.pilot, body, scenario); });
}

}  // namespace

bool guarded(const Pilot& pilot) {
  const guidance::Law law = pilot.guide.law;
  return !pilot.through && pilot.manner == Manner::guarded &&
         (law == guidance::Law::avoidance || law == guidance::Law::clearance);
}

double most_commanded(const Pilot& pilot) {
  if (pilot.through)
    return pilot.through->law == Through::Law::passage ? pilot.through->passage.most
                                                       : pilot.through->source.most;
  return pilot.guide.law == guidance::Law::clearance ? pilot.guide.clearance.most
                                                     : pilot.guide.inversion.most;
}

double time_of_step(const Scenario& scenario, std::uint64_t k) {
  const double in_a_second = std::round(1 / scenario.step);
  const bool whole = std::abs(in_a_second * scenario.step - 1) < 1e-15;
  return whole ? double(k) / in_a_second : double(k) * scenario.step;
}

void check(const Scenario& scenario) {
  require_positive(scenario.duration, "duration", " (s)");
  require_positive(scenario.step, "step", " (s)");
  if (!(scenario.duration / scenario.step <= 1e7))
    throw InputError("step", to_text(scenario.step), "at least duration / 1e7");
  require_not_negative(scenario.proof.padding, "proof.padding", " (m)");
  require_positive(scenario.proof.resolution, "proof.resolution", " (s)");
  require_not_negative(scenario.proof.drift, "proof.drift", " (m/s)");
  if (scenario.planes_logged < 0 || scenario.planes_logged > 10000)
    throw InputError("planes_logged", std::to_string(scenario.planes_logged), "from 0 to 10000");
  if (scenario.bodies.empty()) throw InputError("bodies", "none", "one body or more");
  if (scenario.water.moves() && std::none_of(scenario.bodies.begin(), scenario.bodies.end(),
                                             [](const Body& body) { return body.vehicle != nullptr; }))
    throw InputError("current", "one that moves", "left out: it moves vehicles, and no body is one");
  std::set<std::string> names;
  check_orifices(scenario);
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const Body& body = scenario.bodies[i];
    if (body.name.empty() || !names.insert(body.name).second)
      throw InputError(at("bodies", i) + ".name", body.name.empty() ? "nothing" : body.name,
                       "a name that no other body has");
  }
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    try {
      check_body(scenario.bodies[i], scenario);
    } catch (const InputError& e) {
      throw e.within(at("bodies", i));
    }
  }
}

}  // namespace vericone::simulation
