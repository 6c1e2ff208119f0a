// SPDX-License-Identifier: GPL-3.0-or-later
#include "combined/engagement.h"

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace vericone::verify {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kStream = 730;
constexpr int kCoarse = 1, kFine = 2;
constexpr int kDenseSamples = 20000;
constexpr double kReach = 1e-3;  // of distances, what samples resolve
constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-13;

double det(const Vector3d& x, const Vector3d& y, const Vector3d& z) { return x.cross(y).dot(z); }

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Solid angle of the polygon about the axis: the sum of signed spherical triangles (Van Oosterom, Strackee).
double solid_angle(const PolyhedralCone& polygon, const Vector3d& axis) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.directions.size(); ++i) {
    const Vector3d &x = polygon.directions[i], &y = polygon.directions[(i + 1) % polygon.directions.size()];
    sum += 2 * std::atan2(det(axis, x, y), 1 + axis.dot(x) + x.dot(y) + y.dot(axis));
  }
  return sum;
}

/// Counter-clockwise: no edge runs backwards about the axis, to rounding.
bool star_shaped(const PolyhedralCone& polygon, const Vector3d& axis) {
  for (std::size_t i = 0; i < polygon.directions.size(); ++i)
    if (det(axis, polygon.directions[i], polygon.directions[(i + 1) % polygon.directions.size()]) < -1e-12)
      return false;
  return true;
}

}  // namespace

bool within(const PolyhedralCone& polygon, const Vector3d& axis, const Vector3d& d, double margin) {
  const Vector3d u = d.normalized();
  // Everything: its directions are all opposite to the axis.
  if (polygon.solid_angle >= 4 * kPi) return true;
  if ((u - axis).norm() < kRounding) return margin <= 0;
  for (std::size_t i = 0; i < polygon.directions.size(); ++i) {
    const Vector3d &x = polygon.directions[i], &y = polygon.directions[(i + 1) % polygon.directions.size()];
    // Of the wedge of half-planes between x and y, or within rounding of its ends.
    if (det(axis, x, y) <= 0 || det(axis, x, u) < -kRounding || det(axis, u, y) < -kRounding) continue;
    if (axis.cross(x + y).dot(axis.cross(u)) <= 0) continue;
    // The plane through x and y parts each half-plane of the wedge at one direction.
    if (det(x, y, u) > margin) return true;
  }
  return false;
}

CombinedEngagement::CombinedEngagement(const CombinedPair& pair, const CombinedOptions& options,
                                       std::uint64_t index, CombinedFamilyReport& report)
    : pair_(pair),
      options_(options),
      index_(index),
      report_(report),
      random_(kStream + static_cast<std::uint32_t>(report.family), options.seed, index),
      truth_(pair.a, pair.b, index % options.fine_every == 0 ? kFine : kCoarse),
      sweep_(pair.a, pair.b, options.samples),
      oracle_(pair.a, pair.b, options.oracle_tolerance),
      c_(pair.b.center() - pair.a.center()),
      width_(1.5 * (pair.a.ellipsoid().semi_axes()(0) + pair.b.ellipsoid().semi_axes()(0)) / c_.norm()) {}

void CombinedEngagement::expect(Check& check, bool holds, const char* what, const Vector3d& w) {
  check.note(holds, index_);
  if (holds || !report_.first_failure.empty()) return;
  char text[200];
  std::snprintf(text, sizeof text, "%s seed %llu index %llu: %s, w = (%.17g, %.17g, %.17g)",
                name(report_.family), static_cast<unsigned long long>(report_.seed),
                static_cast<unsigned long long>(index_), what, w.x(), w.y(), w.z());
  report_.first_failure = text;
}

CombinedEngagement::Known CombinedEngagement::known(const GridVector& w) const {
  Known k;
  k.truth = truth_.direction(w);
  (k.truth == Truth::in    ? report_.proved_in
   : k.truth == Truth::out ? report_.proved_out
                           : report_.unproved) += 1;
  k.found = k.truth == Truth::in || meets(sweep_, as_vector(w));
  return k;
}

bool CombinedEngagement::meets(const CombinedSweep& sweep, const Vector3d& w) const {
  for (int way = 0; way < 2; ++way) {
    const auto hit = way == 0 ? sweep.first(w) : sweep.search(w);
    if (hit && exactly_meets(pair_.a, pair_.b, hit->x, w, hit->t)) return true;
  }
  return false;
}

const CombinedSweep& CombinedEngagement::dense() {
  if (!dense_) dense_.emplace(pair_.a, pair_.b, kDenseSamples);
  return *dense_;
}

