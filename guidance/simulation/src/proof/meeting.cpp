// SPDX-License-Identifier: BSD-3-Clause
#include "proof/meeting.h"

#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "proof/nearness.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

/// Boxes of the search are refined to this part of the bodies.
constexpr double kTolerance = 1e-8;

Meeting of_relation(Relation relation) {
  return relation == Relation::disjoint ? Meeting::apart : Meeting::meet;
}

Meeting meeting_of(const WorldBody& a, const WorldBody& b) {
  const std::optional<Relation> relation = relation_of(a, b, kTolerance);
  return relation ? of_relation(*relation) : Meeting::unknown;
}

bool apart_by(const WorldBody& a, const WorldBody& b, double distance) {
  const bool inflate_b = !b.delimited() || a.delimited();
  return (inflate_b ? meeting_of(a, b.inflated(distance)) : meeting_of(a.inflated(distance), b)) ==
         Meeting::apart;
}

/// Where the larger of both gauges is least, by a pattern search: a common point where there is one. The
/// pattern turns at every step, as the larger of two functions has ridges.
Vector3d by_gauges(const Posed& bodies, const Vector3d& p_a, const Vector3d& p_b, const Vector3d& guess,
                   bool planar) {
  const auto value = [&](const Vector3d& x) { return std::max(bodies.a.gauge(x), bodies.b.gauge(x)); };
  const double size = (p_b - p_a).norm() + 1e-9;
  Vector3d best = guess;
  double least = value(best);
  // Nearer than this to a common point is near enough.
  constexpr double kNear = 1 + 1e-6;
  for (int start = 0; start < 8 && least > kNear; ++start) {
    Vector3d x = start == 0 ? guess : Vector3d(p_a + (start % 3 + 1) * 0.25 * (p_b - p_a));
    if (start > 3) x(start % (planar ? 2 : 3)) += (start % 2 ? 0.25 : -0.25) * size;
    double here = value(x), angle = 0;
    for (double step = 0.25 * size; step > 1e-9 * size && here > kNear;) {
      angle += 2.4;  // no whole part of a turn
      const Vector3d about =
          planar ? Vector3d::UnitZ() : Vector3d(std::sin(angle / 3), std::cos(angle / 3), 0.6);
      const Eigen::Matrix3d axes = Eigen::AngleAxisd(angle, about.normalized()).toRotationMatrix();
      bool better = false;
      for (int axis = 0; axis < (planar ? 2 : 3); ++axis)
        for (const double sign : {step, -step}) {
          const Vector3d next = x + sign * axes.col(axis);
          if (const double v = value(next); v < here) {
            x = next;
            here = v;
            better = true;
          }
        }
      step *= better ? 1.2 : 0.8;
    }
    if (here < least) {
      least = here;
      best = x;
    }
  }
  return best;
}

/// The middle of all that lies next to the supporting plane along n, and how much that is.
std::pair<Vector3d, std::size_t> face(const WorldBody& body, const SweptBody& swept, const Vector3d& position,
                                      const Vector3d& n) {
  if (const HullBody* hull = body.hull()) {
    const double most = hull->support(n);
    double size = 0;
    for (const Vector3d& x : hull->points()) size = std::max(size, (x - position).norm());
    Vector3d sum = Vector3d::Zero();
    std::size_t count = 0;
    for (const Vector3d& x : hull->points())
      if (n.dot(x) > most - 1e-6 * size) {
        sum += x;
        ++count;
      }
    return {sum / static_cast<double>(count), count};
  }
  return {position + swept.support_point(n), 1};
}

}  // namespace

Meeting meeting(const MovingPair& pair, const Moment& moment) {
  const Posed bodies = posed(pair, moment);
  if (bodies.a.planar() != bodies.b.planar())
    throw InputError("bodies", "one of the plane and one of space", "two of the plane, or two of space");
  if (by_distances(pair)) {
    const std::optional<Relation> relation = certified_pair(bodies).relation();
    return relation ? of_relation(*relation) : Meeting::unknown;
  }
  return meeting_of(bodies.a, bodies.b);
}

bool delimited(const MovingPair& pair, const Moment& moment) {
  const Posed bodies = posed(pair, moment);
  return bodies.a.delimited() || bodies.b.delimited();
}

std::optional<Inflation> apart_by_inflation(const MovingPair& pair, const Piece& piece, double padding,
                                            bool measure) {
  const double dt = piece.duration();
  const Track::Bounds a = pair.a().bounds(piece.from.t, piece.to.t),
                      b = pair.b().bounds(piece.from.t, piece.to.t);
  const Vector3d c = piece.middle.between();
  const double chord = std::max((piece.from.between() - c).norm(), (piece.to.between() - c).norm());
  const double from = piece.from.t, to = piece.to.t;
  const double sway = pair.swept_a(from, to, piece.middle.a.rotation, half_turn(a, piece)).sway() +
                      pair.swept_b(from, to, piece.middle.b.rotation, half_turn(b, piece)).sway();
  const double needed = (chord + chord_deviation(a, b, dt) + sway) * (1 + 1e-12) + padding +
                        1e-9 * (reach(pair.a().shape()) + reach(pair.b().shape())) + 3 * pair.rounding();
  if (!std::isfinite(needed)) return std::nullopt;
  const Posed bodies = posed_over(pair, piece);
  const auto proved = [&](double distance) { return apart_by(bodies.a, bodies.b, distance); };
  if (!proved(needed)) return std::nullopt;
  if (!measure) return Inflation{};
  double lo = needed, hi = 2 * needed;
  while (hi < 1e6 * needed && proved(hi)) {
    lo = hi;
    hi *= 2;
  }
  for (int step = 0; step < 4; ++step) {
    const double half = 0.5 * (lo + hi);
    (proved(half) ? lo : hi) = half;
  }
  return Inflation{lo - needed, hi};
}

Vector3d place_between(const MovingPair& pair, const Moment& moment, const Vector3d& normal) {
  const Posed bodies = posed(pair, moment);
  Vector3d n = normal;
  if (n.isZero(0)) n = moment.between();
  if (n.isZero(0)) return moment.a.position;
  n.normalize();
  const double t = moment.t;
  const auto [on_a, count_a] = face(bodies.a, pair.swept_a(t, t, moment.a.rotation, 0), moment.a.position, n);
  const auto [on_b, count_b] =
      face(bodies.b, pair.swept_b(t, t, moment.b.rotation, 0), moment.b.position, -n);
  return count_a == count_b ? Vector3d(0.5 * (on_a + on_b)) : count_a < count_b ? on_a : on_b;
}

Vector3d place_of_meeting(const MovingPair& pair, const Moment& moment, const Vector3d& normal) {
  const Posed bodies = posed(pair, moment);
  const Vector3d between = place_between(pair, moment, normal);
  if (bodies.a.hull() || bodies.b.hull()) return between;
  if (!bodies.a.delimited() && !bodies.b.delimited() && !normal.isZero(0)) return between;
  return by_gauges(bodies, moment.a.position, moment.b.position, between, pair.planar());
}

}  // namespace vericone::simulation
