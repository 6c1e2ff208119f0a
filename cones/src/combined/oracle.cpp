// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/cone.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "answers/stretch.h"
#include "combined/contacts.h"

namespace vericone {

using Eigen::Vector3d;

struct CombinedOracle::State {
  CombinedEllipsoid given_a, given_b;
  bool swapped;
  CombinedEllipsoid a, b;  // a is an ellipsoid whenever one of the two is
  double tolerance;
  std::optional<Relation> relation;
  std::optional<ConeOracle> exact;   // two ellipsoids
  std::optional<ConeOracle> around;  // the ellipsoids, which contain the bodies

  /// Simpler bodies, tried first where a search would be the only other way; made when first asked for.
  struct Simpler {
    std::optional<ConeOracle> inside;  // ellipsoids inside the bodies
    // Where neither body is an ellipsoid: one of them replaced by its ellipsoid (what misses that misses the
    // body) or by one inside of it (what meets that meets the body).
    std::vector<CombinedOracle> wider, narrower;
  };
  mutable std::optional<Simpler> simpler_;
  mutable std::optional<CombinedContacts> contacts_;
  mutable std::optional<CombinedEdges> edges_;

  State(const CombinedEllipsoid& first, const CombinedEllipsoid& second, double width)
      : given_a(first),
        given_b(second),
        swapped(!first.is_ellipsoid() && second.is_ellipsoid()),
        a(swapped ? second : first),
        b(swapped ? first : second),
        tolerance(width) {
    ConeOracle outer(a.ellipsoid(), b.ellipsoid());
    if (a.is_ellipsoid() && b.is_ellipsoid()) {
      relation = outer.relation();
      exact.emplace(std::move(outer));
      return;
    }
    if (outer.relation() == Relation::disjoint) {
      relation = Relation::disjoint;
      around.emplace(std::move(outer));
    } else if (contacts().usable()) {
      relation = contacts().relation();
    }
  }

  const Simpler& simpler() const {
    if (simpler_) return *simpler_;
    simpler_.emplace();
    Simpler& made = *simpler_;
    // Narrower by so much that intervals can prove it inside, though it touches all around.
    const auto core = [](const CombinedEllipsoid& body) -> std::optional<Ellipsoid> {
      if (body.is_ellipsoid()) return body.ellipsoid();
      const auto inscribed = body.inscribed_ellipsoid();
      if (!inscribed) return std::nullopt;
      Eigen::Matrix3d axes = inscribed->axis_directions();
      if (axes.determinant() < 0) axes.col(0) *= -1;
      const Ellipsoid inner = Ellipsoid::from_axes(body.center(), inscribed->semi_axes() * (1 - 5e-5), axes);
      return surely_contains(body, inner) ? std::optional(inner) : std::nullopt;
    };
    const auto core_a = core(a), core_b = core(b);
    if (core_a && core_b) made.inside.emplace(*core_a, *core_b);
    if (a.is_ellipsoid()) return made;
    const auto add = [&](std::vector<CombinedOracle>& list, const CombinedEllipsoid& p,
                         const CombinedEllipsoid& q) {
      CombinedOracle oracle(p, q, tolerance);
      if (oracle.relation() == Relation::disjoint) list.push_back(std::move(oracle));
    };
    add(made.wider, a.ellipsoid(), b);
    add(made.wider, a, b.ellipsoid());
    if (core_a) add(made.narrower, *core_a, b);
    if (core_b) add(made.narrower, a, *core_b);
    return made;
  }

  const CombinedContacts& contacts() const {
    if (!contacts_) contacts_.emplace(a, b, tolerance);
    return *contacts_;
  }

  const CombinedEdges& edges() const {
    if (!edges_) edges_.emplace(given_a, given_b);
    return *edges_;
  }

  std::uint64_t boxes_searched() const {
    std::uint64_t sum = contacts_ ? contacts_->boxes_searched() : 0;
    if (!simpler_) return sum;
    for (const auto* list : {&simpler_->wider, &simpler_->narrower})
      for (const CombinedOracle& oracle : *list) sum += oracle.boxes_searched();
    return sum;
  }

