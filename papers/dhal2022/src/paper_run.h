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
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace vericone::dhal2022 {

/// An encounter as the source looks at it: slices, on the plane where they open most.
struct Look {
  double t = 0, y = 0, v_r_hat = 0;
  double psi = 0;  // rad
  double v_r = 0;  // m/s, of the centres

  bool inside() const { return y < 0 && v_r_hat < 0; }  // (5.1)
  bool receding() const { return v_r_hat >= 0; }
  bool clear() const { return y > 0 && receding(); }
};

struct PaperRun {
  std::filesystem::path file;
  std::string text;  // of the scenario: the file's, or what changes made of it
  simulation::Scenario scenario;
  simulation::Run run;
  double seconds = 0;  // that it took

  const simulation::Body& body(const std::string& name) const;
  const simulation::Track& track(const std::string& name) const;
  /// y, psi, ... of an encounter at a time; throws std::runtime_error where there is no sample.
  simulation::EncounterSample sample(const std::string& agent, const std::string& obstacle, double t) const;
  std::optional<double> time_of(simulation::EventKind kind, const std::string& agent,
                                const std::string& obstacle, double after = 0) const;
  /// At every step from when both are there to the end of the run, whatever the run itself logs of it: from
  /// the tracks. Ends where there is no cone: the bodies have met.
  const std::vector<Look>& looks(const std::string& agent, const std::string& obstacle) const;
  /// Whether the agent ever steered against that obstacle.
  bool engaged(const std::string& agent, const std::string& obstacle) const;
  /// Largest |a| of a body over [from, to] at the times of its commands, m/s^2.
  double most_acceleration(const std::string& body, double from, double to) const;
  /// Of a pair of bodies, in any order; nothing where none was asked for.
  std::optional<simulation::PairProof> proof(const std::string& a, const std::string& b) const;

 private:
  mutable std::map<std::pair<std::string, std::string>, std::vector<Look>> looks_;
};

/// The first look with the property, at or after a time: the source prints times of such samples.
template <class Property>
const Look* first_look(const std::vector<Look>& looks, Property property, double after = 0) {
  for (const Look& look : looks)
    if (look.t >= after - 1e-9 && property(look)) return &look;
  return nullptr;
}
template <class Property>
std::optional<double> first_time(const std::vector<Look>& looks, Property property, double after = 0) {
  const Look* look = first_look(looks, property, after);
  return look ? std::optional<double>(look->t) : std::nullopt;
}

/// "; in the cone again N times, last out at T s", of looks after the first outside; empty where it never is.
std::string reentries(const std::vector<Look>& looks);

/// `progress`: called with the scenario's name and the share of its duration; false interrupts, and run()
/// throws Interrupted.
struct Interrupted {};
using RunProgress = std::function<bool(const std::string& scenario, double share)>;

/// Inputs that are not the paper's, in some of its scenarios.
struct Changes {
  std::set<std::string> scenarios;
  std::filesystem::path file;  // in place of theirs; empty: none
  /// Paths of fields with their values as YAML: "bodies.F1.pilot.gain", "8". Elements of lists by their
  /// number or by their name. The field's parent has to be there.
  std::vector<std::pair<std::string, std::string>> values;

  bool any() const { return !file.empty() || !values.empty(); }
};
/// PATH=VALUE. Throws InputError naming `option`.
std::pair<std::string, std::string> read_change(const std::string& text, const std::string& option);

class PaperRuns {
 public:
  PaperRuns(std::filesystem::path scenarios, RunProgress progress, Changes changes = {});
  /// By the scenario file's name without extension. Throws InputError of the scenario.
  const PaperRun& run(const std::string& scenario);

 private:
  std::filesystem::path scenarios_;
  RunProgress progress_;
  Changes changes_;
  std::map<std::string, std::unique_ptr<PaperRun>> runs_;
};

}  // namespace vericone::dhal2022
