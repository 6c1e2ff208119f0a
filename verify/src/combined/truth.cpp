// SPDX-License-Identifier: GPL-3.0-or-later
//
// P moved along w meets Q iff a segment in the direction w leads from P to Q. Seen along w, two triangles
// that overlap have a vertex of one inside the other or two edges that cross; there the lines along w through
// both are compared. All of it is signs of 3 x 3 determinants of whole numbers: with coordinates below 2^37,
// extents of one polyhedron below 2^26 and |w_i| <= 2^20 they fit into 128 bits.
#include <vericone/internal/verify/combined/truth.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "combined/forms.h"

namespace vericone::verify {
namespace {

int sign(Int128 x) { return (x > 0) - (x < 0); }

GridVector difference(const GridVector& x, const GridVector& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}

std::array<Int128, 3> cross(const GridVector& x, const GridVector& y) {
  const auto minor = [&](int i, int j) {
    return static_cast<Int128>(x[i]) * y[j] - static_cast<Int128>(x[j]) * y[i];
  };
  return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

Int128 dot(const std::array<Int128, 3>& n, const GridVector& x) {
  return n[0] * x[0] + n[1] * x[1] + n[2] * x[2];
}

/// Of the volume of the tetrahedron (a, b, c, d).
int orientation(const GridVector& a, const GridVector& b, const GridVector& c, const GridVector& d) {
  return sign(dot(cross(difference(b, a), difference(c, a)), difference(d, a)));
}

/// Across w.
struct Point {
  std::int64_t x, y;
};

int orientation(const Point& a, const Point& b, const Point& c) {
  return sign(static_cast<Int128>(b.x - a.x) * (c.y - a.y) - static_cast<Int128>(b.y - a.y) * (c.x - a.x));
}

struct SeenFacet {
  std::array<Point, 3> p;
  std::array<const GridVector*, 3> v;
  std::int64_t low_x, high_x, low_y, high_y;
};

/// A polyhedron seen along w, facets in the order of low_x.
std::vector<SeenFacet> seen(const StarPolyhedron& polyhedron, const GridVector& w) {
  int k = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(w[i]) > std::abs(w[k])) k = i;
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  std::vector<Point> points;
  points.reserve(polyhedron.vertices.size());
  for (const GridVector& x : polyhedron.vertices)
    points.push_back({w[k] * x[i] - w[i] * x[k], w[k] * x[j] - w[j] * x[k]});
  std::vector<SeenFacet> all;
  all.reserve(polyhedron.facets.size());
  for (const auto& f : polyhedron.facets) {
    SeenFacet s{};
    for (int m = 0; m < 3; ++m) {
      s.p[m] = points[f[m]];
      s.v[m] = &polyhedron.vertices[f[m]];
    }
    s.low_x = std::min({s.p[0].x, s.p[1].x, s.p[2].x});
    s.high_x = std::max({s.p[0].x, s.p[1].x, s.p[2].x});
    s.low_y = std::min({s.p[0].y, s.p[1].y, s.p[2].y});
    s.high_y = std::max({s.p[0].y, s.p[1].y, s.p[2].y});
    all.push_back(s);
  }
  std::sort(all.begin(), all.end(), [](const SeenFacet& a, const SeenFacet& b) { return a.low_x < b.low_x; });
  return all;
}

/// Calls `visit` for every pair whose boxes across w meet, until it answers true; returns whether it did.
template <class Visit>
bool any_pair(const std::vector<SeenFacet>& p, const std::vector<SeenFacet>& q, const Visit& visit) {
  std::int64_t widest = 0;
  for (const SeenFacet& g : q) widest = std::max(widest, g.high_x - g.low_x);
  for (const SeenFacet& f : p) {
    auto g = std::lower_bound(q.begin(), q.end(), f.low_x - widest,
                              [](const SeenFacet& s, std::int64_t x) { return s.low_x < x; });
    for (; g != q.end() && g->low_x <= f.high_x; ++g)
      if (g->high_x >= f.low_x && g->high_y >= f.low_y && g->low_y <= f.high_y && visit(f, *g)) return true;
  }
  return false;
}

/// Strictly on one side of all edges.
bool covers(const SeenFacet& f, const Point& x) {
  const int s = orientation(f.p[0], f.p[1], x);
  return s != 0 && s == orientation(f.p[1], f.p[2], x) && s == orientation(f.p[2], f.p[0], x);
}

/// Sign of t with x + t w in the plane of f; 0 also where there is none.
int steps_to(const GridVector& x, const SeenFacet& f, const GridVector& w) {
  const auto n = cross(difference(*f.v[1], *f.v[0]), difference(*f.v[2], *f.v[0]));
  return sign(dot(n, difference(*f.v[0], x))) * sign(dot(n, w));
}

/// Sign of t where an edge of p and one of q cross as seen along w.
int steps_between(const GridVector& p0, const GridVector& p1, const GridVector& q0, const GridVector& q1,
                  const GridVector& w) {
  const auto n = cross(difference(p1, p0), difference(q1, q0));
  return sign(dot(n, difference(q0, p0))) * sign(dot(n, w));
}

/// Calls `visit` with the sign of t for every place where the two facets overlap in general position, until
/// it answers true.
template <class Visit>
bool any_place(const SeenFacet& f, const SeenFacet& g, const GridVector& w, const Visit& visit) {
  for (int i = 0; i < 3; ++i) {
    if (covers(g, f.p[i]) && visit(steps_to(*f.v[i], g, w))) return true;
    if (covers(f, g.p[i]) && visit(-steps_to(*g.v[i], f, w))) return true;
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, j1 = (j + 1) % 3;
      if (orientation(f.p[i], f.p[i1], g.p[j]) * orientation(f.p[i], f.p[i1], g.p[j1]) >= 0) continue;
      if (orientation(g.p[j], g.p[j1], f.p[i]) * orientation(g.p[j], g.p[j1], f.p[i1]) >= 0) continue;
      if (visit(steps_between(*f.v[i], *f.v[i1], *g.v[j], *g.v[j1], w))) return true;
    }
  return false;
}

/// An edge line of one with the other strictly beyond it.
bool separated(const SeenFacet& f, const SeenFacet& g) {
  for (int i = 0; i < 3; ++i) {
    const Point &a = f.p[i], &b = f.p[(i + 1) % 3];
    const int own = orientation(a, b, f.p[(i + 2) % 3]);
    if (own == 0) continue;
    bool beyond = true;
    for (int j = 0; j < 3 && beyond; ++j) beyond = orientation(a, b, g.p[j]) == -own;
    if (beyond) return true;
  }
  return false;
}

/// Whether a segment and a triangle can have a common point.
bool may_pierce(const GridVector& e0, const GridVector& e1, const std::array<const GridVector*, 3>& t) {
  const int s0 = orientation(*t[0], *t[1], *t[2], e0), s1 = orientation(*t[0], *t[1], *t[2], e1);
  if (s0 * s1 > 0) return false;
  int most = -1, least = 1;
  for (int i = 0; i < 3; ++i) {
    const int s = orientation(e0, e1, *t[i], *t[(i + 1) % 3]);
    most = std::max(most, s);
    least = std::min(least, s);
  }
  return !(most > 0 && least < 0);
}

struct SpaceBox {
  GridVector low, high;
  explicit SpaceBox(const std::array<const GridVector*, 3>& t) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min({(*t[0])[i], (*t[1])[i], (*t[2])[i]});
      high[i] = std::max({(*t[0])[i], (*t[1])[i], (*t[2])[i]});
    }
  }
  bool meets(const SpaceBox& o) const {
    for (int i = 0; i < 3; ++i)
      if (low[i] > o.high[i] || high[i] < o.low[i]) return false;
    return true;
  }
};

