// SPDX-License-Identifier: BSD-3-Clause
#include "montecarlo/campaign_command.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>

#include "input/stopwatch.h"
#include "json/json_value.h"
#include "montecarlo/summary_text.h"
#include "output/figures.h"
#include "output/interrupt.h"
#include "output/output_file.h"
#include "output/provenance.h"
#include "output/resumable_table.h"
#include "output/staged_folder.h"
#include "output/threads.h"

namespace vericone::montecarlo {
namespace {

namespace fs = std::filesystem;

void require_positive(const char* option, double value, const char* unit) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(option, to_text(value), std::string("a positive number") + unit);
}

void validate(const CampaignOptions& o) {
  if (o.engagements < 1 || o.engagements > 100'000'000)
    throw InputError("--engagements", std::to_string(o.engagements), "between 1 and 100000000");
  threads_for(o.threads);
  require_positive("--most", o.most, " (m/s^2)");
  if (!(o.most < kUnlimited))
    throw InputError("--most", to_text(o.most),
                     "below " + to_text(kUnlimited) + " m/s^2, which is unlimited here");
  require_positive("--gain", o.gain, " (1/s)");
  if (!std::isfinite(o.reference)) throw InputError("--reference", to_text(o.reference), "a finite number");
  require_positive("--required", o.required, " (m)");
  require_positive("--step", o.step, " (s)");
  if (o.step < 1e-4) throw InputError("--step", to_text(o.step), "0.0001 s or more");
  for (std::size_t i = 0; i < o.laws.size(); ++i)
    if (std::count(o.laws.begin(), o.laws.end(), o.laws[i]) > 1)
      throw InputError("--laws", o.laws[i], "given once");
}

std::string settings_line(const CampaignOptions& o) {
  std::string laws;
  for (const std::string& name : o.laws) laws += (laws.empty() ? "" : "+") + name;
  return "# vericone campaign, seed " + std::to_string(o.seed) + ", " + std::to_string(o.engagements) +
         " engagements, laws " + laws + ", most " + to_text(o.most) + ", gain " + to_text(o.gain) +
         ", reference " + to_text(o.reference) + ", required " + to_text(o.required) + ", step " +
         to_text(o.step);
}

}  // namespace

int run_campaign(const CampaignOptions& options, std::ostream& out) {
  validate(options);
  const FlightSettings settings{options.step, options.most, options.gain, options.reference,
                                options.required};
  const std::vector<Flown> laws = flown_laws(options.laws, settings);
  StagedFolder folder(options.out, "--out");
  const auto start = Clock::now();
  ResumableTable table{folder, "engagements.csv"};
  table.settings = settings_line(options);
  table.header = csv_header(laws);
  table.count = options.engagements;
  table.threads = threads_for(options.threads);
  table.quiet = options.quiet;
  table.label = "engagements";
  table.row = [&](std::uint64_t i) { return csv_row(i, measure(options.seed, i, laws, settings)); };
  if (run_table(table) == TableOutcome::interrupted) {
    out << "interrupted; the same command goes on where it stopped (" << options.out << ")\n";
    return kExitInterrupted;
  }
  const double seconds = seconds_since(start);
  const Summary found = summarise(read_table(folder.resumable(table.name), laws.size()), laws);
  Json summary = to_json(found);
  summary["settings"] = table.settings;
  summary["seconds"] = seconds;
  summary["violations"] = violations(found);
  write_whole(folder.path() / "summary.json", summary.dump(1) + "\n");
  write_whole(folder.path() / "summary.csv", summary_csv(found));
  write_whole(folder.path() / "provenance.json",
              provenance(options.command_line, table.threads, {}).dump(1) + "\n");
  if (options.figures) draw_figures("engagement_campaign.py", folder.path());
  const std::vector<fs::path> files = folder.publish({"campaign.pdf", "campaign.png"});
  if (options.json) {
    out << summary.dump(1) << '\n';
  } else {
    print_summary(found, out);
    if (const auto wrong = violations(found))
      out << "VIOLATED: " << wrong << " runs met that a proved statement had called safe\n";
    const fs::path shown = options.out;
    out << "tables    " << (shown / table.name).string() << ", " << (shown / "summary.csv").string() << ", "
        << (shown / "summary.json").string() << '\n';
    for (const fs::path& picture : pictures_of(files)) out << "picture   " << picture.string() << '\n';
  }
  return violations(found) ? 1 : 0;
}

}  // namespace vericone::montecarlo