bool CombinedEngagement::confirmed(const Vector3d& w) {
  if (meets(sweep_, w)) return true;
  if (meets(dense(), w)) return true;
  if (!exchanged_) exchanged_.emplace(pair_.b, pair_.a, kDenseSamples);
  const auto hit = exchanged_->search(-w);
  return hit && exactly_meets(pair_.b, pair_.a, hit->x, -w, hit->t);
}

bool CombinedEngagement::overlap_found(const CombinedEllipsoid& a) const {
  const Vector3d c = pair_.b.center() - a.center(), e = c.normalized();
  const double back = 3 * (a.ellipsoid().semi_axes()(0) + pair_.b.ellipsoid().semi_axes()(0));
  const auto hit = CombinedSweep(a.translated(-back * e), pair_.b, kDenseSamples).earliest(e);
  return hit && hit->t <= back * (1 + kReach);
}

GridVector CombinedEngagement::random_direction(bool any) {
  if (any) return grid_direction(random_.direction<3>());
  const double off = width_ * random_.uniform(0, 1);
  return grid_direction(c_.normalized() + off * random_.direction<3>());
}

bool CombinedEngagement::relation() {
  const auto r = oracle_.relation();
  (!r ? report_.undecided : *r == Relation::disjoint ? report_.disjoint : report_.overlapping) += 1;
  const auto contrary = [](std::optional<Relation> x, std::optional<Relation> y) {
    return x && y && (*x == Relation::disjoint) != (*y == Relation::disjoint);
  };
  expect(report_.relation, !contrary(r, truth_.relation()), "relation against polyhedra", c_);
  const CombinedOracle mirrored(pair_.b, pair_.a, options_.oracle_tolerance);
  expect(report_.relation, !contrary(r, mirrored.relation()), "relation of the exchanged bodies", c_);
  const auto overlap = sweep_.march(Vector3d::Zero(), 0, 1);
  if (overlap && exactly_meets(pair_.a, pair_.b, overlap->x, Vector3d::Zero(), 0))
    expect(report_.relation, r != Relation::disjoint, "disjoint, but a point is in both", c_);
  if (report_.family != CombinedFamily::mouth && report_.family != CombinedFamily::nearly_touching)
    expect(report_.relation, r != Relation::overlapping, "relation of ellipsoids put apart", c_);
  if (r == Relation::overlapping) report_.confirmed.note(overlap || overlap_found(pair_.a), index_);
  if (truth_.relation() != Relation::disjoint) ++report_.no_outer;
  return r == Relation::disjoint;
}

void CombinedEngagement::directions() {
  const CombinedOracle mirrored(pair_.b, pair_.a, options_.oracle_tolerance);
  double spent = 0;
  for (int i = 0; i < 2 * options_.directions; ++i) {
    const GridVector g = random_direction(i % 4 == 3);
    const Vector3d w = as_vector(g);
    const double start = seconds();
    const Certified m = oracle_.membership(w);
    spent += seconds() - start;
    const Known k = known(g);
    expect(report_.membership, m != Certified::in || k.truth != Truth::out, "in, but proved out", w);
    expect(report_.membership, m != Certified::out || !k.found, "out, but a contact was found", w);
    if (m == Certified::in) report_.confirmed.note(k.found || confirmed(w), index_);
    report_.decided.note(m != Certified::undecided, index_);
    const Certified n = mirrored.membership(-w);
    expect(report_.mirrored,
           !(m == Certified::in && n == Certified::out) && !(m == Certified::out && n == Certified::in),
           "contrary answers for exchanged bodies", w);
  }
  expect(report_.membership, oracle_.membership(c_) != Certified::out, "the line of centres out", c_);
  expect(report_.membership, oracle_.membership(-c_) != Certified::in, "away from the centre in", -c_);
  expect(report_.membership, oracle_.membership(Vector3d::Zero()) == Certified::out, "rest not out",
         Vector3d::Zero());
  report_.microseconds_membership += spent / (2 * options_.directions) * 1e6;
}

void CombinedEngagement::said_in(Check& check, const Vector3d& w, const char* what) {
  expect(check, oracle_.membership(w) != Certified::out, what, w);
  const GridVector g = grid_direction(w);
  expect(check, truth_.direction(g) != Truth::out, what, as_vector(g));
}

void CombinedEngagement::said_out(Check& check, const Vector3d& w, const char* what) {
  expect(check, oracle_.membership(w) != Certified::in, what, w);
  const GridVector g = grid_direction(w);
  expect(check, !known(g).found, what, as_vector(g));
}

