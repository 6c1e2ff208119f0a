// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/guidance/plane_view.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/simulation/scenario.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "names.h"

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

void check_goal(const Goal& goal, const Body& self, const std::vector<Body>& bodies) {
  if (!goal.point.allFinite()) throw InputError("point", "a number that is not finite", "finite (m)");
  if (!goal.velocity.allFinite()) throw InputError("velocity", "a number that is not finite", "finite (m/s)");
  require_positive(goal.most, "most", " (m/s^2)");
  require_positive(goal.reached, "reached", " (m)");
  require_not_negative(goal.stay, "stay", " (s)");
  if (!(goal.corridor > 0)) throw InputError("corridor", to_text(goal.corridor), "positive (m)");
  if (goal.from && !goal.from->allFinite())
    throw InputError("from", "a number that is not finite", "finite (m)");
  for (const auto& [field, name] : {std::pair("after", goal.after), std::pair("follows", goal.follows)})
    if (!name.empty() && (name == self.name || index_of(bodies, name) == bodies.size()))
      throw InputError(field, name, "the name of another body");
}

/// A leg is a straight line that stays, and who keeps to it can stop there.
void check_corridor(const Pilot& pilot, std::size_t i) {
  const std::vector<Goal>& goals = pilot.goals;
  if (!std::isfinite(goals[i].corridor)) return;
  const auto moves = [](const Goal& goal) { return goal.velocity.any() || !goal.follows.empty(); };
  const auto refuse = [&](const char* meant) {
    throw InputError("corridor", to_text(goals[i].corridor), meant);
  };
  if (pilot.own || pilot.through || !guarded(pilot) || !pilot.guide.clearance.longitudinal)
    refuse("left out: only a guarded pilot that may change its speed (clearance.longitudinal) keeps to one");
  if (moves(goals[i])) refuse("left out: its goal moves");
  if (i > 0 && !goals[i].from && moves(goals[i - 1])) refuse("left out: the goal before it moves");
}

void check_pilot(const Pilot& pilot, const PilotModel& model, const Body& self, const Scenario& scenario) {
  const std::vector<Body>& bodies = scenario.bodies;
  const auto require_other = [&](const std::vector<std::string>& names, const char* field) {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == self.name || index_of(bodies, names[i]) == bodies.size())
        throw InputError(at(field, i), names[i], "the name of another body");
  };
  require_other(pilot.minds, "minds");
  require_other(pilot.partners, "partners");
  for (std::size_t i = 0; i < pilot.partners.size(); ++i) {
    const Body& partner = bodies[index_of(bodies, pilot.partners[i])];
    if (partner.pilot)
      throw InputError(at("partners", i), pilot.partners[i],
                       "a body without a pilot of its own: it carries out what this law says");
    if (partner.road)
      throw InputError(at("partners", i), pilot.partners[i],
                       "a body without a road, which leaves it no choice");
  }
  model.check(scenario, self);
  for (std::size_t i = 0; i < pilot.goals.size(); ++i) {
    try {
      check_goal(pilot.goals[i], self, bodies);
      check_corridor(pilot, i);
    } catch (const InputError& e) {
      throw e.within(at("goals", i));
    }
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
  const auto model = model_of(*body.pilot);
  if (!body.start.velocity.any() && !model->may_rest())
    throw InputError("velocity", "0", "a heading: only a guarded pilot may start at rest");
  within("pilot", [&] { check_pilot(*body.pilot, *model, body, scenario); });
}

/// Where it will be, and how far from where, is reckoned with: nothing is to overflow on the way.
void require_within(const Eigen::Vector3d& value, double most, const char* field, const char* unit) {
  if (!value.allFinite())
    throw InputError(field, "a number that is not finite", std::string("finite") + unit);
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(value[i]) <= most))
      throw InputError(std::string(field) + "[" + std::to_string(i) + "]", to_text(value[i]),
                       "between -" + to_text(most) + " and " + to_text(most) + unit);
}

void check_orifice(const MovingOrifice& orifice, double duration) {
  if (!(orifice.appears >= 0) || !(orifice.appears < duration))
    throw InputError("appears", to_text(orifice.appears),
                     "0 or more, before the end, duration = " + to_text(duration));
  require_within(orifice.position, 1e12, "position", " (m)");
  require_within(orifice.velocity, 1e9, "velocity", " (m/s)");
  require_within(orifice.spin, 1e9, "spin", " (rad/s)");
  const Eigen::Matrix3d off = orifice.rotation.transpose() * orifice.rotation - Eigen::Matrix3d::Identity();
  if (!(off.cwiseAbs().maxCoeff() < 1e-9) || !(orifice.rotation.determinant() > 0))
    throw InputError("rotation", "a matrix", "a rotation");
}

void check_orifices(const Scenario& scenario) {
  std::set<std::string> names;
  for (const Body& body : scenario.bodies) names.insert(body.name);
  for (std::size_t i = 0; i < scenario.orifices.size(); ++i) {
    const MovingOrifice& orifice = scenario.orifices[i];
    const std::string path = at("orifices", i);
    if (orifice.name.empty() || !names.insert(orifice.name).second)
      throw InputError(path + ".name", orifice.name.empty() ? "nothing" : orifice.name,
                       "a name that no other orifice and no body has");
    try {
      check_orifice(orifice, scenario.duration);
    } catch (const InputError& e) {
      throw e.within(path);
    }
  }
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const Body& body = scenario.bodies[i];
    const bool flown = body.pilot || body.vehicle;
    const bool whole = body.shape.rigid() && body.shape.rigid()->placed();
    for (const MovingOrifice& orifice : scenario.orifices)
      if (flown && whole && orifice.window)
        throw InputError(
            at("bodies", i) + ".shape", "a mesh, a cloud, a map or a union",
            "an ellipsoid, a body with dents or a hull, where " + orifice.name + " is a window of a mesh");
  }
  if (!scenario.orifices.empty() && !scenario.bodies.empty() && planar(scenario.bodies.front().shape))
    throw InputError("orifices", "given", "left out beside planar bodies: an opening is in space");
}

}  // namespace

double time_of_step(const Scenario& scenario, std::uint64_t k) {
  const double in_a_second = std::round(1 / scenario.step);
  const bool whole = !scenario.multiples && std::abs(in_a_second * scenario.step - 1) < 1e-15;
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
