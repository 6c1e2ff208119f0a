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

std::string discretisation_text(const Json& row) {
  const Json& error = row["discretisation_error"];
  const auto number = [&](const Json& value, int width) {
    std::ostringstream cell;
    cell << std::setw(width)
         << (value.is_null()           ? "-"
             : value.is_number_float() ? scientific(value.get<double>())
                                       : std::to_string(value.get<long>()));
    return cell.str();
  };
  const Json none;
  return number(error.is_null() ? none : error["median"], 7) + "    " +
         number(error.is_null() ? none : error["worst"], 7) + "   " + number(row["two_over_n"], 7) +
         number(row["above_two_over_n"], 8);
}

std::string planes_text(const std::vector<int>& planes) {
  std::string text;
  for (const int n : planes) text.append(text.empty() ? "" : " ").append(std::to_string(n));
  return text;
}

}  // namespace vericone::accuracy
