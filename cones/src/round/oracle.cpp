// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/internal/cones/round/round_oracle.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "answers/stretch.h"
#include "answers/velocity_ladder.h"
#include "hulls/search.h"
#include "round/contact.h"
#include "round/last_rung.h"
#include "round/scene.h"
#include "round/triage.h"

namespace vericone {
namespace {

using Eigen::Vector3d;

/// w times the power of two that brings its largest entry into [1/2, 1); w is finite and not zero.
Vector3d to_scale_one(const Vector3d& w, int& exponent) {
  exponent = std::ilogb(w.cwiseAbs().maxCoeff()) + 1;
  return {std::scalbn(w.x(), -exponent), std::scalbn(w.y(), -exponent), std::scalbn(w.z(), -exponent)};
}

/// The second rung.
struct IntervalShadow {
  const RoundScene& scene;
  const std::array<Interval, 3>& w;
  ShadowAxes axes;
  Interval u = w[axes.i] / w[axes.k], v = w[axes.j] / w[axes.k];

  /// n + s e_k, s chosen so that n.w <= 0: the ray, not its other half, is behind the plane.
  bool outside(const Vector3d& n, double, const RoundSupport&) const noexcept {
    std::array<Interval, 3> away{n(0), n(1), n(2)};
    const Interval along = Interval(n(axes.i)) * u + Interval(n(axes.j)) * v + Interval(n(axes.k));
    if (!along.finite()) return false;
    const bool forwards = w[axes.k].positive();
    const double excess = std::max(forwards ? along.hi() : -along.lo(), 0.0) * (1 + 0x1p-50) +
                          0x1p-51 * std::abs(n(axes.k)) + 0x1p-900;
    away[axes.k] = n(axes.k) + (forwards ? -excess : excess);
    return scene.enclosed_least(away) > 0;
  }
  std::array<Interval, 2> shadow(const ShadowPoint& point) const noexcept {
    std::array<Interval, 3> x = point.n.isZero(0) ? scene.enclosed_middle() : scene.enclosed_point(point.n);
    if (point.halfway) {
      const auto middle = scene.enclosed_middle();
      for (int k = 0; k < 3; ++k) x[k] = Interval(0.5) * (x[k] + middle[k]);
    }
    return {x[axes.i] - u * x[axes.k], x[axes.j] - v * x[axes.k]};
  }
  template <std::size_t kCount>
  bool around(const std::array<ShadowPoint, kCount>& corner) const noexcept {
    std::array<std::array<Interval, 2>, kCount> y;
    for (std::size_t i = 0; i < kCount; ++i) y[i] = shadow(corner[i]);
    bool left = true, right = true;
    for (std::size_t i = 0; i < kCount; ++i) {
      const auto &p = y[i], &q = y[(i + 1) % kCount];
      const Interval turn = p[0] * q[1] - p[1] * q[0];
      left = left && turn.positive();
      right = right && turn.negative();
    }
    return left || right;
  }
};

/// `side`: of w, seen from a plane that has K ahead: 1, -1 or 0 where that is not certain.
template <class Rung>
std::optional<Membership> decide(const RoundScene& scene, const Vector3d& w, int side, const Rung& rung) {
  if (side < 0) return Membership::out;
  const auto meets = ShadowSearch(scene, w, rung).run();
  if (!meets) return std::nullopt;
  if (!*meets) return Membership::out;
  return side > 0 ? std::optional(Membership::in) : std::nullopt;
}

/// Whether four points of K have the origin in the interior of their hull: by volumes off by at most so much.
bool surrounds(const HullSimplex<3>& simplex, double slack, double size) {
  const auto &a = simplex.z[0], &b = simplex.z[1], &c = simplex.z[2], &d = simplex.z[3];
  const double volume[4] = {b.dot(c.cross(d)), -a.dot(c.cross(d)), a.dot(b.cross(d)), -a.dot(b.cross(c))};
  const double least = 64 * slack * size * size;
  return std::all_of(volume, volume + 4, [&](double x) { return x > least; }) ||
         std::all_of(volume, volume + 4, [&](double x) { return x < -least; });
}

/// What doubles find of K and the origin: a plane with room, largest entry of its normal 1, or an overlap.
struct Whereabouts {
  std::optional<Relation> relation;
  Vector3d normal = Vector3d::Zero();
  double room = 0;
};

Whereabouts whereabouts(const RoundScene& scene) {
  constexpr int kMostSteps = 60;
  Whereabouts found;
  HullSimplex<3> simplex;
  simplex.add({}, scene.middle);
  double last = std::numeric_limits<double>::infinity(), best = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    simplex.reduce();
    if (simplex.surrounds) {
      if (surrounds(simplex, scene.slack, scene.size)) found.relation = Relation::overlapping;
      return found;
    }
    const double length = simplex.nearest.norm();
    if (!(length < last)) return found;
    last = length;
    Vector3d n = simplex.normal;
    const double largest = n.cwiseAbs().maxCoeff();
    if (!(largest > 1e-250 && largest < 1e250)) return found;
    n /= largest;
    const RoundSupport support = scene.least(n);
    const double room = support.value - scene.slack, distance = room / n.norm();
    if (room > 0 && distance > best) {
      best = distance;
      found = {Relation::disjoint, n, room};
      if (distance > 0.999 * length) return found;
    }
    simplex.add({}, scene.point(n, support));
  }
  return found;
}

/// Of two hulls, whose own last rung has fewer numbers.
HullOracle hulls_of(const RoundScene& scene) {
  const auto hull = [](const Convex& body) {
    std::vector<Vector3d> points;
    for (const Convex::Piece& piece : body.pieces()) points.push_back(piece.center);
    return HullBody(std::move(points));
  };
  return {hull(scene.given_agent), hull(scene.given_obstacle), scene.agent_at, scene.obstacle_at};
}

}  // namespace

