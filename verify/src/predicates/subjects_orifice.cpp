// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/cones/opening/orifice.h>
#include <vericone/internal/verify/predicates/orifice_truth.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <vector>

#include "predicates/cases.h"
#include "predicates/subjects.h"

namespace vericone::verify {
namespace {

using cases::Kind;
using cases::kind_of;
using Eigen::Matrix3d;
using Eigen::Vector3d;

bool on_boundary(int answer) { return answer == code(Transit::grazes); }

struct Aimed {
  Ellipsoid agent;
  Orifice orifice;
  Vector3d w;  // touches the rim, exactly or to rounding
};

/// Pythagorean triples scaled to the hypotenuse 5 or 13 or 25, zeros included.
constexpr int kTriples[][3] = {{3, 4, 5},   {4, 3, 5}, {5, 12, 13}, {12, 5, 13},
                               {7, 24, 25}, {1, 0, 1}, {0, 1, 1}};

/// The agent is the ball of radius a: moving along the axis of the opening and offset by (p, q) with
/// sqrt(p^2 + q^2) + a = r it touches the rim. Axes are permuted and signed, w is sheared where the agent is
/// an ellipsoid that the shear makes of the ball: then the shear keeps the plane and the swept section.
Aimed exact_opening(SeededRandom& random) {
  const int* triple = kTriples[random.integer(0, 6)];
  const int a = random.integer(1, 6), height = a + random.integer(0, 9);
  Matrix3d shear = Matrix3d::Identity();
  shear(0, 2) = random.integer(-3, 3), shear(1, 2) = random.integer(-3, 3);
  Matrix3d turn = Matrix3d::Zero();
  const int first = random.integer(0, 2), second = (first + random.integer(1, 2)) % 3;
  turn(first, 0) = random.coin() ? 1 : -1;
  turn(second, 1) = random.coin() ? 1 : -1;
  turn(3 - first - second, 2) = random.coin() ? 1 : -1;
  const double scale = std::ldexp(1.0, random.integer(0, 2) ? 0 : random.integer(-480, 480));
  Vector3d home;
  for (int k = 0; k < 3; ++k) home(k) = random.integer(-9, 9);
  // In the frame of the opening: the agent's centre (p, q, -height) is carried by (0, 0, 1) into the disc.
  const Matrix3d m = turn * shear;
  const Vector3d center = shear * Vector3d(triple[0], triple[1], -height);
  const Matrix3d s = (a * a) * (m * m.transpose());
  Aimed o;
  o.agent = Ellipsoid::from_shape(scale * (home + turn * center), scale * (scale * s));
  o.orifice = {scale * home, turn.col(2) * random.integer(1, 5), scale * (triple[2] + a)};
  o.w = m.col(2);
  return o;
}

/// The section of the swept agent with the plane, and the direction of w moved until it touches the rim.
Aimed opening(SeededRandom& random, Kind kind) {
  if (kind == Kind::exact) return exact_opening(random);
  const cases::Tangency<3> t = cases::tangency<3>(random, kind, false);
  Aimed o;
  o.agent = t.a;
  const Vector3d m = random.direction<3>();
  const double reach = t.a.radius(m), most = t.a.semi_axes()(0);
  const Vector3d sideways = random.direction<3>();
  const Vector3d c = (reach + most * random.uniform(0.01, 3)) * m + most * random.uniform(0, 2) * sideways;
  o.orifice.normal = m * cases::log_uniform(random, -2, 2);
  o.orifice.center = t.a.center() + c;
  const Vector3d other = random.direction<3>();
  o.w = c / c.norm() + random.uniform(0, 0.3) * other;
  // Half widths of the section in coordinates of the plane: the radius that just holds it.
  const Vector3d u = m.unitOrthogonal(), v = m.cross(u);
  const auto cast = [&](const Vector3d& x) { return Vector3d(x - m.dot(x) / m.dot(o.w) * o.w); };
  const Vector3d d = cast(c);
  Eigen::Matrix<double, 2, 3> f;
  for (int k = 0; k < 3; ++k) {
    const Vector3d column = cast(t.a.factor().col(k));
    f(0, k) = u.dot(column), f(1, k) = v.dot(column);
  }
  const Eigen::Vector2d d2(u.dot(d), v.dot(d));
  double least = 0;
  const auto width = [&](double angle) {
    const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
    return std::abs(n.dot(d2)) + (f.transpose() * n).norm();
  };
  double best = 0;
  for (int i = 0; i < 24; ++i) {
    const double x = width(i * 0.1308996938995747);
    if (x > least) least = x, best = i * 0.1308996938995747;
  }
  for (double step = 0.1; step > 1e-9; step /= 2)
    for (const double sign : {-1.0, 1.0})
      while (width(best + sign * step) > least) least = width(best += sign * step);
  o.orifice.radius = least;
  return o;
}

void run(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  SeededRandom random(350, seed, number);
  const Kind kind = kind_of(number);
  for (;;) {
    const Aimed o = opening(random, kind);
    if (!o.w.allFinite() || !(o.orifice.radius > 0) || !std::isfinite(o.orifice.radius)) continue;
    // Another radius for the ordinary half: the velocities of one oracle share it.
    // The exact rung takes up to a millisecond: one block in sixteen is hard.
    const std::uint64_t round = number / cases::kKinds;
    const bool hard = round % 16 == 0, ordinary = kind == Kind::exact ? round % 2 == 1 : !hard;
    Orifice orifice = o.orifice;
    if (ordinary) orifice.radius *= random.uniform(0.7, 2);
    const OrificeOracle oracle(o.agent, orifice);
    std::array<Vector3d, kCasesPerBlock> w;
    const Vector3d c = orifice.center - o.agent.center();
    for (int i = 0; i < kCasesPerBlock; ++i) {
      bool& is_random = block.cases[i].random;
      is_random = false;
      const int what = i == 0 || hard ? i : kCasesPerBlock;
      if (what == 0) {
        w[i] = o.w;
      } else if (what == 1) {
        w[i] = -o.w;
      } else if (what < 6) {
        w[i] = cases::jittered<3>(random, o.w, what == 2 ? 1 : 8);
      } else if (what < 9) {
        const double off = cases::log_uniform(random, -16, -3) * o.w.norm();
        w[i] = o.w + off * random.direction<3>();
      } else {
        is_random = kind == Kind::regular && ordinary;
        const Vector3d e = random.direction<3>();
        w[i] = c / c.norm() + random.uniform(0, 1) * e;
      }
    }
    climb_all(block, [&](int i, Rung* rung) { return code(oracle.transit(w[i], rung)); });
    for (int i = 0; i < kCasesPerBlock; ++i) {
      PredicateCase& k = block.cases[i];
      k.triage = code(oracle.triage_transit(w[i]));
      k.interval = code(oracle.interval_transit(w[i]));
      if (depth.exact) k.exact = code(oracle.exact_transit(w[i]));
      if (depth.truth)
        k.truth = code(orifice_truth(o.agent, orifice.center, orifice.normal, orifice.radius, w[i]));
    }
    return;
  }
}

// Openings of any outline.

struct AimedAt {
  Ellipsoid agent;
  PlacedOpening opening;
  Vector3d w;  // touches the rim, exactly or to rounding
};

/// A ball of radius a that moves along z and is off by (p, q), sheared and turned as in exact_opening(). It
/// touches an edge (p + a, ...), a vertex at (p, q) + a (3, 4) / 5, or the end of an ellipse's axis.
AimedAt exact_outline(SeededRandom& random) {
  const int a = 5 * random.integer(1, 3), p = random.integer(0, 6), q = random.integer(-6, 6),
            height = a + random.integer(0, 9), far = 60 + random.integer(0, 9);
  Matrix3d shear = Matrix3d::Identity();
  shear(0, 2) = random.integer(-3, 3), shear(1, 2) = random.integer(-3, 3);
  Matrix3d turn = Matrix3d::Zero();
  const int first = random.integer(0, 2), second = (first + random.integer(1, 2)) % 3;
  turn(first, 0) = random.coin() ? 1 : -1;
  turn(second, 1) = random.coin() ? 1 : -1;
  turn(3 - first - second, 2) = random.coin() ? 1 : -1;
  Vector3d home;
  for (int k = 0; k < 3; ++k) home(k) = random.integer(-9, 9);
  const Matrix3d m = turn * shear;
  const bool round = random.integer(0, 2) == 0;
  AimedAt o;
  o.agent = Ellipsoid::from_shape(home + turn * (shear * Vector3d(p, round ? 0 : q, -height)),
                                  (a * a) * (m * m.transpose()));
  o.opening.center = home;
  o.opening.axes = turn.leftCols<2>();
  if (round) {
    o.opening.opening = Opening::ellipse({double(p + a), double(far)});
  } else if (random.coin()) {
    o.opening.opening = Opening::polygon({{double(-far), double(-far)},
                                          {double(p + a), double(-far)},
                                          {double(p + a), double(far)},
                                          {double(-far), 65}});
  } else {
    const double x = p + 0.6 * a, y = q + 0.8 * a;
    o.opening.opening = Opening::polygon({{double(-far), double(-far)},
                                          {double(far), double(-far)},
                                          {double(far), std::round(y)},
                                          {std::round(x), std::round(y)},
                                          {std::round(x), double(far)},
                                          {double(-far), double(far)}});
  }
  o.w = m.col(2);
  return o;
}

/// A random outline, as large as it must be for the agent to touch it.
AimedAt outline(SeededRandom& random, Kind kind) {
  if (kind == Kind::exact) return exact_outline(random);
  const cases::Tangency<3> t = cases::tangency<3>(random, kind, false);
  AimedAt o;
  o.agent = t.a;
  const Vector3d m = random.direction<3>();
  const double most = t.a.semi_axes()(0);
  const Vector3d sideways = random.direction<3>();
  const Vector3d c = (t.a.radius(m) + most * random.uniform(0.01, 3)) * m + 0.2 * most * sideways;
  o.opening.center = t.a.center() + c;
  o.w = c / c.norm() + random.uniform(0, 0.3) * random.direction<3>();
  const Vector3d u = m.unitOrthogonal();
  o.opening.axes << u, m.cross(u);
  if (random.integer(0, 2) == 0) {
    const double a = random.uniform(0.3, 1);
    o.opening.opening = Opening::ellipse({a, random.uniform(0.3, 1)});
  } else {
    std::vector<Eigen::Vector2d> p;
    const int n = random.integer(3, 12);
    const double least = random.coin() ? 0.9 : 0.4;
    for (int i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * (i + random.uniform(0, 0.5)) / n;
      const double r = random.uniform(least, 1);
      p.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    o.opening.opening = Opening::polygon(p);
  }
  const auto passes = [&](double size) {
    PlacedOpening sized = o.opening;
    sized.axes *= size;
    return OrificeOracle(o.agent, sized).transit(o.w) != Transit::blocked;
  };
  double low = 1e-3 * most, high = 1e4 * most;
  if (passes(high))
    for (int step = 0; step < 100 && cases::moved_by_ulps(low, 1) < high; ++step) {
      const double mid = 0.5 * (low + high);
      (passes(mid) ? high : low) = mid;
    }
  o.opening.axes *= high;
  return o;
}

void run_outline(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  SeededRandom random(351, seed, number);
  const Kind kind = kind_of(number);
  for (;;) {
    AimedAt o = outline(random, kind);
    if (!o.w.allFinite() || !o.opening.axes.allFinite()) continue;
    const std::uint64_t round = number / cases::kKinds;
    const bool hard = round % 16 == 0, ordinary = kind == Kind::exact ? round % 2 == 1 : !hard;
    if (ordinary) o.opening.axes *= random.uniform(0.7, 2);
    const OrificeOracle oracle(o.agent, o.opening);
    std::array<Vector3d, kCasesPerBlock> w;
    const Vector3d c = o.opening.center - o.agent.center();
    for (int i = 0; i < kCasesPerBlock; ++i) {
      bool& is_random = block.cases[i].random;
      is_random = false;
      const int what = i == 0 || hard ? i : kCasesPerBlock;
      if (what == 0) {
        w[i] = o.w;
      } else if (what == 1) {
        w[i] = -o.w;
      } else if (what < 6) {
        w[i] = cases::jittered<3>(random, o.w, what == 2 ? 1 : 8);
      } else if (what < 9) {
        const double off = cases::log_uniform(random, -16, -3) * o.w.norm();
        w[i] = o.w + off * random.direction<3>();
      } else {
        is_random = kind == Kind::regular && ordinary;
        const Vector3d e = random.direction<3>();
        w[i] = c / c.norm() + random.uniform(0, 1) * e;
      }
    }
    climb_all(block, [&](int i, Rung* rung) { return code(oracle.transit(w[i], rung)); });
    for (int i = 0; i < kCasesPerBlock; ++i) {
      PredicateCase& k = block.cases[i];
      k.triage = code(oracle.triage_transit(w[i]));
      k.interval = code(oracle.interval_transit(w[i]));
      if (depth.exact) k.exact = code(oracle.exact_transit(w[i]));
      if (depth.truth) k.truth = code(orifice_truth(o.agent, o.opening, w[i]));
    }
    return;
  }
}

constexpr Subject kSubjects[] = {{"velocity, orifice", run, on_boundary},
                                 {"velocity, opening", run_outline, on_boundary}};

}  // namespace

std::span<const Subject> orifice_subjects() { return kSubjects; }

}  // namespace vericone::verify
