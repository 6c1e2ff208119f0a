// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/internal/verify/spatial/contact_march.h>
#include <vericone/internal/verify/spatial/minkowski_bounds.h>
#include <vericone/verify/spatial/campaign.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vericone::verify {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kDirectionStream = 150;
constexpr int kSphereLevel = 2;
constexpr int kDirections = 40;        // of each of the two random kinds
constexpr int kPerturbedSamples = 24;  // boundary directions to move in and out
constexpr int kSlices = 16;
constexpr double kMoved = 1e-6;
constexpr double kGrazing = 1e-9;
constexpr double kSquare = 0.01;    // closing from which contact times are compared
constexpr int kManySamples = 3072;  // enough for the trapezoidal rule to have converged for thin bodies too

/// What is asked about one pair.
class PairChecks {
 public:
  PairChecks(const Ellipsoid& a, const Ellipsoid& b, std::uint64_t index, SpatialFamilyReport& report)
      : a_(a),
        b_(b),
        index_(index),
        report_(report),
        oracle_(a, b),
        march_(a, b),
        bounds_(minkowski_bounds(a, b, kSphereLevel)),
        cone_(true_cone(a, b, kPerturbedSamples)) {}

  bool disjoint() {
    const bool holds =
        oracle_.relation() == Relation::disjoint && march_.distance(Vector3d::Zero()).distance > 1;
    report_.relation.note(holds, index_);
    if (bounds_.outer.everything()) ++report_.no_outer_polyhedron;
    return holds;
  }

  /// Membership of w against polyhedra and march.
  Membership direction(const Vector3d& w) {
    const Membership membership = oracle_.membership(w);
    const bool collides = membership != Membership::out;
    report_.polyhedra.note(
        (collides || !bounds_.inner.contains(w)) && (!collides || bounds_.outer.contains(w)), index_);
    const ContactMarch::Result contact = march_.first_contact(w);
    // Within rounding of grazing the march says nothing. It stops at 1 when it hits, so depth is judged by
    // how fast the distance falls there.
    if (contact.time ? contact.closing < kGrazing : contact.closest < 1 + kGrazing) {
      ++report_.march_grazing;
      return membership;
    }
    report_.march.note(collides == contact.time.has_value(), index_);
    if (collides && contact.time) {
      const double time = contact_time(a_, b_, w);
      if (contact.closing > kSquare)
        report_.time.raise(std::abs(time - *contact.time) / *contact.time, index_);
      report_.surface.raise(
          std::abs(march_.distance(time * w).distance - 1) / (0x1p-52 * march_.resolution(time * w)), index_);
    }
    return membership;
  }

  void random_directions(std::uint64_t seed) {
    SeededRandom random(kDirectionStream + static_cast<std::uint32_t>(report_.family), seed, index_);
    const Vector3d c = b_.center() - a_.center();
    // Twice as wide as a right circular cone of the same size.
    const double width = std::min(2.0, 2 * std::sqrt(cone_.solid_angle / 3.0));
    for (int i = 0; i < kDirections; ++i) {
      const double off = width * random.uniform(0, 1);
      const Vector3d around = c.normalized() + off * random.direction<3>();
      direction(around);
      clearance_of(around, random.direction<3>());
      direction(random.direction<3>());
    }
  }

  void perturbed_directions() {
    for (const BoundarySample& s : cone_.boundary) {
      const Vector3d in = s.direction + kMoved * (cone_.axis - s.direction),
                     out = s.direction - kMoved * (cone_.axis - s.direction);
      report_.perturbed.note(direction(in) == Membership::in, index_);
      report_.perturbed.note(direction(out) == Membership::out, index_);
    }
  }

