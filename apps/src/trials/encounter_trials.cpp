// SPDX-License-Identifier: BSD-3-Clause
#include "trials/encounter_trials.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <ostream>

#include "json/json_value.h"
#include "scenarios/encounters/risk.h"

namespace vericone::trials {
namespace {

using encounters::Entered, encounters::Nearness;

/// When a pilot first commanded anything.
std::optional<double> alert_of(const simulation::Scenario& flown, const simulation::Run& run) {
  std::optional<double> first;
  for (std::size_t i = 0; i < flown.bodies.size(); ++i) {
    if (!flown.bodies[i].pilot) continue;
    for (const auto& leg : run.tracks[i].legs())
      if (leg->accelerated()) {
        if (!first || leg->from() < *first) first = leg->from();
        break;
      }
  }
  return first;
}

/// Of all pairs with one of the agents, the one that comes nearest.
Nearness nearest(const simulation::Run& run, const std::vector<bool>& agents,
                 const encounters::Volume& volume) {
  std::optional<Nearness> best;
  bool yes = false, undecided = false;
  const auto size = [&](const Nearness& n) {
    return std::max(n.horizontal / volume.radius, n.vertical / volume.half_height);
  };
  for (std::size_t i = 0; i < agents.size(); ++i)
    for (std::size_t j = 0; j < agents.size(); ++j) {
      if (!agents[i] || i == j || (agents[j] && j < i)) continue;
      const Nearness one = encounters::nearness(run.tracks[i], run.tracks[j], 0, run.end, volume);
      yes |= one.entered == Entered::yes;
      undecided |= one.entered == Entered::undecided;
      if (!best || size(one) < size(*best)) best = one;
    }
  Nearness found = best.value_or(Nearness{Entered::no, 0, 0, 0});
  found.entered = yes ? Entered::yes : undecided ? Entered::undecided : Entered::no;
  return found;
}

std::vector<double> numbers_of(const simulation::Table& rows, const std::string& name) {
  const simulation::Column* column = rows.find(name);
  // A column without any number is one of words.
  return column && !column->text ? column->numbers : std::vector<double>(rows.rows(), NAN);
}

std::vector<Entered> outcomes_of(const simulation::Table& rows, const std::string& name) {
  std::vector<Entered> all;
  for (const std::string& word : rows.find(name)->words)
    all.push_back(word == "yes" ? Entered::yes : word == "no" ? Entered::no : Entered::undecided);
  return all;
}

Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

/// The half of all weight is at or below it; nothing where no number is.
Json median_of(const std::vector<double>& values, const std::vector<double>& weights) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i]) && weights[i] > 0) order.push_back(i);
  if (order.empty()) return nullptr;
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  double all = 0, below = 0;
  for (const std::size_t i : order) all += weights[i];
  for (const std::size_t i : order)
    if ((below += weights[i]) >= 0.5 * all) return values[i];
  return values[order.back()];
}

Json bounds_json(const encounters::Risk& risk) {
  return {{"share", risk.share}, {"low", risk.bounds.low}, {"high", risk.bounds.high}};
}

}  // namespace

std::string encounter_columns(const std::string& cell, const Encounters& with) {
  std::string columns = "," + cell + " alert [s]," + cell + " HMD [m]," + cell + " VMD [m]";
  for (const encounters::Volume& volume : with.volumes) columns += "," + cell + " within " + volume.name;
  return columns;
}

std::string encounter_cells(const simulation::Scenario& flown, const simulation::Run& run,
                            const std::vector<bool>& agents, const Encounters& with) {
  const auto alert = alert_of(flown, run);
  std::string cells = "," + (alert ? to_text(*alert) : "");
  for (std::size_t k = 0; k < with.volumes.size(); ++k) {
    const Nearness near = nearest(run, agents, with.volumes[k]);
    if (k == 0) cells += "," + to_text(near.horizontal) + "," + to_text(near.vertical);
    cells += std::string(",") + to_string(near.entered);
  }
  return cells;
}

