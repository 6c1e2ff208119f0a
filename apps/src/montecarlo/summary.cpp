// SPDX-License-Identifier: BSD-3-Clause
#include "montecarlo/summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "json/json_value.h"

namespace vericone::montecarlo {
namespace {

constexpr double kBin = 0.25, kLastBin = 15;  // m

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Json null_if_nan(double x) { return std::isnan(x) ? Json(nullptr) : Json(x); }

/// Counts over the outcomes that `of` takes from the rows.
template <typename Of>
Json count(const std::vector<Row>& rows, Of of) {
  std::uint64_t avoided = 0, infeasible = 0, unsafe = 0, undecided = 0;
  std::vector<double> peaks, left, histogram(std::size_t(kLastBin / kBin) + 1, 0);
  for (const Row& row : rows) {
    const Outcome& o = of(row);
    avoided += o.fate == Fate::avoided;
    undecided += o.fate == Fate::undecided;
    infeasible += o.fate == Fate::met && !o.called_safe;
    unsafe += o.fate == Fate::met && o.called_safe;
    if (o.fate != Fate::avoided) continue;
    ++histogram[std::size_t(std::clamp(o.least_distance, 0.0, kLastBin) / kBin)];
    if (o.peak > 0) peaks.push_back(o.peak);
    if (!std::isnan(o.left_cone)) left.push_back(o.left_cone);
  }
  return {{"avoided", avoided},
          {"met", infeasible + unsafe},
          {"infeasible", infeasible},
          {"called_safe_and_met", unsafe},
          {"undecided", undecided},
          {"median_peak", null_if_nan(median(peaks))},
          {"median_left_cone", null_if_nan(median(left))},
          {"least_distances", histogram}};
}

/// Laws whose word is a theorem about the straight flight that follows it: they ask the true cone, or m.
bool word_is_proof(const Flown& law) {
  return law.guide.law == guidance::Law::clearance || law.guide.sector == guidance::SectorMethod::true_cone;
}

}  // namespace

Json summarise(const std::vector<Row>& rows, const std::vector<Flown>& laws) {
  const auto number = [&](auto which) {
    return std::uint64_t(std::count_if(rows.begin(), rows.end(), which));
  };
  const auto met = [](const Row& r) { return r.straight.outcome.fate == Fate::met; };
  Json straight = count(rows, [](const Row& r) -> const Outcome& { return r.straight.outcome; });
  for (const char* key : {"infeasible", "called_safe_and_met", "median_peak", "median_left_cone"})
    straight.erase(key);
  straight["slice_called_safe_and_met"] =
      number([&](const Row& r) { return met(r) && r.straight.slice_called_safe; });
  straight["exact_called_safe_and_met"] =
      number([&](const Row& r) { return met(r) && r.straight.exact_called_safe; });
  straight["predicate_called_safe_and_met"] =
      number([&](const Row& r) { return met(r) && r.straight.outcome.called_safe; });
  straight["exact_called_unsafe_and_avoided"] = number([&](const Row& r) {
    return r.straight.outcome.fate == Fate::avoided && !r.straight.exact_called_safe;
  });
  Json summary{{"engagements", rows.size()}, {"bin", kBin}, {"straight", straight}, {"laws", Json::array()}};
  for (std::size_t i = 0; i < laws.size(); ++i) {
    Json entry{{"name", laws[i].name},
               {"most", laws[i].guide.inversion.most},
               {"word_is_proof", word_is_proof(laws[i])}};
    const Json counts = count(rows, [i](const Row& r) -> const Outcome& { return r.outcomes[i]; });
    for (const auto& [key, value] : counts.items()) entry[key] = value;
    entry["made_worse"] = number([&](const Row& r) {
      return r.straight.outcome.fate == Fate::avoided && r.outcomes[i].fate == Fate::met;
    });
    summary["laws"].push_back(entry);
  }
  return summary;
}

std::string summary_csv(const Json& summary) {
  std::string table =
      "law,avoided,met,infeasible,called safe and met,undecided,met though straight flight avoids,"
      "median peak [m/s^2],median time to leave the cone [s]\n";
  const auto text = [](const Json& value) { return value.is_null() ? std::string() : value.dump(); };
  const Json& s = summary["straight"];
  table += "straight," + text(s["avoided"]) + "," + text(s["met"]) + ",,," + text(s["undecided"]) + ",,,\n";
  for (const Json& law : summary["laws"]) {
    table += law["name"].get<std::string>();
    for (const char* key : {"avoided", "met", "infeasible", "called_safe_and_met", "undecided", "made_worse",
                            "median_peak", "median_left_cone"})
      table += "," + text(law[key]);
    table += "\n";
  }
  return table;
}

void print_summary(const Json& summary, std::ostream& out) {
  const auto count = [](const Json& value) { return std::to_string(value.get<std::uint64_t>()); };
  const Json& s = summary["straight"];
  const double all = std::max(1.0, summary["engagements"].get<double>());
  char share[16];
  std::snprintf(share, sizeof share, "%.1f %%", 100 * s["met"].get<double>() / all);
  out << count(summary["engagements"]) << " engagements; straight on: met " << count(s["met"]) << " ("
      << share << "), avoided " << count(s["avoided"]) << ", undecided " << count(s["undecided"]) << '\n'
      << "  slice sector on the plane of motion called safe, and met:  "
      << count(s["slice_called_safe_and_met"]) << '\n'
      << "  true sector on the plane of motion called safe, and met:   "
      << count(s["exact_called_safe_and_met"]) << '\n'
      << "  law                avoided       met  infeasible  called safe,  undecided  worse than  median "
         "peak\n"
      << "                    (proved)                             and met              straight        "
         "m/s^2\n";
  for (const Json& law : summary["laws"]) {
    char line[160];
    std::snprintf(line, sizeof line, "  %-16s %10s%10s%12s%14s%11s%12s%13.3g\n",
                  law["name"].get<std::string>().c_str(), count(law["avoided"]).c_str(),
                  count(law["met"]).c_str(), count(law["infeasible"]).c_str(),
                  count(law["called_safe_and_met"]).c_str(), count(law["undecided"]).c_str(),
                  count(law["made_worse"]).c_str(),
                  law["median_peak"].is_null() ? 0.0 : law["median_peak"].get<double>());
    out << line;
  }
}

std::uint64_t violations(const Json& summary) {
  const Json& s = summary["straight"];
  auto wrong = s["exact_called_safe_and_met"].get<std::uint64_t>() +
               s["predicate_called_safe_and_met"].get<std::uint64_t>();
  for (const Json& law : summary["laws"])
    if (law["word_is_proof"].get<bool>()) wrong += law["called_safe_and_met"].get<std::uint64_t>();
  return wrong;
}

}  // namespace vericone::montecarlo
