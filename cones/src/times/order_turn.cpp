// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <vericone/internal/cones/times/order.h>
#include <vericone/internal/geometry/exact/algebraic.h>

#include "ellipsoids/enclosed_pair.h"
#include "ellipsoids/pair_on_grid.h"
#include "planar/planar_frame.h"

namespace vericone {
namespace {

using Eigen::Vector2d;

/// A normal of the tangent, found in doubles. g(n) is positive on the inner side of it, negative on the
/// outer: two normals with certified signs hold the exact one between them, because { g >= 0 } is convex.
class TangentSearch {
 public:
  explicit TangentSearch(const TangentRef& tangent) : pair_(tangent.a, tangent.b), left_(tangent.left) {
    if (!pair_.usable) return;
    const ContactFrame<2> contact(pair_.factor_a, pair_.factor_b, pair_.center_line);
    if (!(contact.contact > 1)) return;
    const PlanarFrame frame(contact);
    // As in sector_by_support: the slope +1 belongs to the clockwise edge unless the map reflects.
    const bool up = (frame.normal_to_space.determinant() > 0) != left_;
    normal_ = (frame.normal_to_space * Vector2d(1, support_tangent_slope(frame, contact, up ? 1 : -1)))
                  .normalized();
    found_ = normal_.allFinite();
  }

  /// The directions of two normals, off by `angle` to either side.
  struct Bounds {
    Vector2d inner, outer;
  };
  std::optional<Bounds> bounds(double angle) const {
    if (!found_) return std::nullopt;
    const Vector2d outwards = (left_ ? 1 : -1) * angle * Vector2d(normal_.y(), -normal_.x());
    const Vector2d inner = normal_ - outwards, outer = normal_ + outwards;
    if (!pair_.gap(inner).positive() || !pair_.gap(outer).negative()) return std::nullopt;
    return Bounds{direction(inner), direction(outer)};
  }
  std::optional<Bounds> narrowest_bounds() const {
    for (double angle = 0x1p-51; angle < 1e-3; angle *= 8)
      if (const auto found = bounds(angle)) return found;
    return std::nullopt;
  }

 private:
  Vector2d direction(const Vector2d& n) const {
    return left_ ? Vector2d(-n.y(), n.x()) : Vector2d(n.y(), -n.x());
  }

  EnclosedPair<2> pair_;
  bool left_, found_ = false;
  Vector2d normal_ = Vector2d::Zero();
};

constexpr double kTriageAngle = 1e-9;

/// The cross product is bilinear: its sign on two small sectors is that at their edges.
std::optional<Sign> turn_between(const std::optional<TangentSearch::Bounds>& p,
                                 const std::optional<TangentSearch::Bounds>& q) {
  if (!p || !q) return std::nullopt;
  int positive = 0, negative = 0;
  for (const Vector2d* d : {&p->inner, &p->outer})
    for (const Vector2d* e : {&q->inner, &q->outer}) {
      const Interval cross = Interval(d->x()) * Interval(e->y()) - Interval(d->y()) * Interval(e->x());
      positive += cross.positive();
      negative += cross.negative();
    }
  return positive == 4   ? std::optional(Sign::positive)
         : negative == 4 ? std::optional(Sign::negative)
                         : std::nullopt;
}

using exact::Integer, exact::Polynomial, exact::RealRoot;
using exact::operator*, exact::operator-;

/// With n = u + tau u', u' = u turned by +90 degrees: G = (n.c)^2 - q_A - q_B and F = G^2 - 4 q_A q_B, the
/// product of n.c +- rho_A +- rho_B over all signs. An inner tangent is a root of F with G > 0.
struct NormalForms {
  Polynomial along, g, f;