void CombinedEngagement::cone() {
  const double start = seconds();
  const double tolerance = index_ % 4 == 0 ? options_.tolerance / 4 : options_.tolerance;
  const CombinedCone cone = combined_cone(pair_.a, pair_.b, tolerance, options_.most_boxes);
  report_.milliseconds_cone += (seconds() - start) * 1e3;
  const Vector3d axis = cone.axis;
  // Its oracle may be coarser and not decide.
  expect(report_.nested, !cone.relation || *cone.relation == Relation::disjoint, "disjoint bodies overlap",
         c_);
  if (cone.relation != Relation::disjoint) return;
  const double inner = cone.inner.solid_angle, outer = cone.outer.solid_angle;
  report_.gap.raise((outer - inner) / outer, index_);
  expect(report_.nested, (axis - c_.normalized()).norm() < 1e-14, "axis", axis);
  expect(report_.nested, inner <= outer && cone.solid_angle_error >= 0.5 * (outer - inner), "bounds", axis);
  expect(report_.nested, std::abs(cone.solid_angle - 0.5 * (outer + inner)) <= 1e-14 * outer, "middle", axis);
  expect(report_.nested,
         !(cone.cross_section_area_error < 0) &&
             (std::isinf(cone.cross_section_area) ||
              cone.inner.cross_section_area <= cone.outer.cross_section_area),
         "areas", axis);
  expect(report_.nested, std::abs(solid_angle(cone.inner, axis) - inner) <= 1e-9 * (1 + inner),
         "solid angle of the inner polygon", axis);
  if (outer < 4 * kPi * (1 - 1e-9))
    expect(report_.nested, std::abs(solid_angle(cone.outer, axis) - outer) <= 1e-9 * (1 + outer),
           "solid angle of the outer polygon", axis);
  expect(report_.nested, star_shaped(cone.inner, axis) && star_shaped(cone.outer, axis), "order", axis);
  const std::size_t n = cone.inner.directions.size(), step = std::max<std::size_t>(1, n / 12);
  const std::size_t first = static_cast<std::size_t>(random_.integer(0, static_cast<int>(step) - 1));
  for (std::size_t i = first; i < n; i += step) {
    const Vector3d &x = cone.inner.directions[i], &y = cone.inner.directions[(i + 1) % n];
    // Drawn in by a rounding of the grid: within the polygon even after it.
    const double s = random_.uniform(0, 1), t = random_.uniform(0, 1);
    said_in(report_.inner, x, "vertex of the inner polygon");
    said_in(report_.inner, (1 - s) * x + s * y, "edge of the inner polygon");
    const Vector3d d = t * axis + (1 - t) * ((1 - s) * x + s * y);
    said_in(report_.inner, d, "within the inner polygon");
    report_.confirmed.note(confirmed(d), index_);
    if (outer < 4 * kPi * (1 - 1e-9) && x.dot(axis) > -0.999)
      expect(report_.nested, within(cone.outer, axis, x, -1e-9), "inner vertex beyond the outer polygon", x);
  }
  const std::size_t m = cone.outer.directions.size(), stride = std::max<std::size_t>(1, m / 12);
  for (std::size_t i = first; i < m; i += stride) {
    const Vector3d &x = cone.outer.directions[i], &y = cone.outer.directions[(i + 1) % m];
    const double s = random_.uniform(0, 1);
    for (const Vector3d& d : {x, Vector3d((1 - s) * x + s * y)}) {
      // Away from the axis on its half-plane by 1e-5 radians: beyond what rounding to the grid moves.
      const Vector3d away = (d - d.dot(axis) * axis).normalized(), u = d.normalized();
      if (!(away.allFinite()) || u.dot(axis) < -0.9999) continue;
      const double angle = std::atan2(u.dot(away), u.dot(axis)) + 1e-5;
      said_out(report_.outer, std::cos(angle) * axis + std::sin(angle) * away,
               "just beyond the outer polygon");
    }
  }
  for (int i = 0; i < options_.directions; ++i) {
    const GridVector g = random_direction(i % 4 == 3);
    const Vector3d w = as_vector(g);
    if (within(cone.inner, axis, w, 1e-9)) said_in(report_.inner, w, "within the inner polygon");
    if (!within(cone.outer, axis, w, -1e-9)) said_out(report_.outer, w, "beyond the outer polygon");
  }
}

