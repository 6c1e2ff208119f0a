// SPDX-License-Identifier: BSD-3-Clause
//
// What a paper measures on: runs of its scenarios and what commands print, each carried out once.
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

#include "json/json_value.h"
#include "measures/table.h"

namespace vericone::paper {

struct PaperRun {
  std::filesystem::path file;
  std::string text;  // of the scenario: the file's, or what changes made of it
  Json fields;       // of the scenario
  simulation::Scenario scenario;
  simulation::Run run;
  double seconds = 0;  // that it took

  /// Index of a body in the scenario. Throws InputError naming `path`.
  std::size_t index_of(const std::string& body, const std::string& path) const;
  /// bodies, encounters, planes, sights, orifices, vehicles and events as `vericone simulate` writes them
  /// (docs/reference/scenarios.md), and proofs: every pair in both orders; passages: every one. encounters,
  /// planes and sights have a column `passed` more: when the run says that the agent passes that obstacle.
  /// Throws InputError naming `path` where there is no such table.
  const Table& table(const std::string& name, const std::string& path) const;
  /// An encounter at every step from when both are there to the end of the run, whatever the run itself logs
  /// of it: the slices' cone on the plane where they open most. Columns t, r, y, psi, theta, theta_b, V_r,
  /// V_theta, V_r_hat, V_theta_hat and passed. Ends where there is no cone: the bodies have met.
  const Table& looks(const std::string& agent, const std::string& obstacle, const std::string& path) const;
  /// Whether the relative velocity is in the cone that the agent's law sees, at the time t.
  bool on_course(const std::string& agent, const std::string& obstacle, double t,
                 const std::string& path) const;

 private:
  mutable std::map<std::string, Table> tables_;
  mutable std::map<std::pair<std::string, std::string>, Table> looks_;
};

/// Inputs that are not the paper's, in some of its scenarios.
struct Changes {
  std::set<std::string> scenarios;
  std::filesystem::path file;  // in place of theirs; empty: none
  /// Paths of fields (pointer_to) with their values as YAML: "bodies.F1.pilot.gain", "8".
  std::vector<std::pair<std::string, std::string>> values;

  bool any() const { return !file.empty() || !values.empty(); }
};
/// PATH=VALUE. Throws InputError naming `option`.
std::pair<std::string, std::string> read_change(const std::string& text, const std::string& option);

/// Where a path of words with dots between them leads; nothing where there is no such field. Elements of
/// lists by their number or by their name.
std::optional<Json::json_pointer> pointer_to(const Json& fields, const std::string& path);
/// `text`: the value, as YAML. Throws InputError naming --set where the field's parent is not there.
void set_field(Json& fields, const std::string& path, const std::string& text);

/// Called with what is under way and its share; false interrupts, and the caller throws Interrupted.
using Show = std::function<bool(const std::string& what, double share)>;

class Sources {
 public:
  /// `folder`: of the paper.
  Sources(std::filesystem::path folder, Show show, Changes changes = {});
  ~Sources();

  /// By the name of its file in scenarios, without extension. Throws InputError of the scenario, or naming
  /// `path`.
  const PaperRun& run(const std::string& scenario, const std::string& path);
  /// Carries out commands of one thread each, so many at the same time; files() and table() then have them.
  void prepare(const std::vector<std::string>& commands, int threads, const std::string& path);
  /// The folder that `vericone WORDS --out ...` wrote, carried out in the paper's folder; there as long as
  /// this is.
  std::filesystem::path files(const std::string& words, const std::string& path);
  /// A table that `vericone WORDS --out ...` writes, carried out in the paper's folder. Throws InputError
  /// naming `path`.
  const Table& table(const std::string& words, const std::string& file, const std::string& path);
  /// What `vericone WORDS --json` prints.
  const Json& answer(const std::string& words, const std::string& path);

  const std::filesystem::path& folder() const { return folder_; }
  const Show& show() const { return show_; }

 private:
  struct Carried;

  /// What a command printed and wrote. `files`: whether it has to have written some.
  const Carried& carried(const std::string& words, bool files, const std::string& path);
  std::unique_ptr<Carried> carry_out(const std::string& words, bool files, const std::string& path) const;

  std::filesystem::path folder_;
  Show show_;
  Changes changes_;
  std::map<std::string, std::unique_ptr<PaperRun>> runs_;
  std::map<std::string, std::unique_ptr<Carried>> carried_;  // each command once, by its words
  std::map<std::pair<std::string, std::string>, Table> tables_;
};

}  // namespace vericone::paper
