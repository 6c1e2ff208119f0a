// SPDX-License-Identifier: BSD-3-Clause
#include "paper_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>

#include "input/scene.h"
#include "json/json_value.h"
#include "scenarios/read_scenario.h"

namespace vericone::dhal2022 {

namespace {

std::size_t index_of(const simulation::Scenario& scenario, const std::string& name) {
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i)
    if (scenario.bodies[i].name == name) return i;
  throw std::logic_error("no body " + name + " in " + scenario.name);
}

}  // namespace

const simulation::Body& PaperRun::body(const std::string& name) const {
  return scenario.bodies[index_of(scenario, name)];
}

const simulation::Track& PaperRun::track(const std::string& name) const {
  return run.tracks[index_of(scenario, name)];
}

simulation::EncounterSample PaperRun::sample(const std::string& agent, const std::string& obstacle,
                                             double t) const {
  const auto found = simulation::sample_at(scenario, run, agent, obstacle, t);
  if (!found) throw std::runtime_error(scenario.name + ": no sample of " + agent + " and " + obstacle);
  return *found;
}

std::optional<double> PaperRun::time_of(simulation::EventKind kind, const std::string& agent,
                                        const std::string& obstacle, double after) const {
  const auto event = simulation::find_event(scenario, run, kind, agent, obstacle, after);
  return event ? std::optional<double>(event->t) : std::nullopt;
}

const std::vector<Look>& PaperRun::looks(const std::string& agent, const std::string& obstacle) const {
  const auto [it, fresh] = looks_.try_emplace({agent, obstacle});
  std::vector<Look>& looks = it->second;
  if (!fresh) return looks;
  const simulation::Track &a = track(agent), &b = track(obstacle);
  const double from = std::max(a.appears(), b.appears());
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
    looks.push_back({t, rates.y, rates.v_r_hat, view->cone.psi, view->state.v_r});
  }
  if (looks.empty()) throw std::runtime_error(scenario.name + ": no cone of " + agent + " and " + obstacle);
  return looks;
}

bool PaperRun::engaged(const std::string& agent, const std::string& obstacle) const {
  const std::size_t i = index_of(scenario, agent), j = index_of(scenario, obstacle);
  return std::any_of(run.encounters.begin(), run.encounters.end(), [&](const auto& sample) {
    return sample.agent == i && sample.obstacle == j && sample.attended && sample.step.a.norm() > 0;
  });
}

std::string reentries(const std::vector<Look>& looks) {
  int times = 0;
  double last_out = 0;
  bool out = false, inside = true;
  for (const Look& look : looks) {
    if (look.inside()) {
      times += out && !inside;
    } else {
      if (inside) last_out = look.t;
      out = true;
    }
    inside = look.inside();
  }
  if (times == 0) return "";
  char text[96];
  std::snprintf(text, sizeof text, "; in the cone again %d %s, last out at %.4g s", times,
                times == 1 ? "time" : "times", last_out);
  return text;
}

double PaperRun::most_acceleration(const std::string& body, double from, double to) const {
  double most = 0;
  for (const simulation::Arc& arc : track(body).arcs())
    if (arc.from() >= from && arc.to() <= to) most = std::max(most, arc.acceleration(arc.from()).norm());
  return most;
}

std::optional<simulation::PairProof> PaperRun::proof(const std::string& a, const std::string& b) const {
  const std::size_t i = index_of(scenario, a), j = index_of(scenario, b);
  for (const simulation::PairOutcome& pair : run.proofs)
    if ((pair.a == i && pair.b == j) || (pair.a == j && pair.b == i)) return pair.proof;
  return std::nullopt;
}

namespace {

/// The element of a mapping or list that a word names; nothing where there is none.
Json* element(Json& value, const std::string& word) {
  if (value.is_object()) return value.contains(word) ? &value[word] : nullptr;
  if (!value.is_array()) return nullptr;
  for (std::size_t i = 0; i < value.size(); ++i)
    if (word == std::to_string(i) || (value[i].is_object() && value[i].value("name", Json()) == Json(word)))
      return &value[i];
  return nullptr;
}

void set_field(Json& fields, const std::string& path, const std::string& text) {
  Json* at = &fields;
  std::size_t begin = 0;
  for (std::size_t dot; (dot = path.find('.', begin)) != std::string::npos; begin = dot + 1) {
    at = element(*at, path.substr(begin, dot - begin));
    if (at == nullptr)
      throw InputError("--set", path, "a field of the scenario: there is no " + path.substr(0, dot));
  }
  const std::string last = path.substr(begin);
  const Json value = input::scene_fields("value: " + text + "\n", "--set " + path)["value"];
  if (Json* there = element(*at, last)) {
    *there = value;
  } else if (at->is_object()) {
    (*at)[last] = value;
  } else {
    throw InputError("--set", path, "a field of the scenario: there is no " + path);
  }
}

}  // namespace

std::pair<std::string, std::string> read_change(const std::string& text, const std::string& option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw InputError(option, text, "PATH=VALUE, such as bodies.F1.pilot.gain=8");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

PaperRuns::PaperRuns(std::filesystem::path scenarios, RunProgress progress, Changes changes)
    : scenarios_(std::move(scenarios)), progress_(std::move(progress)), changes_(std::move(changes)) {}

const PaperRun& PaperRuns::run(const std::string& name) {
  std::unique_ptr<PaperRun>& run = runs_[name];
  if (run) return *run;
  auto made = std::make_unique<PaperRun>();
  const bool changed = changes_.scenarios.contains(name);
  made->file = changed && !changes_.file.empty() ? changes_.file : scenarios_ / (name + ".yaml");
  made->text = input::read_scene_text(made->file.string());
  Json fields = input::scene_fields(made->text, made->file.string());
  if (changed && !changes_.values.empty()) {
    for (const auto& [path, value] : changes_.values) set_field(fields, path, value);
    made->text = fields.dump(1) + "\n";  // JSON is YAML
  }
  made->scenario = scenario::read_scenario(fields, made->file.stem().string());
  simulation::RunOptions options;
  if (progress_) options.progress = [&](double t) { return progress_(name, t / made->scenario.duration); };
  const auto start = std::chrono::steady_clock::now();
  made->run = simulation::simulate(made->scenario, options);
  made->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (made->run.interrupted) throw Interrupted{};
  run = std::move(made);
  return *run;
}

}  // namespace vericone::dhal2022