std::array<const GridVector*, 3> vertices_of(const StarPolyhedron& p, const std::array<int, 3>& f) {
  return {&p.vertices[f[0]], &p.vertices[f[1]], &p.vertices[f[2]]};
}

/// In one of the tetrahedra over the facets; strictly, or on their boundary too.
bool contains(const StarPolyhedron& p, const GridVector& x, bool strictly) {
  const int least = strictly ? 1 : 0;
  for (const auto& f : p.facets) {
    const auto t = vertices_of(p, f);
    if (orientation(*t[0], *t[1], *t[2], x) <= -least && orientation(p.center, *t[0], *t[1], x) >= least &&
        orientation(p.center, *t[1], *t[2], x) >= least && orientation(p.center, *t[2], *t[0], x) >= least)
      return true;
  }
  return false;
}

}  // namespace

bool surely_meets(const StarPolyhedron& moving, const StarPolyhedron& other, const GridVector& w) {
  return any_pair(seen(moving, w), seen(other, w), [&](const SeenFacet& f, const SeenFacet& g) {
    return any_place(f, g, w, [](int t) { return t > 0; });
  });
}

bool surely_misses(const StarPolyhedron& moving, const StarPolyhedron& other, const GridVector& w) {
  return !any_pair(seen(moving, w), seen(other, w), [&](const SeenFacet& f, const SeenFacet& g) {
    if (separated(f, g) || separated(g, f)) return false;
    // Facets that are apart: t has one sign wherever they overlap, so one place settles it.
    return !any_place(f, g, w, [](int t) { return t < 0; });
  });
}

