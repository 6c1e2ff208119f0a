// SPDX-License-Identifier: BSD-3-Clause
//
// Pairs of turned cylinders, cones, capsules, boxes, ellipsoids and swollen ones that touch exactly, now or
// on their way, in rational numbers: each body gives a normal at which its support function is rational, a
// rational turn brings both normals together, and the support points do the rest.
#pragma once

#include <vericone/geometry/exact/rational.h>
#include <string>
#include <vector>

#include "round/exact.h"
#include "support/random.h"

namespace vericone::testing {

using exact::Integer;
using exact::Rational;
using RVector = exact::RationalVector<3>;
using RMatrix = exact::RationalMatrix<3>;

inline Rational dot(const RVector& x, const RVector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
inline RVector cross(const RVector& x, const RVector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
inline RVector plus(const RVector& x, const RVector& y, const Rational& times = 1) {
  return {x[0] + times * y[0], x[1] + times * y[1], x[2] + times * y[2]};
}
inline RVector scaled(const RVector& x, const Rational& by) { return {x[0] * by, x[1] * by, x[2] * by}; }
inline RVector image(const RMatrix& m, const RVector& x) {
  return {dot(m[0], x), dot(m[1], x), dot(m[2], x)};
}
inline RVector image_of_transpose(const RMatrix& m, const RVector& x) {
  return plus(plus(scaled(m[0], x[0]), m[1], x[1]), m[2], x[2]);
}
inline RMatrix product(const RMatrix& x, const RMatrix& y) {
  RMatrix r;
  for (int i = 0; i < 3; ++i) r[i] = image_of_transpose(y, x[i]);
  return r;
}
inline RMatrix diagonal(const Rational& x, const Rational& y, const Rational& z) {
  return {{{x, 0, 0}, {0, y, 0}, {0, 0, z}}};
}

/// The root of a rational square; the test fails where it is none.
inline Rational root(const Rational& x) {
  const Integer n = sqrt(Integer(numerator(x))), d = sqrt(Integer(denominator(x)));
  EXPECT_EQ(n * n, numerator(x));
  EXPECT_EQ(d * d, denominator(x));
  return Rational(n, d);
}

struct TouchBody {
  struct Piece {
    RVector center;
    RMatrix factor = diagonal(0, 0, 0);
  };
  std::vector<Piece> pieces;
  Rational margin = 0;
  std::vector<RVector> normals;  // rational of length and of support, one of which is drawn

  [[nodiscard]] Rational value(const Piece& piece, const RVector& n) const {
    const RVector back = image_of_transpose(piece.factor, n);
    return dot(n, piece.center) + root(dot(back, back));
  }
  [[nodiscard]] RVector support_point(const RVector& n) const {
    const Piece* best = &pieces[0];
    for (const Piece& piece : pieces)
      if (value(piece, n) > value(*best, n)) best = &piece;
    const RVector back = image_of_transpose(best->factor, n);
    RVector x = best->center;
    if (dot(back, back) != 0) x = plus(x, image(best->factor, back), 1 / root(dot(back, back)));
    return plus(x, n, margin / root(dot(n, n)));
  }
  [[nodiscard]] RVector middle() const {
    RVector sum{0, 0, 0};
    for (const Piece& piece : pieces) sum = plus(sum, piece.center, Rational(1, pieces.size()));
    return sum;
  }
  [[nodiscard]] TouchBody turned(const RMatrix& r) const {
    TouchBody body = *this;
    for (Piece& piece : body.pieces) piece = {image(r, piece.center), product(r, piece.factor)};
    for (RVector& n : body.normals) n = image(r, n);
    return body;
  }
  [[nodiscard]] TouchBody moved(const RVector& by) const {
    TouchBody body = *this;
    for (Piece& piece : body.pieces) piece.center = plus(piece.center, by);
    return body;
  }
};

/// Bodies about the origin, axis z.
inline TouchBody touch_body(const std::string& kind, Random& random) {
  const auto size = [&] { return Rational(random.integer(1, 16), 4); };
  const RMatrix none = diagonal(0, 0, 0);
  // x^2 + y^2 and x^2 + y^2 + z^2 are squares; then lengths that are.
  const std::vector<RVector> rim{{3, 4, 12}, {-8, 6, 24}, {15, 20, -60}, {5, -12, 84}, {-8, -15, 144}};
  const std::vector<RVector> side{{3, 4, 0}, {-5, 12, 0}, {15, -8, 0}};
  const std::vector<RVector> any{{1, 2, 2}, {-2, 3, 6}, {4, -4, 7}, {1, -4, -8}, {2, 6, 9}};
  const RVector up{0, 0, 1}, down{0, 0, -1};
  TouchBody body;
  const auto add = [&](const std::vector<RVector>& normals) {
    body.normals.insert(body.normals.end(), normals.begin(), normals.end());
  };
  if (kind == "capsule") {
    body = {{{{0, 0, size()}, none}, {{0, 0, -size()}, none}}, size(), any};
    add(side);
  } else if (kind == "cylinder" || kind == "cylinder + r") {
    const Rational r = size(), h = size();
    body = {{{{0, 0, h}, diagonal(r, r, 0)}, {{0, 0, -h}, diagonal(r, r, 0)}}, 0, rim};
    add(side);
    add({up, down});
    if (kind == "cylinder + r") body.margin = size();
  } else if (kind == "disc") {
    const Rational r = size();
    body = {{{{0, 0, 0}, diagonal(r, r, 0)}}, 0, rim};
    add(side);
  } else if (kind == "cone") {
    const Rational h = size(), r = h * Rational(12, 5);  // (3, 4, 12) is orthogonal to its side
    body = {{{{0, 0, h / 2}, none}, {{0, 0, -h / 2}, diagonal(r, r, 0)}}, 0, rim};
    add({down, {3, 4, 12}, {-4, 3, 12}});
  } else if (kind == "frustum") {
    const Rational h = size(), r = h * Rational(12, 5), top = size();
    body = {
        {{{0, 0, h / 2}, diagonal(top, top, 0)}, {{0, 0, -h / 2}, diagonal(r + top, r + top, 0)}}, 0, rim};
    add({up, down, {3, 4, 12}, {-4, 3, 12}});
  } else if (kind == "ellipsoid" || kind == "ellipsoid + r") {
    const RVector n = any[random.integer(0, 4)], m = any[random.integer(0, 4)];
    const Rational s = size();
    body = {
        {{{0, 0, 0}, diagonal(abs(s * m[0] / n[0]), abs(s * m[1] / n[1]), abs(s * m[2] / n[2]))}}, 0, {n}};
    if (kind == "ellipsoid + r") body.margin = size();
  } else if (kind == "box" || kind == "box + r") {
    const Rational a = size(), b = size(), c = size();
    for (int i = 0; i < 8; ++i)
      body.pieces.push_back(
          {{i & 1 ? a : Rational(-a), i & 2 ? b : Rational(-b), i & 4 ? c : Rational(-c)}, none});
    body.normals = any;
    add(side);
    add({up, {-1, 0, 0}});
    if (kind == "box + r") body.margin = size();
  }
  return body;
}

inline RMatrix turn(const Rational& w, const RVector& v) {
  const Rational n = w * w + dot(v, v);
  RMatrix r;
  for (int i = 0; i < 3; ++i) {
    RVector e{0, 0, 0};
    e[i] = 1;
    // R e = e + 2 (w v x e + v x (v x e)) / |q|^2, a column.
    const RVector t = cross(v, e);
    const RVector column = plus(e, plus(scaled(t, w), cross(v, t)), 2 / n);
    for (int k = 0; k < 3; ++k) r[k][i] = column[k];
  }
  return r;
}

/// Agent and obstacle that touch: n is the common normal, from the agent to the obstacle.
struct Touch {
  TouchBody agent, obstacle;
  RVector n;        // of rational length
  RVector inwards;  // moving the obstacle by a little of it makes them overlap
  RVector w;        // orthogonal to n, of whole numbers

  static Touch random(const std::string& agent, const std::string& obstacle, Random& random) {
    Touch t;
    t.agent = touch_body(agent, random);
    t.obstacle = touch_body(obstacle, random);
    const auto q = [&] { return Rational(random.integer(-4, 4)); };
    t.agent = t.agent.turned(turn(random.integer(1, 5), {q(), q(), q()}));
    const auto unit = [](const RVector& x) { return scaled(x, 1 / root(dot(x, x))); };
    const auto drawn = [&](const TouchBody& body) {
      return unit(body.normals[random.integer(0, static_cast<int>(body.normals.size()) - 1)]);
    };
    t.n = drawn(t.agent);
    const RVector from = drawn(t.obstacle);
    RVector axis = plus(from, t.n, -1);  // the half turn about it brings `from` to -n
    if (dot(axis, axis) == 0) axis = cross(t.n, t.n[0] == 0 ? RVector{1, 0, 0} : RVector{0, 1, 0});
    t.obstacle = t.obstacle.turned(turn(0, axis)).turned(turn(random.integer(1, 5), scaled(t.n, q())));
    const RVector k = plus(t.obstacle.support_point(scaled(t.n, -1)), t.agent.support_point(t.n), -1);
    t.inwards = plus(plus(k, t.obstacle.middle(), -1), t.agent.middle());
    t.obstacle = t.obstacle.moved(scaled(k, -1));
    do t.w = cross(t.n, {q(), q(), q()});
    while (dot(t.w, t.w) == 0);
    Integer common = 1;
    for (const Rational& x : t.w) common = lcm(common, Integer(denominator(x)));
    t.w = scaled(t.w, common);
    return t;
  }
};

struct OnGrid {
  round::ExactBody agent, obstacle;
  Integer margin;

  OnGrid(const TouchBody& a, const TouchBody& b) {
    const Rational r = a.margin + b.margin;
    Integer unit = denominator(r);
    const auto shape = [](const TouchBody::Piece& piece) {
      RMatrix s;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) s[i][j] = dot(piece.factor[i], piece.factor[j]);
      return s;
    };
    for (const TouchBody* body : {&a, &b})
      for (const auto& piece : body->pieces) {
        const RMatrix s = shape(piece);
        for (int i = 0; i < 3; ++i) {
          unit = lcm(unit, Integer(denominator(piece.center[i])));
          for (const Rational& x : s[i]) unit = lcm(unit, Integer(denominator(x)));
        }
      }
    const auto whole = [](const Rational& x) { return Integer(numerator(x) / denominator(x)); };
    for (const auto& [body, to] : {std::pair{&a, &agent}, {&b, &obstacle}})
      for (const auto& piece : body->pieces) {
        round::ExactPiece p;
        const RMatrix s = shape(piece);
        for (int i = 0; i < 3; ++i) {
          p.center[i] = whole(piece.center[i] * unit);
          for (int j = 0; j < 3; ++j) p.shape[i][j] = whole(s[i][j] * unit * unit);
        }
        to->pieces.push_back(p);
      }
    margin = whole(r * unit);
  }

  [[nodiscard]] std::optional<Membership> membership(const RVector& w) const {
    return round::exact_membership(agent, obstacle, margin, exact::direction_on_grid<3>(w));
  }
  [[nodiscard]] Membership line(const RVector& w) const {
    return round::line_meets(agent, obstacle, margin, exact::direction_on_grid<3>(w));
  }
  [[nodiscard]] std::optional<Relation> relation() const {
    return round::exact_relation(agent, obstacle, margin);
  }
};

}  // namespace vericone::testing
