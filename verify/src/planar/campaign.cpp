// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/verify/planar/campaign.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/verify/predicates/exact_tangents.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include "two_sum.h"

namespace vericone::verify {
namespace {

double finite_or_infinity(double error) {
  return std::isfinite(error) ? std::abs(error) : std::numeric_limits<double>::infinity();
}

void raise(WorstError& worst, double error, std::uint64_t index) {
  if (error > worst.error) worst = {error, index};
}

double edge_error(const InnerTangents& exact, const PlanarAnswer& answer) {
  const TwoSum right(answer.theta_b, -0.5 * answer.psi), left(answer.theta_b, 0.5 * answer.psi);
  return std::max(finite_or_infinity(exact.right.direction.angle_error(right.sum, right.rest)),
                  finite_or_infinity(exact.left.direction.angle_error(left.sum, left.rest)));
}

std::string short_text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.2g", x);
  return buffer;
}

std::string cell(const WorstError& worst) {
  if (worst.error == 0) return "0";
  return short_text(worst.error) + " #" + std::to_string(worst.index);
}

/// JSON has no infinities.
std::string json_number(double x) {
  if (std::isfinite(x)) return to_text(x);
  std::string quoted(1, '"');
  quoted += to_text(x);
  quoted += '"';
  return quoted;
}

std::string json_pair(const char* key, const WorstError& worst) {
  return std::string(", \"") + key + "\": {\"error\": " + json_number(worst.error) +
         ", \"index\": " + std::to_string(worst.index) + "}";
}

}  // namespace

PlanarFamilyReport run_planar_family(const PlanarMethod& method, PlanarFamily family, std::uint64_t cases,
                                     std::uint64_t seed, const std::function<bool()>& stop) {
  PlanarFamilyReport report;
  report.family = family;
  report.seed = seed;
  std::vector<double> psi_errors;
  for (std::uint64_t index = 0; index < cases && !(stop && stop()); ++index) {
    ++report.cases;
    const auto [a, b] = planar_pair(family, seed, index);
    const ExactTangents exact = exact_inner_tangents(a, b);
    if (exact.relation == PlanarRelation::separated) ++report.separated;
    const PlanarAnswer answer = method(a, b);
    if (!answer.answered) {
      if (report.not_answered++ == 0) report.first_not_answered_index = index;
      continue;
    }
    if (answer.relation != exact.relation) {
      if (report.wrong_relations++ == 0) report.first_wrong_index = index;
      continue;
    }
    if (!exact.tangents) continue;
    const InnerTangents& t = *exact.tangents;
    const double psi_relative = finite_or_infinity(t.psi.relative_error(answer.psi));
    const double edge = edge_error(t, answer);
    psi_errors.push_back(psi_relative);
    raise(report.psi_relative, psi_relative, index);
    raise(report.psi_ulps, finite_or_infinity(t.psi.ulps_off(answer.psi)), index);
    raise(report.theta_b, finite_or_infinity(t.theta_b.angle_error(answer.theta_b)), index);
    raise(report.edge, edge, index);
    raise(report.edge_over_psi, edge / t.psi.nearest(), index);
  }
  report.compared = psi_errors.size();
  if (!psi_errors.empty()) {
    const auto middle = psi_errors.begin() + static_cast<std::ptrdiff_t>(psi_errors.size() / 2);
    std::nth_element(psi_errors.begin(), middle, psi_errors.end());
    report.psi_median_relative = *middle;
  }
  return report;
}

std::vector<PlanarFamilyReport> run_planar_campaign(const PlanarMethod& method, std::uint64_t cases,
                                                    std::uint64_t seed) {
  std::vector<PlanarFamilyReport> reports;
  for (const PlanarFamily family : kAllPlanarFamilies)
    reports.push_back(run_planar_family(method, family, cases, seed));
  return reports;
}

std::string to_markdown(std::span<const PlanarFamilyReport> reports) {
  std::string out =
      "| family | seed | cases | separated | not answered | wrong relation | psi median rel. | psi worst "
      "rel. | "
      "psi worst ulps | theta_b worst rad | edge worst rad | edge worst / psi |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  const auto count = [](std::uint64_t n, std::uint64_t first) {
    return std::to_string(n) + (n ? " #" + std::to_string(first) : "");
  };
  for (const PlanarFamilyReport& r : reports) {
    for (const std::string& text :
         {std::string(name(r.family)), std::to_string(r.seed), std::to_string(r.cases),
          std::to_string(r.separated), count(r.not_answered, r.first_not_answered_index),
          count(r.wrong_relations, r.first_wrong_index), short_text(r.psi_median_relative),
          cell(r.psi_relative), cell(r.psi_ulps), cell(r.theta_b), cell(r.edge), cell(r.edge_over_psi)})
      out += "| " + text + " ";
    out += "|\n";
  }
  return out;
}

std::string to_json_lines(std::span<const PlanarFamilyReport> reports) {
  std::string out;
  for (const PlanarFamilyReport& r : reports) {
    out += std::string("{\"family\": \"") + name(r.family) + "\"";
    const auto integer = [&](const char* key, std::uint64_t value) {
      out += std::string(", \"") + key + "\": " + std::to_string(value);
    };
    integer("seed", r.seed);
    integer("cases", r.cases);
    integer("separated", r.separated);
    integer("not_answered", r.not_answered);
    if (r.not_answered) integer("first_not_answered_index", r.first_not_answered_index);
    integer("wrong_relations", r.wrong_relations);
    if (r.wrong_relations) integer("first_wrong_index", r.first_wrong_index);
    integer("compared", r.compared);
    out += ", \"psi_median_relative\": " + json_number(r.psi_median_relative);
    out += json_pair("psi_relative", r.psi_relative) + json_pair("psi_ulps", r.psi_ulps) +
           json_pair("theta_b", r.theta_b) + json_pair("edge", r.edge) +
           json_pair("edge_over_psi", r.edge_over_psi);
    out += "}\n";
  }
  return out;
}

}  // namespace vericone::verify
