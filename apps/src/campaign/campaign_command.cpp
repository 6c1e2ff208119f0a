// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/montecarlo/flight.h>
#include <vericone/simulation/montecarlo/campaign.h>
#include <cstdint>
#include <iostream>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "campaign/summary_text.h"
#include "campaign/verdict_campaign.h"
#include "command/default_seed.h"
#include "command/output_line.h"
#include "commands.h"
#include "job/job.h"
#include "json/json_value.h"
#include "output/output_file.h"
#include "scenarios/campaign_table.h"

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
  const Campaign campaign = campaign_of(options);
  const std::vector<Flown> laws = laws_of_options(campaign);
  const work::ResumableTable table = scenario::campaign_table(campaign, laws, 1);
  return run_job(
      {options, {}, {{table, "engagements"}}},
      [&](Results& results, work::StagedFolder& folder) {
        const Summary found = summarise_file(folder.resumable(table.name), laws);
        const auto wrong = violations(found);
        results.summary = to_json(found);
        results.summary["settings"] = table.settings;
        results.summary["violations"] = wrong;
        results.scripts = {"campaigns/engagement_campaign.py"};
        results.files = {table.name, "summary.csv", "summary.json"};
        results.old = {"campaign.pdf", "campaign.png"};
        write_whole(folder.path() / "summary.csv", summary_csv(found));
        print_summary(found, results.text);
        if (wrong)
          results.text << "VIOLATED: " << wrong << " runs met that a proved statement had called safe\n";
        results.status = wrong ? 1 : 0;
      },
      out);
}

}  // namespace

}  // namespace vericone::montecarlo

namespace vericone {

int campaign_command(CommandLine& line) {
  montecarlo::CampaignOptions campaign;
  line.option("-N,--engagements", campaign.engagements, "Random engagements, or with --verdicts encounters");
  line.option("--seed", campaign.seed, "Seed of all random numbers");
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
  read_job_line(line, campaign);
  if (!campaign.verdicts.empty()) {
    for (const auto& [name, option] : of_flights)
      if (option.given()) throw InputError(name, "given", "left out beside --verdicts: nothing flies");
    return populations::run_verdict_campaign(campaign.verdicts, campaign.engagements, campaign.seed, campaign,
                                             std::cout);
  }
  return montecarlo::run_campaign(campaign, std::cout);
}

}  // namespace vericone
