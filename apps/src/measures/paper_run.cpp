// SPDX-License-Identifier: BSD-3-Clause
#include "measures/sources.h"

#include <vericone/guidance/guide.h>
#include <vericone/guidance/plane_view.h>
#include <vericone/internal/guidance/collision_course.h>
#include <vericone/internal/simulation/run_tables.h>
#include <vericone/simulation/run_tables.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "input/fields.h"
#include "input/scene.h"
#include "input/stopwatch.h"
#include "scenarios/read_scenario.h"

namespace vericone::paper {
namespace {

Table proofs_of(const simulation::Scenario& scenario, const simulation::Run& run) {
  Table table;
  for (const simulation::PairOutcome& pair : run.proofs)
    for (const auto& [a, b] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
      const simulation::PairProof& proof = pair.proof;
      const bool avoided = proof.verdict == simulation::ProofVerdict::avoided;
      ++table.rows;
      table.words["agent"].push_back(scenario.bodies[a].name);
      table.words["obstacle"].push_back(scenario.bodies[b].name);
      table.numbers["avoided"].push_back(avoided);
      table.numbers["touched"].push_back(proof.verdict == simulation::ProofVerdict::touched);
      table.numbers["undecided"].push_back(proof.verdict == simulation::ProofVerdict::undecided);
      table.numbers["from"].push_back(proof.from);
      table.numbers["to"].push_back(proof.to);
      table.numbers["least_distance"].push_back(avoided ? proof.least_distance : kNothing);
      table.numbers["least_time"].push_back(avoided ? proof.least_time : kNothing);
    }
  return table;
}

Table passages_of(const simulation::Scenario& scenario, const simulation::Run& run) {
  Table table;
  for (const simulation::PassageOutcome& passage : run.passages) {
    using enum simulation::PassageVerdict;
    const simulation::PassageProof& proof = passage.proof;
    ++table.rows;
    table.words["agent"].push_back(scenario.bodies[passage.agent].name);
    table.words["orifice"].push_back(scenario.orifices[passage.orifice].name);
    for (const auto verdict : {passed, touched, missed, undecided})
      table.numbers[to_string(verdict)].push_back(proof.verdict == verdict);
    table.numbers["time"].push_back(proof.verdict == passed ? proof.time : kNothing);
    table.numbers["from"].push_back(proof.from);
    table.numbers["to"].push_back(proof.to);
    table.numbers["least_distance"].push_back(
        proof.verdict == passed || proof.verdict == missed ? proof.least_distance : kNothing);
  }
  return table;
}

double passed(const PaperRun& run, const std::string& agent, const std::string& obstacle) {
  const auto event =
      simulation::find_event(run.scenario, run.run, simulation::EventKind::passes, agent, obstacle);
  return event ? event->t : kNothing;
}

void add_passed(Table& table, const PaperRun& run) {
  if (!table.words.contains("agent")) return;  // of no rows
  std::map<std::pair<std::string, std::string>, double> times;
  for (std::size_t i = 0; i < table.rows; ++i) {
    const std::pair pair(table.words["agent"][i], table.words["obstacle"][i]);
    if (!times.contains(pair)) times[pair] = passed(run, pair.first, pair.second);
    table.numbers["passed"].push_back(times[pair]);
  }
}

}  // namespace

std::size_t PaperRun::index_of(const std::string& body, const std::string& path) const {
  std::string names;
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    if (scenario.bodies[i].name == body) return i;
    names.append(i ? ", " : "").append(scenario.bodies[i].name);
  }
  throw InputError(path, body, "a body of the scenario " + file.stem().string() + ": " + names);
}

const Table& PaperRun::table(const std::string& name, const std::string& path) const {
  if (const auto it = tables_.find(name); it != tables_.end()) return it->second;
  using MakeTable = simulation::Table (*)(const simulation::Scenario&, const simulation::Run&);
  constexpr std::pair<const char*, MakeTable> kTables[] = {
      {"bodies", simulation::bodies_table},    {"encounters", simulation::encounters_table},
      {"planes", simulation::planes_table},    {"sights", simulation::sights_table},
      {"events", simulation::events_table},    {"orifices", simulation::orifices_table},
      {"vehicles", simulation::vehicles_table}};
  const auto of_run = std::find_if(std::begin(kTables), std::end(kTables),
                                   [&](const auto& entry) { return name == entry.first; });
  Table made;
  if (of_run != std::end(kTables))
    made = table_of(of_run->second(scenario, run));
  else if (name == "proofs")
    made = proofs_of(scenario, run);
  else if (name == "passages")
    made = passages_of(scenario, run);
  else
    throw InputError(
        path, name,
        "bodies, encounters, planes, sights, orifices, vehicles, events, looks, proofs or passages");
  if (name == "encounters" || name == "planes" || name == "sights") add_passed(made, *this);
  return tables_.emplace(name, std::move(made)).first->second;
}

