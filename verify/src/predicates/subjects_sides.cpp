// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/geometry/combined.h>
#include <vericone/internal/geometry/quadric_side.h>
#include <vericone/internal/verify/predicates/truth.h>

#include <Eigen/LU>
#include <cmath>

#include "predicates/cases.h"
#include "predicates/subjects.h"

namespace vericone::verify {
namespace {

using cases::Kind;
using cases::kind_of;

bool is_zero(int answer) { return answer == code(Sign::zero); }
int sign_of(double x) { return x < 0 ? 0 : x == 0 ? 1 : 2; }

/// Case i of a block: a point of the surface, a few ulps from it, near it, anywhere.
template <int D>
Eigen::Matrix<double, D, 1> place(SeededRandom& random, const Eigen::Matrix<double, D, 1>& on,
                                  const Eigen::Matrix<double, D, 1>& center, Kind kind, int i,
                                  bool& is_random) {
  is_random = false;
  if (i < 3) return on;
  if (i < 7) return cases::jittered<D>(random, on, i == 3 ? 1 : 8);
  if (i < 10) {
    const double off = cases::log_uniform(random, -16, -3);
    return center + (random.coin() ? 1 + off : 1 - off) * (on - center);
  }
  is_random = kind == Kind::regular;
  const double factor = random.uniform(-2, 2);
  return center + factor * (on - center);
}

template <int D>
void run_body(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  using Vector = Eigen::Matrix<double, D, 1>;
  SeededRandom random(310 + D, seed, number);
  const Kind kind = kind_of(number);
  // Touching bodies: their common point is the support point of A.
  const cases::Tangency<D> t = cases::tangency<D>(random, kind, true);
  std::array<Vector, kCasesPerBlock> x;
  for (int i = 0; i < kCasesPerBlock; ++i) {
    Vector on = t.a.support_point(random.direction<D>());
    if (kind == Kind::exact) {
      // p + S n / rho(n) for the exact normal has the integer coordinates that the construction started from,
      // to a rounding of the support point: rounded to the grid of the scale.
      on = t.a.support_point(t.normal);
      for (int k = 0; k < D; ++k) on(k) = std::round(on(k) / t.size) * t.size;
    }
    x[i] = place<D>(random, on, t.a.center(), kind, i, block.cases[i].random);
  }
  climb_all(block, [&](int i, Rung* rung) { return code(side<D>(t.a, x[i], rung)); });
  for (int i = 0; i < kCasesPerBlock; ++i) {
    PredicateCase& c = block.cases[i];
    const Vector u = t.a.factor().inverse() * (x[i] - t.a.center());
    c.naive = sign_of(u.squaredNorm() - 1);
    c.triage = code(triage_side<D>(t.a, x[i]));
    c.interval = code(interval_side<D>(t.a, x[i]));
    if (depth.exact) c.exact = code(exact_side<D>(t.a, x[i]));
    if (depth.truth) c.truth = code(side_truth<D>(t.a, x[i]));
  }
}

/// A quadric of any kind and a point of its surface.
template <int D>
std::pair<BasicQuadric<D>, Eigen::Matrix<double, D, 1>> quadric(SeededRandom& random, Kind kind) {
  using Vector = Eigen::Matrix<double, D, 1>;
  Eigen::Matrix<double, D + 1, D + 1> q;
  for (;;) {
    const bool exact = kind == Kind::exact;
    for (int i = 0; i <= D; ++i)
      for (int j = i; j <= D; ++j) {
        const double s = kind == Kind::thin ? cases::log_uniform(random, -8, 8) : 1;
        q(i, j) = q(j, i) = exact ? random.integer(-9, 9) : s * random.uniform(-1, 1);
      }
    Vector x;
    const double offset = kind == Kind::far ? cases::log_uniform(random, 0, 8) : 1;
    for (int i = 0; i < D; ++i) x(i) = exact ? random.integer(-99, 99) : offset * random.uniform(-3, 3);
    // The constant term makes x a point of the surface.
    q(D, D) = 0;
    Eigen::Matrix<double, D + 1, 1> h;
    h << x, 1;
    q(D, D) = -h.dot(q * h);
    if (q.template topLeftCorner<D, D>().isZero(0)) continue;
    const int e = kind == Kind::scaled || exact ? random.integer(-240, 240) : 0;
    for (int i = 0; i <= D; ++i)
      for (int j = 0; j <= D; ++j) q(i, j) = std::ldexp(q(i, j), -e * ((i < D) + (j < D)));
    return {BasicQuadric<D>(q), Vector(x * std::ldexp(1.0, e))};
  }
}

template <int D>
void run_quadric(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  using Vector = Eigen::Matrix<double, D, 1>;
  SeededRandom random(320 + D, seed, number);
  const Kind kind = kind_of(number);
  const auto made = quadric<D>(random, kind);
  const BasicQuadric<D>& q = made.first;  // a lambda of clang 14 has no structured bindings
  const Vector& on = made.second;
  std::array<Vector, kCasesPerBlock> x;
  for (int i = 0; i < kCasesPerBlock; ++i)
    x[i] = place<D>(random, on, Vector::Zero(), kind, i, block.cases[i].random);
  climb_all(block, [&](int i, Rung* rung) { return code(side<D>(q, x[i], rung)); });
  for (int i = 0; i < kCasesPerBlock; ++i) {
    PredicateCase& c = block.cases[i];
    Eigen::Matrix<double, D + 1, 1> h;
    h << x[i], 1;
    c.naive = sign_of(h.dot(q.matrix() * h));
    c.triage = code(triage_side<D>(q, x[i]));
    c.interval = code(interval_side<D>(q, x[i]));
    if (depth.exact) c.exact = code(exact_side<D>(q, x[i]));
    if (depth.truth) c.truth = code(side_truth<D>(q, x[i]));
  }
}

/// A combination of two quadrics: the point lies on the first one and anywhere with regard to the second.
template <int D>
void run_combination(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  using Vector = Eigen::Matrix<double, D, 1>;
  SeededRandom random(330 + D, seed, number);
  const Kind kind = kind_of(number);
  const auto [first, on] = quadric<D>(random, kind);
  const auto [second, elsewhere] = quadric<D>(random, kind);
  const std::array<BasicQuadric<D>, 2> both{first, second};
  const std::span<const BasicQuadric<D>> members(both);
  std::array<Vector, kCasesPerBlock> x;
  for (int i = 0; i < kCasesPerBlock; ++i)
    x[i] = place<D>(random, random.coin() ? on : elsewhere, Vector::Zero(), kind, i, block.cases[i].random);
  climb_all(block, [&](int i, Rung* rung) { return code(side<D>(members, x[i], rung)); });
  for (int i = 0; i < kCasesPerBlock; ++i) {
    PredicateCase& c = block.cases[i];
    if (depth.exact) c.exact = std::max(code(exact_side<D>(first, x[i])), code(exact_side<D>(second, x[i])));
    if (depth.truth) c.truth = std::max(code(side_truth<D>(first, x[i])), code(side_truth<D>(second, x[i])));
  }
}

constexpr Subject kSubjects[] = {
    {"point, ellipsoid", run_body<3>, is_zero},
    {"point, ellipse", run_body<2>, is_zero},
    {"point, quadric", run_quadric<3>, is_zero},
    {"point, two quadrics", run_combination<3>, is_zero},
};

}  // namespace

std::span<const Subject> side_subjects() { return kSubjects; }

}  // namespace vericone::verify
