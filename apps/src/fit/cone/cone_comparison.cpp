// SPDX-License-Identifier: BSD-3-Clause
#include "fit/cone/cone_comparison.h"

#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <vericone/internal/fitting/canonical.h>
#include <vericone/internal/fitting/convex_hull.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fit/cone/cone_bodies.h"
#include "input/stopwatch.h"

namespace vericone {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kFinest = 1e-8;  // radians, of cone maps

/// The bodies that are compared, which all agents share.
struct Bodies {
  Assembly scan;
  Vector3d middle;
  std::optional<Ellipsoid> ellipsoid;
  std::optional<HullBody> convex_hull;
  std::optional<double> convex_hull_volume;
};

bool proved_to_contain(const fitting::FitResult& fit) {
  return fit.certified && fit.certificate.all_inside();
}

Bodies bodies_of(const fitting::Sample& scan, const fitting::FitResult& fit,
                 std::vector<std::string>& notes) {
  std::vector<Vector3d> points;
  for (const std::uint32_t i : fitting::used_points(scan)) points.push_back(scan.points[i]);
  const double radius = fit.certificate.margin;
  Bodies bodies{
      .scan = scan.is_mesh() ? Assembly::mesh(scan.points, scan.triangles) : Assembly::cloud(points, radius),
      .middle = Vector3d::Zero(),
      .ellipsoid = {},
      .convex_hull = {},
      .convex_hull_volume = {}};
  bodies.middle = bodies.scan.bounds().center();
  try {
    bodies.ellipsoid = min_volume_ellipsoid<3>(points).body;
    const fitting::ConvexHull hull = fitting::convex_hull(points);
    std::vector<Vector3d> corners;
    for (const std::uint32_t i : hull.vertices) corners.push_back(points[i]);
    // Inside of both hulls wherever the scan is.
    bodies.middle = Vector3d::Zero();
    for (const Vector3d& x : corners) bodies.middle += (x - bodies.middle) / double(&x - corners.data() + 1);
    bodies.convex_hull = HullBody(std::move(corners));
    bodies.convex_hull_volume = hull.volume;
  } catch (const InputError& e) {
    notes.push_back("no ellipsoid or convex hull with a volume: points " + e.value());
  }
  if (!scan.is_mesh())
    notes.push_back(radius > 0 ? "the scan is a cloud: its cone is that of balls of " + to_text(radius) +
                                     " m about its points"
                               : "the scan is a cloud: its cone is that of its points, with what gaps there "
                                 "are between them for this agent");
  if (!scan.is_mesh() && radius > 0)
    notes.push_back("ellipsoid and convex hull are those of the points, without the balls");
  if (!fit.certified)
    notes.push_back(
        "the hull is not proved to contain the scan: the excess compares sizes of cones, and "
        "directions may be missing");
  return bodies;
}

/// `contains`: the body is proved to contain the scan, so its cone contains the scan's.
void set_excess(ConeRow& row, const ConeRow& scan, bool contains) {
  if (contains) row.low = std::max(row.low, scan.low);
  row.excess_low = scan.high > 0 ? row.low / scan.high - 1 : 0;
  if (contains) row.excess_low = std::max(row.excess_low, 0.0);
  row.excess_high = scan.low > 0 ? row.high / scan.low - 1 : std::numeric_limits<double>::infinity();
}

class Comparison {
 public:
  Comparison(const fitting::FitResult& fit, const Bodies& bodies, const ConeComparisonOptions& options)
      : fit_(fit), bodies_(bodies), options_(options) {}

