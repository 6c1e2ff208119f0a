// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/guide.h>
#include <vericone/guidance/plane_view.h>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "input/fields.h"
#include "measures/measure.h"

namespace vericone::paper {
namespace {

using Names = std::map<std::string, double>;

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
  const simulation::Scenario& scenario = run.scenario;
  const simulation::Body &first = scenario.bodies[run.index_of(agent, path + ".agent")],
                         &second = scenario.bodies[run.index_of(obstacle, path + ".obstacle")];
  if (!first.pilot) throw InputError(path + ".agent", agent, "a body with a pilot, whose limit and mu hold");
  const guidance::GuideOptions& options = first.pilot->guide;
  const double most = options.inversion.most;
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
    simulation::Track a(first.shape, first.start, first.orientation, first.appears),
        b(second.shape, second.start, second.orientation, second.appears);
    const double from = std::max(first.appears, second.appears);
    for (const auto& [track, appears] : {std::pair(&a, first.appears), std::pair(&b, second.appears)})
      if (appears < from) track->advance(Eigen::Vector3d::Zero(), from);
    for (std::int64_t k = 0; from + double(k) * scenario.step < trial.until; ++k) {
      const double t = from + double(k) * scenario.step,
                   to = std::min(trial.until, from + double(k + 1) * scenario.step);
      const guidance::BodyState at_a = a.state(t), at_b = b.state(t);
      Eigen::Vector3d command_a = Eigen::Vector3d::Zero(), command_b = command_a;
      const auto across = guidance::choose_plane(at_a, at_b, guidance::SectorMethod::slice, {});
      const auto view = across ? guidance::plane_view(at_a, at_b, *across, guidance::SectorMethod::slice,
                                                      guidance::RateMethod::analytic)
                               : std::nullopt;
      if (!view) break;  // slices meet: the bodies do as well
      const guidance::ConeRates rates = guidance::cone_rates(view->state, view->cone);
      if (rates.colliding()) {
        Names names = set;
        names["mu"] = options.mu;
        name_view(names, *view, rates);
        for (const auto& [name, formula] : trial.with) names[name] = value(formula, names);
        double command = value(trial.command, names);
        if (!std::isfinite(command)) command = most;  // where the law divides by 0 it is saturated
        command = std::clamp(command, -most, most);
        command_a = command * view->lateral_a();
        command_b = options.mu * command * view->lateral_b();
      }
      a.advance(command_a, to);
      b.advance(command_b, to);
    }
    const simulation::PairProof proof =
        simulation::prove(a, b, from, std::min(a.end(), b.end()), scenario.proof);
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
