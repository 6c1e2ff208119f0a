// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/montecarlo/flight.h>
#include <vericone/simulation/montecarlo/campaign.h>
#include <vericone/work/staged_folder.h>
#include <cstdint>
#include <iostream>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "campaign/summary_text.h"
#include "campaign/verdict_campaign.h"
#include "command/default_seed.h"
#include "command/output_line.h"
#include "commands.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/output_file.h"
#include "output/output_options.h"
#include "output/part.h"
#include "output/progress.h"
#include "output/results.h"
#include "scenarios/campaign_table.h"
#include "work/interrupt.h"
#include "work/provenance.h"
#include "work/threads.h"

namespace vericone::montecarlo {
namespace {

struct CampaignOptions : OutputOptions {
  CampaignOptions() { out = "out/campaign"; }
  std::uint64_t engagements = 10'000;
  std::uint64_t seed = kDefaultSeed;
  std::vector<std::string> laws{"slice", "exact", "motion", "clearance"};
  double most = 15;         // m/s^2
  double gain = 4;          // 1/s
  double reference = 0.05;  // w
  double required = 1;      // m
  double step = 0.05;       // s
  std::string verdicts;     // a population's file: nothing flies
};

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

/// Random engagements under every law, with a proof of what became of each. Returns the exit status: 1 where
/// a run met that a proved statement called safe, 130 interrupted. Throws InputError naming the option.
int run_campaign(const CampaignOptions& options, std::ostream& out) {
  threads_for(options.threads);
  const Campaign campaign = campaign_of(options);
  const std::vector<Flown> laws = laws_of_options(campaign);
  work::StagedFolder folder(options.out, "--out");
  const auto start = Clock::now();
  const work::ResumableTable table = scenario::campaign_table(campaign, laws, threads_for(options.threads));
  if (!run_with_bar(table, folder, "engagements", options, out)) return kExitInterrupted;
  Json origin = provenance(options.command_line, table.threads, {});
  origin["seconds"] = seconds_since(start);
  if (!options.part.empty()) return publish_part(options, folder, {table}, std::move(origin), out);
  const Summary found = summarise_file(folder.resumable(table.name), laws);
  Results results{.summary = to_json(found),
                  .origin = std::move(origin),
                  .scripts = {"campaigns/engagement_campaign.py"},
                  .files = {table.name, "summary.csv", "summary.json"},
                  .old = {"campaign.pdf", "campaign.png"}};
  results.summary["settings"] = table.settings;
  results.summary["violations"] = violations(found);
  write_whole(folder.path() / "summary.csv", summary_csv(found));
  std::ostringstream text;
  print_summary(found, text);
  if (const auto wrong = violations(found))
    text << "VIOLATED: " << wrong << " runs met that a proved statement had called safe\n";
  publish(results, options, folder, text.str(), out);
  return violations(found) ? 1 : 0;
}

}  // namespace

}  // namespace vericone::montecarlo

namespace vericone {

int campaign_command(CommandLine& line) {
  montecarlo::CampaignOptions campaign;
  line.option("--out", campaign.out, "Folder for tables and picture");
  line.option("-N,--engagements", campaign.engagements, "Random engagements");
  line.option("--seed", campaign.seed, "Seed of all random numbers");
  line.option("--threads", campaign.threads, "Threads, 0: one per processor");
  line.option(
      "--verdicts", campaign.verdicts,
      "Nothing flies: verdicts of encounters drawn from this file (docs/reference/formats.md, Populations)");
  const std::pair<const char*, CommandLine::Option> of_flights[] = {
      {"--laws", line.option("--laws", campaign.laws,
                             "slice, exact (largest opening), motion (true sector on the plane of motion), "
                             "clearance")
                     .commas()},
      {"--most", line.option("--most", campaign.most, "Saturation, m/s^2; every law also flies without")},
      {"--gain", line.option("--gain", campaign.gain, "K of all laws, 1/s")},
      {"--reference", line.option("--reference", campaign.reference, "w, to which y is driven")},
      {"--required", line.option("--required", campaign.required, "Of the clearance law, metres")},
      {"--step", line.option("--step", campaign.step, "Between two commands, s")}};
  part_option(line, campaign.part);
  line.negative_flag("--no-figures", campaign.figures, "Tables only");
  line.flag("--quiet", campaign.quiet, "No progress");
  line.flag("--json", campaign.json, "Print JSON");
  line.read();
  keep_words(line, campaign);
  if (!campaign.verdicts.empty()) {
    for (const auto& [name, option] : of_flights)
      if (option.given()) throw InputError(name, "given", "left out beside --verdicts: nothing flies");
    return populations::run_verdict_campaign(campaign.verdicts, campaign.engagements, campaign.seed, campaign,
                                             std::cout);
  }
  return montecarlo::run_campaign(campaign, std::cout);
}

}  // namespace vericone
