// SPDX-License-Identifier: BSD-3-Clause
#include "combined/tracer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone {

using Eigen::Vector3d;

Tracer::Tracer(const CombinedOracle& oracle, double tolerance, int count)
    : oracle_(oracle),
      frame_(oracle.b().center() - oracle.a().center()),
      tolerance_(tolerance),
      edges_(oracle.a(), oracle.b()),
      guided_(!oracle.a().is_ellipsoid() && !oracle.b().is_ellipsoid()) {
  // What the ellipsoids around would show is a fair first guess.
  double guess = std::atan2(oracle.a().ellipsoid().semi_axes()(1) + oracle.b().ellipsoid().semi_axes()(1),
                            (oracle.b().center() - oracle.a().center()).norm());
  for (int i = 0; i < count; ++i) {
    const double azimuth = 2 * std::numbers::pi * i / count;
    const ConeEnd none;
    ends_.push_back(end_between(azimuth, i > 0 ? ends_.back() : none, none, guess));
    guess = 0.5 * (ends_.back().in + ends_.back().out);
  }
}

Vector3d Tracer::side(double azimuth) const { return frame_.across(azimuth); }
Vector3d Tracer::direction(double azimuth, double angle) const {
  return std::cos(angle) * frame_.axis + std::sin(angle) * side(azimuth);
}

ConeEnd Tracer::proved_end(double azimuth, double guess, const CombinedEdge* start) const {
  const EdgeBracket bracket =
      oracle_.edge(frame_.axis, side(azimuth), tolerance_ * 0.05 * std::sin(guess), start);
  return {azimuth, bracket.in, bracket.out, bracket.edge, true, 0};
}

std::optional<CombinedEdge> Tracer::edge_near(double azimuth, const CombinedEdge& start) const {
  if (const auto edge = edges_.near(frame_.axis, side(azimuth), start)) return edge;
  return edges_.reached(frame_.axis, side(azimuth), start);
}

std::optional<CombinedEdge> Tracer::highest(double azimuth, const ConeEnd& first, const ConeEnd& last) const {
  std::optional<CombinedEdge> best;
  for (const ConeEnd* other : {&first, &last}) {
    if (!other->edge) continue;
    const auto edge = edge_near(azimuth, *other->edge);
    if (edge && (!best || edge->angle > best->angle)) best = edge;
  }
  return best;
}

ConeEnd Tracer::end_at(double azimuth, const CombinedEdge& edge) const {
  return {azimuth, edge.angle, edge.angle, edge, false, 0};
}

ConeEnd Tracer::end_between(double azimuth, const ConeEnd& first, const ConeEnd& last, double guess) const {
  if (guided_)
    if (const auto edge = highest(azimuth, first, last)) return end_at(azimuth, *edge);
  return proved_end(azimuth, guess, first.edge ? &*first.edge : last.edge ? &*last.edge : nullptr);
}

/// Wider ones are better divided than searched for chords that are hard to prove.
bool Tracer::narrow(const ConeEnd& first, const ConeEnd& last) const {
  double width = last.azimuth - first.azimuth;
  if (width < 0) width += 2 * std::numbers::pi;
  return width < 0.1;
}

/// Where a chord stands off little, the ends are what matters; where it bends, its sagitta.
double Tracer::expected_standoff(const ConeEnd& first, const ConeEnd& last) const {
  double width = last.azimuth - first.azimuth;
  if (width < 0) width += 2 * std::numbers::pi;
  const double angle = 0.5 * (first.in + last.in);
  return std::max({0.125 * width * width * std::sin(angle), first.out - first.in, last.out - last.in, 1e-9});
}

int Tracer::divide(const ConeWedge& wedge) {
  const ConeEnd &first = ends_[wedge.first], &last = ends_[wedge.last];
  double width = last.azimuth - first.azimuth;
  if (width <= 0) width += 2 * std::numbers::pi;
  const double around = 0.25 * (first.in + first.out + last.in + last.out);
  ends_.push_back(end_between(first.azimuth + 0.5 * width, first, last, around));
  return static_cast<int>(ends_.size()) - 1;
}

/// What was in the way of a chord may be a contact farther out than the ends: those are moved.
void Tracer::learn(const CombinedEdge& hint, int first, int last) {
  for (const int k : {first, last}) {
    ConeEnd& end = ends_[k];
    // What is proved stays, and steps without end are cut short: bisection is next.
    constexpr int kMostMoves = 8;
    if (end.proved || end.moves >= kMostMoves) continue;
    const auto edge = edge_near(end.azimuth, hint);
    if (!edge || edge->angle < end.in + 1e-3 * tolerance_ * std::sin(end.in)) continue;
    const int moves = end.moves + 1;
    end = end_at(end.azimuth, *edge);
    end.moves = moves;
    moved_.push_back(k);
  }
}

/// Ends that Newton's method may have left too far in, found with proof.
void Tracer::bisect_again(int first, int last) {
  for (const int k : {first, last}) {
    ConeEnd& end = ends_[k];
    if (end.proved) continue;
    const double before = end.out;
    end = proved_end(end.azimuth, end.in, end.edge ? &*end.edge : nullptr);
    // Where the end stays, so does what was in the way of the chord.
    if (end.in > before) moved_.push_back(k);
  }
}

