// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/geometry/decompositions.h>
#include <vericone/internal/verify/combined/planar_truth.h>
#include <Eigen/LU>

#include <cmath>
#include <cstdint>

#include "planar/conics.h"
#include "planar/separation.h"

namespace vericone::verify {

using namespace planar;

namespace {

/// Whether the ray from `from` (an offset from the body's centre) along w meets the body. If it does, the
/// first common point is its start or a root of one of the quadratics.
template <class N>
Answer ray_meets(const std::vector<Conic<N>>& conics, const Point<N>& from, const Point<N>& w) {
  struct Quadratic {
    N a, b, c;  // a t^2 + 2 b t + c
  };
  std::vector<Quadratic> q;
  Answer answer = Answer::yes;
  for (const Conic<N>& conic : conics) {
    q.push_back({conic.square(w), conic.form(w, from), conic.square(from) - conic.level});
    answer = both(answer, not_positive(q.back().c));
  }
  if (answer == Answer::yes) return answer;
  const N across = from.x * w.y - from.y * w.x;
  for (std::size_t j = 0; j < q.size() && answer != Answer::yes; ++j) {
    // b^2 - a c without the cancellation.
    const N discriminant = conics[j].level * q[j].a - conics[j].determinant() * across * across;
    const Answer real = not_positive(N(0) - discriminant);
    if (real == Answer::no) continue;
    const N s = root(discriminant);
    const N big = looks_negative(q[j].b) ? s - q[j].b : N(0) - s - q[j].b;
    for (const bool first : {true, false}) {
      const N &numerator = first ? big : q[j].c, &denominator = first ? q[j].a : big;
      const Answer up = positive(denominator), down = positive(N(0) - denominator);
      if (up == Answer::no && down == Answer::no) continue;  // no such root
      if (up != Answer::yes && down != Answer::yes) {
        answer = either(answer, Answer::unknown);
        continue;
      }
      const N t = numerator / denominator;
      Answer hit = both(real, not_positive(N(0) - t));
      const Point<N> there{from.x + t * w.x, from.y + t * w.y};
      for (std::size_t k = 0; k < q.size() && hit != Answer::no; ++k)
        if (k != j) hit = both(hit, not_positive(conics[k].square(there) - conics[k].level));
      answer = either(answer, hit);
    }
  }
  return answer;
}

/// Points of the body, as offsets, that may be extremes across n: where round conics have the normal +-n.
template <class N>
std::vector<Candidate<N>> support_points(const std::vector<Conic<N>>& conics, const Point<N>& n) {
  std::vector<Candidate<N>> all;
  for (int i = 0; i < static_cast<int>(conics.size()); ++i) {
    const Conic<N>& c = conics[i];
    const N det = c.determinant();
    const Answer convex = both(both(positive(det), positive(c.xx)), positive(c.level));
    if (convex == Answer::no) continue;
    if (convex == Answer::unknown) throw std::domain_error("a conic that intervals cannot tell");
    const Point<N> along{c.yy * n.x - c.xy * n.y, c.xx * n.y - c.xy * n.x};
    const N s = root(N(c.level / (det * (along.x * n.x + along.y * n.y))));
    const Point<N> p{s * along.x, s * along.y};
    const Answer on_body = in_others(conics, p, i, i);
    if (on_body == Answer::no) continue;
    all.push_back({p, on_body, i, i});
    all.push_back({{N(0) - p.x, N(0) - p.y}, on_body, i, i});
  }
  return all;
}

/// Where A's ellipse is about a unit disc and B's axes are about the coordinate axes.
Map simple_coordinates(const CombinedEllipse& a, const CombinedEllipse& b) {
  const Eigen::Matrix2d f = a.ellipsoid().factor(), g = f.inverse() * b.ellipsoid().factor();
  const auto solver = symmetric_eigen<2>(g * g.transpose());
  return Map(f * solver.vectors);
}

template <class N>
struct Pair {
  std::vector<Conic<N>> a, b;
  Point<N> c;  // p_B - p_A
  std::vector<Candidate<N>> corners_a;

