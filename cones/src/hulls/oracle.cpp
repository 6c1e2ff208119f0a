// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/hulls/hull_oracle.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "answers/elementary.h"
#include "answers/stretch.h"
#include "answers/velocity_ladder.h"
#include "hulls/certificates.h"
#include "hulls/exact.h"
#include "hulls/scene.h"
#include "hulls/seam.h"
#include "hulls/search.h"

namespace vericone {
namespace {

using exact::OriginIn;

/// The coordinates in the order i, j, k, where k is that of the largest entry of w.
struct Axes {
  int i, j, k;
  explicit Axes(const Eigen::Vector3d& w) {
    const Eigen::Vector3d a = w.cwiseAbs();
    k = a.z() > std::max(a.x(), a.y()) ? 2 : static_cast<int>(a.y() > a.x());
    i = (k + 1) % 3;
    j = (k + 2) % 3;
  }
  int operator[](int r) const { return r == 0 ? i : r == 1 ? j : k; }
};

/// w times the power of two that brings its largest entry into [1/2, 1); w is finite and not zero.
Eigen::Vector3d at_scale_one(const Eigen::Vector3d& w, int& exponent) {
  exponent = std::ilogb(w.cwiseAbs().maxCoeff()) + 1;
  return {std::scalbn(w.x(), -exponent), std::scalbn(w.y(), -exponent), std::scalbn(w.z(), -exponent)};
}

/// A normal close to n that has n.v < 0 certainly for all v within `spread` of w: a plane that contains w to
/// rounding is turned to face away from it.
Eigen::Vector3d facing_away(const Eigen::Vector3d& n, const Eigen::Vector3d& w,
                            const Eigen::Vector3d& spread) {
  const double along = n.dot(w), noise = n.cwiseAbs().dot(0x1p-48 * w.cwiseAbs() + 1.001 * spread) + 1e-30;
  return n - ((along + noise) / w.squaredNorm()) * w;
}

/// The first rung's arithmetic for one velocity.
struct TriageCertificates {
  const HullScene& scene;
  const Eigen::Vector3d& w;
  Axes axes;
  Tracked minus_u, minus_v;

  TriageCertificates(const HullScene& s, const Eigen::Vector3d& velocity)
      : scene(s),
        w(velocity),
        axes(velocity),
        minus_u(Tracked::minus(velocity(axes.i) / velocity(axes.k))),
        minus_v(Tracked::minus(velocity(axes.j) / velocity(axes.k))) {}

  std::array<Tracked, 3> difference(HullPair pair) const {
    const Eigen::Vector3d b = scene.centred_obstacle[pair.obstacle], a = scene.centred_agent[pair.agent];
    const auto entry = [&](int r) { return Tracked::of(b(axes[r])) - Tracked::of(a(axes[r])); };
    return {entry(0), entry(1), entry(2)};
  }
  static Eigen::Vector3d spread() { return Eigen::Vector3d::Zero(); }
  int side(const Eigen::Vector3d& n) const { return triage_side(n, w); }
  bool ahead_of(const Eigen::Vector3d& near, const HullSupport& support, const Eigen::Vector3d& n) const {
    return triage_ahead_of(scene, near, support, n);
  }
  bool in_shadow(const HullSimplex<2>& simplex) const {
    std::array<std::array<Tracked, 3>, 3> d;
    std::array<Tracked, 3> weight;
    for (int t = 0; t < 3; ++t) {
      const bool used = t < simplex.count;
      d[t] = difference(simplex.pair[used ? t : 0]);
      weight[t] = Tracked::of(used ? simplex.weight[t] : 0);
    }
    const auto shape = [this](int r, int c) {
      return Tracked::of(scene.shape(axes[r], axes[c]),
                         scene.shape_magnitude[HullScene::kPacked[axes[r]][axes[c]]]);
    };
    return shadow_depth<Tracked>(shape, d, weight, minus_u, minus_v)
               .certain(kHullCount.depth, kHullUnderflow) > 0;
  }
  int turn(HullPair p, HullPair q) const {
    return shadow_cross<Tracked>(difference(p), difference(q), minus_u, minus_v)
        .certain(kHullCount.cross, kHullUnderflow);
  }
};

/// The second rung's.
struct IntervalCertificates {
  const HullScene& scene;
  const std::array<Interval, 3>& w;
  Axes axes;
  Interval minus_u, minus_v;

