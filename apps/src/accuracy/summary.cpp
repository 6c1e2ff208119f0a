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
  const std::size_t finest =
      static_cast<std::size_t>(std::max_element(planes.begin(), planes.end()) - planes.begin());
  summary.finest_planes = planes[finest];
  const auto collect = [&](auto&& value) {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const Measurement& m : rows) values.push_back(value(m));
    return values;
  };
  std::vector<double> fit_n, fit_error;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const std::vector<double> errors =
        collect([&](const Measurement& m) { return std::abs(m.slice_areas[i] / m.slice_areas[finest] - 1); });
    const Spread discretisation = spread(errors);
    Summary::Slices row;
    row.discretisation = {planes[i], {}, 2.0 / planes[i]};
    // The finest count is the reference of the others, and has none itself.
    if (i != finest) row.discretisation.error = discretisation;
    row.discretisation.above =
        std::count_if(errors.begin(), errors.end(), [&](double x) { return x >= 2.0 / planes[i]; });
    row.missing = spread(collect([&](const Measurement& m) { return 1 - m.slice_areas[i] / m.exact_area; }));
    summary.slices.push_back(row);
    if (planes[i] >= 6 && planes[i] * 4 <= planes[finest] && discretisation.median > 0) {
      fit_n.push_back(planes[i]);
      fit_error.push_back(discretisation.median);
    }
  }
  if (fit_n.size() >= 2) summary.slice_order = order(fit_n, fit_error);
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
  for (const Summary::Slices& row : s.slices) {
    slices.push_back(discretisation_json(row.discretisation));
    slices.back()["error_against_true_cone"] = spread_json(row.missing);
  }
  summary["slice"] = slices;
  if (s.slice_order) summary["slice_order"] = *s.slice_order;
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
  for (const Summary::Slices& row : s.slices)
    out << std::setw(8) << row.discretisation.planes << "   " << discretisation_text(row.discretisation)
        << std::setw(12) << percent(row.missing.mean) << "  " << std::setw(9) << percent(row.missing.worst)
        << '\n';
  if (s.slice_order)
    out << "  discretisation error falls as n^" << std::fixed << std::setprecision(2) << *s.slice_order
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
