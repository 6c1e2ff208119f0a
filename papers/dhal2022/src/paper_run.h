// SPDX-License-Identifier: BSD-3-Clause
//
// Runs of the paper's scenarios, each carried out once, and what is read from them.
#pragma once

#include <vericone/simulation/run.h>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace vericone::dhal2022 {

struct PaperRun {
  std::filesystem::path file;
  simulation::Scenario scenario;
  simulation::Run run;
  double seconds = 0;  // that it took

  const simulation::Body& body(const std::string& name) const;
  const simulation::Track& track(const std::string& name) const;
  /// y, psi, ... of an encounter at a time; throws std::runtime_error where there is no sample.
  simulation::EncounterSample sample(const std::string& agent, const std::string& obstacle, double t) const;
  std::optional<double> time_of(simulation::EventKind kind, const std::string& agent,
                                const std::string& obstacle, double after = 0) const;
  /// Largest |a| of a body over [from, to] at the times of its commands, m/s^2.
  double most_acceleration(const std::string& body, double from, double to) const;
  /// Of a pair of bodies, in any order; nothing where none was asked for.
  std::optional<simulation::PairProof> proof(const std::string& a, const std::string& b) const;
};

/// `progress`: called with the scenario's name and the share of its duration; false interrupts, and run()
/// throws Interrupted.
struct Interrupted {};
using RunProgress = std::function<bool(const std::string& scenario, double share)>;

class PaperRuns {
 public:
  PaperRuns(std::filesystem::path scenarios, RunProgress progress);
  /// By the scenario file's name without extension. Throws InputError of the scenario.
  const PaperRun& run(const std::string& scenario);

 private:
  std::filesystem::path scenarios_;
  RunProgress progress_;
  std::map<std::string, std::unique_ptr<PaperRun>> runs_;
};

}  // namespace vericone::dhal2022