bool surely_apart(const StarPolyhedron& p, const StarPolyhedron& q) {
  if (contains(p, q.center, false) || contains(q, p.center, false)) return false;
  std::vector<SpaceBox> boxes;
  for (const auto& f : q.facets) boxes.emplace_back(vertices_of(q, f));
  for (const auto& f : p.facets) {
    const auto s = vertices_of(p, f);
    const SpaceBox box(s);
    for (std::size_t k = 0; k < q.facets.size(); ++k) {
      if (!box.meets(boxes[k])) continue;
      const auto t = vertices_of(q, q.facets[k]);
      for (int i = 0; i < 3; ++i)
        if (may_pierce(*s[i], *s[(i + 1) % 3], t) || may_pierce(*t[i], *t[(i + 1) % 3], s)) return false;
    }
  }
  return true;
}

CombinedTruth::CombinedTruth(const CombinedEllipsoid& a, const CombinedEllipsoid& b, int level) {
  const double size =
      std::max(a.ellipsoid().semi_axes().maxCoeff(), b.ellipsoid().semi_axes().maxCoeff()) * (1 + 0x1p-40);
  const int unit = std::ilogb(size) - 23;
  GridVector at;
  for (int i = 0; i < 3; ++i) {
    const mpq_class c = mpq_class(b.center()(i)) - mpq_class(a.center()(i));
    const double k = std::ldexp(c.get_d(), -unit);
    if (mpq_class(c.get_d()) != c || k != std::nearbyint(k) || !(std::abs(k) < 0x1p36))
      throw std::logic_error("CombinedTruth: centres off the grid");
    at[i] = static_cast<std::int64_t>(k);
  }
  a_ = polyhedral_bounds(a, level, unit, {});
  b_ = polyhedral_bounds(b, level, unit, at);
  if (a_.outer && b_.outer && surely_apart(*a_.outer, *b_.outer)) {
    relation_ = Relation::disjoint;
    return;
  }
  const auto overlap = [](const StarPolyhedron& p, const StarPolyhedron& q) {
    if (contains(p, q.center, true)) return true;
    // Vertices of facets only: others need not be in the body.
    std::vector<bool> asked(q.vertices.size(), false);
    for (const auto& f : q.facets)
      for (const int i : f) {
        if (!asked[i] && contains(p, q.vertices[i], true)) return true;
        asked[i] = true;
      }
    return false;
  };
  if (overlap(a_.inner, b_.inner) || overlap(b_.inner, a_.inner)) relation_ = Relation::overlapping;
}

Truth CombinedTruth::direction(const GridVector& w) const {
  for (const std::int64_t x : w)
    if (std::abs(x) > kGreatestDirection) throw std::logic_error("CombinedTruth: a direction too long");
  if (surely_meets(a_.inner, b_.inner, w)) return Truth::in;
  if (relation_ == Relation::disjoint && surely_misses(*a_.outer, *b_.outer, w)) return Truth::out;
  return Truth::unknown;
}

}  // namespace vericone::verify
