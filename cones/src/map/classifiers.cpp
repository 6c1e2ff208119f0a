// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/map/classifiers.h>

#include <vericone/geometry/interval.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "answers/frontier.h"

namespace vericone {
namespace {

using Eigen::Vector3d;

Interval dot(const Vector3d& a, const Vector3d& b) {
  return Interval(a.x()) * Interval(b.x()) + Interval(a.y()) * Interval(b.y()) +
         Interval(a.z()) * Interval(b.z());
}

/// Normals of the planes through two corners, towards the third; not normalised. Differences keep the digits
/// of small cells.
DirectionCell inward_normals(const DirectionCell& c) {
  return {c[0].cross(c[1] - c[0]), c[1].cross(c[2] - c[1]), c[2].cross(c[0] - c[2])};
}

DirectionCell normalized(DirectionCell c) {
  for (Vector3d& x : c) x.stableNormalize();
  return c;
}

/// The angle in (-pi/2, pi/2) where a quasi-concave function is largest, to some 1e-8.
template <typename F>
double largest_at(const F& f) {
  constexpr double kGolden = 1 / std::numbers::phi;
  double low = -0.5 * std::numbers::pi, high = -low;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low), fa = f(a), fb = f(b);
  while (high - low > 1e-8) {
    if (fa > fb) {
      high = std::exchange(b, a);
      fb = fa;
      fa = f(a = high - kGolden * (high - low));
    } else {
      low = std::exchange(a, b);
      fa = fb;
      fb = f(b = low + kGolden * (high - low));
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

// Two ellipsoids. Of all n with n.d_i <= 0 the one that separates best, with the largest n.c / (rho_A +
// rho_B), a quasi-concave function, has none, one or two n.d_i = 0: it is the normal that separates best of
// all, the best of those normal to one corner, or that of a side.

std::optional<Vector3d> EllipsoidClassifier::normal_along(const Vector3d& direction) const {
  const Vector3d w = direction.normalized(), c = oracle_.b().center() - oracle_.a().center();
  const Vector3d e1 = (c - c.dot(w) * w).stableNormalized(), e2 = w.cross(e1);
  if (e1.isZero(0)) return std::nullopt;
  const auto normal = [&](double t) -> Vector3d { return std::cos(t) * e1 + std::sin(t) * e2; };
  return normal(largest_at([&](double t) {
    const Vector3d n = normal(t);
    return n.dot(c) / (oracle_.a().radius(n) + oracle_.b().radius(n));
  }));
}

bool EllipsoidClassifier::proved_out(Vector3d normal, const DirectionCell& cell) const {
  normal.stableNormalize();
  // Turned away by the rounding of those that are to be zero.
  const Vector3d middle = cell[0] + cell[1] + cell[2];
  double most = 0;
  for (const Vector3d& d : cell) most = std::max(most, normal.dot(d));
  if (most > 1e-9) return false;
  normal -= (2 * most + 1e-15) * middle;
  for (const Vector3d& d : cell)
    if (!(dot(normal, d).hi() <= 0)) return false;
  return separates<3>(oracle_.a(), oracle_.b(), normal);
}

Certified EllipsoidClassifier::classify(const DirectionCell& cell, const Frontier&, Frontier&) const {
  if (oracle_.relation() != Relation::disjoint) return Certified::in;
  const auto inside = std::count_if(
      cell.begin(), cell.end(), [&](const Vector3d& d) { return oracle_.membership(d) != Membership::out; });
  if (inside == 3) return Certified::in;
  if (inside > 0) return Certified::undecided;
  if (proved_out(oracle_.separating_normal(), cell)) return Certified::out;
  for (const Vector3d& d : cell)
    if (const auto n = normal_along(d); n && proved_out(*n, cell)) return Certified::out;
  for (const Vector3d& n : inward_normals(cell))
    if (proved_out(-n, cell)) return Certified::out;
  return Certified::undecided;
}

// Two combined quadrics. A cell whose distance from the polygon is at least kMargin is on the same side of
// the one without rounding: directions and normals are right to kRounding.

namespace {
constexpr double kMargin = 1e-12, kRounding = 1e-15;

double least(const Vector3d& n, const DirectionCell& c) {
  return std::min({n.dot(c[0]), n.dot(c[1]), n.dot(c[2])});
}

/// Whether the plane has the one on its positive side and the other beyond.
bool parts(const Vector3d& n, const DirectionCell& one, const DirectionCell& other) {
  return least(n, one) >= -kRounding && least(-n, other) >= kMargin;
}

bool contains(const DirectionCell& inwards, const Vector3d& d) {
  return std::all_of(inwards.begin(), inwards.end(),
                     [&](const Vector3d& n) { return n.dot(d) >= -kRounding; });
}
}  // namespace

CombinedClassifier::CombinedClassifier(const CombinedCone& cone) : relation_(cone.relation) {
  for (const PolyhedralCone* polygon : {&cone.inner, &cone.outer})
    for (std::size_t i = 0; i < polygon->directions.size(); ++i) {
      const Vector3d &p = polygon->directions[i],
                     &q = polygon->directions[(i + 1) % polygon->directions.size()];
      const DirectionCell corners = {cone.axis, p, q};
      const double widest = std::min({cone.axis.dot(p), cone.axis.dot(q), p.dot(q)});
      parts_.push_back(
          {corners, normalized(inward_normals(corners)), polygon == &cone.outer, !(widest > -0.99)});
    }
}

Frontier CombinedClassifier::start() const {
  Frontier all(parts_.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

bool CombinedClassifier::apart(const Part& part, const DirectionCell& cell,
                               const DirectionCell& inwards) const {
  if (part.wide) return false;
  for (int i = 0; i < 3; ++i)
    if (parts(part.inwards[i], part.corners, cell) || parts(-part.inwards[i], part.corners, cell) ||
        parts(inwards[i], cell, part.corners))
      return true;
  return false;
}

Certified CombinedClassifier::classify(const DirectionCell& cell, const Frontier& parent,
                                       Frontier& own) const {
  if (!relation_) return Certified::undecided;
  if (*relation_ != Relation::disjoint) return Certified::in;
  require_indices(parent, parts_.size());
  const DirectionCell inwards = normalized(inward_normals(cell));
  bool may_meet = false, inside = false, crosses = false;
  for (const std::uint32_t i : parent) {
    const Part& part = parts_[i];
    if (apart(part, cell, inwards)) continue;
    own.push_back(i);
    if (part.outer) {
      may_meet = true;
      continue;
    }
    const DirectionCell side = {part.corners[1], part.corners[2], part.corners[2]};
    crosses =
        crosses || !(least(part.inwards[1], cell) >= kMargin || least(-part.inwards[1], cell) >= kMargin ||
                     std::any_of(inwards.begin(), inwards.end(),
                                 [&](const Vector3d& n) { return parts(n, cell, side); }));
    inside = inside || (!part.wide && contains(part.inwards, cell[0]));
  }
  return !may_meet ? Certified::out : inside && !crosses ? Certified::in : Certified::undecided;
}

// Several.

Frontier AnyOfClassifier::start() const {
  Frontier all;
  for (std::uint32_t i = 0; i < all_.size(); ++i) {
    const Frontier one = all_[i]->start();
    all.push_back(i);
    all.push_back(static_cast<std::uint32_t>(one.size()));
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

/// ask(classifier, parent, own) of each that its parent's frontier names.
template <typename Ask>
Certified AnyOfClassifier::each(const Frontier& parent, Frontier& own, const Ask& ask) const {
  Frontier before, after;
  for (std::size_t at = 0; at < parent.size();) {
    const std::size_t left = parent.size() - at;
    require_frontier(left >= 2 && parent[at] < all_.size() && parent[at + 1] <= left - 2, parent);
    const std::uint32_t index = parent[at], count = parent[at + 1];
    before.assign(parent.begin() + at + 2, parent.begin() + at + 2 + count);
    at += 2 + count;
    after.clear();
    const Certified answer = ask(*all_[index], before, after);
    if (answer == Certified::in) return Certified::in;
    if (answer == Certified::out) continue;
    own.push_back(index);
    own.push_back(static_cast<std::uint32_t>(after.size()));
    own.insert(own.end(), after.begin(), after.end());
  }
  return own.empty() ? Certified::out : Certified::undecided;
}

Certified AnyOfClassifier::classify(const DirectionCell& cell, const Frontier& parent, Frontier& own) const {
  return each(parent, own, [&](const DirectionClassifier& one, const Frontier& before, Frontier& after) {
    return one.classify(cell, before, after);
  });
}

bool AnyOfClassifier::misses(const DirectionCell& cell, const Frontier& parent, Frontier& own) const {
  return each(parent, own, [&](const DirectionClassifier& one, const Frontier& before, Frontier& after) {
           return one.misses(cell, before, after) ? Certified::out : Certified::undecided;
         }) == Certified::out;
}

namespace {

DirectionCell mirrored(const DirectionCell& cell) { return {-cell[0], -cell[2], -cell[1]}; }

}  // namespace

Certified MirroredClassifier::classify(const DirectionCell& cell, const Frontier& parent,
                                       Frontier& own) const {
  return exchanged_->classify(mirrored(cell), parent, own);
}

bool MirroredClassifier::misses(const DirectionCell& cell, const Frontier& parent, Frontier& own) const {
  return exchanged_->misses(mirrored(cell), parent, own);
}

}  // namespace vericone