  /// Of an edge, in the frame.
  CombinedContact contact(const CombinedEdge& edge) const {
    const Vector3d &point_a = swapped ? edge.on_b : edge.on_a, &point_b = swapped ? edge.on_a : edge.on_b;
    const Vector3d on_a = contacts().frame().in_frame(point_a);
    const Vector3d apart = contacts().frame().in_frame(b.center() - a.center() + point_b) - on_a;
    return {SearchOutcome::found, b.ellipsoid().factor().inverse() * point_b, on_a, apart.norm()};
  }

  /// The points of a contact found along w.
  CombinedEdge points(const CombinedContact& found, const IntervalVector3& w) const {
    const CombinedFrame& frame = contacts().frame();
    const Vector3d along = middle(w);
    Vector3d on_a = found.on_a, on_b;
    if (a.is_ellipsoid()) {
      on_b = found.on_b;
      Vector3d x = middle(frame.center());
      for (int j = 0; j < 3; ++j) x += on_b(j) * middle(frame.columns_b()[j]);
      const Vector3d ahead = along.normalized();
      on_a = x - x.dot(ahead) * ahead;
      on_a += std::sqrt(std::max(0.0, 1 - on_a.squaredNorm())) * ahead;
      on_b = b.ellipsoid().factor() * on_b;
    } else {
      on_b = a.ellipsoid().factor() * (on_a + found.way * along) - (b.center() - a.center());
    }
    on_a = a.ellipsoid().factor() * on_a;
    CombinedEdge edge;
    edge.on_a = swapped ? on_b : on_a;
    edge.on_b = swapped ? on_a : on_b;
    return edge;
  }

  Certified within(const Vector3d& v_a, const Vector3d& v_b, double until) const;
  /// Seconds a way in the frame along the direction of w; rounded.
  double seconds_a_way(const IntervalVector3& direction, const Vector3d& w) const {
    // direction = k F^{-1} w: t w = way F (k F^{-1} w), so t = way k.
    return (a.ellipsoid().factor() * middle(direction)).norm() / w.norm();
  }

  /// `near`: an edge near w, or none. `met`: where to write a contact along w if one is found.
  Certified membership(const Vector3d& v_a, const Vector3d& v_b, const CombinedEdge* near,
                       std::optional<CombinedEdge>* met) const;

  Vector3d own(const Vector3d& w) const { return swapped ? Vector3d(-w) : w; }
  IntervalVector3 direction(const Vector3d& w) const { return contacts().frame().direction(own(w)); }
  /// Of first - second, without rounding, in the order of a and b.
  IntervalVector3 direction(const Vector3d& first, const Vector3d& second) const {
    if (second.isZero(0)) return contacts().frame().direction(first);
    const double largest = std::max(first.cwiseAbs().maxCoeff(), second.cwiseAbs().maxCoeff());
    const int e = std::ilogb(largest);
    IntervalVector3 w;
    for (int i = 0; i < 3; ++i) {
      const Interval tiny(0, Interval::kTiny);  // what may be lost in scaling
      w[i] = Interval(std::ldexp(first(i), -e)) - Interval(std::ldexp(second(i), -e)) + tiny;
    }
    return contacts().frame().direction(w);
  }
};

std::optional<Relation> combined_relation(const CombinedEllipsoid& a, const CombinedEllipsoid& b,
                                          double tolerance) {
  const Relation ellipsoids = relation<3>(a.ellipsoid(), b.ellipsoid());
  if (ellipsoids == Relation::disjoint || (a.is_ellipsoid() && b.is_ellipsoid())) return ellipsoids;
  return CombinedOracle(a, b, tolerance).relation();
}

CombinedOracle::CombinedOracle(const CombinedEllipsoid& a, const CombinedEllipsoid& b, double tolerance) {
  if (!(tolerance > 0) || !(tolerance < 1))
    throw InputError("tolerance", to_text(tolerance), "between 0 and 1");
  state_ = std::make_unique<State>(a, b, std::max(tolerance, 1e-12));
}
CombinedOracle::~CombinedOracle() = default;
CombinedOracle::CombinedOracle(CombinedOracle&&) noexcept = default;
CombinedOracle& CombinedOracle::operator=(CombinedOracle&&) noexcept = default;

const CombinedEllipsoid& CombinedOracle::a() const { return state_->given_a; }
const CombinedEllipsoid& CombinedOracle::b() const { return state_->given_b; }
std::uint64_t CombinedOracle::boxes_searched() const { return state_->boxes_searched(); }
std::optional<Relation> CombinedOracle::relation() const { return state_->relation; }

Certified CombinedOracle::membership(const Vector3d& w) const {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(w(i)))
      throw InputError("relative_velocity[" + std::to_string(i) + "]", to_text(w(i)),
                       "a finite number (m/s)");
  return membership(w, Vector3d::Zero());
}

