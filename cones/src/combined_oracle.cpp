// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/combined_cone.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <cmath>

#include "combined_frame.h"

namespace vericone {
namespace {

using Eigen::Vector3d;

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

Interval norm(const IntervalVector3& v) { return sqrt(square(v[0]) + square(v[1]) + square(v[2])); }

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

}  // namespace

const char* to_string(Certified answer) {
  switch (answer) {
    case Certified::in:
      return "in";
    case Certified::out:
      return "out";
    case Certified::undecided:
      return "undecided";
  }
  return "";
}

/// Contacts of a and b, where a is an ellipsoid whenever one of the two is: then the points x of B in the
/// frame where A is the unit ball are searched (three unknowns); otherwise a point of A and the way along the
/// direction, four unknowns for one direction and five for all between two.
struct CombinedOracle::State {
  CombinedEllipsoid given_a, given_b;
  bool swapped;
  CombinedEllipsoid a, b;
  CombinedFrame frame;
  SearchLimits limits;
  std::optional<ConeOracle> exact;   // two ellipsoids
  std::optional<ConeOracle> around;  // ellipsoids that contain the bodies
  std::optional<ConeOracle> inside;  // ellipsoids inside the bodies
  std::optional<Relation> relation;
  // Where neither body is an ellipsoid: one of them replaced by its ellipsoid (what misses that misses the
  // body) or by one inside of it (what meets that meets the body). Three unknowns each; tried first.
  std::vector<CombinedOracle> wider, narrower;
  std::vector<QuadraticConstraint<3>> surfaces_b;  // of z, B's own coordinates
  double extent = 0;                               // |x| is at most this
  double columns_square = 0;                       // squared columns of G, summed
  mutable std::uint64_t boxes = 0;

  // Scratch memory; an oracle is used by one thread at a time.
  mutable QuadraticSearch<3> search3;
  mutable QuadraticSearch<4> search4;
  mutable QuadraticSearch<5> search5;
  mutable std::vector<QuadraticConstraint<3>> list3;
  mutable std::vector<QuadraticConstraint<4>> list4;
  mutable std::vector<QuadraticConstraint<5>> list5;

  State(const CombinedEllipsoid& first, const CombinedEllipsoid& second, double tolerance)
      : given_a(first),
        given_b(second),
        swapped(!first.is_ellipsoid() && second.is_ellipsoid()),
        a(swapped ? second : first),
        b(swapped ? first : second),
        frame(a, b) {
    if (a.is_ellipsoid() && b.is_ellipsoid()) {
      exact.emplace(a.ellipsoid(), b.ellipsoid());
      relation = exact->relation();
    }
    if (!frame.usable()) return;
    for (const EnclosedQuadric& q : frame.own_b())
      surfaces_b.push_back(
          quadratic_constraint<3>(q.matrix, kIdentity, kZero, Interval(q.level), -q.least_eigenvalue, kRoom));
    for (const IntervalVector3& column : frame.columns_b()) columns_square += dot(column, column).hi();
    extent = (middle(frame.center()).norm() + std::sqrt(columns_square) + 1) * (1 + 1e-6);
    limits.least_width = tolerance / std::max(1.0, std::sqrt(columns_square));
    if (exact) return;
    const bool apart = vericone::relation<3>(a.ellipsoid(), b.ellipsoid()) == Relation::disjoint;
    relation = apart ? Relation::disjoint : search_relation();
    if (relation != Relation::disjoint) return;
    ConeOracle outer(a.bounding_ellipsoid(), b.bounding_ellipsoid());
    if (outer.relation() == Relation::disjoint) around.emplace(std::move(outer));
    const auto in_a = a.is_ellipsoid() ? std::optional(a.ellipsoid()) : a.inscribed_ellipsoid();
    const auto in_b = b.inscribed_ellipsoid();
    if (in_a && in_b) {
      ConeOracle inner(*in_a, *in_b);
      if (inner.relation() == Relation::disjoint) inside.emplace(std::move(inner));
    }
    if (a.is_ellipsoid()) return;
    const auto add = [&](std::vector<CombinedOracle>& list, const CombinedEllipsoid& p,
                         const CombinedEllipsoid& q) {
      CombinedOracle oracle(p, q, tolerance);
      if (oracle.relation() == Relation::disjoint) list.push_back(std::move(oracle));
    };
    add(wider, a.ellipsoid(), b);
    add(wider, a, b.ellipsoid());
    if (in_a) add(narrower, *in_a, b);
    if (in_b) add(narrower, a, *in_b);
  }

