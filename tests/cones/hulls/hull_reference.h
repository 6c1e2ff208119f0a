// SPDX-License-Identifier: BSD-3-Clause
//
// Answers about hulls by trying every combination of points in rational arithmetic: nothing in common with
// the library's projections, metrics and searches.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/exact/rational.h>
#include <algorithm>
#include <vector>

namespace vericone::testing {

using exact::Rational;
template <typename N>
using VectorOf = std::array<N, 3>;
using Vector = VectorOf<Rational>;

inline Vector rational(const Eigen::Vector3d& v) { return exact::to_rational<3>(v); }
template <typename N>
int sign_of(const N& x) {
  return static_cast<int>(x > 0) - static_cast<int>(x < 0);
}
template <typename N>
VectorOf<N> operator-(const VectorOf<N>& x, const VectorOf<N>& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
template <typename N>
VectorOf<N> operator+(const VectorOf<N>& x, const VectorOf<N>& y) {
  return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
}
inline Vector times(const Rational& s, const Vector& x) { return {s * x[0], s * x[1], s * x[2]}; }
template <typename N>
N dot(const VectorOf<N>& x, const VectorOf<N>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
template <typename N>
VectorOf<N> cross(const VectorOf<N>& x, const VectorOf<N>& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
template <typename N>
bool zero(const VectorOf<N>& x) {
  return x[0] == 0 && x[1] == 0 && x[2] == 0;
}

/// The convex cone of a few vectors: K = conv(d), not with the origin in it.
template <typename N>
Membership cone_of_points(const std::vector<VectorOf<N>>& d, const VectorOf<N>& w) {
  if (zero(w)) return Membership::out;
  // In the cone iff a non-negative combination of one, two or three of them (Caratheodory).
  bool in_cone = false;
  const std::size_t n = d.size();
  for (std::size_t i = 0; i < n && !in_cone; ++i) {
    if (zero(cross(d[i], w)) && dot(d[i], w) > 0) in_cone = true;
    for (std::size_t j = 0; j < i && !in_cone; ++j) {
      const VectorOf<N> m = cross(d[i], d[j]);
      if (zero(m)) continue;
      // w = s d_i + t d_j + r m, by Cramer; r = 0.
      if (dot(m, w) == 0) {
        if (dot(cross(w, d[j]), m) >= 0 && dot(cross(d[i], w), m) >= 0) in_cone = true;
        continue;
      }
      for (std::size_t k = 0; k < j && !in_cone; ++k) {
        const N det = dot(m, d[k]);
        if (det == 0) continue;
        const int side = sign_of(det);
        in_cone = side * sign_of(dot(m, w)) >= 0 && side * sign_of(dot(cross(w, d[j]), d[k])) >= 0 &&
                  side * sign_of(dot(cross(d[i], w), d[k])) >= 0;
      }
    }
  }
  if (!in_cone) return Membership::out;
  // On its boundary iff a plane through w has all vectors on one side; if one does, so does one through
  // another of them.
  bool all_along = true;
  for (const VectorOf<N>& x : d) {
    const VectorOf<N> m = cross(w, x);
    if (zero(m)) continue;
    all_along = false;
    bool positive = true, negative = true;
    for (const VectorOf<N>& y : d) {
      const int s = sign_of(dot(m, y));
      positive = positive && s >= 0;
      negative = negative && s <= 0;
    }
    if (positive || negative) return Membership::on;
  }
  return all_along ? Membership::on : Membership::in;
}

inline std::vector<Vector> differences(const std::vector<Eigen::Vector3d>& b,
                                       const std::vector<Eigen::Vector3d>& a) {
  std::vector<Vector> d;
  for (const auto& x : b)
    for (const auto& y : a) {
      const Vector z = rational(x) - rational(y);
      if (std::find(d.begin(), d.end(), z) == d.end()) d.push_back(z);
    }
  return d;
}

/// Where the origin lies with regard to conv(d): every plane through three of the points, and what is flat.
template <typename N>
Relation origin_and_points(const std::vector<VectorOf<N>>& d) {
  const std::size_t n = d.size();
  bool solid = false, touched = false;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const VectorOf<N> m = cross(d[j] - d[i], d[k] - d[i]);
        if (zero(m)) continue;
        bool above = false, below = false;
        for (const VectorOf<N>& x : d) {
          const int s = sign_of(dot(m, x - d[i]));
          above = above || s > 0;
          below = below || s < 0;
        }
        solid = solid || above || below;
        if (above && below) continue;
        const int origin = -sign_of(dot(m, d[i]));
        if ((above && origin < 0) || (below && origin > 0)) return Relation::disjoint;
        if (!above && !below && origin != 0) return Relation::disjoint;
        touched = touched || origin == 0;
      }
  if (solid) return touched ? Relation::touching : Relation::overlapping;
  // Flat: the origin is in conv(d) iff in a triangle, segment or point of it.
  for (const VectorOf<N>& x : d)
    if (zero(x)) return Relation::touching;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (zero(cross(d[i], d[j])) && dot(d[i], d[j]) < 0) return Relation::touching;
      for (std::size_t k = 0; k < j; ++k) {
        const VectorOf<N> m = cross(d[j] - d[i], d[k] - d[i]);
        if (zero(m) || dot(m, d[i]) != 0) continue;
        if (dot(m, cross(d[i], d[j])) >= 0 && dot(m, cross(d[j], d[k])) >= 0 &&
            dot(m, cross(d[k], d[i])) >= 0)
          return Relation::touching;
      }
    }
  return Relation::disjoint;
}

/// K = conv(d) and the ball of radius r; least squared distance of conv(d) from the origin. Zero when inside.
inline Rational squared_distance(const std::vector<Vector>& d) {
  if (origin_and_points(d) != Relation::disjoint) return 0;
  const std::size_t n = d.size();
  Rational best = dot(d[0], d[0]);
  for (std::size_t i = 0; i < n; ++i) {
    best = std::min(best, dot(d[i], d[i]));
    for (std::size_t j = 0; j < i; ++j) {
      const Vector e = d[j] - d[i];
      const Rational ee = dot(e, e);
      if (ee == 0) continue;
      const Rational t = -dot(d[i], e) / ee;
      if (t > 0 && t < 1) {
        const Vector foot = d[i] + times(t, e);
        best = std::min(best, dot(foot, foot));
      }
      for (std::size_t k = 0; k < j; ++k) {
        const Vector m = cross(e, d[k] - d[i]);
        if (zero(m)) continue;
        const Rational s = dot(m, d[i]) / dot(m, m);
        const Vector foot = times(s, m), p = d[i] - foot, q = d[j] - foot, r = d[k] - foot;
        if (dot(m, cross(p, q)) >= 0 && dot(m, cross(q, r)) >= 0 && dot(m, cross(r, p)) >= 0)
          best = std::min(best, dot(foot, foot));
      }
    }
  }
  return best;
}

inline Relation ball_and_points(const std::vector<Vector>& d, const Rational& radius) {
  const Rational distance = squared_distance(d), r2 = radius * radius;
  return distance > r2 ? Relation::disjoint : distance == r2 ? Relation::touching : Relation::overlapping;
}

/// Membership of w in the cone of conv(d) + ball, which do not meet at the origin: least |x cross w| over
/// conv(d), over all segments and triangles.
inline Membership cone_of_ball_and_points(const std::vector<Vector>& d, const Rational& radius,
                                          const Vector& w) {
  if (zero(w)) return Membership::out;
  const std::size_t n = d.size();
  const auto off = [&](const Vector& x) { return dot(cross(x, w), cross(x, w)); };
  Rational best = off(d[0]);
  Vector where = d[0];
  const auto consider = [&](const Vector& x) {
    const Rational o = off(x);
    if (o < best) {
      best = o;
      where = x;
    }
  };
  for (std::size_t i = 0; i < n; ++i) {
    consider(d[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const Vector e = d[j] - d[i], ew = cross(e, w);
      if (zero(ew)) continue;
      const Rational t = -dot(cross(d[i], w), ew) / dot(ew, ew);
      if (t > 0 && t < 1) consider(d[i] + times(t, e));
      for (std::size_t k = 0; k < j; ++k) {
        const Vector m = cross(e, d[k] - d[i]);
        const Rational along = dot(m, w);
        if (along == 0) continue;
        const Vector hit = times(dot(m, d[i]) / along, w), p = d[i] - hit, q = d[j] - hit, r = d[k] - hit;
        if (dot(m, cross(p, q)) >= 0 && dot(m, cross(q, r)) >= 0 && dot(m, cross(r, p)) >= 0) consider(hit);
      }
    }
  }
  const Rational limit = radius * radius * dot(w, w);
  if (best > limit || dot(where, w) < 0) return Membership::out;
  return best == limit ? Membership::on : Membership::in;
}

}  // namespace vericone::testing