  /// Returns the gaps relative to the solid angle.
  std::array<double, kGapSamples.size()> cones() {
    std::array<double, kGapSamples.size()> gaps;
    const double truth = true_cone(a_, b_, kManySamples).solid_angle;
    for (std::size_t i = 0; i < kGapSamples.size(); ++i) {
      const TrueCone cone = true_cone(a_, b_, kGapSamples[i]);
      const ConeBounds bounds = cone_bounds(cone, a_, b_);
      gaps[i] = (bounds.outer.solid_angle - bounds.inner.solid_angle) / bounds.solid_angle;
      if (kGapSamples[i] != 96) continue;
      report_.gap.raise(gaps[i], index_);
      report_.value.raise(std::abs(bounds.solid_angle / truth - 1), index_);
      const double least = bounds_.inner.solid_angle(), most = bounds_.outer.solid_angle();
      report_.solid_angle.note(least <= truth && truth <= most && least <= bounds.outer.solid_angle &&
                                   bounds.inner.solid_angle <= most &&
                                   std::abs(bounds.solid_angle - truth) <= bounds.solid_angle_error &&
                                   bounds.inner.solid_angle <= bounds.solid_angle &&
                                   bounds.solid_angle <= bounds.outer.solid_angle,
                               index_);
      for (const Vector3d& w : bounds.inner.directions)
        report_.inner_bound.note(oracle_.membership(w) != Membership::out, index_);
      for (const Vector3d& w : bounds.outer.directions)
        report_.outer_bound.note(oracle_.membership(w + 1e-9 * (w - cone.axis)) == Membership::out, index_);
    }
    for (const Vector3d& w : slice_cone(a_, b_, kSlices).polyhedral().directions)
      report_.slices.note(oracle_.membership(w + 1e-9 * (cone_.axis - w)) != Membership::out, index_);
    return gaps;
  }

 private:
  /// Shifting B against the clearance's normal by the clearance makes the line of motion graze; a little less
  /// must leave the line as it was, a little more must change it. So must a little less in every other
  /// direction across the line, here four, turned at random by `turn`. The line is w or -w, ahead or behind.
  void clearance_of(const Vector3d& w, const Vector3d& turn) {
    const Clearance m = clearance(a_, b_, w);
    // What the coordinates resolve.
    if (std::abs(m.distance) < 1e-8 * (b_.center() - a_.center()).norm()) return;
    const auto misses = [&](const Vector3d& shift) {
      const Vector3d center = b_.center() + shift;
      const ConeOracle oracle(a_, b_.defined_by_factor() ? b_.translated(center - b_.center())
                                                         : Ellipsoid::from_shape(center, b_.shape()));
      return oracle.relation() == Relation::disjoint && oracle.membership(w) == Membership::out &&
             oracle.membership(-w) == Membership::out;
    };
    const bool miss = m.distance > 0;
    const Vector3d across = w.cross(turn).normalized(), second = w.cross(across).normalized();
    bool holds = misses(Vector3d::Zero()) == miss;
    for (const Vector3d& n : {m.normal, across, Vector3d(-across), second, Vector3d(-second)})
      holds = holds && misses((kMoved - 1) * m.distance * n) == miss;
    holds = holds && misses(-(1 + kMoved) * m.distance * m.normal) != miss;
    report_.clearance.note(holds, index_);
  }

  const Ellipsoid& a_;
  const Ellipsoid& b_;
  std::uint64_t index_;
  SpatialFamilyReport& report_;
  ConeOracle oracle_;
  ContactMarch march_;
  MinkowskiBounds bounds_;
  TrueCone cone_;
};