const Table& PaperRun::looks(const std::string& agent, const std::string& obstacle,
                             const std::string& path) const {
  const auto [it, fresh] = looks_.try_emplace({agent, obstacle});
  Table& table = it->second;
  if (!fresh) return table;
  const simulation::Track &a = run.tracks[index_of(agent, path + ".agent")],
                          &b = run.tracks[index_of(obstacle, path + ".obstacle")];
  if (&a == &b) throw InputError(path + ".obstacle", obstacle, "another body than the agent");
  const double from = std::max(a.appears(), b.appears()), past = passed(*this, agent, obstacle);
  for (const char* name :
       {"t", "r", "y", "psi", "theta", "theta_b", "V_r", "V_theta", "V_r_hat", "V_theta_hat", "passed"})
    table.numbers[name];
  for (std::int64_t k = std::int64_t(std::ceil(from / scenario.step - 1e-9));; ++k) {
    const double t = std::max(from, simulation::time_of_step(scenario, std::uint64_t(k)));
    if (t > run.end || t > a.end() || t > b.end()) break;
    const guidance::BodyState at_a = a.state(t), at_b = b.state(t);
    const auto across = guidance::choose_plane(at_a, at_b, guidance::SectorMethod::slice, {});
    if (!across) continue;
    const auto view =
        guidance::plane_view(at_a, at_b, *across, guidance::SectorMethod::slice, guidance::RateMethod::none);
    if (!view) break;
    const guidance::ConeRates rates = guidance::cone_rates(view->state, view->cone);
    ++table.rows;
    for (const auto& [name, value] :
         {std::pair("t", t), std::pair("r", view->state.r), std::pair("y", rates.y),
          std::pair("psi", view->cone.psi),
          std::pair("theta", std::atan2(view->line_of_sight.y(), view->line_of_sight.x())),
          std::pair("theta_b", view->cone.theta_b), std::pair("V_r", view->state.v_r),
          std::pair("V_theta", view->state.v_theta), std::pair("V_r_hat", rates.v_r_hat),
          std::pair("V_theta_hat", rates.v_theta_hat), std::pair("passed", past)})
      table.numbers[name].push_back(value);
  }
  return table;
}

bool PaperRun::on_course(const std::string& agent, const std::string& obstacle, double t,
                         const std::string& path) const {
  const std::size_t i = index_of(agent, path + ".agent"), j = index_of(obstacle, path + ".obstacle");
  const simulation::Track &a = run.tracks[i], &b = run.tracks[j];
  if (!(t >= std::max(a.appears(), b.appears()) && t <= std::min(a.end(), b.end())))
    throw InputError(path + ".course", to_text(t), "a time, in seconds, at which both bodies are there");
  const auto& pilot = scenario.bodies[i].pilot;
  const guidance::SectorMethod sector = pilot ? pilot->guide.sector : guidance::SectorMethod::true_cone;
  return guidance::on_collision_course(a.state(t), b.state(t), sector).value_or(false);
}

namespace {

/// The key or index of what a word names in a mapping or list; nothing where there is none.
std::optional<std::string> key_of(const Json& value, const std::string& word) {
  if (value.is_object() && value.contains(word)) return word;
  if (!value.is_array()) return std::nullopt;
  for (std::size_t i = 0; i < value.size(); ++i)
    if (word == std::to_string(i) || (value[i].is_object() && value[i].value("name", Json()) == Json(word)))
      return std::to_string(i);
  return std::nullopt;
}

}  // namespace

std::optional<Json::json_pointer> pointer_to(const Json& fields, const std::string& path) {
  Json::json_pointer pointer;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t dot = std::min(path.find('.', begin), path.size());
    const auto key = key_of(fields.at(pointer), path.substr(begin, dot - begin));
    if (!key) return std::nullopt;
    pointer /= *key;
    begin = dot + 1;
  }
  return pointer;
}

void set_field(Json& fields, const std::string& path, const std::string& text) {
  const std::size_t dot = path.rfind('.');
  const std::string parent = path.substr(0, dot == std::string::npos ? 0 : dot), last = path.substr(dot + 1);
  const auto above = pointer_to(fields, parent), there = pointer_to(fields, path);
  if (!there && (!above || !fields.at(*above).is_object()))
    throw InputError("--set", path, "a field of the scenario: there is no " + (above ? path : parent));
  fields[there ? *there : *above / last] =
      input::scene_fields("value: " + text + "\n", "--set " + path)["value"];
}

std::pair<std::string, std::string> read_change(const std::string& text, const std::string& option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw InputError(option, text, "PATH=VALUE, such as bodies.F1.pilot.gain=8");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace vericone::paper
