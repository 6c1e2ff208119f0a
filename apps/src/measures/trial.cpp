// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/guide.h>
#include <vericone/guidance/plane_view.h>
#include <vericone/simulation/run.h>
#include <algorithm>
#include <cmath>
#include <optional>

#include "input/fields.h"
#include "measures/measure.h"

namespace vericone::paper {
namespace {

using Names = std::map<std::string, double>;
using guidance::BodyState;

/// What a law may use, on the plane of the largest psi of slices, at one command.
void name_view(Names& names, const guidance::PlaneView& view, const guidance::ConeRates& rates) {
  const guidance::PlanarState& s = view.state;
  names["r"] = s.r;
  names["y"] = rates.y;
  names["V_r"] = s.v_r;
  names["V_theta"] = s.v_theta;
  names["V_r_hat"] = rates.v_r_hat;
  names["V_theta_hat"] = rates.v_theta_hat;
  names["alpha"] = s.alpha - s.theta;
  names["beta"] = s.beta - s.theta;
  names["psi"] = view.cone.psi;
  names["theta_b"] = view.cone.theta_b - s.theta;
  names["psi_rate"] = view.cone.psi_rate;
  names["theta_b_rate"] = view.cone.theta_b_rate;
}

}  // namespace

Table fly_trials(const PaperRun& run, const std::string& agent, const std::string& obstacle,
                 const Trial& trial, const std::string& path,
                 const std::function<double(const std::string&, const Expression&)>& named) {
  simulation::Scenario scenario;
  for (const auto& [name, field] : {std::pair(agent, ".agent"), std::pair(obstacle, ".obstacle")}) {
    scenario.bodies.push_back(run.scenario.bodies[run.index_of(name, path + field)]);
    scenario.bodies.back().vehicle.reset();
    scenario.bodies.back().road.reset();
  }
  simulation::Body &first = scenario.bodies[0], &second = scenario.bodies[1];
  if (!first.pilot) throw InputError(path + ".agent", agent, "a body with a pilot, whose limit and mu hold");
  const guidance::GuideOptions options = first.pilot->guide;
  const double most = options.inversion.most;
  scenario.step = run.scenario.step;
  scenario.multiples = true;
  scenario.duration = trial.until;
  const double from = std::max(first.appears, second.appears);
  Table table;
  for (const Names& set : trial.sets) {
    const auto value = [&](const Expression& formula, const Names& names) {
      std::vector<double> values;
      for (const std::string& name : formula.names()) {
        const auto known = names.find(name);
        values.push_back(known == names.end() ? named(name, formula) : known->second);
      }
      return formula.value(values);
    };
    std::optional<double> met;  // s, when slices meet: the bodies do as well
    Eigen::Vector3d of_obstacle;
    const auto steer = [&](double t, const BodyState& a, const std::vector<BodyState>& others) {
      Eigen::Vector3d of_agent = of_obstacle = Eigen::Vector3d::Zero();
      if (others.empty()) return of_agent;
      const auto across = guidance::choose_plane(a, others[0], guidance::SectorMethod::slice, {});
      const auto view = across ? guidance::plane_view(a, others[0], *across, guidance::SectorMethod::slice,
                                                      guidance::RateMethod::analytic)
                               : std::nullopt;
      if (!view) {
        met = t;
        return of_agent;
      }
      const guidance::ConeRates rates = guidance::cone_rates(view->state, view->cone);
      if (!rates.colliding()) return of_agent;
      Names names = set;
      names["mu"] = options.mu;
      name_view(names, *view, rates);
      for (const auto& [name, formula] : trial.with) names[name] = value(formula, names);
      double command = value(trial.command, names);
      if (!std::isfinite(command)) command = most;  // where the law divides by 0 it is saturated
      command = std::clamp(command, -most, most);
      of_obstacle = options.mu * command * view->lateral_b();
      return Eigen::Vector3d(command * view->lateral_a());
    };
    first.pilot.emplace().own = simulation::pilot_by(steer);
    second.pilot.emplace().own =
        simulation::pilot_by([&](double, const BodyState&, const auto&) { return of_obstacle; });
    simulation::RunOptions flight;
    flight.prove = flight.log = false;
    flight.progress = [&](double) { return !met; };
    const simulation::Run flown = simulation::simulate(scenario, flight);
    const simulation::PairProof proof = simulation::prove(flown.tracks[0], flown.tracks[1], from,
                                                          met.value_or(flown.end), run.scenario.proof);
    const bool touched = proof.verdict == simulation::ProofVerdict::touched;
    ++table.rows;
    for (const auto& [name, x] : set) table.numbers[name].push_back(x);
    table.numbers["touched"].push_back(touched);
    table.numbers["avoided"].push_back(proof.verdict == simulation::ProofVerdict::avoided);
    table.numbers["to"].push_back(touched ? proof.to : kNothing);
  }
  return table;
}

}  // namespace vericone::paper
