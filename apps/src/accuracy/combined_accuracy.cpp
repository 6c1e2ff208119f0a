// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/combined_accuracy.h"

#include <vericone/cones/slices/slice_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/cone.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <ostream>

#include "accuracy/distribution.h"
#include "accuracy/measure.h"
#include "accuracy/statistics.h"
#include "job/job.h"
#include "json/json_value.h"

namespace vericone::accuracy {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kDefaultEngagements = 1000;

/// Areas of sections at distance 1.
struct Row {
  double inner_area = 0, outer_area = 0;
  double inner_solid_angle = 0, outer_solid_angle = 0;  // sr
  std::vector<double> slice_areas;                      // one for each plane count
};

Row measure_combined(const Ellipsoid& a, const CombinedEllipsoid& b, const std::vector<int>& planes,
                     double tolerance) {
  Row row;
  const CombinedCone cone = combined_cone(a, b, tolerance);
  row.inner_area = cone.inner.cross_section_area;
  row.outer_area = cone.outer.cross_section_area;
  row.inner_solid_angle = cone.inner.solid_angle;
  row.outer_solid_angle = cone.outer.solid_angle;
  for (const int n : planes)
    row.slice_areas.push_back(combined_slice_cone(a, b, n).polyhedral().cross_section_area);
  return row;
}

std::string header(const std::vector<int>& planes) {
  std::string text = "engagement,inner_area,outer_area,inner_solid_angle_sr,outer_solid_angle_sr";
  for (const int n : planes) text += ",slice_area_n" + std::to_string(n);
  return text + body_columns();
}

std::string line(std::uint64_t index, const Row& row, const Ellipsoid& a, const CombinedEllipsoid& b) {
  std::string text = std::to_string(index);
  for (const double x : {row.inner_area, row.outer_area, row.inner_solid_angle, row.outer_solid_angle})
    text += "," + to_text(x);
  for (const double x : row.slice_areas) text += "," + to_text(x);
  return text + body_cells(a, b.ellipsoid());
}

std::vector<Row> read_combined(const fs::path& path, std::size_t planes) {
  std::vector<Row> rows;
  for (const auto& x : read_numbers(path, 4 + planes + kBodyColumns))
    rows.push_back(
        {x[0], x[1], x[2], x[3], {x.begin() + 4, x.begin() + 4 + static_cast<std::ptrdiff_t>(planes)}});
  return rows;
}

/// The part of the true area that a slice area misses: between these two. The lower one may be negative: what
/// lies between slices need not be in the cone.
struct Missing {
  double at_least = 0, at_most = 0;
};
Missing missing(double slice_area, const Row& row) {
  return {1 - slice_area / row.inner_area, 1 - slice_area / row.outer_area};
}

struct MissingSpread {
  Missing mean, worst{-1e300, -1e300};
};

MissingSpread missing_spread(const std::vector<Row>& rows, std::size_t planes) {
  MissingSpread s;
  for (const Row& row : rows) {
    const Missing m = missing(row.slice_areas[planes], row);
    s.mean.at_least += m.at_least / static_cast<double>(rows.size());
    s.mean.at_most += m.at_most / static_cast<double>(rows.size());
    s.worst.at_least = std::max(s.worst.at_least, m.at_least);
    s.worst.at_most = std::max(s.worst.at_most, m.at_most);
  }
  return s;
}

Json missing_json(const Missing& m) { return {m.at_least, m.at_most}; }
Json missing_json(const MissingSpread& s) {
  return {{"mean", missing_json(s.mean)}, {"worst", missing_json(s.worst)}};
}

struct CombinedSummary {
  std::size_t engagements = 0;
  int finest_planes = 0;
  SliceErrors slices;
  std::vector<MissingSpread> missing;  // of each plane count
  MissingSpread slice_bias;
  std::vector<Missing> slice_bias_values;
  Spread reference_gap;  // between inner and outer reference cone, parts of the solid angle
};

CombinedSummary summarise_combined(const std::vector<Row>& rows, const std::vector<int>& planes) {
  CombinedSummary summary;
  summary.engagements = rows.size();
  const std::size_t finest = planes.size() - 1;
  summary.finest_planes = planes[finest];
  std::vector<std::vector<double>> areas;
  areas.reserve(rows.size());
  for (const Row& row : rows) areas.push_back(row.slice_areas);
  summary.slices = slice_errors(areas, planes);
  for (std::size_t i = 0; i < planes.size(); ++i) summary.missing.push_back(missing_spread(rows, i));
  summary.slice_bias = missing_spread(rows, finest);
  std::vector<double> gaps;
  gaps.reserve(rows.size());
  for (const Row& row : rows) {
    summary.slice_bias_values.push_back(missing(row.slice_areas[finest], row));
    gaps.push_back(1 - row.inner_solid_angle / row.outer_solid_angle);
  }
  summary.reference_gap = spread(gaps);
  return summary;
}

Json to_json(const CombinedSummary& s) {
  Json summary{{"engagements", s.engagements}, {"finest_planes", s.finest_planes}};
  Json slices = Json::array(), values = Json::array();
  for (std::size_t i = 0; i < s.missing.size(); ++i) {
    slices.push_back(discretisation_json(s.slices.counts[i]));
    slices.back()["error_against_true_cone"] = missing_json(s.missing[i]);
  }
  summary["slice"] = slices;
  if (s.slices.order) summary["slice_order"] = *s.slices.order;
  summary["slice_bias"] = missing_json(s.slice_bias);
  for (const Missing& m : s.slice_bias_values) values.push_back(missing_json(m));
  summary["slice_bias_values"] = values;
  summary["reference_gap"] = spread_json(s.reference_gap);
  return summary;
}

void print_combined_summary(const CombinedSummary& s, std::ostream& out) {
  const auto range = [](const Missing& m) { return percent(m.at_least) + " to " + percent(m.at_most); };
  out << "  planes   discretisation error      2/n   above it   missing from the true cone, between\n"
      << "           median     worst                           mean                   worst\n";
  for (std::size_t i = 0; i < s.missing.size(); ++i)
    out << std::setw(8) << s.slices.counts[i].planes << "   " << discretisation_text(s.slices.counts[i])
        << "     " << std::left << std::setw(23) << range(s.missing[i].mean) << range(s.missing[i].worst)
        << std::right << '\n';
  if (s.slices.order)
    out << "  discretisation error falls as n^" << std::fixed << std::setprecision(2) << *s.slices.order
        << '\n';
  out << "  slice bias (n = " << s.finest_planes << "): mean " << range(s.slice_bias.mean) << ", worst "
      << range(s.slice_bias.worst) << "\n  inner and outer reference cone differ by "
      << percent(s.reference_gap.median) << " (median), " << percent(s.reference_gap.worst)
      << " (worst) of the solid angle\n";
}

}  // namespace

