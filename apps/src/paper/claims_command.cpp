// SPDX-License-Identifier: BSD-3-Clause
#include "paper/claims_command.h"

#include <vericone/geometry/error.h>
#include <vericone/work/staged_folder.h>
#include <iomanip>
#include <iostream>
#include <optional>
#include <ostream>

#include "commands.h"
#include "output/output_file.h"
#include "output/progress.h"
#include "paper/claim.h"
#include "paper/paper.h"
#include "paper/shuffle.h"
#include "work/interrupt.h"
#include "work/provenance.h"

namespace vericone::paper {
namespace {

std::string outcome(const Fit& fit) {
  return std::to_string(fit.explains) + " of " + std::to_string(fit.claims) +
         " statements that rest on it come out" +
         (fit.unmeasured > 0 ? ", " + std::to_string(fit.unmeasured) + " not measured here" : "");
}

void print_table(const std::vector<Claim>& claims, bool given, std::ostream& out) {
  for (const Claim& c : claims) {
    if (c.kind == Kind::given && !given) continue;
    out << c.id << ": " << c.what << '\n'
        << "  printed     " << c.printed << '\n'
        << "  ours        " << c.ours << '\n';
    if (c.tolerance)
      out << "  tolerance   " << short_text(*c.tolerance, 3) << " (" << c.tolerance_reason << ")\n";
    out << "  verdict     " << to_string(c.verdict) << '\n';
    for (const auto& fit : c.fits) out << "  fit         " << fit->text() << "; " << outcome(*fit) << '\n';
    out << "  note        " << c.note << '\n';
  }
  const Json counts = count_verdicts(claims);
  for (const auto& [kind, row] : counts.items()) {
    std::string list;
    for (const auto& [verdict, count] : row.items())
      if (count.get<int>() > 0)
        list.append(list.empty() ? "" : ", ").append(std::to_string(count.get<int>()) + " " + verdict);
    if (!list.empty()) out << std::left << std::setw(29) << kind << list << '\n';
  }
}

}  // namespace

int run_claims(const ClaimsOptions& options, std::ostream& out) {
  Paper paper(options.paper);
  const Which which = paper.claims_named(options.ids);
  std::optional<work::StagedFolder> folder;
  if (!options.out.empty()) folder.emplace(options.out, "--out");
  std::vector<Claim> claims;
  try {
    Progress progress(options.quiet);
    Sources sources(paper.folder, [&](const std::string& what, double share) {
      return progress.show("measuring " + what, share);
    });
    if (options.shuffle > 0) return shuffle_claims(options, paper, which, progress, out);
    claims = paper.measured_claims(sources, which);
  } catch (const Interrupted&) {
    return kExitInterrupted;
  }
  const Json json = claims_json(claims, paper, which, options.command_line, {});
  if (folder) {
    write_whole(folder->path() / "claims.json", json.dump(1) + "\n");
    folder->publish({"claims.json"});
  }
  if (options.json)
    out << json.dump(1) << '\n';
  else {
    print_table(claims, options.given, out);
    for (const auto& [command, count] : paper.left_out(which))
      out << std::left << std::setw(12) << "not measured" << ' ' << count
          << ", for want of the program vericone-" << command << '\n';
  }
  return 0;
}

}  // namespace vericone::paper

namespace vericone {

int claims_command(CommandLine& line) {
  paper::ClaimsOptions claims;
  line.option("claims", claims.ids, "Of these claims or sections, such as 5.4.1 or 7; all if not given");
  line.option("--paper", claims.paper,
              "Its folder, or the name of one of ours; papers/dhal2022 if not given");
  line.option("--out", claims.out, "Also write claims.json to this folder");
  line.flag("--json", claims.json, "Print JSON");
  line.flag("--given", claims.given, "Also list the printed values that go into the runs");
  line.option("--shuffle", claims.shuffle,
              "Draw the chosen numbers so often from their ranges: what holds throughout, what at one place")
      .within(0, 100000);
  line.option("--only", claims.only, "Shuffle the numbers of this fit alone").one_each();
  line.option("--seed", claims.seed, "Of the draws");
  line.flag("--quiet", claims.quiet, "No progress");
  line.read();
  claims.command_line = line.text();
  return paper::run_claims(claims, std::cout);
}

}  // namespace vericone