/// On the plane that touches the cone at an edge between, lifted by an angle: where the cone is convex all
/// beyond it is out.
ConeChord Tracer::tangent_chord(const ConeEnd& first, const ConeEnd& last, const CombinedEdge& between,
                                double azimuth, double lift) const {
  if (between.normal.isZero(0)) return {};
  const Vector3d n = -between.normal - lift * direction(azimuth, between.angle);
  const auto angle = [&](const ConeEnd& end) {
    return std::atan2(-n.dot(frame_.axis), n.dot(side(end.azimuth))) + 1e-12;
  };
  const ConeChord chord{angle(first), angle(last), true};
  for (const auto& [end, at] : {std::pair(&first, chord.first), {&last, chord.last}})
    if (!(at >= end->in) || !(at < std::numbers::pi - 1e-6) || !(n.dot(direction(end->azimuth, at)) > 1e-14))
      return {};
  return oracle_.half_space_out(n, between) ? chord : ConeChord{};
}

/// The least of a few distances at which the chord is certified.
ConeChord Tracer::outer_chord(int first, int last, double standoff) {
  const ConeEnd from = ends_[first], to = ends_[last];
  const double most = std::numbers::pi - 1e-6 - std::max(from.out, to.out);
  const ConeChord none{std::numbers::pi, std::numbers::pi, false};
  const auto at = [&](double d) { return ConeChord{from.out + d, to.out + d, true}; };
  const auto chord = [&](double d) {
    return std::pair(direction(from.azimuth, from.out + d), direction(to.azimuth, to.out + d));
  };
  // Beyond the edge half way between, where the chord is lowest.
  double least = 0;
  const double azimuth = middle_azimuth(from, to);
  if (const auto edge = highest(azimuth, from, to)) {
    if (const ConeChord touching = tangent_chord(from, to, *edge, azimuth, 0.05 * standoff); touching.proved)
      return touching;
    const Vector3d middle = (chord(0).first + chord(0).second).normalized();
    least = std::max(0.0, edge->angle - std::acos(std::min(1.0, middle.dot(frame_.axis))));
  }
  if (!guided_) {
    for (double d = 0.5 * standoff; d < most; d *= 2)
      if (const auto [v, w] = chord(d); oracle_.all_out(v, w)) return at(d);
    return none;
  }
  const int attempts = narrow(from, to) ? 12 : 2;
  double step = 0.3 * standoff;
  for (int attempt = 0; least + step < most && attempt < attempts; ++attempt, step *= 2) {
    CombinedEdge hint;
    const auto [v, w] = chord(least + step);
    if (oracle_.all_out(v, w, &hint)) return at(least + step);
    if (attempt == 1 || attempt == 3) learn(hint, first, last);
    if (!moved_.empty()) return none;
  }
  return none;
}

ConeChord Tracer::inner_chord(const ConeEnd& first, const ConeEnd& last, const CombinedEdge* between,
                              double standoff) const {
  const CombinedEdge *at_first = first.edge ? &*first.edge : nullptr,
                     *at_last = last.edge ? &*last.edge : at_first;
  if (!at_first) at_first = at_last;
  const auto tried = [&](double d, const CombinedEdge* near_first, const CombinedEdge* near_last,
                         const CombinedEdge* near_middle) {
    return oracle_.all_in(direction(first.azimuth, first.in - d), direction(last.azimuth, last.in - d),
                          near_first, near_last, near_middle);
  };
  // By steps from the contacts at the ends first; those may lead nowhere.
  constexpr int kSteps = 5;
  constexpr double kFarther = 4;
  double d = 0.1 * standoff;
  for (int attempt = 0; guided_ && at_first && attempt < kSteps && d < std::min(first.in, last.in);
       ++attempt, d *= kFarther)
    if (tried(d, at_first, at_last, between)) return {first.in - d, last.in - d, true};
  if (guided_ && at_first && !narrow(first, last)) return {};
  for (d = 2 * standoff; d < std::min(first.in, last.in); d *= kFarther)
    if (tried(d, nullptr, nullptr, nullptr)) return {first.in - d, last.in - d, true};
  return {};
}

/// Of the middle of the chord between two ends.
double Tracer::middle_azimuth(const ConeEnd& first, const ConeEnd& last) const {
  const Vector3d middle = direction(first.azimuth, first.out) + direction(last.azimuth, last.out);
  return std::atan2(middle.dot(frame_.e2), middle.dot(frame_.e1));
}

ConeWedge Tracer::wedge(int first, int last) {
  ConeWedge s;
  s.first = first, s.last = last;
  s.outer = std::numeric_limits<double>::infinity();
  const double standoff = expected_standoff(ends_[first], ends_[last]);
  s.out = outer_chord(first, last, standoff);
  if (!s.out.proved && moved_.empty()) bisect_again(first, last);
  if (!moved_.empty()) return s;
  const ConeEnd &from = ends_[first], &to = ends_[last];
  const auto between = guided_ ? highest(middle_azimuth(from, to), from, to) : std::nullopt;
  s.in = inner_chord(from, to, between ? &*between : nullptr, standoff);
  // What could not be proved at any distance: nothing is known to be out, nothing but the axis to be in.
  if (s.out.proved) s.outer = triangle(from, to, s.out.first, s.out.last);
  if (s.in.proved) s.inner = triangle(from, to, s.in.first, s.in.last);
  return s;
}

double Tracer::triangle(const ConeEnd& first, const ConeEnd& last, double angle_first,
                        double angle_last) const {
  const Vector3d b = direction(first.azimuth, angle_first), c = direction(last.azimuth, angle_last);
  const Vector3d& a = frame_.axis;
  return 2 * std::atan2(a.dot((b - a).cross(c - a)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

}  // namespace vericone