int run_combined_accuracy(const Options& options, ObstacleKind kind, std::ostream& out) {
  if (!options.scans.empty())
    throw InputError("--scan", options.scans.front(), "left out with --obstacle " + options.obstacle);
  const double tolerance = options.tolerance.value_or(kReferenceTolerance);
  if (!(tolerance > 0 && tolerance < 1))
    throw InputError("--tolerance", to_text(tolerance), "between 0 and 1, both excluded");
  const std::uint64_t count = options.engagements.value_or(kDefaultEngagements);
  const Distribution from = distribution(options);
  work::ResumableTable campaign{"engagements.csv"};
  campaign.header = header(options.planes);
  campaign.block = 5;
  campaign.count = count;
  campaign.settings = "# vericone accuracy, obstacle " + options.obstacle + ", tolerance " +
                      to_text(tolerance) + ", seed " + std::to_string(options.seed) + ", " +
                      std::to_string(count) + " engagements" + distribution_settings(options) + ", planes " +
                      planes_text(options.planes);
  campaign.row = [&](std::uint64_t i) {
    const auto [a, b] = random_combined_engagement(kind, options.seed, i, from);
    return line(i, measure_combined(a, b, options.planes, tolerance), a, b);
  };
  const auto tell = [&](Results& found, work::StagedFolder& folder) {
    const CombinedSummary summary = summarise_combined(
        read_combined(folder.resumable(campaign.name), options.planes.size()), options.planes);
    found.summary["random"] = to_json(summary);
    found.summary["random"].update(
        {{"obstacle", options.obstacle}, {"tolerance", tolerance}, {"drawn", distribution_text(from)}});
    found.scripts = {"combined_accuracy.py"};
    found.files = {campaign.name, "summary.json", "provenance.json"};
    found.old = {"accuracy.pdf", "accuracy.png"};
    found.text << count << " random engagements with " << options.obstacle << " obstacles, "
               << options.planes.size() << " plane counts, true cones certified to " << percent(tolerance)
               << ", " << std::fixed << std::setprecision(1) << found.origin["seconds"].get<double>()
               << " s\n";
    print_combined_summary(summary, found.text);
    found.origin.update({{"seed", options.seed},
                         {"obstacle", options.obstacle},
                         {"tolerance", tolerance},
                         {"engagements", count},
                         {"planes", options.planes}});
  };
  return run_job({options, {}, {{campaign, options.obstacle + " obstacles"}}}, tell, out);
}

}  // namespace vericone::accuracy