double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Least-squares slope of log gap against log samples.
double slope(const std::array<double, kGapSamples.size()>& gaps) {
  double x = 0, y = 0, xx = 0, xy = 0;
  // From 48 samples on: 24 are too few for the law to hold of bodies that lie sideways.
  const double n = static_cast<double>(kGapSamples.size() - 1);
  for (std::size_t i = 1; i < kGapSamples.size(); ++i) {
    const double u = std::log(kGapSamples[i]), v = std::log(gaps[i]);
    x += u, y += v, xx += u * u, xy += u * v;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

std::string short_text(const char* format, double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, x);
  return buffer;
}

std::string cell(const Check& check) {
  std::string text = std::to_string(check.failed) + "/" + std::to_string(check.tried);
  if (check.failed) text += " #" + std::to_string(check.first_failed_index);
  return text;
}

std::string cell(const WorstFigure& worst) {
  return short_text("%.2g", worst.value) + " #" + std::to_string(worst.index);
}

std::string row(std::initializer_list<std::string> cells) {
  std::string out = "|";
  for (const std::string& c : cells) out += " " + c + " |";
  return out + "\n";
}

}  // namespace

std::uint64_t SpatialFamilyReport::failures() const {
  std::uint64_t sum = 0;
  for (const Check* c : {&relation, &polyhedra, &march, &perturbed, &solid_angle, &inner_bound, &outer_bound,
                         &slices, &clearance})
    sum += c->failed;
  return sum;
}

SpatialFamilyReport run_spatial_family(SpatialFamily family, std::uint64_t cases, std::uint64_t seed,
                                       const std::function<bool()>& stop) {
  SpatialFamilyReport report;
  report.family = family;
  report.seed = seed;
  std::array<std::vector<double>, kGapSamples.size()> gaps;
  for (std::uint64_t index = 0; index < cases && !(stop && stop()); ++index) {
    ++report.cases;
    const auto [a, b] = spatial_pair(family, seed, index);
    PairChecks checks(a, b, index, report);
    if (!checks.disjoint()) continue;
    checks.random_directions(seed);
    checks.perturbed_directions();
    const auto of_pair = checks.cones();
    for (std::size_t i = 0; i < gaps.size(); ++i) gaps[i].push_back(of_pair[i]);
  }
  for (std::size_t i = 0; i < gaps.size(); ++i) report.gap_medians[i] = median(gaps[i]);
  report.gap_slope = slope(report.gap_medians);
  return report;
}

std::vector<SpatialFamilyReport> run_spatial_campaign(std::uint64_t cases, std::uint64_t seed) {
  std::vector<SpatialFamilyReport> reports;
  for (const SpatialFamily family : kAllSpatialFamilies)
    reports.push_back(run_spatial_family(family, cases, seed));
  return reports;
}

std::string to_markdown(std::span<const SpatialFamilyReport> reports) {
  std::string out = row({"family", "seed", "pairs", "relation", "polyhedra", "march", "perturbed",
                         "solid angle", "inner bound", "outer bound", "slices", "clearance"}) +
                    row({"---", "---", "---", "---", "---", "---", "---", "---", "---", "---", "---", "---"});
  for (const SpatialFamilyReport& r : reports)
    out += row({name(r.family), std::to_string(r.seed), std::to_string(r.cases), cell(r.relation),
                cell(r.polyhedra), cell(r.march), cell(r.perturbed), cell(r.solid_angle), cell(r.inner_bound),
                cell(r.outer_bound), cell(r.slices), cell(r.clearance)});
  out += "\n" +
         row({"family", "no outer polyhedron", "left out as grazing", "contact time worst rel.",
              "off surface worst eps", "solid angle worst rel. at 96", "gap median 24", "48", "96", "192",
              "slope", "gap worst at 96"}) +
         row({"---", "---", "---", "---", "---", "---", "---", "---", "---", "---", "---", "---"});
  for (const SpatialFamilyReport& r : reports)
    out += row({name(r.family), std::to_string(r.no_outer_polyhedron), std::to_string(r.march_grazing),
                cell(r.time), cell(r.surface), cell(r.value), short_text("%.2g", r.gap_medians[0]),
                short_text("%.2g", r.gap_medians[1]), short_text("%.2g", r.gap_medians[2]),
                short_text("%.2g", r.gap_medians[3]), short_text("%.2f", r.gap_slope), cell(r.gap)});
  return out;
}

}  // namespace vericone::verify
