// SPDX-License-Identifier: BSD-3-Clause
#include "montecarlo/campaign_command.h"

#include <vericone/geometry/error.h>
#include <vericone/simulation/montecarlo/campaign.h>
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

Campaign campaign_of(const CampaignOptions& o) {
  return {o.engagements, o.seed, o.laws, {o.step, o.most, o.gain, o.reference, o.required}};
}

/// The laws; whatever is wrong is named by its option.
std::vector<Flown> laws_of_options(const Campaign& campaign) {
  try {
    return laws_of(campaign);
  } catch (const InputError& e) {
    throw InputError("--" + e.field(), e.value(), e.requirement());
  }
}

}  // namespace

int run_campaign(const CampaignOptions& options, std::ostream& out) {
  threads_for(options.threads);
  const Campaign campaign = campaign_of(options);
  const std::vector<Flown> laws = laws_of_options(campaign);
  StagedFolder folder(options.out, "--out");
  const auto start = Clock::now();
  ResumableTable table{folder, "engagements.csv"};
  table.settings = settings_line(campaign);
  table.header = csv_header(laws);
  table.count = options.engagements;
  table.threads = threads_for(options.threads);
  table.quiet = options.quiet;
  table.label = "engagements";
  table.row = [&](std::uint64_t i) { return csv_row(i, measure(campaign.seed, i, laws, campaign.flight)); };
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
