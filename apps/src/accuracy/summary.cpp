// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/summary.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

#include "json/json_value.h"

namespace vericone::accuracy {

Summary summarise(const std::vector<Measurement>& rows, const std::vector<int>& planes) {
  Summary summary;
  summary.engagements = rows.size();
  const std::size_t finest = planes.size() - 1;
  summary.finest_planes = planes[finest];
  const auto collect = [&](auto&& value) {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const Measurement& m : rows) values.push_back(value(m));
    return values;
  };
  std::vector<std::vector<double>> areas;
  areas.reserve(rows.size());
  for (const Measurement& m : rows) areas.push_back(m.slice_areas);
  summary.slices = slice_errors(areas, planes);
  for (std::size_t i = 0; i < planes.size(); ++i)
    summary.missing.push_back(
        spread(collect([&](const Measurement& m) { return 1 - m.slice_areas[i] / m.exact_area; })));
  summary.slice_bias_values =
      collect([&](const Measurement& m) { return 1 - m.slice_areas[finest] / m.exact_area; });
  summary.slice_bias = spread(summary.slice_bias_values);
  std::vector<double> bound_n, bound_median;
  for (std::size_t i = 0; i < kSampleCounts.size(); ++i) {
    Summary::Samples row;
    row.samples = kSampleCounts[i];
    row.error =
        spread(collect([&](const Measurement& m) { return std::abs(m.areas[i] / m.exact_area - 1); }));
    row.bound = spread(collect([&](const Measurement& m) { return m.area_bounds[i] / m.exact_area; }));
    row.violated = std::count_if(rows.begin(), rows.end(), [&](const Measurement& m) {
      return std::abs(m.areas[i] - m.exact_area) > m.area_bounds[i];
    });
    summary.exact.push_back(row);
    if (row.samples >= 24) {
      bound_n.push_back(row.samples);
      bound_median.push_back(row.bound.median);
    }
  }
  summary.bound_order = order(bound_n, bound_median);
  return summary;
}

Json to_json(const Summary& s) {
  Json summary{{"engagements", s.engagements}, {"finest_planes", s.finest_planes}};
  Json slices = Json::array(), exact = Json::array();
  for (std::size_t i = 0; i < s.missing.size(); ++i) {
    slices.push_back(discretisation_json(s.slices.counts[i]));
    slices.back()["error_against_true_cone"] = spread_json(s.missing[i]);
  }
  summary["slice"] = slices;
  if (s.slices.order) summary["slice_order"] = *s.slices.order;
  summary["slice_bias"] = spread_json(s.slice_bias);
  summary["slice_bias_values"] = s.slice_bias_values;
  for (const Summary::Samples& row : s.exact)
    exact.push_back({{"samples", row.samples},
                     {"error", spread_json(row.error)},
                     {"certified_bound", spread_json(row.bound)},
                     {"bound_violations", row.violated}});
  summary["exact"] = exact;
  summary["bound_order"] = s.bound_order;
  return summary;
}

void print_summary(const Summary& s, std::ostream& out) {
  out << "  planes   discretisation error      2/n   above it   missing from the true cone\n"
      << "           median     worst                            mean       worst\n";
  for (std::size_t i = 0; i < s.missing.size(); ++i)
    out << std::setw(8) << s.slices.counts[i].planes << "   " << discretisation_text(s.slices.counts[i])
        << std::setw(12) << percent(s.missing[i].mean) << "  " << std::setw(9) << percent(s.missing[i].worst)
        << '\n';
  if (s.slices.order)
    out << "  discretisation error falls as n^" << std::fixed << std::setprecision(2) << *s.slices.order
        << "; slice bias (n = " << s.finest_planes << "): mean " << percent(s.slice_bias.mean) << ", worst "
        << percent(s.slice_bias.worst) << '\n';
  out << "  samples  error of the exact cone   certified bound         bound\n"
      << "           median     worst          median     worst        violated\n";
  for (const Summary::Samples& row : s.exact)
    out << std::setw(8) << row.samples << "   " << scientific(row.error.median) << "    "
        << scientific(row.error.worst) << "        " << scientific(row.bound.median) << "    "
        << scientific(row.bound.worst) << "      " << row.violated << '\n';
  out << "  certified bound falls as m^" << std::fixed << std::setprecision(2) << s.bound_order << '\n';
}

}  // namespace vericone::accuracy