Certified CombinedOracle::membership(const Vector3d& w, const CombinedEdge& near) const {
  return state_->membership(w, Vector3d::Zero(), &near, nullptr);
}

Certified CombinedOracle::membership(const Vector3d& v_a, const Vector3d& v_b) const {
  return state_->membership(v_a, v_b, nullptr, nullptr);
}

Certified CombinedOracle::State::membership(const Vector3d& v_a, const Vector3d& v_b,
                                            const CombinedEdge* near,
                                            std::optional<CombinedEdge>* met) const {
  require_finite_velocity(v_a, "agent_velocity");
  require_finite_velocity(v_b, "obstacle_velocity");
  if (v_a == v_b) return Certified::out;
  if (relation == Relation::overlapping) return Certified::in;
  if (relation != Relation::disjoint) return Certified::undecided;
  const Vector3d &first = swapped ? v_b : v_a, &second = swapped ? v_a : v_b;
  if (exact) return exact->membership(first, second) == Membership::out ? Certified::out : Certified::in;
  if (around && around->membership(first, second) == Membership::out) return Certified::out;
  // Enclosed only where the ellipsoids do not decide.
  const auto found = [&](const CombinedContact& contact, const IntervalVector3& w) {
    if (contact.outcome == SearchOutcome::undecided) return Certified::undecided;
    if (contact.outcome == SearchOutcome::empty) return Certified::out;
    if (met) *met = points(contact, w);
    return Certified::in;
  };
  if (near && contacts().usable()) {
    const IntervalVector3 w = direction(first, second);
    const Certified answer = found(contacts().beside(w, contact(*near)), w);
    if (answer != Certified::undecided) return answer;
  }
  const Simpler& by = simpler();
  if (by.inside && by.inside->membership(first, second) != Membership::out) return Certified::in;
  if (!contacts().usable()) return Certified::undecided;
  for (const CombinedOracle& oracle : by.wider)
    if (oracle.membership(first, second) == Certified::out) return Certified::out;
  for (const CombinedOracle& oracle : by.narrower)
    if (oracle.state_->membership(first, second, nullptr, met) == Certified::in) return Certified::in;
  const IntervalVector3 w = direction(first, second);
  return found(contacts().along(w, contacts().extent()), w);
}