  IntervalCertificates(const HullScene& s, const std::array<Interval, 3>& velocity)
      : scene(s),
        w(velocity),
        axes({velocity[0].mid(), velocity[1].mid(), velocity[2].mid()}),
        minus_u(-velocity[axes.i] / velocity[axes.k]),
        minus_v(-velocity[axes.j] / velocity[axes.k]) {}

  std::array<Interval, 3> difference(HullPair pair) const {
    const auto d = enclosed_difference(scene, pair);
    return {d[axes.i], d[axes.j], d[axes.k]};
  }
  Eigen::Vector3d spread() const { return {w[0].rad(), w[1].rad(), w[2].rad()}; }
  int side(const Eigen::Vector3d& n) const { return interval_side(n, w); }
  bool ahead_of(const Eigen::Vector3d& near, const HullSupport& support, const Eigen::Vector3d& n) const {
    return interval_ahead_of(scene, near, support, n);
  }
  bool in_shadow(const HullSimplex<2>& simplex) const {
    std::array<std::array<Interval, 3>, 3> d;
    std::array<Interval, 3> weight;
    for (int t = 0; t < simplex.count; ++t) {
      d[t] = difference(simplex.pair[t]);
      weight[t] = Interval(simplex.weight[t]);
    }
    const auto shape = [this](int r, int c) {
      return scene.enclosed_shape[HullScene::kPacked[axes[r]][axes[c]]];
    };
    return shadow_depth<Interval>(shape, d, weight, minus_u, minus_v).positive();
  }
  int turn(HullPair p, HullPair q) const {
    const Interval c = shadow_cross<Interval>(difference(p), difference(q), minus_u, minus_v);
    return static_cast<int>(c.positive()) - static_cast<int>(c.negative());
  }
};

/// Whether the origin is strictly inside the polygon: between its corners, seen from there, it turns the same
/// way, each time by less than half a turn; less than two turns together, so it is one.
template <typename Certificates, std::size_t kCorners>
bool winds_around(const Certificates& certificates, const std::array<HullPair, kCorners>& corner) {
  const int first = certificates.turn(corner[kCorners - 1], corner[0]);
  if (first == 0) return false;
  for (std::size_t i = 0; i + 1 < kCorners; ++i)
    if (certificates.turn(corner[i], corner[i + 1]) != first) return false;
  return true;
}

/// Both lower rungs: the search with the rung's certificates. `w` about the velocity, at a scale of one.
/// `normal`: separates the bodies, certified.
template <typename Certificates>
std::optional<Membership> decide(const HullScene& scene, const Eigen::Vector3d& w,
                                 const Eigen::Vector3d& normal, const Certificates& certificates) {
  const int side = certificates.side(normal);
  if (side < 0) return Membership::out;
  std::optional<Membership> answer;
  HullSimplex<2> simplex;
  const bool round = scene.ellipsoid.has_value();
  const auto at_point = [&](const HullSimplex<2>& s) {
    const bool hit =
        round ? s.nearest.squaredNorm() < 1 - 1e-15 && certificates.in_shadow(s)
              : s.surrounds && winds_around(certificates, std::array{s.pair[0], s.pair[1], s.pair[2]});
    if (!hit) return false;
    if (side > 0) answer = Membership::in;
    return true;  // the line meets K: without the side nothing else will be found
  };
  const auto at_plane = [&](const HullSimplex<2>& s, const Eigen::Vector3d& n, const HullSupport& support) {
    if (support.value() > radius_above(scene, n) * (1 - 1e-14)) {
      const Eigen::Vector3d away = facing_away(n, w, certificates.spread());
      if (certificates.side(away) < 0 && certificates.ahead_of(n, support, away)) {
        answer = Membership::out;
        return true;
      }
      return false;
    }
    // An edge through the origin, or nearly: with the farthest points on both sides it is a quadrilateral.
    if (!round && s.count == 2 && s.nearest.squaredNorm() < 1e-6 * (s.z[1] - s.z[0]).squaredNorm()) {
      const HullSupport other = least_support(scene, -n);
      if (winds_around(certificates, std::array{s.pair[0], support.pair, s.pair[1], other.pair})) {
        if (side > 0) answer = Membership::in;
        return true;
      }
    }
    return false;
  };
  search_hull<2>(scene, shadow_plane(scene, w), simplex, at_point, at_plane);
  return answer;
}

exact::Rows<3> identity_rows() { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }

Relation relation_of(OriginIn position) {
  return position == OriginIn::outside    ? Relation::disjoint
         : position == OriginIn::boundary ? Relation::touching
                                          : Relation::overlapping;
}

/// Over its largest entry, rounded.
Eigen::Vector3d to_direction(const exact::IntegerVector<3>& n) {
  exact::Integer largest = 0;
  for (const exact::Integer& e : n) largest = std::max(largest, exact::Integer(abs(e)));
  Eigen::Vector3d r;
  for (int i = 0; i < 3; ++i)
    r(i) = static_cast<double>(exact::Integer((abs(n[i]) << 64) / largest)) * 0x1p-64 * n[i].sign();
  return r;
}

}  // namespace

HullOracle::HullOracle(const Ellipsoid& agent, const HullBody& obstacle, const Eigen::Vector3d& agent_at,
                       const Eigen::Vector3d& obstacle_at)
    : HullOracle(std::make_shared<HullScene>(std::vector<Eigen::Vector3d>{agent.center()}, agent_at,
                                             obstacle.points(), obstacle_at, agent.center() + agent_at,
                                             &agent)) {}

HullOracle::HullOracle(const HullBody& agent, const Ellipsoid& obstacle, const Eigen::Vector3d& agent_at,
                       const Eigen::Vector3d& obstacle_at)
    : HullOracle(std::make_shared<HullScene>(agent.points(), agent_at,
                                             std::vector<Eigen::Vector3d>{obstacle.center()}, obstacle_at,
                                             obstacle.center() + obstacle_at, &obstacle)) {}

HullOracle::HullOracle(const HullBody& agent, const HullBody& obstacle, const Eigen::Vector3d& agent_at,
                       const Eigen::Vector3d& obstacle_at)
    : HullOracle(std::make_shared<HullScene>(agent.points(), agent_at, obstacle.points(), obstacle_at,
                                             agent.points().front() + agent_at, nullptr)) {}

HullOracle::HullOracle(std::shared_ptr<HullScene> scene) : scene_(scene) {
  std::optional<Relation> found;
  HullSimplex<3> simplex;
  if (scene->usable) {
    const bool round = scene->ellipsoid.has_value();
    const auto at_point = [&](const HullSimplex<3>& s) {
      const bool hit = round ? s.nearest.squaredNorm() < 1 - 1e-15 &&
                                   interval_inside(*scene, s.pair.data(), s.weight.data(), s.count)
                             : s.surrounds && interval_surrounds(*scene, s.pair.data());
      if (!hit) return false;
      found = Relation::overlapping;
      relation_rung_ = Rung::interval;
      return true;
    };
    // The search goes on after the first plane: later ones have more room.
    const auto at_plane = [&](const HullSimplex<3>&, const Eigen::Vector3d& n, const HullSupport& support) {
      const bool first_rung = triage_ahead_of(*scene, n, support, n);
      if (!first_rung && !interval_ahead_of(*scene, n, support, n)) return false;
      normal_ = n;
      normal_certified_ = true;
      const double room = support.value() - (support_slack(*scene, n) + radius_above(*scene, n)) * kRoundUp;
      room_ = std::ldexp(std::max(room, 0.0), scene->exponent);
      if (!found || first_rung) relation_rung_ = first_rung ? Rung::triage : Rung::interval;
      found = Relation::disjoint;
      return false;
    };
    search_hull<3>(*scene, scene->to_ball, simplex, at_point, at_plane);
    if (simplex.count > 0) scene->start = simplex.pair[0];
  }
  if (!found) {
    const std::vector<HullPair> start(simplex.pair.begin(), simplex.pair.begin() + simplex.count);
    found = relation_of(exact::origin_in_image<3>(*scene, identity_rows(), start, &scene->exact_normal));
    relation_rung_ = Rung::exact;
    if (found == Relation::disjoint) {
      normal_ = to_direction(scene->exact_normal);
      normal_certified_ = exact::separates(*scene, exact::direction_on_grid<3>(normal_));
    }
  }
  relation_ = *found;
  if (normal_certified_) scene->exact_normal = exact::direction_on_grid<3>(normal_);
}

const HullScene& scene_of(const HullOracle& oracle) { return *oracle.scene_; }

Relation HullOracle::exact_relation() const { return exact::relation(*scene_); }

std::size_t HullOracle::size() const { return scene_->agent.size() + scene_->obstacle.size(); }

std::optional<Membership> HullOracle::triage_membership(const Eigen::Vector3d& w) const noexcept {
  if (w.x() == 0 && w.y() == 0 && w.z() == 0) return Membership::out;
  if (!w.allFinite()) return std::nullopt;
  if (relation_ != Relation::disjoint) return Membership::in;
  if (!scene_->usable || !normal_certified_) return std::nullopt;
  int exponent = 0;
  const Eigen::Vector3d v = at_scale_one(w, exponent);
  return decide(*scene_, v, normal_, TriageCertificates(*scene_, v));
}

std::optional<Membership> HullOracle::interval_membership(const Eigen::Vector3d& v_a,
                                                          const Eigen::Vector3d& v_b) const noexcept {
  std::array<Interval, 3> w;
  for (int i = 0; i < 3; ++i) w[i] = v_b(i) == 0 ? Interval(v_a(i)) : Interval(v_a(i)) - Interval(v_b(i));
  return interval_membership(w);
}

std::optional<Membership> HullOracle::interval_membership(const std::array<Interval, 3>& w) const noexcept {
  const Eigen::Vector3d mid{w[0].mid(), w[1].mid(), w[2].mid()};
  if (!w[0].finite() || !w[1].finite() || !w[2].finite()) return std::nullopt;
  const bool point = w[0].rad() == 0 && w[1].rad() == 0 && w[2].rad() == 0;
  if (mid.isZero(0)) return point ? std::optional(Membership::out) : std::nullopt;
  if (w[Axes(mid).k].sign() == FilteredSign::uncertain) return std::nullopt;
  if (relation_ != Relation::disjoint) return Membership::in;
  if (!scene_->usable || !normal_certified_) return std::nullopt;
  int exponent = 0;
  const Eigen::Vector3d v = at_scale_one(mid, exponent);
  if (std::abs(exponent) > 1020) return std::nullopt;
  const Interval scale(std::ldexp(1.0, -exponent));
  std::array<Interval, 3> scaled;
  for (int i = 0; i < 3; ++i) scaled[i] = w[i] * scale;
  return decide(*scene_, v, normal_, IntervalCertificates(*scene_, scaled));
}

Membership HullOracle::exact_membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const {
  const exact::IntegerVector<3> w = exact::difference_on_grid<3>(v_a, v_b);
  if (w[0] == 0 && w[1] == 0 && w[2] == 0) return Membership::out;
  if (relation_ != Relation::disjoint) return Membership::in;
  // All of K is ahead of this plane through the origin.
  const exact::IntegerVector<3>& n = scene_->exact_normal;
  const exact::Integer side = n[0] * w[0] + n[1] * w[1] + n[2] * w[2];
  if (side.sign() <= 0) return Membership::out;
  const auto start = around_line(*scene_, to_direction(w));
  switch (exact::origin_in_image<2>(*scene_, exact::shadow_rows(w), start, nullptr)) {
    case OriginIn::interior:
      return Membership::in;
    case OriginIn::boundary:
      return Membership::on;
    case OriginIn::outside:
      break;
  }
  return Membership::out;
}

Membership HullOracle::membership(const Eigen::Vector3d& w, Rung* rung) const {
  return climb_membership<HullMembership>(*this, w, Eigen::Vector3d(Eigen::Vector3d::Zero()), rung);
}

Membership HullOracle::membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b, Rung* rung) const {
  return climb_membership<HullMembership>(*this, v_a, v_b, rung);
}

