// SPDX-License-Identifier: BSD-3-Clause
#include "campaign/campaign_command.h"

#include <vericone/geometry/error.h>
#include <vericone/simulation/montecarlo/campaign.h>
#include <vericone/work/staged_folder.h>
#include <ostream>
#include <sstream>

#include "campaign/summary_text.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/output_file.h"
#include "output/progress.h"
#include "output/results.h"
#include "scenarios/campaign_table.h"
#include "work/interrupt.h"
#include "work/provenance.h"
#include "work/threads.h"

namespace vericone::montecarlo {
namespace {

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
  work::StagedFolder folder(options.out, "--out");
  const auto start = Clock::now();
  const work::ResumableTable table = scenario::campaign_table(campaign, laws, threads_for(options.threads));
  if (!run_with_bar(table, folder, "engagements", options.quiet, options.out, out)) return kExitInterrupted;
  const double seconds = seconds_since(start);
  const Summary found = summarise(read_table(folder.resumable(table.name), laws.size()), laws);
  Results results{.summary = to_json(found),
                  .origin = provenance(options.command_line, table.threads, {}),
                  .scripts = {"engagement_campaign.py"},
                  .files = {table.name, "summary.csv", "summary.json"},
                  .old = {"campaign.pdf", "campaign.png"}};
  results.summary["settings"] = table.settings;
  results.summary["seconds"] = seconds;
  results.summary["violations"] = violations(found);
  write_whole(folder.path() / "summary.csv", summary_csv(found));
  std::ostringstream text;
  print_summary(found, text);
  if (const auto wrong = violations(found))
    text << "VIOLATED: " << wrong << " runs met that a proved statement had called safe\n";
  publish(results, options, folder, text.str(), out);
  return violations(found) ? 1 : 0;
}

}  // namespace vericone::montecarlo