EdgeBracket CombinedOracle::edge(const Vector3d& u, const Vector3d& side, double width,
                                 const CombinedEdge* start) const {
  const State& s = *state_;
  EdgeBracket bracket;
  width = std::max(width, 1e-14);
  double low = 0;  // what is undecided is on this side
  std::optional<CombinedEdge> next;
  if (start) next = *start;
  const auto ask = [&](double angle, const CombinedEdge* near) {
    std::optional<CombinedEdge> met;
    const Certified answer =
        s.membership(std::cos(angle) * u + std::sin(angle) * side, Vector3d::Zero(), near, &met);
    if (answer == Certified::out) {
      bracket.out = angle;
    } else {
      low = angle;
      if (answer == Certified::in) bracket.in = angle;
      if (met) next = met;
    }
    return answer;
  };
  // What is asked just outside of an edge that is not the last one meets something farther out: there the
  // next one is looked for.
  constexpr int kTries = 3;
  for (int tries = 0; bracket.out - low > width; tries = (tries + 1) % (kTries + 1)) {
    if (tries == kTries) {
      ask(0.5 * (low + bracket.out), nullptr);
      continue;
    }
    if (!next) {
      // The points of both bodies farthest across.
      const Vector3d up = std::cos(low) * side - std::sin(low) * u;
      next.emplace();
      next->on_a = -up / a().gauge(up);
      next->on_b = up / b().gauge(up);
    }
    const auto edge = s.edges().near(u, side, *next);
    next.reset();
    if (!edge || !(edge->angle > low && edge->angle < bracket.out)) {
      tries = kTries - 1;
      continue;
    }
    if (ask(edge->angle + 0.5 * width, &*edge) == Certified::out &&
        ask(edge->angle - 0.5 * width, &*edge) != Certified::out) {
      bracket.edge = edge;
      return bracket;
    }
  }
  return bracket;
}

Verdict CombinedOracle::verdict(const Vector3d& v_a, const Vector3d& v_b) const {
  require_finite_velocity(v_a, "agent_velocity");
  require_finite_velocity(v_b, "obstacle_velocity");
  if (!state_->relation) return Verdict::undecided;
  if (*state_->relation == Relation::touching) return Verdict::touching;
  if (*state_->relation == Relation::overlapping) return Verdict::overlapping;
  switch (membership(v_a, v_b)) {
    case Certified::in:
      return Verdict::in;
    case Certified::out:
      return Verdict::out;
    case Certified::undecided:
      break;
  }
  return Verdict::undecided;
}

bool CombinedOracle::half_space_out(const Vector3d& n, const CombinedEdge& touching) const {
  const State& s = *state_;
  if (s.relation != Relation::disjoint || !s.contacts().usable()) return false;
  return s.contacts().none_beyond(s.own(n), s.contact(touching));
}

bool CombinedOracle::all_in(const Vector3d& from, const Vector3d& to, const CombinedEdge* at_from,
                            const CombinedEdge* at_to, const CombinedEdge* between) const {
  const State& s = *state_;
  if (s.relation != Relation::disjoint || !s.contacts().usable()) return false;
  const auto& inside = s.simpler().inside;
  const auto of_inside = [&](const Vector3d& w) { return inside->membership(s.own(w)) != Membership::out; };
  if (inside && of_inside(from) && of_inside(to)) return true;  // the cone of convex bodies is convex
  const IntervalVector3 first = s.direction(from), last = s.direction(to);
  if (!dot(first, last).positive()) return false;
  if (at_from && at_to && !s.a.is_ellipsoid()) {
    const CombinedContact of_first = s.contact(*at_from), of_last = s.contact(*at_to);
    std::optional<CombinedContact> of_middle;
    if (between) of_middle = s.contact(*between);
    return s.contacts().all_between(first, last, &of_first, &of_last, of_middle ? &*of_middle : nullptr);
  }
  for (const CombinedOracle& oracle : s.simpler().narrower)
    if (oracle.all_in(s.own(from), s.own(to))) return true;
  return s.contacts().all_between(first, last);
}

bool CombinedOracle::all_out(const Vector3d& from, const Vector3d& to, CombinedEdge* left) const {
  const State& s = *state_;
  if (s.relation != Relation::disjoint || !s.contacts().usable()) return false;
  // Pairs of boxes are quicker than all that leads to single directions.
  if (s.a.is_ellipsoid() && membership(from.normalized() + to.normalized()) != Certified::out) return false;
  const IntervalVector3 first = s.direction(from), last = s.direction(to);
  if (!dot(first, last).positive()) return false;
  if (s.contacts().none_between(first, last)) return true;
  if (left && !s.a.is_ellipsoid()) {
    const auto [on_a, on_b] = s.contacts().left();
    left->on_a = s.a.ellipsoid().factor() * on_a;
    left->on_b = s.b.ellipsoid().factor() * on_b;
  }
  return false;
}