  template <int N>
  SearchResult<N> search(QuadraticSearch<N>& searcher, const std::vector<QuadraticConstraint<N>>& list,
                         const SearchBox<N>& box, const SearchLimits& most) const {
    SearchResult<N> r = searcher.run(list, box, most);
    boxes += static_cast<std::uint64_t>(r.boxes);
    return r;
  }

  static inline const SearchBox<3> kBox{Vector3d::Zero(), Vector3d::Constant(1.001)};
  /// With room for what boxes are widened by.
  static inline const Vector3d kRoom = Vector3d::Constant(1.002);

  /// The row of l.x = l.c + (G^T l).z.
  IntervalVector3 in_own(const IntervalVector3& l) const {
    const auto& g = frame.columns_b();
    return {dot(l, g[0]), dot(l, g[1]), dot(l, g[2])};
  }
  /// l.x + l0 <= 0.
  void add_half_space(const IntervalVector3& l, const Interval& l0) const {
    const IntervalVector3 row = in_own(l);
    list3.push_back(linear_constraint<3>({row[0], row[1], row[2]}, dot(l, frame.center()) + l0, kRoom));
  }
  IntervalVector3 position(const Vector3d& z) const {
    const auto& g = frame.columns_b();
    return frame.center() + g[0] * Interval(z(0)) + g[1] * Interval(z(1)) + g[2] * Interval(z(2));
  }

  std::optional<Relation> search_relation() const {
    list3 = surfaces_b;
    for (const EnclosedQuadric& q : frame.a())
      list3.push_back(quadratic_constraint<3>(q.matrix, frame.columns_b(), frame.center(), Interval(q.level),
                                              -q.least_eigenvalue * columns_square, kRoom));
    switch (search(search3, list3, kBox, limits).outcome) {
      case SearchOutcome::empty:
        return Relation::disjoint;
      case SearchOutcome::found:
        return Relation::overlapping;
      case SearchOutcome::undecided:
        break;
    }
    return std::nullopt;
  }

  /// A contact along a direction w.
  struct Contact {
    SearchOutcome outcome = SearchOutcome::undecided;
    Vector3d on_b = Vector3d::Zero();  // A an ellipsoid: the point of B, in B's own coordinates
    Vector3d on_a = Vector3d::Zero();  // otherwise: the point of A, in the frame,
    double way = 0;                    // and way w from there to that of B
  };

  // Room that `defect` takes: |x| <= extent in all that follows.
  double ball_slack() const { return 5 * frame.defect() * (extent * extent + 1); }

  /// Contacts along w (of the frame, about unit length) within the ways [0, longest].
  Contact contact(const IntervalVector3& w, double longest) const {
    return a.is_ellipsoid() ? contact_of_ball(w, longest) : contact_of_both(w, longest);
  }

  Contact contact_of_ball(const IntervalVector3& w, double longest) const {
    list3 = surfaces_b;
    // |w x (c + G z)|^2 <= |w|^2: in the shadow.
    const Interval w2 = dot(w, w);
    const auto& g = frame.columns_b();
    list3.push_back(quadratic_constraint<3>(kUnitMatrix, {cross(w, g[0]), cross(w, g[1]), cross(w, g[2])},
                                            cross(w, frame.center()), w2, 0, kRoom));
    list3.back().slack += ball_slack();
    // Disjoint bodies meet at points beyond the middle of A only.
    add_half_space(-w, Interval(0));
    list3.back().slack += 4 * frame.defect() * extent;
    const bool bounded = longest < extent;
    if (bounded) {
      add_half_space(w, -(Interval(longest) * w2));
      list3.back().slack += 4 * frame.defect() * extent;
    }
    SearchResult<3> r = search(search3, list3, kBox, limits);
    if (bounded && r.outcome != SearchOutcome::found) {
      // What the ball at the end of the way reaches beyond its middle.
      list3 = surfaces_b;
      list3.push_back(quadratic_constraint<3>(kUnitMatrix, g, frame.center() + (-(w * Interval(longest))),
                                              Interval(1), 0, kRoom));
      list3.back().slack += ball_slack();
      const SearchResult<3> end = search(search3, list3, kBox, limits);
      if (end.outcome != SearchOutcome::empty) r = end;
    }
    return {r.outcome, r.point, Vector3d::Zero(), 0};
  }

