// SPDX-License-Identifier: BSD-3-Clause
#include "fit/cone/cone_json.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <ostream>

#include "json/json_value.h"

namespace vericone {
namespace {

using Eigen::Vector3d;

Json row_json(const ConeRow& row) {
  return {{"what", row.what},
          {"low", row.low},
          {"high", row.high},
          {"excess_low", number_or_null(row.excess_low)},
          {"excess_high", number_or_null(row.excess_high)},
          {"volume", number_or_null(row.volume)},
          {"overlapping", row.overlapping},
          {"method", row.method},
          {"seconds", row.seconds}};
}

Json rows_json(const std::vector<ConeRow>& rows) {
  Json list = Json::array();
  for (const ConeRow& row : rows) list.push_back(row_json(row));
  return list;
}

std::string text(const char* format, double x) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, format, x);
  return buffer;
}

std::string between(const char* format, double low, double high) {
  const std::string a = text(format, low), b = text(format, high);
  return a == b ? a : a + " to " + b;
}

/// How much less the hull's cone has than the ellipsoid's, at least; steradian.
double gain(const ConesOfAgent& agent) {
  double ellipsoid = 0, hull = 0;
  for (const ConeRow& row : agent.rows) {
    if (row.what == "ellipsoid") ellipsoid = row.low;
    if (row.what == "hull") hull = row.high;
  }
  return ellipsoid - hull;
}

}  // namespace

Json cones_json(const ConeComparison& comparison) {
  Json agents = Json::array();
  for (const ConesOfAgent& a : comparison.agents)
    agents.push_back({{"agent", a.agent.text},
                      {"center", vector_json(a.agent.body.center())},
                      {"semi_axes", vector_json(a.agent.body.semi_axes())},
                      {"towards", vector_json(a.towards)},
                      {"rows", rows_json(a.rows)}});
  return {{"resolution", comparison.resolution},
          {"mean", rows_json(comparison.mean)},
          {"agents", std::move(agents)},
          {"notes", comparison.notes}};
}

void print_cones(const ConeComparison& comparison, std::ostream& out) {
  const std::size_t count = comparison.agents.size();
  out << "cones               "
      << (count == 1 ? comparison.agents.front().agent.text
                     : "mean over " + std::to_string(count) + " agents around, the first a " +
                           comparison.agents.front().agent.text)
      << '\n'
      << std::left << std::setw(20) << "  of" << std::setw(27) << "solid angle (sr)" << std::setw(27)
      << "excess over scan (%)" << std::setw(14) << "volume (m^3)"
      << "how\n";
  for (const ConeRow& row : comparison.mean) {
    out << "  " << std::setw(18) << row.what << std::setw(27) << between("%.5g", row.low, row.high)
        << std::setw(27)
        << (row.what == "scan" ? "" : between("%.2f", 100 * row.excess_low, 100 * row.excess_high))
        << std::setw(14) << (row.volume ? text("%.5g", *row.volume) : "-") << row.method;
    if (row.overlapping && count == 1) out << "; the agent is not apart from it: all directions";
    if (row.overlapping && count > 1) out << "; " << row.overlapping << " agents are not apart from it";
    out << '\n';
  }
  out << std::right;
  for (const std::string& note : comparison.notes) out << "note                " << note << '\n';
}

Json cones_picture(const ConeComparison& comparison, const std::string& title) {
  const auto shown = std::max_element(comparison.agents.begin(), comparison.agents.end(),
                                      [](const auto& a, const auto& b) { return gain(a) < gain(b); });
  Json outlines = Json::array();
  for (const ConeRow& row : shown->rows) {
    Json loops = Json::array();
    for (const auto& loop : row.outline) {
      Json points = Json::array();
      for (const Vector3d& d : loop) points.push_back(vector_json(d));
      loops.push_back(std::move(points));
    }
    Json one = row_json(row);
    one["loops"] = std::move(loops);
    outlines.push_back(std::move(one));
  }
  Json picture = cones_json(comparison);
  picture["title"] = title;
  picture["shown"] = {
      {"agent", shown->agent.text}, {"towards", vector_json(shown->towards)}, {"rows", std::move(outlines)}};
  return picture;
}

}  // namespace vericone
