// SPDX-License-Identifier: BSD-3-Clause
#include "campaign/summary_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <sstream>

#include "json/json_value.h"

namespace vericone::montecarlo {
namespace {

Json null_if_nan(double x) { return std::isnan(x) ? Json(nullptr) : Json(x); }

Json counts_json(const Counts& c) {
  return {{"avoided", c.avoided},
          {"met", c.met()},
          {"infeasible", c.infeasible},
          {"called_safe_and_met", c.called_safe_and_met},
          {"undecided", c.undecided},
          {"median_peak", null_if_nan(c.median_peak)},
          {"median_left_cone", null_if_nan(c.median_left_cone)},
          {"least_distances", c.least_distances}};
}

}  // namespace

Json to_json(const Summary& s) {
  Json straight = counts_json(s.straight);
  for (const char* key : {"infeasible", "called_safe_and_met", "median_peak", "median_left_cone"})
    straight.erase(key);
  straight["slice_called_safe_and_met"] = s.slice_called_safe_and_met;
  straight["exact_called_safe_and_met"] = s.exact_called_safe_and_met;
  straight["predicate_called_safe_and_met"] = s.predicate_called_safe_and_met;
  straight["exact_called_unsafe_and_avoided"] = s.exact_called_unsafe_and_avoided;
  Json summary{
      {"engagements", s.engagements}, {"bin", kBin}, {"straight", straight}, {"laws", Json::array()}};
  for (const Summary::OfLaw& law : s.laws) {
    Json entry{{"name", law.name}, {"most", law.most}, {"word_is_proof", law.word_is_proof}};
    entry.update(counts_json(law.counts));
    entry["made_worse"] = law.made_worse;
    summary["laws"].push_back(entry);
  }
  return summary;
}

std::string summary_csv(const Summary& s) {
  std::ostringstream table;
  table << "law,avoided,met,infeasible,called safe and met,undecided,met though straight flight avoids,"
           "median peak [m/s^2],median time to leave the cone [s]\n"
        << "straight," << s.straight.avoided << ',' << s.straight.met() << ",,," << s.straight.undecided
        << ",,,\n";
  const auto text = [](double x) { return std::isnan(x) ? std::string() : Json(x).dump(); };
  for (const Summary::OfLaw& law : s.laws) {
    const Counts& c = law.counts;
    table << law.name << ',' << c.avoided << ',' << c.met() << ',' << c.infeasible << ','
          << c.called_safe_and_met << ',' << c.undecided << ',' << law.made_worse << ','
          << text(c.median_peak) << ',' << text(c.median_left_cone) << '\n';
  }
  return table.str();
}

void print_summary(const Summary& s, std::ostream& out) {
  const double all = std::max(1.0, static_cast<double>(s.engagements));
  char share[16];
  std::snprintf(share, sizeof share, "%.1f %%", 100 * static_cast<double>(s.straight.met()) / all);
  out << s.engagements << " engagements; straight on: met " << s.straight.met() << " (" << share
      << "), avoided " << s.straight.avoided << ", undecided " << s.straight.undecided << '\n'
      << "  slice sector on the plane of motion called safe, and met:  " << s.slice_called_safe_and_met
      << '\n'
      << "  true sector on the plane of motion called safe, and met:   " << s.exact_called_safe_and_met
      << '\n'
      << "  law                avoided       met  infeasible  called safe,  undecided  worse than  median "
         "peak\n"
      << "                    (proved)                             and met              straight        "
         "m/s^2\n";
  for (const Summary::OfLaw& law : s.laws) {
    const Counts& c = law.counts;
    const auto text = [](std::uint64_t n) { return std::to_string(n); };
    char line[160];
    std::snprintf(line, sizeof line, "  %-16s %10s%10s%12s%14s%11s%12s%13.3g\n", law.name.c_str(),
                  text(c.avoided).c_str(), text(c.met()).c_str(), text(c.infeasible).c_str(),
                  text(c.called_safe_and_met).c_str(), text(c.undecided).c_str(),
                  text(law.made_worse).c_str(), std::isnan(c.median_peak) ? 0.0 : c.median_peak);
    out << line;
  }
}

}  // namespace vericone::montecarlo
