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
    ends_.push_back(end_between(azimuth, i > 0 ? ends_.back() : none, none, guess, 0.1 * guess));
    guess = 0.5 * (ends_.back().in + ends_.back().out);
  }
}

Vector3d Tracer::side(double azimuth) const {
  return std::cos(azimuth) * frame_.e1 + std::sin(azimuth) * frame_.e2;
}
Vector3d Tracer::direction(double azimuth, double angle) const {
  return std::cos(angle) * frame_.axis + std::sin(angle) * side(azimuth);
}

/// The axis is in and its opposite out, whatever the bodies (docs/theory.md, 7).
ConeEnd Tracer::bisected(double azimuth, double guess, double spread) const {
  ConeEnd e{azimuth, 0, std::numbers::pi, {}, true, 0};
  const auto ask = [&](double angle) {
    const Certified answer = oracle_.membership(direction(azimuth, angle));
    if (answer == Certified::in) e.in = angle;
    if (answer == Certified::out) e.out = angle;
    return answer;
  };
  // Closing in from the guess.
  for (double step = spread; e.out == std::numbers::pi && guess + step < std::numbers::pi; step *= 4)
    if (ask(guess + step) != Certified::in) break;
  for (double step = spread; e.in == 0 && guess - step > 0; step *= 4)
    if (ask(guess - step) != Certified::out) break;
  for (int step = 0; step < 60 && e.out - e.in > tolerance_ * 0.05 * std::sin(0.5 * (e.in + e.out)); ++step)
    if (ask(0.5 * (e.in + e.out)) == Certified::undecided) break;
  return e;
}

/// The contact at an end found by bisection, from the points of the bodies farthest across it.
void Tracer::seed(ConeEnd& end) const {
  const Vector3d up = std::cos(end.in) * side(end.azimuth) - std::sin(end.in) * frame_.axis;
  CombinedEdge start;
  start.on_a = -up / oracle_.a().gauge(up);
  start.on_b = up / oracle_.b().gauge(up);
  const auto edge = edge_near(end.azimuth, start);
  if (edge && std::abs(edge->angle - end.in) < 0.05 * end.in) end.edge = edge;
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

ConeEnd Tracer::end_between(double azimuth, const ConeEnd& first, const ConeEnd& last, double guess,
                            double spread) const {
  if (guided_)
    if (const auto edge = highest(azimuth, first, last)) return end_at(azimuth, *edge);
  ConeEnd end = bisected(azimuth, guess, spread);
  if (guided_) seed(end);
  return end;
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
  ends_.push_back(end_between(first.azimuth + 0.5 * width, first, last, around,
                              std::max(expected_standoff(first, last), 1e-6)));
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
    end = bisected(end.azimuth, end.in, 0.1 * end.in);
    seed(end);
    moved_.push_back(k);
  }
}

/// The least of a few distances at which the chord is certified; -1 for none.
double Tracer::outer_chord(int first, int last, double standoff) {
  const ConeEnd from = ends_[first], to = ends_[last];
  const double most = std::numbers::pi - 1e-6 - std::max(from.out, to.out);
  const auto chord = [&](double d) {
    return std::pair(direction(from.azimuth, from.out + d), direction(to.azimuth, to.out + d));
  };
  if (!guided_) {
    for (double d = 0.5 * standoff; d < most; d *= 2)
      if (const auto [v, w] = chord(d); oracle_.all_out(v, w)) return d;
    return -1;
  }
  // Beyond the edge half way between, where the chord is lowest.
  double least = 0;
  const Vector3d middle = (chord(0).first + chord(0).second).normalized();
  const double azimuth = std::atan2(middle.dot(frame_.e2), middle.dot(frame_.e1));
  if (const auto edge = highest(azimuth, from, to))
    least = std::max(0.0, edge->angle - std::acos(std::min(1.0, middle.dot(frame_.axis))));
  double step = 0.15 * standoff;
  for (int attempt = 0; least + step < most && attempt < 12; ++attempt, step *= 2) {
    CombinedEdge hint;
    const auto [v, w] = chord(least + step);
    if (oracle_.all_out(v, w, &hint)) return least + step;
    if (attempt == 1 || attempt == 3) learn(hint, first, last);
    if (!moved_.empty()) return -1;
  }
  return -1;
}

double Tracer::inner_chord(const ConeEnd& first, const ConeEnd& last, double standoff) const {
  const CombinedEdge* near = first.edge ? &*first.edge : last.edge ? &*last.edge : nullptr;
  double d = (near ? 0.1 : 0.5) * standoff;
  for (int attempt = 0; d < std::min(first.in, last.in); ++attempt, d *= 2) {
    // By steps from a contact nearby first; those may lead nowhere.
    const CombinedEdge* start = attempt < 4 ? near : nullptr;
    if (oracle_.all_in(direction(first.azimuth, first.in - d), direction(last.azimuth, last.in - d), start))
      return d;
  }
  return -1;
}

ConeWedge Tracer::wedge(int first, int last) {
  ConeWedge s{first, last, -1, -1, 0, std::numeric_limits<double>::infinity()};
  const double standoff = expected_standoff(ends_[first], ends_[last]);
  s.outwards = outer_chord(first, last, standoff);
  if (s.outwards < 0 && moved_.empty()) bisect_again(first, last);
  if (!moved_.empty()) return s;
  const ConeEnd &from = ends_[first], &to = ends_[last];
  s.inwards = inner_chord(from, to, standoff);
  // What could not be proved at any distance: nothing is known to be out, nothing but the axis to be in.
  if (s.outwards >= 0) s.outer = triangle(from, to, from.out + s.outwards, to.out + s.outwards);
  if (s.inwards >= 0) s.inner = triangle(from, to, from.in - s.inwards, to.in - s.inwards);
  return s;
}

double Tracer::triangle(const ConeEnd& first, const ConeEnd& last, double angle_first,
                        double angle_last) const {
  const Vector3d b = direction(first.azimuth, angle_first), c = direction(last.azimuth, angle_last);
  const Vector3d& a = frame_.axis;
  return 2 * std::atan2(a.dot((b - a).cross(c - a)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

}  // namespace vericone