Json encounters_json(const simulation::Table& rows, const std::vector<std::string>& cells,
                     const Encounters& with) {
  const std::vector<double> weights = numbers_of(rows, "weight");
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0)) throw InputError("--encounters", with.file, "encounters of which one has a weight above 0");
  const double mean = with.set.drawn ? 1 : sum / double(weights.size());
  const double largest = with.set.largest_weight;
  Json laws = Json::array();
  const auto column = [](const std::string& cell, const encounters::Volume& volume) {
    return cell + " within " + volume.name;
  };
  const std::vector<Entered> unequipped = outcomes_of(rows, column(cells[0], with.volumes[0]));
  for (const std::string& cell : cells) {
    Json law{{"law", cell}, {"volumes", Json::array()}};
    for (const encounters::Volume& volume : with.volumes) {
      const std::vector<Entered> mine = outcomes_of(rows, column(cell, volume));
      Json of_volume = bounds_json(risk_of(mine, weights, mean, largest));
      of_volume["volume"] = volume.name;
      of_volume["entered"] = std::count(mine.begin(), mine.end(), Entered::yes);
      of_volume["undecided"] = std::count(mine.begin(), mine.end(), Entered::undecided);
      of_volume["ratios"] = Json::array();
      for (const std::string& other : cells) {
        if (other == cell) break;
        const auto ratio = risk_ratio(mine, outcomes_of(rows, column(other, volume)), weights, largest);
        of_volume["ratios"].push_back({{"to", other},
                                       {"ratio", finite_or_null(ratio.ratio)},
                                       {"low", ratio.bounds.low},
                                       {"high", finite_or_null(ratio.bounds.high)}});
      }
      law["volumes"].push_back(std::move(of_volume));
    }
    const std::vector<double> alerts = numbers_of(rows, cell + " alert");
    std::vector<Entered> needless(alerts.size());
    for (std::size_t i = 0; i < alerts.size(); ++i)
      needless[i] = std::isnan(alerts[i]) || unequipped[i] == Entered::yes ? Entered::no
                    : unequipped[i] == Entered::no                         ? Entered::yes
                                                                           : Entered::undecided;
    law["needless_alerts"] = bounds_json(risk_of(needless, weights, mean, largest));
    law["median_alert"] = median_of(alerts, weights);
    law["median_hmd"] = median_of(numbers_of(rows, cell + " HMD"), weights);
    law["median_vmd"] = median_of(numbers_of(rows, cell + " VMD"), weights);
    laws.push_back(std::move(law));
  }
  return {{"encounters", weights.size()},
          {"weight", sum},
          {"confidence", populations::kConfidence},
          {"laws", laws}};
}

void print_encounters(const Json& summary, std::ostream& out) {
  char line[240];
  out << "  law                volume                 probability  interval (95 %)           ratio to none, "
         "interval\n";
  for (const Json& law : summary["laws"])
    for (const Json& volume : law["volumes"]) {
      const auto number = [](const Json& x) { return x.is_null() ? NAN : x.get<double>(); };
      std::snprintf(line, sizeof line, "  %-18s %-20s %13.4g  %-9.4g to %-9.4g",
                    law["law"].get<std::string>().c_str(), volume["volume"].get<std::string>().c_str(),
                    number(volume["share"]), number(volume["low"]), number(volume["high"]));
      out << line;
      if (!volume["ratios"].empty()) {
        const Json& ratio = volume["ratios"][0];
        const auto shown = [&](const char* key) {
          char digits[24] = "any";
          if (!ratio[key].is_null()) std::snprintf(digits, sizeof digits, "%.4g", ratio[key].get<double>());
          return std::string(digits);
        };
        std::snprintf(line, sizeof line, "  %10s  %s to %s", shown("ratio").c_str(), shown("low").c_str(),
                      shown("high").c_str());
        out << line;
      }
      out << '\n';
    }
}

}  // namespace vericone::trials