  /// The points of both bodies: the first three unknowns are that of A, L z + k is that of B about its
  /// centre.
  template <int N>
  void add_bodies(const std::array<IntervalVector3, N>& to_y, const IntervalVector3& k, double squares,
                  const Eigen::Matrix<double, N, 1>& room, std::vector<QuadraticConstraint<N>>& list) const {
    std::array<IntervalVector3, N> to_a;
    to_a.fill(kZero);
    std::copy(kIdentity.begin(), kIdentity.end(), to_a.begin());
    list.clear();
    for (const EnclosedQuadric& q : frame.b())
      list.push_back(
          quadratic_constraint<N>(q.matrix, to_y, k, Interval(q.level), -q.least_eigenvalue * squares, room));
    for (const EnclosedQuadric& q : frame.a())
      list.push_back(
          quadratic_constraint<N>(q.matrix, to_a, kZero, Interval(q.level), -q.least_eigenvalue, room));
  }

  static Eigen::Vector4d way_room(double way) { return Eigen::Vector4d(1.01, 1.01, 1.01, way); }

  /// The inequalities of a contact along w for both bodies, into list4; ways up to `way`.
  void contact_inequalities(const IntervalVector3& w, double way) const {
    const Eigen::Vector4d room = way_room(way) * 1.0001;
    add_bodies<4>({kIdentity[0], kIdentity[1], kIdentity[2], w}, -frame.center(), 1 + dot(w, w).hi(), room,
                  list4);
    const Interval zero(0);
    list4.push_back(linear_constraint<4>({zero, zero, zero, Interval(-1)}, zero, room));
  }

  Contact contact_of_both(const IntervalVector3& w, double longest) const {
    const double way = std::min(longest, 1.01 * extent);
    contact_inequalities(w, way);
    const SearchBox<4> box{Eigen::Vector4d(0, 0, 0, 0.5 * way),
                           Eigen::Vector4d(1.001, 1.001, 1.001, 0.5 * way)};
    const SearchResult<4> r = search(search4, list4, box, limits);
    return {r.outcome, Vector3d::Zero(), r.point.head<3>(), r.point(3)};
  }

  /// A contact along w near another one, moved inwards as far as a few steps find: it then carries over to
  /// more directions. Not a proof; `carries` checks.
  Contact deepened(const IntervalVector3& w, const Contact& near) const {
    contact_inequalities(w, 1.01 * extent);
    Eigen::Vector4d z;
    z << near.on_a, near.way;
    Contact best = near;
    best.outcome = SearchOutcome::undecided;
    for (double margin = 1e-6; margin < 1; margin *= 2) {
      if (!descend<4>(list4, margin, z)) break;
      best = {SearchOutcome::found, Vector3d::Zero(), z.head<3>(), z(3)};
    }
    return best;
  }