std::optional<Interval> CombinedOracle::time_to_contact(const Vector3d& w, double width) const {
  const State& s = *state_;
  if (s.relation == Relation::overlapping) return Interval(0);
  if (!s.contacts().usable() || membership(w) != Certified::in) return std::nullopt;
  const IntervalVector3 direction = s.direction(w);
  // Ways in the frame, in units of the direction's length; monotone: a contact by one way is one by any
  // longer.
  double lo = 0, hi = s.contacts().extent();
  while (hi - lo > std::max(width, 1e-12) * s.contacts().extent()) {
    const double half = 0.5 * (lo + hi);
    const SearchOutcome outcome = s.contacts().along(direction, half).outcome;
    if (outcome == SearchOutcome::undecided) break;
    (outcome == SearchOutcome::found ? hi : lo) = half;
  }
  const double k = s.seconds_a_way(direction, w);
  // The way of a contact is not negative, whatever rounding says.
  const Interval time = Interval::between(lo * k * (1 - 1e-9), hi * k * (1 + 1e-9));
  return lo > 0 ? time : Interval::between(0, time.hi());
}

/// From now on, of disjoint bodies.
Certified CombinedOracle::State::within(const Vector3d& v_a, const Vector3d& v_b, double until) const {
  const Vector3d &first = swapped ? v_b : v_a, &second = swapped ? v_a : v_b;
  const Horizon horizon{0, until};
  if (exact) return exact->verdict(first, second, horizon) == Verdict::out ? Certified::out : Certified::in;
  if (around && around->verdict(first, second, horizon) == Verdict::out) return Certified::out;
  const Simpler& by = simpler();
  if (by.inside && by.inside->verdict(first, second, horizon) != Verdict::out) return Certified::in;
  if (!contacts().usable()) return Certified::undecided;
  for (const CombinedOracle& oracle : by.wider)
    if (oracle.state_->within(first, second, until) == Certified::out) return Certified::out;
  for (const CombinedOracle& oracle : by.narrower)
    if (oracle.state_->within(first, second, until) == Certified::in) return Certified::in;
  const IntervalVector3 w = direction(first, second);
  const double way = until / seconds_a_way(w, first - second), longest = contacts().extent();
  if (contacts().along(w, std::min(way * (1 + 1e-9), longest)).outcome == SearchOutcome::empty)
    return Certified::out;
  if (way > 0 && contacts().along(w, std::min(way * (1 - 1e-9), longest)).outcome == SearchOutcome::found)
    return Certified::in;
  return Certified::undecided;
}

Verdict CombinedOracle::verdict(const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon) const {
  const State& s = *state_;
  return verdict_within(s.relation, v_a, v_b, horizon, [&](const Stretch& stretch) {
    if (stretch.from > 0) {
      const ConeOracle outer(s.given_a.ellipsoid(), s.given_b.ellipsoid());
      if (outer.verdict(v_a, v_b, horizon) == Verdict::out) return Verdict::out;
    }
    if (s.relation != Relation::disjoint) return Verdict::undecided;
    const Certified ever = s.within(v_a, v_b, stretch.until);
    if (ever == Certified::out) return Verdict::out;
    if (stretch.from == 0) return ever == Certified::in ? Verdict::in : Verdict::undecided;
    // Of the rounded difference: no certainty is left within its rounding of either end.
    const auto time = time_to_contact(v_a - v_b);
    const bool inside =
        time && time->lo() * (1 - 1e-9) > stretch.from && time->hi() * (1 + 1e-9) < stretch.until;
    return inside ? Verdict::in : Verdict::undecided;
  });
}

}  // namespace vericone
