// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/statistics.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "json/json_value.h"

namespace vericone::accuracy {

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  Spread s;
  for (const double v : values) s.mean += v / static_cast<double>(values.size());
  std::sort(values.begin(), values.end());
  s.median = values[values.size() / 2];
  s.worst = values.back();
  return s;
}

Json spread_json(const Spread& s) { return {{"median", s.median}, {"mean", s.mean}, {"worst", s.worst}}; }

double order(const std::vector<double>& n, const std::vector<double>& error) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto count = static_cast<double>(n.size());
  for (std::size_t i = 0; i < n.size(); ++i) {
    const double x = std::log(n[i]), y = std::log(error[i]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

SliceErrors slice_errors(const std::vector<std::vector<double>>& areas, const std::vector<int>& planes) {
  SliceErrors found;
  std::vector<double> fit_n, fit_error;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    std::vector<double> errors;
    errors.reserve(areas.size());
    for (const auto& own : areas) errors.push_back(std::abs(own[i] / own.back() - 1));
    const Spread all = spread(errors);
    Discretisation row{planes[i], {}, 2.0 / planes[i]};
    if (i + 1 != planes.size()) row.error = all;
    row.above = std::count_if(errors.begin(), errors.end(), [&](double x) { return x >= 2.0 / planes[i]; });
    found.counts.push_back(row);
    if (planes[i] >= 6 && planes[i] * 4 <= planes.back() && all.median > 0) {
      fit_n.push_back(planes[i]);
      fit_error.push_back(all.median);
    }
  }
  if (fit_n.size() >= 2) found.order = order(fit_n, fit_error);
  return found;
}

std::string percent(double x) {
  std::ostringstream s;
  s << std::fixed << std::setprecision(2) << 100 * x << " %";
  return s.str();
}

std::string scientific(double x) {
  std::ostringstream s;
  s << std::scientific << std::setprecision(1) << x;
  return s.str();
}

Json discretisation_json(const Discretisation& row) {
  return {{"planes", row.planes},
          {"discretisation_error", row.error ? spread_json(*row.error) : Json()},
          {"two_over_n", row.two_over_n},
          {"above_two_over_n", row.error ? Json(row.above) : Json()}};
}

std::string discretisation_text(const Discretisation& row) {
  std::ostringstream cells;
  cells << std::setw(7) << (row.error ? scientific(row.error->median) : "-") << "    " << std::setw(7)
        << (row.error ? scientific(row.error->worst) : "-") << "   " << std::setw(7)
        << scientific(row.two_over_n) << std::setw(8) << (row.error ? std::to_string(row.above) : "-");
  return cells.str();
}

std::string planes_text(const std::vector<int>& planes) {
  std::string text;
  for (const int n : planes) text.append(text.empty() ? "" : " ").append(std::to_string(n));
  return text;
}

}  // namespace vericone::accuracy
