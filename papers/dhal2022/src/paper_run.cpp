// SPDX-License-Identifier: BSD-3-Clause
#include "paper_run.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "simulate/read_scenario.h"

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

PaperRuns::PaperRuns(std::filesystem::path scenarios, RunProgress progress)
    : scenarios_(std::move(scenarios)), progress_(std::move(progress)) {}

const PaperRun& PaperRuns::run(const std::string& name) {
  std::unique_ptr<PaperRun>& run = runs_[name];
  if (run) return *run;
  auto made = std::make_unique<PaperRun>();
  made->file = scenarios_ / (name + ".yaml");
  made->scenario = scenario::read_scenario(made->file.string());
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