RoundOracle::RoundOracle(Convex agent, Convex obstacle, const Vector3d& agent_at, const Vector3d& obstacle_at)
    : scene_(std::make_shared<RoundScene>(std::move(agent), agent_at, std::move(obstacle), obstacle_at)) {
  if (scene_->usable) {
    const Whereabouts found = whereabouts(*scene_);
    relation_ = found.relation;
    relation_rung_ = Rung::triage;
    normal_ = found.normal;
    normal_certified_ = relation_ == Relation::disjoint;
    room_ = std::ldexp(found.room, scene_->exponent) * (1 - 0x1p-50);
  }
  hulls_ = scene_->given_agent.is_hull() && scene_->given_obstacle.is_hull();
  if (relation_) return;
  relation_rung_ = Rung::exact;
  relation_ = exact_relation();
}

std::optional<Relation> RoundOracle::exact_relation() const {
  return hulls_ ? hulls_of(*scene_).exact_relation() : round::LastRung(*scene_).relation();
}

std::optional<Membership> RoundOracle::triage_membership(const Vector3d& w) const noexcept {
  if (w.x() == 0 && w.y() == 0 && w.z() == 0) return Membership::out;
  if (!w.allFinite()) return std::nullopt;
  if (relation_ != Relation::disjoint) return relation_ ? std::optional(Membership::in) : std::nullopt;
  if (!normal_certified_) return std::nullopt;
  const double largest = w.cwiseAbs().maxCoeff();
  int exponent = 0;
  const Vector3d v = largest > 1e-100 && largest < 1e100 ? w : to_scale_one(w, exponent);
  const double along = normal_.dot(v), bound = 8 * kUnitRoundoff * v.cwiseAbs().sum();
  const int side = static_cast<int>(along > bound) - static_cast<int>(along < -bound);
  return decide(*scene_, v, side, TriageShadow<RoundScene>{*scene_, v});
}

std::optional<Membership> RoundOracle::interval_membership(const Vector3d& v_a,
                                                           const Vector3d& v_b) const noexcept {
  std::array<Interval, 3> w;
  for (int i = 0; i < 3; ++i) w[i] = v_b(i) == 0 ? Interval(v_a(i)) : Interval(v_a(i)) - Interval(v_b(i));
  const Vector3d mid{w[0].mid(), w[1].mid(), w[2].mid()};
  if (!w[0].finite() || !w[1].finite() || !w[2].finite()) return std::nullopt;
  if (mid.isZero(0)) return v_a == v_b ? std::optional(Membership::out) : std::nullopt;
  if (relation_ != Relation::disjoint) return relation_ ? std::optional(Membership::in) : std::nullopt;
  if (!normal_certified_) return std::nullopt;
  int exponent = 0;
  const Vector3d v = to_scale_one(mid, exponent);
  if (std::abs(exponent) > 1000) return std::nullopt;
  const Interval scale(std::ldexp(1.0, -exponent));
  for (Interval& x : w) x = x * scale;
  const Interval along =
      Interval(normal_(0)) * w[0] + Interval(normal_(1)) * w[1] + Interval(normal_(2)) * w[2];
  const int side = static_cast<int>(along.positive()) - static_cast<int>(along.negative());
  const ShadowAxes axes(v);
  if (w[axes.k].sign() == FilteredSign::uncertain) return std::nullopt;
  return decide(*scene_, v, side, IntervalShadow{*scene_, w, axes});
}

Membership RoundOracle::exact_membership(const Vector3d& v_a, const Vector3d& v_b) const {
  const auto w = exact::difference_on_grid<3>(v_a, v_b);
  if (w[0] == 0 && w[1] == 0 && w[2] == 0) return Membership::out;
  if (relation_ != Relation::disjoint) return Membership::in;
  return hulls_ ? hulls_of(*scene_).exact_membership(v_a, v_b) : round::LastRung(*scene_).membership(w);
}

Membership RoundOracle::membership(const Vector3d& w, Rung* rung) const {
  return climb_membership<RoundMembership>(*this, w, Vector3d(Vector3d::Zero()), rung);
}

Membership RoundOracle::membership(const Vector3d& v_a, const Vector3d& v_b, Rung* rung) const {
  return climb_membership<RoundMembership>(*this, v_a, v_b, rung);
}