  Answer contains(const Point<N>& w) const {
    // The centre is in A whatever A is; back from B's centre to A.
    const Point<N> back{N(0) - w.x, N(0) - w.y};
    Answer answer = either(ray_meets(b, {N(0) - c.x, N(0) - c.y}, w), ray_meets(a, c, back));
    const auto look = [&](const std::vector<Candidate<N>>& candidates) {
      for (const Candidate<N>& p : candidates) {
        if (answer == Answer::yes) return;
        answer = either(answer, both(p.on_body, ray_meets(b, {p.point.x - c.x, p.point.y - c.y}, w)));
      }
    };
    look(corners_a);
    if (answer != Answer::yes) look(support_points(a, {N(0) - w.y, w.x}));
    return answer;
  }
};

/// From the stored numbers themselves.
template <class N>
std::unique_ptr<Pair<N>> unrounded(const CombinedEllipse& a, const CombinedEllipse& b) {
  auto pair = std::make_unique<Pair<N>>();
  pair->a = conics<N>(a);
  pair->b = conics<N>(b);
  pair->c = {N(b.center().x()) - N(a.center().x()), N(b.center().y()) - N(a.center().y())};
  pair->corners_a = crossings(pair->a);
  return pair;
}

template <class N>
Enclosure enclosure(const N& x) {
  const auto [lo, hi] = CGAL::to_interval(x);
  return {lo, hi};
}

std::vector<ExactCorner> enclosed(const std::vector<Conic<Exact>>& conics) {
  std::vector<ExactCorner> all;
  for (const auto& corner : crossings(conics))
    all.push_back({enclosure(corner.point.x), enclosure(corner.point.y), corner.first, corner.second});
  return all;
}

}  // namespace

struct CombinedPlanarTruth::State {
  CombinedEllipse a, b;
  Map map;
  Pair<Interval> fast;
  bool fast_corners = false;
  std::unique_ptr<Pair<WideInterval>> wide;
  std::unique_ptr<Pair<Exact>> exact;
  std::uint64_t exact_answers = 0;
};

CombinedPlanarTruth::CombinedPlanarTruth(const CombinedEllipse& a, const CombinedEllipse& b)
    : state_(std::make_unique<State>(State{a, b, simple_coordinates(a, b), {}, false, {}, {}, 0})) {
  const Interval::Protector rounding;
  Pair<Interval>& fast = state_->fast;
  fast.a = state_->map.conics(a);
  fast.b = state_->map.conics(b);
  fast.c = state_->map.vector(Rational(b.center().x()) - Rational(a.center().x()),
                              Rational(b.center().y()) - Rational(a.center().y()));
  try {
    fast.corners_a = crossings(fast.a);
    state_->fast_corners = true;
  } catch (const std::domain_error&) {
  }
}
CombinedPlanarTruth::~CombinedPlanarTruth() = default;

std::uint64_t CombinedPlanarTruth::exact_answers() const { return state_->exact_answers; }

std::optional<bool> CombinedPlanarTruth::disjoint() const {
  const Interval::Protector rounding;
  return separated(state_->fast.a, state_->fast.b, state_->fast.c);
}

bool CombinedPlanarTruth::contains(const Eigen::Vector2d& w) const {
  if (state_->fast_corners) {
    const Interval::Protector rounding;
    try {
      const Answer answer = state_->fast.contains(state_->map.vector(w.x(), w.y()));
      if (answer != Answer::unknown) return answer == Answer::yes;
    } catch (const std::domain_error&) {
    }
  }
  try {
    if (!state_->wide) state_->wide = unrounded<WideInterval>(state_->a, state_->b);
    const Answer answer = state_->wide->contains({w.x(), w.y()});
    if (answer != Answer::unknown) return answer == Answer::yes;
  } catch (const std::domain_error&) {
  }
  ++state_->exact_answers;
  if (!state_->exact) state_->exact = unrounded<Exact>(state_->a, state_->b);
  return state_->exact->contains({w.x(), w.y()}) == Answer::yes;
}

std::vector<ExactCorner> exact_corners(const CombinedEllipse& body) { return enclosed(conics<Exact>(body)); }

std::vector<ExactCorner> exact_section_corners(const CombinedEllipsoid& body, const Eigen::Vector3d& x_axis,
                                               const Eigen::Vector3d& y_axis) {
  using Row = std::array<Exact, 3>;
  const auto row = [](const Eigen::Vector3d& v) { return Row{Exact(v.x()), Exact(v.y()), Exact(v.z())}; };
  const Row x = row(x_axis), y = row(y_axis);
  const auto dot = [](const Row& u, const Row& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
  std::vector<Conic<Exact>> section;
  const Ellipsoid& e = body.ellipsoid();
  if (!e.defined_by_factor()) throw std::invalid_argument("sections of bodies given by axes only");
  // |adj(F) y|^2 <= det(F)^2: rows of adj(F) are cross products of columns of F.
  const auto cross = [](const Row& u, const Row& v) {
    return Row{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  const Row f0 = row(e.factor().col(0)), f1 = row(e.factor().col(1)), f2 = row(e.factor().col(2));
  const Row rows[3] = {cross(f1, f2), cross(f2, f0), cross(f0, f1)};
  const Exact det = dot(f0, rows[0]);
  Row gx, gy;
  for (int i = 0; i < 3; ++i) gx[i] = dot(rows[i], x), gy[i] = dot(rows[i], y);
  section.push_back({dot(gx, gx), dot(gx, gy), dot(gy, gy), det * det});
  for (const auto& d : body.delimiters()) {
    Row mx, my;
    for (int i = 0; i < 3; ++i) {
      const Row m = row(d.matrix.row(i).transpose());
      mx[i] = dot(m, x), my[i] = dot(m, y);
    }
    section.push_back({dot(x, mx), dot(x, my), dot(y, my), Exact(d.level)});
  }
  return enclosed(section);
}

}  // namespace vericone::verify