  ConesOfAgent of(const ConeAgent& agent, double begin, double end) {
    begin_ = begin;
    end_ = end;
    ConesOfAgent cones{agent, (bodies_.middle - agent.body.center()).stableNormalized(), {}};
    const AssemblyOracle oracle(agent.body, bodies_.scan);
    if (const Relation r = oracle.relation(); r != Relation::disjoint)
      throw InputError("--cone", agent.text,
                       std::string("an agent apart from the scan: they are ") + to_string(r));

    std::optional<ConeRow> ellipsoid, hull, convex;
    // The widest cones first: they say how fine the maps have to be.
    if (bodies_.ellipsoid)
      ellipsoid = row("ellipsoid", bodies_.ellipsoid->volume(),
                      [&] { return cone_of_ellipsoid(agent.body, *bodies_.ellipsoid); });
    MapSettings settings;
    settings.threads = options_.threads;
    settings.resolution = std::max(kFinest, options_.resolution * radius_of(ellipsoid));
    const double tolerance = std::clamp(options_.resolution, 1e-4, 0.01);
    settings.progress = [&](double share) { return told("cone of the hull", 0.5 * share); };
    hull = row("hull", fit_.volume ? std::optional(fit_.volume->value) : std::nullopt,
               [&] { return cone_of_pieces(agent.body, fit_.pieces, tolerance, settings); });
    if (bodies_.convex_hull)
      convex = row("convex hull", bodies_.convex_hull_volume,
                   [&] { return cone_of_polyhedron(agent.body, *bodies_.convex_hull, bodies_.middle); });
    settings.progress = [&](double share) { return told("cone of the scan", 0.5 + 0.5 * share); };
    ConeRow scan = row("scan", fit_.scan_volume, [&] { return cone_by_map(oracle, settings); });
    if (scan.outline.empty())
      throw InputError("--cone", agent.text, "an agent outside of the scan: it is enclosed by it");
    // The minimum-volume ellipsoid contains every point exactly; nothing proves that Qhull's corners do.
    if (ellipsoid) set_excess(*ellipsoid, scan, bodies_.scan.radius() == 0);
    set_excess(*hull, scan, proved_to_contain(fit_));
    if (convex) set_excess(*convex, scan, false);
    cones.rows.push_back(std::move(scan));
    for (auto* other : {&ellipsoid, &hull, &convex})
      if (*other) cones.rows.push_back(std::move(**other));
    return cones;
  }

 private:
  template <typename Cone>
  ConeRow row(const char* what, std::optional<double> volume, const Cone& cone_of) const {
    const auto start = Clock::now();
    BodyCone cone = cone_of();
    return {.what = what,
            .low = cone.low,
            .high = cone.high,
            .volume = volume,
            .seconds = seconds_since(start),
            .method = std::move(cone.method),
            .overlapping = cone.disjoint ? 0 : 1,
            .outline = std::move(cone.outline)};
  }

  /// Of a circular cone of the same solid angle, at most 1.
  static double radius_of(const std::optional<ConeRow>& cone) {
    if (!cone || cone->overlapping) return 1;
    return std::min(1.0, std::acos(std::max(-1.0, 1 - cone->high / (2 * pi))));
  }

  bool told(const char* what, double share) const {
    return !options_.progress || options_.progress(what, begin_ + (end_ - begin_) * share);
  }

  const fitting::FitResult& fit_;
  const Bodies& bodies_;
  const ConeComparisonOptions& options_;
  double begin_ = 0, end_ = 1;
};

/// Rows of all agents are of the same bodies in the same order.
std::vector<ConeRow> mean_of(const std::vector<ConesOfAgent>& agents) {
  std::vector<ConeRow> mean;
  const double share = 1 / double(agents.size());
  for (const ConeRow& first : agents.front().rows) {
    ConeRow& row = mean.emplace_back();
    row.what = first.what;
    row.volume = first.volume;
    row.method = first.method;
  }
  for (const ConesOfAgent& agent : agents)
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const ConeRow& row = agent.rows[i];
      mean[i].low += share * row.low;
      mean[i].high += share * row.high;
      mean[i].excess_low += share * row.excess_low;
      mean[i].excess_high += share * row.excess_high;
      mean[i].seconds += row.seconds;
      mean[i].overlapping += row.overlapping;
      if (row.method != mean[i].method) mean[i].method = "various";
    }
  return mean;
}

}  // namespace

ConeComparison compare_cones(const fitting::Sample& scan, const fitting::FitResult& fit,
                             const ConeRequest& request, const ConeComparisonOptions& options) {
  if (!(options.resolution >= 1e-4 && options.resolution <= 1))
    throw InputError("--cone", "a resolution of " + to_text(options.resolution), "between 1e-4 and 1");
  ConeComparison comparison;
  comparison.resolution = options.resolution;
  const Bodies bodies = bodies_of(scan, fit, comparison.notes);
  const std::vector<ConeAgent> agents = agents_of(request, scan);
  Comparison compare(fit, bodies, options);
  for (std::size_t i = 0; i < agents.size(); ++i)
    comparison.agents.push_back(
        compare.of(agents[i], double(i) / double(agents.size()), double(i + 1) / double(agents.size())));
  comparison.mean = mean_of(comparison.agents);
  return comparison;
}

}  // namespace vericone
