// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/scenarios/scenario_files.h>
#include <optional>
#include <sstream>

#include "output/output_file.h"
#include "scenarios/campaign_table.h"
#include "work/threads.h"

namespace vericone::scenario {
work::ResumableTable campaign_table(const montecarlo::Campaign& campaign,
                                    const std::vector<montecarlo::Flown>& laws, int threads) {
  work::ResumableTable table{"engagements.csv"};
  table.settings = settings_line(campaign);
  table.header = csv_header(laws);
  table.count = campaign.engagements;
  table.threads = threads;
  table.row = [&](std::uint64_t i) { return csv_row(i, measure(campaign.seed, i, laws, campaign.flight)); };
  return table;
}

FlownCampaign fly_campaign(const montecarlo::Campaign& campaign, const CampaignOptions& options) {
  const std::vector<montecarlo::Flown> laws = laws_of(campaign);
  work::ResumableTable table = campaign_table(campaign, laws, threads_for(options.threads, "threads"));
  table.rows = options.rows;
  std::optional<std::uint64_t> told;
  if (options.progress)
    table.progress = [&](std::uint64_t rows) {
      const bool come = told && *told != rows;
      told = rows;
      return !come || options.progress(static_cast<double>(rows) / static_cast<double>(table.count));
    };
  FlownCampaign found;
  std::string text = table.header + "\n";
  if (!options.out) {
    told = 0;
    found.finished = compute_rows(table, 0, [&](std::string_view rows) { text += rows; });
  } else {
    work::StagedFolder folder(*options.out, "out");
    const std::filesystem::path partial = folder.resumable(table.name);
    if (!options.resume) std::filesystem::remove(partial);
    found.finished = run_table(table, folder);
    text = content_of(partial);
    text.erase(0, text.find('\n') + 1);  // the settings
    if (found.finished) folder.publish();
  }
  found.table = simulation::table_of_csv(text, "the campaign");
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);  // header
  std::vector<montecarlo::Row> rows;
  while (std::getline(lines, line)) rows.push_back(montecarlo::row_of(line, laws.size()));
  found.summary = summarise(rows, laws);
  found.violations = violations(found.summary);
  return found;
}

std::string campaign_rows(const montecarlo::Campaign& campaign, std::uint64_t first, std::uint64_t end) {
  if (!(first <= end && end <= campaign.engagements))
    throw InputError("end", std::to_string(end),
                     "between first, " + std::to_string(first) + ", and the engagements, " +
                         std::to_string(campaign.engagements));
  const std::vector<montecarlo::Flown> laws = laws_of(campaign);
  const work::ResumableTable table = campaign_table(campaign, laws, 1);
  std::string rows;
  for (std::uint64_t i = first; i < end; ++i) {
    checkpoint();
    rows += table.row(i) + "\n";
  }
  return rows;
}

}  // namespace vericone::scenario
