// SPDX-License-Identifier: BSD-3-Clause
#include "campaign/verdict_campaign.h"

#include <vericone/geometry/error.h>
#include <vericone/simulation/run_tables.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

#include "job/job.h"
#include "json/json_value.h"
#include "output/output_file.h"
#include "scenarios/populations/estimate.h"
#include "scenarios/populations/read_population.h"
#include "work/file_hash.h"

namespace vericone::populations {
namespace {

constexpr std::uint64_t kMostEncounters = 1'000'000'000'000'000;  // counts stay exact as doubles
constexpr std::size_t kGrowth = 60;                               // points of the picture, at most

/// A thousand blocks or fewer, so that what is read again stays small; of few encounters small ones.
std::uint64_t block_of(std::uint64_t encounters) {
  std::uint64_t block = 256;
  while (block * 1000 < encounters) block *= 2;
  return block;
}

/// The columns of a block after its number.
struct Cell {
  const char* name;
  std::function<double(const Tally&)> get;
  std::function<void(Tally&, double)> set;
};

template <typename Member>
Cell cell(const char* name, Member member) {
  using Number = std::remove_reference_t<decltype(std::invoke(member, std::declval<Tally&>()))>;
  return {name, [=](const Tally& t) { return double(std::invoke(member, const_cast<Tally&>(t))); },
          [=](Tally& t, double x) { std::invoke(member, t) = Number(x); }};
}

const std::vector<Cell>& cells() {
  static const std::vector<Cell> all{
      cell("encounters", &Tally::encounters),
      cell("verdicts", &Tally::verdicts),
      cell("in", &Tally::in),
      cell("overlapping", &Tally::overlapping),
      cell("on", &Tally::on),
      cell("undecided", &Tally::undecided),
      cell("uncovered", &Tally::uncovered),
      cell("weight", &Tally::weight),
      cell("weight squared", &Tally::weight_squares),
      cell("collides", [](Tally& t) -> double& { return t.sure.sum; }),
      cell("collides squared", [](Tally& t) -> double& { return t.sure.squares; }),
      cell("collides largest", [](Tally& t) -> double& { return t.sure.largest; }),
      cell("may collide", [](Tally& t) -> double& { return t.possible.sum; }),
      cell("may collide squared", [](Tally& t) -> double& { return t.possible.squares; }),
      cell("may collide largest", [](Tally& t) -> double& { return t.possible.largest; })};
  return all;
}

std::string row_of(std::uint64_t block, const Tally& tally) {
  std::string row = std::to_string(block);
  for (const Cell& one : cells()) row += "," + to_text(one.get(tally));
  return row;
}

std::vector<Tally> read_blocks(const std::filesystem::path& file) {
  const simulation::Table table = simulation::table_of_csv(content_of(file), file.filename().string());
  std::vector<Tally> blocks(table.rows());
  for (std::size_t k = 0; k < cells().size(); ++k)
    for (std::size_t i = 0; i < blocks.size(); ++i)
      cells()[k].set(blocks[i], table.columns[k + 1].numbers[i]);
  return blocks;
}

const char* interval_of(const Estimate& found) {
  return found.exact ? "Clopper and Pearson" : "Waudby-Smith and Ramdas";
}

Json bounds_json(const Estimate& found) {
  return {{"share", found.share}, {"low", found.low}, {"high", found.high}};
}

/// The estimate as the campaign grew, at numbers that are as far apart in parts of each other.
Json growth_of(const std::vector<Tally>& blocks, const Population& population) {
  Json growth = Json::array();
  Tally all;
  double next = 1;
  const double factor = std::pow(double(blocks.size()), 1.0 / kGrowth);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    add(blocks[i], all);
    if (double(i + 1) < next && i + 1 < blocks.size()) continue;
    // Where each stratum has as many encounters alone are these a sample of the population.
    if (population.strata && all.encounters % population.strata->count() != 0) continue;
    next = std::max(next * factor, double(i + 2));
    Json point = bounds_json(estimate_of(all, population));
    point["encounters"] = all.encounters;
    growth.push_back(std::move(point));
  }
  return growth;
}

Json to_json(const Tally& tally, const Estimate& found, const Population& population) {
  Json summary = bounds_json(found);
  summary.update({{"population", population.name},
                  {"confidence", kConfidence},
                  {"interval", interval_of(found)},
                  {"covered", {{"low", found.covered.low}, {"high", found.covered.high}}},
                  {"uncovered", tally.uncovered},
                  {"encounters", tally.encounters},
                  {"verdicts", tally.verdicts},
                  {"in", tally.in},
                  {"overlapping", tally.overlapping},
                  {"on", tally.on},
                  {"undecided", tally.undecided},
                  {"weighted", population.weighted()},
                  {"effective_collisions", found.effective_hits},
                  {"effective_encounters", found.effective_encounters},
                  {"largest_weight", population.largest_weight()},
                  {"mean_weight", found.mean_weight},
                  {"mean_weight_error", found.mean_weight_error}});
  if (population.per_hour) {
    const double rate = *population.per_hour;
    summary["per_hour"] = {{"encounters", rate},
                           {"collisions", rate * found.share},
                           {"low", rate * found.low},
                           {"high", rate * found.high}};
  }
  return summary;
}

template <typename... Values>
std::string line(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string text_of(const Tally& tally, const Estimate& found, const Population& population) {
  using Long = unsigned long long;
  std::string text =
      line("%llu encounters, %llu verdicts: %llu collide (%llu now), %llu touch, %llu undecided\n",
           Long(tally.encounters), Long(tally.verdicts), Long(tally.in), Long(tally.overlapping),
           Long(tally.on), Long(tally.undecided));
  text += line("share     %.4g, with 95 %% confidence between %.4g and %.4g (%s)\n", found.share, found.low,
               found.high, interval_of(found));
  if (!found.exact)
    text += line(
        "          %.1f effective collisions; if no kind of collision is rare among what is drawn: between "
        "%.4g and %.4g (Fay and Feuer)\n",
        found.effective_hits, found.covered.low, found.covered.high);
  if (population.weighted())
    text += line("weights   mean %.4g (1 expected, standard error %.2g), %.1f effective encounters\n",
                 found.mean_weight, found.mean_weight_error, found.effective_encounters);
  if (population.per_hour)
    text += line("an hour   %.4g collisions, between %.4g and %.4g\n", *population.per_hour * found.share,
                 *population.per_hour * found.low, *population.per_hour * found.high);
  constexpr double kFew = 10;
  if (tally.uncovered > 0)
    text += line(
        "uncovered %llu collisions were drawn where the proposal hardly draws: it misses a part of "
        "what collides; rest on the first interval\n",
        Long(tally.uncovered));
  else if (!found.exact && found.effective_hits < kFew)
    text += "few collisions carry this share: rest on the first interval, or draw more of what collides\n";
  return text;
}

}  // namespace

int run_verdict_campaign(const std::string& file, std::uint64_t encounters, std::uint64_t seed,
                         const OutputOptions& options, std::ostream& out) {
  if (encounters < 1 || encounters > kMostEncounters)
    throw InputError("-N", std::to_string(encounters), "between 1 and " + std::to_string(kMostEncounters));
  const Sampler sampler(read_population(file));
  const Population& population = sampler.population();
  if (population.strata && encounters % population.strata->count() != 0)
    throw InputError(
        "-N", std::to_string(encounters),
        "a multiple of " + std::to_string(population.strata->count()) + ", the strata of " + file);
  const std::uint64_t block = block_of(encounters);
  work::ResumableTable table{"blocks.csv"};
  table.settings = "# vericone campaign --verdicts, " + std::filesystem::path(file).filename().string() +
                   " " + sha256_of_file(file) + ", seed " + std::to_string(seed) + ", " +
                   std::to_string(encounters) + " encounters in blocks of " + std::to_string(block);
  table.header = "block";
  for (const Cell& one : cells()) table.header += std::string(",") + one.name;
  table.count = (encounters + block - 1) / block;
  table.block = 1;
  table.row = [&](std::uint64_t i) {
    return row_of(i, sampler.tally(seed, i * block, std::min(block, encounters - i * block)));
  };
  return run_job(
      {options, {file}, {{table, "blocks of " + std::to_string(block)}}},
      [&](Results& results, work::StagedFolder& folder) {
        const std::vector<Tally> blocks = read_blocks(folder.resumable(table.name));
        Tally all;
        for (const Tally& one : blocks) add(one, all);
        const Estimate found = estimate_of(all, population);
        results.summary = to_json(all, found, population);
        results.summary["settings"] = table.settings;
        results.summary["growth"] = growth_of(blocks, population);
        results.scripts = {"campaigns/verdict_campaign.py"};
        results.files = {table.name, "summary.json"};
        results.old = {"share.pdf", "share.png"};
        results.text << text_of(all, found, population);
      },
      out);
}

}  // namespace vericone::populations
