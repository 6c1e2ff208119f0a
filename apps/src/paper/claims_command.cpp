// SPDX-License-Identifier: BSD-3-Clause
#include "paper/claims_command.h"

#include <iomanip>
#include <optional>
#include <ostream>

#include "claims.h"
#include "json/json_value.h"
#include "output/interrupt.h"
#include "output/progress.h"
#include "output/provenance.h"
#include "output/staged_folder.h"
#include "paper/papers_folder.h"
#include "report.h"

namespace vericone {
namespace {

using dhal2022::Claim;

Json claims_json(const std::vector<Claim>& claims, const std::string& command_line) {
  Json list = Json::array();
  for (const Claim& claim : claims) list.push_back(dhal2022::to_json(claim));
  return {{"claims", list},
          {"verdicts", dhal2022::count_verdicts(claims)},
          {"provenance", provenance(command_line, 1, scenario_files())}};
}

void print_table(const std::vector<Claim>& claims, bool given, std::ostream& out) {
  for (const Claim& c : claims) {
    if (c.given && !given) continue;
    out << c.id << ": " << c.what << '\n'
        << "  printed     " << c.printed << '\n'
        << "  ours        " << c.ours << '\n';
    if (c.tolerance)
      out << "  tolerance   " << dhal2022::short_text(*c.tolerance, 3) << " (" << c.tolerance_reason << ")\n";
    out << "  verdict     " << to_string(c.verdict) << '\n';
    if (c.fit != nullptr)
      out << "  fit         " << c.fit->text() << "; " << c.fit_explains << " of " << c.fit_claims
          << " printed statements come out\n";
    out << "  note        " << c.note << '\n';
  }
  const Json counts = dhal2022::count_verdicts(claims);
  for (const auto& [kind, row] : counts.items()) {
    out << std::left << std::setw(12) << kind;
    std::string list;
    for (const auto& [verdict, count] : row.items())
      list.append(list.empty() ? "" : ", ").append(std::to_string(count.get<int>()) + " " + verdict);
    out << list << '\n';
  }
}

}  // namespace

int run_claims(const ClaimsOptions& options, std::ostream& out) {
  std::optional<StagedFolder> folder;
  if (!options.out.empty()) folder.emplace(options.out, "--out");
  std::vector<Claim> claims;
  try {
    Progress progress(options.quiet);
    const auto show = [&](const std::string& what, double share) {
      return progress.show("measuring " + what, share);
    };
    dhal2022::PaperRuns runs(papers_folder() / "dhal2022" / "scenarios", show);
    claims = dhal2022::measure_claims(runs, show);
  } catch (const dhal2022::Interrupted&) {
    return kExitInterrupted;
  }
  const Json json = claims_json(claims, options.command_line);
  if (folder) {
    write_whole(folder->path() / "claims.json", json.dump(1) + "\n");
    folder->publish({"claims.json"});
  }
  if (options.json)
    out << json.dump(1) << '\n';
  else
    print_table(claims, options.given, out);
  return 0;
}

}  // namespace vericone