  /// Steps against what is violated most, until all inequalities hold with the margin.
  template <int N>
  static bool descend(const std::vector<QuadraticConstraint<N>>& list, double margin,
                      Eigen::Matrix<double, N, 1>& z) {
    Eigen::Matrix<double, N, 1> x = z;
    for (int step = 0; step < 30; ++step) {
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

  /// Whether no direction between two meets B; from, to of about unit length, less than a right angle apart.
  SearchOutcome contacts_between(const IntervalVector3& from, const IntervalVector3& to) const {
    const IntervalVector3 n = cross(from, to);
    const Vector3d normal = middle(n);
    if (!(normal.norm() > 1e-9)) return SearchOutcome::undecided;
    if (!a.is_ellipsoid()) return contacts_between_both(from, to);
    const IntervalVector3& c = frame.center();
    const auto& g = frame.columns_b();
    const Interval radius(1 + frame.defect());
    list3 = surfaces_b;
    // Distance from the sweep of the ball's middle, a sector of the plane with normal n: across the plane,
    // and beyond its first or last ray along the plane.
    const auto unit = [](const IntervalVector3& v) { return v * (Interval(1) / norm(v)); };
    const IntervalVector3 across = unit(n);
    std::array<IntervalVector3, 3> rows;
    for (int j = 0; j < 3; ++j) rows[j] = {dot(across, g[j]), Interval(0), Interval(0)};
    for (const IntervalVector3& side : {unit(cross(n, from)), unit(cross(to, n))}) {
      list3.push_back(quadratic_constraint<3>(kUnitMatrix, rows, {dot(across, c), Interval(0), Interval(0)},
                                              square(radius), 0, kRoom));
      add_side(list3.back(), in_own(side), dot(side, c), kRoom);
    }
    // A point of the sweep outside of A itself projects on the ray it belongs to beyond the middle of A, so
    // along the bisector m it is farther than -|m| sin(half the angle).
    const IntervalVector3 m =
        unit(from * Interval(1 / middle(from).norm()) + to * Interval(1 / middle(to).norm()));
    const Interval sine = hull(norm(cross(from, m)) / norm(from), norm(cross(to, m)) / norm(to));
    add_half_space(-m, -(sine * radius));
    return search(search3, list3, kBox, chord_limits()).outcome;
  }

  /// A chord that needs more is better divided.
  SearchLimits chord_limits() const { return {limits.least_width, 1000}; }

  /// Unknowns: the point a of A and two coordinates of that of B; the third makes b - a lie in the plane of
  /// the directions.
  SearchOutcome contacts_between_both(const IntervalVector3& from, const IntervalVector3& to) const {
    const IntervalVector3 n = cross(from, to);
    const Vector3d axis = middle(n).normalized(), u = middle(from).normalized(),
                   v = axis.cross(u).normalized();
    const IntervalVector3 &c = frame.center(), across = n * (Interval(1) / dot(n, exactly(axis)));
    // y = p u + q v + axis (across.(a - c - p u - q v)), relative to the centre of B.
    std::array<IntervalVector3, 5> to_y;
    double square_sum = 0;
    for (int j = 0; j < 3; ++j) to_y[j] = exactly(axis) * across[j];
    to_y[3] = exactly(u) + (-(exactly(axis) * dot(across, exactly(u))));
    to_y[4] = exactly(v) + (-(exactly(axis) * dot(across, exactly(v))));
    const IntervalVector3 k = -(exactly(axis) * dot(across, c));
    for (const IntervalVector3& column : to_y) square_sum += dot(column, column).hi();

    using Vector5 = Eigen::Matrix<double, 5, 1>;
    Vector5 room;
    room << 1.001, 1.001, 1.001, frame.reach_b(u), frame.reach_b(v);
    const SearchBox<5> box{Vector5::Zero(), room};
    room *= 1.0001;
    add_bodies<5>(to_y, k, square_sum, room, list5);
    // Between the two rays: l.(b - a) >= 0 for both sides, b - a = c + y - a.
    for (const IntervalVector3& l : {cross(across, from), cross(to, across)}) {
      std::array<Interval, 5> row;
      for (int j = 0; j < 5; ++j) row[j] = -dot(l, to_y[j]);
      for (int j = 0; j < 3; ++j) row[j] = row[j] + l[j];
      list5.push_back(linear_constraint<5>(row, -dot(l, c + k), room));
    }
    return search(search5, list5, box, chord_limits()).outcome;
  }

  /// Whether one point of B is met along all directions between two: those along which the ball meets it are
  /// a convex cone.
  bool ball_meets(const Contact& found, const IntervalVector3& from, const IntervalVector3& to) const {
    const IntervalVector3 x = position(found.on_b);
    const Interval radius(1 - frame.defect());
    for (const IntervalVector3* w : {&from, &to}) {
      const IntervalVector3 k = cross(*w, x);
      if (!(dot(k, k) - dot(*w, *w) * square(radius)).negative() || !dot(*w, x).positive()) return false;
    }
    return true;
  }

  bool ball_meets_all(const IntervalVector3& from, const IntervalVector3& to, int depth) const {
    const IntervalVector3 half = (from + to) * Interval(0.5);
    Contact found = contact_of_ball(half, 1e300);
    if (found.outcome != SearchOutcome::found) return false;
    // Well inside, a point is met along more directions.
    for (double margin = 1e-6; margin < 1 && descend<3>(list3, margin, found.on_b); margin *= 2) {
    }
    if (ball_meets(found, from, to)) return true;
    if (depth == 0) return false;
    return (ball_meets(found, from, half) || ball_meets_all(from, half, depth - 1)) &&
           (ball_meets(found, half, to) || ball_meets_all(half, to, depth - 1));
  }

  /// Contacts along two directions give one along every direction between them when the segments between
  /// their points lie in the bodies: the differences of matching points sweep all of them.
  bool joined(const IntervalVector3& from, const Contact& first, const IntervalVector3& to,
              const Contact& last) const {
    const IntervalVector3 a1 = exactly(first.on_a), a2 = exactly(last.on_a), minus_c = -frame.center();
    const IntervalVector3 b1 = a1 + from * Interval(first.way) + minus_c,
                          b2 = a2 + to * Interval(last.way) + minus_c;
    const auto all_inside = [](const std::vector<EnclosedQuadric>& body, const IntervalVector3& x,
                               const IntervalVector3& y) {
      return std::all_of(body.begin(), body.end(),
                         [&](const EnclosedQuadric& q) { return segment_inside(q, x, y); });
    };
    return first.way > 0 && last.way > 0 && all_inside(frame.a(), a1, a2) && all_inside(frame.b(), b1, b2);
  }

  bool both_meet_all(const IntervalVector3& from, const Contact& first, const IntervalVector3& to,
                     const Contact& last, int depth) const {
    if (joined(from, first, to, last)) return true;
    if (depth == 0) return false;
    const IntervalVector3 half = (from + to) * Interval(0.5);
    Contact between = deepened(half, first);
    if (between.outcome != SearchOutcome::found) between = deepened(half, last);
    if (between.outcome != SearchOutcome::found) {
      between = contact_of_both(half, 1e300);
      if (between.outcome != SearchOutcome::found) return false;
      const Contact deeper = deepened(half, between);
      if (deeper.outcome == SearchOutcome::found) between = deeper;
    }
    return both_meet_all(from, first, half, between, depth - 1) &&
           both_meet_all(half, between, to, last, depth - 1);
  }

  bool meets_all(const IntervalVector3& from, const IntervalVector3& to) const {
    if (a.is_ellipsoid()) return ball_meets_all(from, to, 5);
    Contact first = contact_of_both(from, 1e300);
    if (first.outcome != SearchOutcome::found) return false;
    Contact deeper = deepened(from, first);
    if (deeper.outcome == SearchOutcome::found) first = deeper;
    Contact last = deepened(to, first);
    if (last.outcome != SearchOutcome::found) {
      last = contact_of_both(to, 1e300);
      if (last.outcome != SearchOutcome::found) return false;
      deeper = deepened(to, last);
      if (deeper.outcome == SearchOutcome::found) last = deeper;
    }
    return both_meet_all(from, first, to, last, 5);
  }

  std::uint64_t all_boxes() const {
    std::uint64_t sum = boxes;
    for (const auto* list : {&wider, &narrower})
      for (const CombinedOracle& oracle : *list) sum += oracle.boxes_searched();
    return sum;
  }

  IntervalVector3 direction(const Vector3d& w) const { return frame.direction(swapped ? Vector3d(-w) : w); }
};

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
std::uint64_t CombinedOracle::boxes_searched() const { return state_->all_boxes(); }
std::optional<Relation> CombinedOracle::relation() const { return state_->relation; }

Certified CombinedOracle::membership(const Vector3d& w) const {
  const State& s = *state_;
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(w(i)))
      throw InputError("relative_velocity[" + std::to_string(i) + "]", to_text(w(i)),
                       "a finite number (m/s)");
  if (w.isZero(0)) return Certified::out;
  if (s.relation != Relation::disjoint) return Certified::undecided;
  const Vector3d own = s.swapped ? Vector3d(-w) : w;
  if (s.exact) return s.exact->membership(own) == Membership::out ? Certified::out : Certified::in;
  if (s.around && s.around->membership(own) == Membership::out) return Certified::out;
  if (s.inside && s.inside->membership(own) != Membership::out) return Certified::in;
  if (!s.frame.usable()) return Certified::undecided;
  for (const CombinedOracle& oracle : s.wider)
    if (oracle.membership(own) == Certified::out) return Certified::out;
  for (const CombinedOracle& oracle : s.narrower)
    if (oracle.membership(own) == Certified::in) return Certified::in;
  switch (s.contact(s.frame.direction(own), 1e300).outcome) {
    case SearchOutcome::empty:
      return Certified::out;
    case SearchOutcome::found:
      return Certified::in;
    case SearchOutcome::undecided:
      break;
  }
  return Certified::undecided;
}

bool CombinedOracle::all_in(const Vector3d& from, const Vector3d& to) const {
  const State& s = *state_;
  if (s.relation != Relation::disjoint || !s.frame.usable()) return false;
  const auto of_inside = [&](const Vector3d& w) {
    return s.inside->membership(s.swapped ? Vector3d(-w) : w) != Membership::out;
  };
  if (s.inside && of_inside(from) && of_inside(to)) return true;  // the cone of convex bodies is convex
  for (const CombinedOracle& oracle : s.narrower)
    if (oracle.all_in(from, to)) return true;
  const IntervalVector3 first = s.direction(from), last = s.direction(to);
  return dot(first, last).positive() && s.meets_all(first, last);
}

bool CombinedOracle::all_out(const Vector3d& from, const Vector3d& to) const {
  const State& s = *state_;
  if (s.relation != Relation::disjoint || !s.frame.usable()) return false;
  for (const CombinedOracle& oracle : s.wider)
    if (oracle.all_out(from, to)) return true;
  if (membership(from.normalized() + to.normalized()) != Certified::out) return false;
  const IntervalVector3 first = s.direction(from), last = s.direction(to);
  return dot(first, last).positive() && s.contacts_between(first, last) == SearchOutcome::empty;
}

std::optional<Interval> CombinedOracle::time_to_contact(const Vector3d& w, double width) const {
  const State& s = *state_;
  if (s.relation == Relation::overlapping) return Interval(0);
  if (!s.frame.usable() || membership(w) != Certified::in) return std::nullopt;
  const IntervalVector3 direction = s.direction(w);
  // Ways in the frame, in units of the direction's length; monotone: a contact by one way is one by any
  // longer.
  double lo = 0, hi = s.extent;
  while (hi - lo > std::max(width, 1e-12) * s.extent) {
    const double half = 0.5 * (lo + hi);
    const SearchOutcome outcome = s.contact(direction, half).outcome;
    if (outcome == SearchOutcome::undecided) break;
    (outcome == SearchOutcome::found ? hi : lo) = half;
  }
  // direction = k F^{-1} w: t w = way F (k F^{-1} w), so t = way k.
  const Vector3d in_space = s.a.ellipsoid().factor() * middle(direction);
  const double k = in_space.norm() / w.norm();
  // The way of a contact is not negative, whatever rounding says.
  const Interval time = Interval::between(lo * k * (1 - 1e-9), hi * k * (1 + 1e-9));
  return lo > 0 ? time : Interval::between(0, time.hi());
}

}  // namespace vericone