Verdict RoundOracle::verdict(const Vector3d& v_a, const Vector3d& v_b, Rung* rung) const {
  if (!relation_) return Verdict::undecided;
  if (rung && relation_ != Relation::disjoint) *rung = relation_rung_;
  try {
    return verdict_of(*relation_, [&] { return membership(v_a, v_b, rung); });
  } catch (const round::Undecided&) {
    return Verdict::undecided;
  }
}

std::optional<RoundOracle::FirstContact> RoundOracle::first_contact(const Vector3d& w) const noexcept {
  const double largest = w.cwiseAbs().maxCoeff();
  if (!normal_certified_ || !(largest > 1e-100 && largest < 1e100)) return std::nullopt;
  if (!(normal_.dot(w) > 8 * kUnitRoundoff * w.cwiseAbs().sum())) return std::nullopt;
  const auto found = round_contact(*scene_, w);
  if (!found) return std::nullopt;
  return FirstContact{found->earliest, found->latest, found->point, found->normal};
}

bool RoundOracle::is_flat() const {
  return scene_->given_agent.is_flat() || scene_->given_obstacle.is_flat();
}

double RoundOracle::gap(const Vector3d& n) const noexcept {
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  if (!scene_->usable || !n.allFinite() || n.isZero(0)) return kNothing;
  int exponent = 0;
  const Vector3d m = to_scale_one(n, exponent);
  const double least = scene_->least(m).value - scene_->slack;
  return std::ldexp(least - std::abs(least) * 0x1p-50, exponent + scene_->exponent);
}

bool RoundOracle::surely_out(const Vector3d& v_a, const Vector3d& v_b,
                             const Horizon& horizon) const noexcept {
  const Vector3d w = v_a - v_b;
  if (const auto known = upright_within(w, horizon)) return known == Membership::out;
  // Of the normal the largest entry is 1.
  const double slack = 32 * kUnitRoundoff * w.cwiseAbs().sum();
  if (normal_certified_ && slack > 1e-280 && (normal_.dot(w) + slack) * horizon.until < room_) return true;
  const auto membership = triage_membership(w);
  return (membership ? membership : interval_membership(v_a, v_b)) == Membership::out;
}

std::optional<Vector3d> RoundOracle::touching_plane(const Vector3d& w,
                                                    const Horizon& horizon) const noexcept {
  if (!scene_->upright) return std::nullopt;
  return scene_->upright->touching_plane(std::ldexp(1.0, -scene_->exponent) * w, horizon.from, horizon.until,
                                         scene_->slack);
}

std::optional<Membership> RoundOracle::upright_within(const Vector3d& w,
                                                      const Horizon& horizon) const noexcept {
  const double largest = w.cwiseAbs().maxCoeff();
  if (!scene_->upright || !(largest > 1e-100 && largest < 1e100)) return std::nullopt;
  const Vector3d n = *touching_plane(w, horizon);
  if (n.isZero(0)) {
    const Vector3d scaled = std::ldexp(1.0, -scene_->exponent) * w;
    const bool meets = scene_->upright->surely_meets(scaled, horizon.from, horizon.until, scene_->slack);
    return meets ? std::optional(Membership::in) : std::nullopt;
  }
  // n.x >= room for all x that are met, and t n.w is most at an end of the time.
  const double room = gap(n), along = n.dot(w) + 8 * kUnitRoundoff * n.cwiseAbs().dot(w.cwiseAbs());
  const double reached = along * (along > 0 ? horizon.until : horizon.from);
  const bool misses = reached + 0x1p-50 * std::abs(reached) < room;
  return misses ? std::optional(Membership::out) : std::nullopt;
}

std::optional<RoundOracle::Meeting> RoundOracle::meeting(const Vector3d& first,
                                                         const Vector3d& last) const noexcept {
  const RoundMeeting found = round_meeting(*scene_, first, last, true);
  if (!found.inside) return std::nullopt;
  return Meeting{*found.inside, found.normal, found.part, found.touching};
}

std::optional<Membership> RoundOracle::triage_within(const Vector3d& v_a, const Vector3d& v_b,
                                                     const Horizon& horizon) const noexcept {
  if (const auto known = upright_within(v_a - v_b, horizon)) return known;
  const auto inside = round_within(*scene_, v_a - v_b, horizon.from, horizon.until);
  if (!inside) return std::nullopt;
  return *inside ? Membership::in : Membership::out;
}

std::optional<Membership> RoundOracle::exact_within(const Vector3d& v_a, const Vector3d& v_b,
                                                    const Horizon& horizon) const {
  if (hulls_) return hulls_of(*scene_).exact_within(v_a, v_b, horizon);
  const auto relation = round::LastRung(*scene_, Stretch{v_a, v_b, horizon.from, horizon.until}).relation();
  if (!relation) return std::nullopt;
  return *relation == Relation::overlapping ? Membership::in
         : *relation == Relation::touching  ? Membership::on
                                            : Membership::out;
}

}  // namespace vericone