double HullOracle::gap(const Eigen::Vector3d& n) const noexcept {
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  if (!scene_->usable || !n.allFinite() || n.isZero(0)) return kNothing;
  int exponent = 0;
  const Eigen::Vector3d m = at_scale_one(n, exponent);
  const double least =
      least_support(*scene_, m).value() - (support_slack(*scene_, m) + radius_above(*scene_, m)) * kRoundUp;
  return std::ldexp(least - std::abs(least) * 0x1p-50, exponent + scene_->exponent);
}

bool HullOracle::surely_out(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                            const Horizon& horizon) const noexcept {
  const Eigen::Vector3d w = v_a - v_b;
  // Of the normal the largest entry is 1.
  const double slack = 32 * kUnitRoundoff * w.cwiseAbs().sum();
  if (normal_certified_ && slack > 1e-280 && (normal_.dot(w) + slack) * horizon.until < room_) return true;
  return triage_membership(w) == Membership::out || interval_membership(v_a, v_b) == Membership::out;
}

Membership HullOracle::exact_within(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                    const Horizon& horizon) const {
  return exact::within(*this, Stretch{v_a, v_b, horizon.from, horizon.until});
}

Passage HullOracle::passage(const Eigen::Vector3d& w) const { return passage_by_membership(*this, w); }

Verdict HullOracle::verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b, Rung* rung) const {
  if (rung && relation_ != Relation::disjoint) *rung = relation_rung_;
  return verdict_of(relation_, [&] { return membership(v_a, v_b, rung); });
}

}  // namespace vericone