void CombinedEngagement::edges() {
  const Vector3d axis = c_.normalized();
  for (int i = 0; i < 2; ++i) {
    const Vector3d aside = axis.cross(random_.direction<3>()).normalized();
    const auto direction = [&](double angle) {
      return Vector3d(std::cos(angle) * axis + std::sin(angle) * aside);
    };
    double in = 0, out = kPi;
    while (out - in > 1e-7 * out) {
      const double angle = 0.5 * (in + out);
      const Vector3d w = direction(angle);
      const bool found = meets(sweep_, w);
      if (found)
        expect(report_.edges, oracle_.membership(w) != Certified::out, "out beside the edge", w);
      else
        report_.edges.note(true, index_);
      (found ? in : out) = angle;
    }
    // Star-shaped: nothing between the axis and what was found is out.
    for (int k = 0; k < 3; ++k) {
      const Vector3d w = direction(in * random_.uniform(0, 1));
      expect(report_.edges, oracle_.membership(w) != Certified::out, "out before a contact", w);
    }
    // Beyond the last contact found: samples and search end a little early, in some places far.
    for (const double beyond : {1e-4, 1e-3, 1e-2}) {
      const Vector3d w = direction(in + beyond);
      if (oracle_.membership(w) == Certified::in) report_.confirmed.note(confirmed(w), index_);
    }
  }
}

void CombinedEngagement::chords() {
  for (int i = 0; i < options_.directions; ++i) {
    const Vector3d x = as_vector(random_direction(false)).normalized();
    const double length = std::min(0.5, width_) * std::pow(10, -random_.uniform(0, 3));
    const Vector3d y = (x + length * random_.direction<3>()).normalized();
    const bool all_in = oracle_.all_in(x, y), all_out = oracle_.all_out(x, y);
    expect(report_.chords, !(all_in && all_out), "a chord both in and out", x);
    for (int k = 0; k < 4 && (all_in || all_out); ++k) {
      const double s = k == 0 ? 0 : k == 1 ? 1 : random_.uniform(0, 1);
      const Vector3d w = (1 - s) * x + s * y;
      if (all_in) said_in(report_.chords, w, "a chord said to be in");
      // Rounded to the grid a direction may leave the chord, but not by more than 1e-6.
      const Certified m = oracle_.membership(w);
      if (all_out) {
        expect(report_.chords, m != Certified::in, "a chord said to be out", w);
        const auto hit = sweep_.first(w);
        expect(report_.chords, !hit || !exactly_meets(pair_.a, pair_.b, hit->x, w, hit->t),
               "a chord said to be out meets", w);
      }
    }
  }
}

void CombinedEngagement::planes() {
  constexpr double kResolution = 0.01;
  for (const bool through : {true, false}) {
    const Vector3d x = through ? c_.normalized() : as_vector(random_direction(false)).normalized();
    const Vector3d y = x.cross(random_.direction<3>()).normalized();
    const std::vector<PlaneInterval> all = plane_intervals(oracle_, x, y, kResolution);
    bool covers =
        !all.empty() && std::abs(all.front().from + kPi) < 1e-12 && std::abs(all.back().to - kPi) < 1e-12;
    for (std::size_t i = 0; i < all.size(); ++i) {
      covers = covers && all[i].from < all[i].to;
      if (i > 0) covers = covers && all[i].from == all[i - 1].to && all[i].answer != all[i - 1].answer;
    }
    expect(report_.planes, covers, "intervals that do not cover the turn", x);
    int in = 0;
    for (const PlaneInterval& p : all) {
      if (p.answer == Certified::undecided) continue;
      in += p.answer == Certified::in;
      const double t = p.from + random_.uniform(1e-3, 1 - 1e-3) * (p.to - p.from);
      const Vector3d w = std::cos(t) * x + std::sin(t) * y;
      if (p.answer == Certified::in)
        said_in(report_.planes, w, "interval in");
      else if (const auto hit = sweep_.first(w))
        expect(report_.planes, !exactly_meets(pair_.a, pair_.b, hit->x, w, hit->t), "interval out meets", w);
    }
  }
}

void CombinedEngagement::times() {
  for (int i = 0; i < 2; ++i) {
    const Vector3d w = as_vector(random_direction(false)).normalized();
    const auto time = oracle_.time_to_contact(w);
    const Certified m = oracle_.membership(w);
    expect(report_.times, !time || m == Certified::in, "a time for something that is not in", w);
    if (!time) continue;
    auto hit = sweep_.earliest(w);
    if (!hit || hit->t > time->hi() * (1 + 1e-6)) {
      report_.confirmed.note(overlap_found(pair_.a.translated(time->hi() * w)), index_);
      hit = dense().earliest(w);
    }
    if (!hit) continue;
    const bool exact = exactly_meets(pair_.a, pair_.b, hit->x, w, hit->t);
    expect(report_.times, time->hi() > 0 && time->finite(), "a time of no contact", w);
    expect(report_.times, !exact || hit->t >= time->lo(), "a contact before the time said", w);
    // Samples find a contact late, never early.
    report_.delay.raise((hit->t - time->hi()) / time->hi(), index_);
  }
}

}  // namespace vericone::verify
