// SPDX-License-Identifier: BSD-3-Clause
#include "proof/nearness.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

bool is_placed(const ShapeInTime& shape) { return shape.rigid() && shape.rigid()->placed(); }
bool is_hull(const ShapeInTime& shape) { return shape.rigid() && shape.rigid()->hull(); }
bool is_dented(const ShapeInTime& shape) { return !shape.rigid() || shape.rigid()->delimited(); }

/// What no point of a body moves more than by turning, about its position.
double sway(double reach, const Track::Bounds& bounds, const Piece& piece) {
  const double angle = half_turn(bounds, piece);
  return (angle < std::numbers::pi ? 2 * reach * std::sin(0.5 * angle) : 2 * reach) * (1 + 1e-12);
}

}  // namespace

Posed posed(const MovingPair& pair, const Moment& m) {
  return {shape_at(pair.a().shape(), m.t, m.a.position, m.a.rotation),
          shape_at(pair.b().shape(), m.t, m.b.position, m.b.rotation)};
}

Posed posed_over(const MovingPair& pair, const Piece& piece) {
  const Moment& m = piece.middle;
  return {shape_over(pair.a().shape(), piece.from.t, piece.to.t, m.a.position, m.a.rotation),
          shape_over(pair.b().shape(), piece.from.t, piece.to.t, m.b.position, m.b.rotation)};
}

bool by_distances(const MovingPair& pair) {
  const ShapeInTime &a = pair.a().shape(), &b = pair.b().shape();
  return is_placed(a) || is_placed(b) || (is_hull(a) && is_dented(b)) || (is_dented(a) && is_hull(b));
}

Pair certified_pair(const Posed& bodies) {
  try {
    return pair_of(bodies.a, bodies.b);
  } catch (const InputError& e) {
    throw InputError("bodies", e.field() + ": " + e.value(), e.requirement());
  }
}

Certificate by_distance(const MovingPair& pair, const Piece& piece) {
  const double dt = piece.duration();
  const Track::Bounds a = pair.a().bounds(piece.from.t, piece.to.t),
                      b = pair.b().bounds(piece.from.t, piece.to.t);
  const Vector3d c = piece.middle.between();
  const double chord = std::max((piece.from.between() - c).norm(), (piece.to.between() - c).norm());
  const double bend = chord_deviation(a, b, dt) * (1 + 1e-12);
  // Taking a body into the other's frame rounds coordinates of the size of both.
  const double size =
      piece.middle.a.position.norm() + piece.middle.b.position.norm() + pair.reach_a() + pair.reach_b();
  const double turning = sway(pair.reach_a(), a, piece) + sway(pair.reach_b(), b, piece) + 1e-13 * size +
                         1e-12 * chord + 3 * pair.rounding();

  const Pair bodies = certified_pair(posed_over(pair, piece));
  const Miss now = bodies.miss(Vector3d::Zero(), Vector3d::Zero());
  Certificate certificate;
  certificate.gap = now.most;
  certificate.normal = now.normal;
  certificate.bound = now.least - (chord + bend + turning);
  const Vector3d w = piece.from.between() - piece.to.between();
  // The chord through the middle is as far from that of the ends as the middle is.
  const double aside = 2 * bend + turning;
  if (certificate.bound > 0 || !(now.least > aside) || w.isZero(0)) return certificate;
  const double ahead = bodies.miss(w, Vector3d::Zero()).least;
  if (!(ahead > aside)) return certificate;
  const double along = std::min(ahead, bodies.miss(-w, Vector3d::Zero()).least);
  certificate.bound = std::max(certificate.bound, along - aside);
  return certificate;
}

Vector3d place_of_nearest(const MovingPair& pair, const Moment& moment) {
  const Posed bodies = posed(pair, moment);
  const Miss miss = certified_pair(bodies).miss(Vector3d::Zero(), Vector3d::Zero());
  const Vector3d half = 0.5 * miss.distance * miss.normal;
  if (miss.normal.isZero(0)) return moment.a.position;
  if (const auto on_a = bodies.a.support_point(miss.normal)) return *on_a + half;
  if (const auto on_b = bodies.b.support_point(-miss.normal)) return *on_b - half;
  return moment.a.position;
}

Vector3d place_of_touch(const MovingPair& pair, const Moment& before, const Moment& at) {
  const Vector3d v_a = at.a.position - before.a.position, v_b = at.b.position - before.b.position;
  if (v_a == v_b) return place_of_nearest(pair, before);
  const auto contact = certified_pair(posed(pair, before)).contact(v_a, v_b);
  return contact && contact->point ? *contact->point : place_of_nearest(pair, before);
}

}  // namespace vericone::simulation