  NormalForms(const exact::PairOnGrid<2>& pair, int ux, int uy) {
    const auto form = [&](const exact::IntegerMatrix<2>& s) {
      const Integer xx = s[0][0] * ux + s[0][1] * uy, xy = s[1][0] * ux + s[1][1] * uy,
                    yx = s[0][1] * ux - s[0][0] * uy, yy = s[1][1] * ux - s[1][0] * uy;
      Polynomial q{xx * ux + xy * uy, 2 * (xy * ux - xx * uy), yy * ux - yx * uy};
      exact::trim(q);
      return q;
    };
    along = {pair.c[0] * ux + pair.c[1] * uy, pair.c[1] * ux - pair.c[0] * uy};
    exact::trim(along);
    const Polynomial qa = form(pair.a), qb = form(pair.b);
    g = along * along - qa - qb;
    f = g * g - qa * qb * Integer(4);
  }
  /// Whether u' is none of the roots.
  bool complete() const { return f.size() == 5; }
};

/// n = sign * (u + tau u'), n.c > 0.
struct AlgebraicNormal {
  RealRoot tau;
  int sign;
};

AlgebraicNormal normal(const NormalForms& forms, bool left) {
  std::vector<AlgebraicNormal> inner;
  for (RealRoot& tau : exact::real_roots(forms.f))
    if (exact::sign_at(forms.g, tau) > 0) {
      const int sign = exact::sign_at(forms.along, tau);
      inner.push_back({std::move(tau), sign});
    }
  // One double root for touching bodies. Of two, the right normal is counter-clockwise from the left one.
  const bool first_is_left = inner.front().sign == inner.back().sign;
  return first_is_left == left ? inner.front() : inner.back();
}

struct ExactTurn {
  int cross;
  bool opposed;
};

ExactTurn compare_exactly(const exact::PairOnGrid<2>& p, bool p_left, const exact::PairOnGrid<2>& q,
                          bool q_left) {
  for (int uy = 0;; ++uy) {  // at most eight directions u' are roots
    const NormalForms of_p(p, 1, uy), of_q(q, 1, uy);
    if (!of_p.complete() || !of_q.complete()) continue;
    AlgebraicNormal m = normal(of_p, p_left), n = normal(of_q, q_left);
    const int same_way = m.sign * n.sign * (p_left == q_left ? 1 : -1);
    const int order = exact::compare(n.tau, m.tau);
    return {same_way * order, order == 0 && same_way < 0};
  }
}

void require_tangent(const TangentRef& tangent, const char* field) {
  if (!tangent.a.center().allFinite() || !tangent.b.center().allFinite() ||
      relation<2>(tangent.a, tangent.b) == Relation::overlapping)
    throw InputError(field, "overlapping bodies", "two finite bodies that do not overlap");
}

ExactTurn compare_exactly(const TangentRef& p, const TangentRef& q) {
  require_tangent(p, "p");
  require_tangent(q, "q");
  return compare_exactly(exact::PairOnGrid<2>(p.a, p.b), p.left, exact::PairOnGrid<2>(q.a, q.b), q.left);
}

}  // namespace

std::optional<Sign> triage_turn(const TangentRef& p, const TangentRef& q) {
  return turn_between(TangentSearch(p).bounds(kTriageAngle), TangentSearch(q).bounds(kTriageAngle));
}

std::optional<Sign> interval_turn(const TangentRef& p, const TangentRef& q) {
  return turn_between(TangentSearch(p).narrowest_bounds(), TangentSearch(q).narrowest_bounds());
}

Sign exact_turn(const TangentRef& p, const TangentRef& q) {
  return static_cast<Sign>(compare_exactly(p, q).cross);
}

Sign turn(const TangentRef& p, const TangentRef& q, Rung* rung) {
  const TangentSearch search_p(p), search_q(q);
  return climb<TurnOfTangents>(
      rung, [&] { return turn_between(search_p.bounds(kTriageAngle), search_q.bounds(kTriageAngle)); },
      [&] { return turn_between(search_p.narrowest_bounds(), search_q.narrowest_bounds()); },
      [&] { return exact_turn(p, q); });
}

bool opposed(const TangentRef& p, const TangentRef& q) {
  Rung rung = Rung::triage;
  if (turn(p, q, &rung) != Sign::zero) return false;
  return compare_exactly(p, q).opposed;
}

}  // namespace vericone
