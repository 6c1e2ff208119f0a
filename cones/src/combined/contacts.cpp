// SPDX-License-Identifier: BSD-3-Clause
#include "combined/contacts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "combined/point_certificate.h"

namespace vericone {
namespace {

using Eigen::Vector3d;

/// A chord that needs more is better divided.
constexpr int kMostPairs = 20'000;
constexpr double kLeastWidth = 4e-3;

const SearchBox<3> kBox{Vector3d::Zero(), Vector3d::Constant(1.001)};
/// Of a point of A and the way to that of B.
SearchBox<4> both_box(double way) {
  return {Eigen::Vector4d(0, 0, 0, 0.5 * way), Eigen::Vector4d(1.001, 1.001, 1.001, 0.5 * way)};
}
/// With room for what boxes are widened by.
const Vector3d kRoom = Vector3d::Constant(1.002);

const IntervalVector3 kZero{Interval(0), Interval(0), Interval(0)};
const std::array<IntervalVector3, 3> kIdentity{IntervalVector3{Interval(1), Interval(0), Interval(0)},
                                               IntervalVector3{Interval(0), Interval(1), Interval(0)},
                                               IntervalVector3{Interval(0), Interval(0), Interval(1)}};
const IntervalMatrix3 kUnitMatrix = kIdentity;

IntervalVector3 operator-(const IntervalVector3& v) { return {-v[0], -v[1], -v[2]}; }
IntervalVector3 operator+(const IntervalVector3& x, const IntervalVector3& y) {
  return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
}
IntervalVector3 operator*(const IntervalVector3& x, const Interval& s) {
  return {x[0] * s, x[1] * s, x[2] * s};
}
IntervalVector3 exactly(const Vector3d& v) { return {Interval(v(0)), Interval(v(1)), Interval(v(2))}; }

/// Whether q, a quadratic form about a centre, is at most its level on the whole segment from x to y
/// (relative to that centre): a parabola's largest value is at an end or at its vertex.
bool segment_inside(const EnclosedQuadric& q, const IntervalVector3& x, const IntervalVector3& y) {
  const IntervalVector3 d = y + (-x);
  const IntervalVector3 md = q.matrix * d;
  const Interval alpha = dot(d, md), beta = dot(x, md) * 2, gamma = dot(x, q.matrix * x) - Interval(q.level);
  if (!gamma.negative() || !(alpha + beta + gamma).negative()) return false;
  if (alpha.positive()) return true;                                                       // convex
  if (gamma.hi() + std::max(beta.hi(), 0.0) + std::max(alpha.hi(), 0.0) < 0) return true;  // short
  // Concave: the vertex lies between the ends only if the slope changes sign there.
  if (beta.negative() || (alpha * 2 + beta).positive()) return true;
  return alpha.negative() && (gamma * alpha * 4 - square(beta)).positive();  // gamma - beta^2 / (4 alpha) < 0
}

/// Steps against what is violated most, until all inequalities hold with the margin.
template <int N>
bool descend(const std::vector<QuadraticConstraint<N>>& list, double margin, Eigen::Matrix<double, N, 1>& z,
             int most_steps = 30) {
  Eigen::Matrix<double, N, 1> x = z;
  for (int step = 0; step < most_steps; ++step) {
    double worst = 0;
    Eigen::Matrix<double, N, 1> gradient = Eigen::Matrix<double, N, 1>::Zero();
    for (const QuadraticConstraint<N>& q : list) {
      Eigen::Matrix<double, N, 1> own;
      const double value = q.evaluate(x, own) + q.slack + margin;
      if (value > worst) {
        worst = value;
        gradient = own;
      }
    }
    if (worst <= 0) {
      z = x;
      return true;
    }
    const double norm = gradient.squaredNorm();
    if (!(norm > 0)) return false;
    x -= (1.1 * worst / norm) * gradient;
  }
  return false;
}

}  // namespace

CombinedContacts::CombinedContacts(const CombinedEllipsoid& a, const CombinedEllipsoid& b, double tolerance)
    : frame_(a, b), ball_(a.is_ellipsoid()) {
  if (!frame_.usable()) return;
  for (const EnclosedQuadric& q : frame_.own_b())
    surfaces_b_.push_back(
        quadratic_constraint<3>(q.matrix, kIdentity, kZero, Interval(q.level), -q.least_eigenvalue, kRoom));
  for (const EnclosedQuadric& q : frame_.a())
    surfaces_a_.push_back(
        quadratic_constraint<3>(q.matrix, kIdentity, kZero, Interval(q.level), -q.least_eigenvalue, kRoom));
  for (const IntervalVector3& column : frame_.columns_b()) columns_square_ += dot(column, column).hi();
  if (!ball_) pairs_ = std::make_unique<PairSearch>(frame_);
  extent_ = (middle(frame_.center()).norm() + std::sqrt(columns_square_) + 1) * (1 + 1e-6);
  limits_.least_width = tolerance / std::max(1.0, std::sqrt(columns_square_));
}

template <int N>
SearchResult<N> CombinedContacts::search(QuadraticSearch<N>& searcher,
                                         const std::vector<QuadraticConstraint<N>>& list,
                                         const SearchBox<N>& box, const SearchLimits& most) const {
  SearchResult<N> r = searcher.run(list, box, most);
  boxes_ += static_cast<std::uint64_t>(r.boxes);
  return r;
}

/// The row of l.x = l.c + (G^T l).z.
IntervalVector3 CombinedContacts::in_own(const IntervalVector3& l) const {
  const auto& g = frame_.columns_b();
  return {dot(l, g[0]), dot(l, g[1]), dot(l, g[2])};
}

/// l.x + l0 <= 0.
void CombinedContacts::add_half_space(const IntervalVector3& l, const Interval& l0) const {
  const IntervalVector3 row = in_own(l);
  list3_.push_back(linear_constraint<3>({row[0], row[1], row[2]}, dot(l, frame_.center()) + l0, kRoom));
}

std::optional<Relation> CombinedContacts::relation() const {
  // A body may be so small that a search of the other would not come upon it: from its centre, in its own
  // coordinates.
  list3_ = surfaces_a_;
  for (const EnclosedQuadric& q : frame_.b())
    list3_.push_back(quadratic_constraint<3>(q.matrix, kIdentity, -frame_.center(), Interval(q.level),
                                             -q.least_eigenvalue, kRoom));
  Vector3d x = Vector3d::Zero();
  if (descend<3>(list3_, 0, x) && x.cwiseAbs().maxCoeff() <= 1) return Relation::overlapping;
  list3_ = surfaces_b_;
  for (const EnclosedQuadric& q : frame_.a())
    list3_.push_back(quadratic_constraint<3>(q.matrix, frame_.columns_b(), frame_.center(), Interval(q.level),
                                             -q.least_eigenvalue * columns_square_, kRoom));
  // Asked once: as fine as rounding lets it be, whatever the tolerance.
  switch (search(search3_, list3_, kBox, {1e-10, limits_.boxes}).outcome) {
    case SearchOutcome::empty:
      return Relation::disjoint;
    case SearchOutcome::found:
      return Relation::overlapping;
    case SearchOutcome::undecided:
      break;
  }
  return std::nullopt;
}

/// Room that `defect` takes: |x| <= extent_ in all that follows.
double CombinedContacts::ball_slack() const { return 5 * frame_.defect() * (extent_ * extent_ + 1); }

CombinedContact CombinedContacts::along(const IntervalVector3& w, double longest) const {
  return ball_ ? of_ball(w, longest) : of_both(w, longest);
}

/// The inequalities of a contact along w where A is the unit ball, into the list.
void CombinedContacts::ball_inequalities(const IntervalVector3& w) const {
  list3_ = surfaces_b_;
  // |w x (c + G z)|^2 <= |w|^2: in the shadow.
  const auto& g = frame_.columns_b();
  list3_.push_back(quadratic_constraint<3>(kUnitMatrix, {cross(w, g[0]), cross(w, g[1]), cross(w, g[2])},
                                           cross(w, frame_.center()), dot(w, w), 0, kRoom));
  list3_.back().slack += ball_slack();
  // Disjoint bodies meet at points beyond the middle of A only.
  add_half_space(-w, Interval(0));
  list3_.back().slack += 4 * frame_.defect() * extent_;
}

CombinedContact CombinedContacts::beside(const IntervalVector3& w, const CombinedContact& near) const {
  CombinedContact found = near;
  if (ball_) {
    ball_inequalities(w);
    found.outcome = decide_from<3>(list3_, kBox, found.on_b);
    return found;
  }
  const double way = 1.01 * extent_;
  contact_inequalities(w, way);
  Eigen::Vector4d z;
  z << near.on_a, near.way;
  found.outcome = decide_from<4>(list4_, both_box(way), z);
  found.on_a = z.head<3>();
  found.way = z(3);
  return found;
}

CombinedContact CombinedContacts::of_ball(const IntervalVector3& w, double longest) const {
  ball_inequalities(w);
  const Interval w2 = dot(w, w);
  const auto& g = frame_.columns_b();
  const bool bounded = longest < extent_;
  if (bounded) {
    add_half_space(w, -(Interval(longest) * w2));
    list3_.back().slack += 4 * frame_.defect() * extent_;
  }
  SearchResult<3> r = search(search3_, list3_, kBox, limits_);
  if (bounded && r.outcome != SearchOutcome::found) {
    // What the ball at the end of the way reaches beyond its middle.
    list3_ = surfaces_b_;
    list3_.push_back(quadratic_constraint<3>(kUnitMatrix, g, frame_.center() + (-(w * Interval(longest))),
                                             Interval(1), 0, kRoom));
    list3_.back().slack += ball_slack();
    const SearchResult<3> end = search(search3_, list3_, kBox, limits_);
    if (end.outcome != SearchOutcome::empty) r = end;
  }
  return {r.outcome, r.point, Vector3d::Zero(), 0};
}

/// The points of both bodies: the first three unknowns are that of A, L z + k is that of B about its
/// centre.
template <int N>
void CombinedContacts::add_bodies(const std::array<IntervalVector3, N>& to_y, const IntervalVector3& k,
                                  double squares, const Eigen::Matrix<double, N, 1>& room,
                                  std::vector<QuadraticConstraint<N>>& list) const {
  std::array<IntervalVector3, N> to_a;
  to_a.fill(kZero);
  std::copy(kIdentity.begin(), kIdentity.end(), to_a.begin());
  list.clear();
  for (const EnclosedQuadric& q : frame_.b())
    list.push_back(
        quadratic_constraint<N>(q.matrix, to_y, k, Interval(q.level), -q.least_eigenvalue * squares, room));
  for (const EnclosedQuadric& q : frame_.a())
    list.push_back(
        quadratic_constraint<N>(q.matrix, to_a, kZero, Interval(q.level), -q.least_eigenvalue, room));
}

/// The inequalities of a contact along w for both bodies, into the list; ways up to `way`.
void CombinedContacts::contact_inequalities(const IntervalVector3& w, double way) const {
  const Eigen::Vector4d room = Eigen::Vector4d(1.01, 1.01, 1.01, way) * 1.0001;
  add_bodies<4>({kIdentity[0], kIdentity[1], kIdentity[2], w}, -frame_.center(), 1 + dot(w, w).hi(), room,
                list4_);
  const Interval zero(0);
  list4_.push_back(linear_constraint<4>({zero, zero, zero, Interval(-1)}, zero, room));
}

CombinedContact CombinedContacts::of_both(const IntervalVector3& w, double longest) const {
  const double way = std::min(longest, 1.01 * extent_);
  contact_inequalities(w, way);
  const SearchResult<4> r = search(search4_, list4_, both_box(way), limits_);
  return {r.outcome, Vector3d::Zero(), r.point.head<3>(), r.point(3)};
}

/// A contact along w near another one, moved inwards as far as a few steps find: it then carries over to
/// more directions. Not a proof; `joined` checks.
CombinedContact CombinedContacts::deepened(const IntervalVector3& w, const CombinedContact& near) const {
  contact_inequalities(w, 1.01 * extent_);
  Eigen::Vector4d z;
  z << near.on_a, near.way;
  CombinedContact best = near;
  best.outcome = SearchOutcome::undecided;
  if (decide_from<4>(list4_, both_box(1.01 * extent_), z) == SearchOutcome::found)
    best = {SearchOutcome::found, Vector3d::Zero(), z.head<3>(), z(3)};
  for (double margin = 1e-6; margin < 1; margin *= 4) {
    // The first contact is the hardest to find: near corners the steps go to and fro.
    if (!descend<4>(list4_, margin, z, best.outcome == SearchOutcome::found ? 12 : 200)) break;
    best = {SearchOutcome::found, Vector3d::Zero(), z.head<3>(), z(3)};
  }
  return best;
}

/// A chord that needs more is better divided.
SearchLimits CombinedContacts::chord_limits() const { return {limits_.least_width, 1000}; }

SearchOutcome CombinedContacts::ball_between(const IntervalVector3& from, const IntervalVector3& to) const {
  const IntervalVector3 n = cross(from, to);
  const IntervalVector3& c = frame_.center();
  const auto& g = frame_.columns_b();
  const Interval radius(1 + frame_.defect());
  list3_ = surfaces_b_;
  // Distance from the sweep of the ball's middle, a sector of the plane with normal n: across the plane,
  // and beyond its first or last ray along the plane.
  const auto unit = [](const IntervalVector3& v) { return v * (Interval(1) / norm(v)); };
  const IntervalVector3 across = unit(n);
  std::array<IntervalVector3, 3> rows;
  for (int j = 0; j < 3; ++j) rows[j] = {dot(across, g[j]), Interval(0), Interval(0)};
  for (const IntervalVector3& side : {unit(cross(n, from)), unit(cross(to, n))}) {
    list3_.push_back(quadratic_constraint<3>(kUnitMatrix, rows, {dot(across, c), Interval(0), Interval(0)},
                                             square(radius), 0, kRoom));
    add_side(list3_.back(), in_own(side), dot(side, c), kRoom);
  }
  // A point of the sweep outside of A itself projects on the ray it belongs to beyond the middle of A, so
  // along the bisector m it is farther than -|m| sin(half the angle).
  const IntervalVector3 m =
      unit(from * Interval(1 / middle(from).norm()) + to * Interval(1 / middle(to).norm()));
  const Interval sine = hull(norm(cross(from, m)) / norm(from), norm(cross(to, m)) / norm(to));
  add_half_space(-m, -(sine * radius));
  return search(search3_, list3_, kBox, chord_limits()).outcome;
}

bool CombinedContacts::none_between(const IntervalVector3& from, const IntervalVector3& to) const {
  if (!(middle(cross(from, to)).norm() > 1e-9)) return false;
  if (!ball_) return pairs_->none_between(from, to, kMostPairs, kLeastWidth);
  return ball_between(from, to) == SearchOutcome::empty;
}

/// Whether one point of B is met along all directions between two: those along which the ball meets it are
/// a convex cone.
bool CombinedContacts::ball_meets(const CombinedContact& found, const IntervalVector3& from,
                                  const IntervalVector3& to) const {
  const auto& g = frame_.columns_b();
  IntervalVector3 x = frame_.center();
  for (int j = 0; j < 3; ++j) x = x + g[j] * Interval(found.on_b(j));
  const Interval radius(1 - frame_.defect());
  for (const IntervalVector3* w : {&from, &to}) {
    const IntervalVector3 k = cross(*w, x);
    if (!(dot(k, k) - dot(*w, *w) * square(radius)).negative() || !dot(*w, x).positive()) return false;
  }
  return true;
}

bool CombinedContacts::ball_meets_all(const IntervalVector3& from, const IntervalVector3& to,
                                      int depth) const {
  const IntervalVector3 half = (from + to) * Interval(0.5);
  CombinedContact found = of_ball(half, 1e300);
  if (found.outcome != SearchOutcome::found) return false;
  // Well inside, a point is met along more directions.
  for (double margin = 1e-6; margin < 1 && descend<3>(list3_, margin, found.on_b); margin *= 2) {
  }
  if (ball_meets(found, from, to)) return true;
  if (depth == 0) return false;
  return (ball_meets(found, from, half) || ball_meets_all(from, half, depth - 1)) &&
         (ball_meets(found, half, to) || ball_meets_all(half, to, depth - 1));
}

/// Contacts along two directions give one along every direction between them when the segments between
/// their points lie in the bodies: the differences of matching points sweep all of them.
bool CombinedContacts::joined(const IntervalVector3& from, const CombinedContact& first,
                              const IntervalVector3& to, const CombinedContact& last) const {
  const IntervalVector3 a1 = exactly(first.on_a), a2 = exactly(last.on_a), minus_c = -frame_.center();
  const IntervalVector3 b1 = a1 + from * Interval(first.way) + minus_c,
                        b2 = a2 + to * Interval(last.way) + minus_c;
  const auto all_inside = [](const std::vector<EnclosedQuadric>& body, const IntervalVector3& x,
                             const IntervalVector3& y) {
    return std::all_of(body.begin(), body.end(),
                       [&](const EnclosedQuadric& q) { return segment_inside(q, x, y); });
  };
  return first.way > 0 && last.way > 0 && all_inside(frame_.a(), a1, a2) && all_inside(frame_.b(), b1, b2);
}

bool CombinedContacts::both_meet_all(const IntervalVector3& from, const CombinedContact& first,
                                     const IntervalVector3& to, const CombinedContact& last,
                                     const CombinedContact* between, bool search, int depth) const {
  if (joined(from, first, to, last)) return true;
  if (depth == 0) return false;
  const IntervalVector3 half = (from + to) * Interval(0.5);
  // Where other parts of the bodies meet along the one than along the other, there is a direction along which
  // both do, or others do between them.
  if (between) {
    const CombinedContact middle = deepened(half, *between);
    if (middle.outcome == SearchOutcome::found &&
        both_meet_all(from, first, half, middle, nullptr, search, depth - 1) &&
        both_meet_all(half, middle, to, last, nullptr, search, depth - 1))
      return true;
  }
  CombinedContact before = deepened(half, first), after = deepened(half, last);
  const bool of_first = before.outcome == SearchOutcome::found,
             of_last = after.outcome == SearchOutcome::found;
  if (!of_first && !of_last) {
    if (search) before = after = deep_contact(half, {}, true);
    if (before.outcome != SearchOutcome::found) return false;
  } else if (!of_first || !of_last) {
    (of_first ? after : before) = of_first ? before : after;
  }
  return both_meet_all(from, first, half, before, nullptr, search, depth - 1) &&
         both_meet_all(half, after, to, last, nullptr, search, depth - 1);
}

/// Deep inside, from a contact nearby; searched for where there is none and it may be.
CombinedContact CombinedContacts::deep_contact(const IntervalVector3& w, const CombinedContact& near,
                                               bool search) const {
  if (near.outcome == SearchOutcome::found) {
    const CombinedContact deeper = deepened(w, near);
    if (deeper.outcome == SearchOutcome::found || !search) return deeper;
  }
  const CombinedContact found = of_both(w, 1e300);
  if (found.outcome != SearchOutcome::found) return found;
  const CombinedContact deeper = deepened(w, found);
  return deeper.outcome == SearchOutcome::found ? deeper : found;
}

bool CombinedContacts::all_between(const IntervalVector3& from, const IntervalVector3& to,
                                   const CombinedContact* at_from, const CombinedContact* at_to,
                                   const CombinedContact* between) const {
  if (ball_) return ball_meets_all(from, to, 5);
  const bool search = !at_from || !at_to;
  const CombinedContact first = deep_contact(from, at_from ? *at_from : CombinedContact{}, search);
  if (first.outcome != SearchOutcome::found) return false;
  const CombinedContact last = deep_contact(to, at_to ? *at_to : first, search);
  if (last.outcome != SearchOutcome::found) return false;
  return both_meet_all(from, first, to, last, between, search, 5);
}

bool CombinedContacts::none_beyond(const Vector3d& along, const CombinedContact& farthest) const {
  const IntervalVector3 n = frame_.covector(along);
  // n.(c + b - a) for a point of each; what it is short of 0 is shared between the two.
  const IntervalVector3 own = in_own(n);
  const Vector3d of_a = middle(n), of_b = middle(own);
  const double at_a = of_a.dot(farthest.on_a), at_b = of_b.dot(farthest.on_b);
  const Interval c = dot(n, frame_.center());
  const double room = at_a - at_b - c.mid();
  if (!(room > 0)) return false;
  const double least_a = at_a - 0.5 * room, most_b = at_b + 0.49 * room;
  if (!(c + Interval(most_b) - Interval(least_a)).negative()) return false;
  // No point of A has n.a <= least_a, none of B n.b >= most_b.
  list3_ = surfaces_a_;
  list3_.push_back(linear_constraint<3>({n[0], n[1], n[2]}, Interval(-least_a), kRoom));
  Vector3d on_a = farthest.on_a;
  if (decide_from<3>(list3_, kBox, on_a) != SearchOutcome::empty) return false;
  list3_ = surfaces_b_;
  list3_.push_back(linear_constraint<3>({-own[0], -own[1], -own[2]}, Interval(most_b), kRoom));
  Vector3d on_b = farthest.on_b;
  return decide_from<3>(list3_, kBox, on_b) == SearchOutcome::empty;
}

}  // namespace vericone
