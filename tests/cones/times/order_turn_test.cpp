// SPDX-License-Identifier: BSD-3-Clause
//
// Order of two tangent directions.
#include <gtest/gtest.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/cones/times/order.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/LU>

#include "cones/ellipsoids/exact_tangency.h"
#include "cones/times/order_rungs.h"
#include "support/campaign.h"

namespace vericone::order_turn_test {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using testing::as_sign, testing::ExactTangency, testing::operator-, testing::RandomBodies, testing::Real,
    testing::Rungs, testing::share;

/// The direction with 80 digits: the root of g in an angle-free form by bisection from a separating normal.
struct WideDirection {
  Real x, y;

  explicit WideDirection(const TangentRef& t) {
    const auto sa = exact::defining_shape<2>(t.a), sb = exact::defining_shape<2>(t.b);
    const Real cx = Real(t.b.center().x()) - Real(t.a.center().x()),
               cy = Real(t.b.center().y()) - Real(t.a.center().y());
    const auto rho = [](const exact::RationalMatrix<2>& s, const Real& nx, const Real& ny) {
      return Real(sqrt(Real(s[0][0]) * nx * nx + 2 * Real(s[0][1]) * nx * ny + Real(s[1][1]) * ny * ny));
    };
    const auto gap = [&](const Real& nx, const Real& ny) {
      return Real(nx * cx + ny * cy - rho(sa, nx, ny) - rho(sb, nx, ny));
    };
    const Vector2d n0 = ContactFrame<2>(t.a, t.b).separating_normal().normalized();
    // n = c + tau c', c' = c turned by +90 degrees: n.c > 0 on all of { g >= 0 }, whose ends are sought.
    const auto at = [&](const Real& tau) { return gap(cx - tau * cy, cy + tau * cx); };
    const Real side = t.left ? -1 : 1;
    Real lo = (Real(n0.y()) * cx - Real(n0.x()) * cy) / (Real(n0.x()) * cx + Real(n0.y()) * cy), step = side;
    while (at(lo + step) > 0) step *= 2;
    Real hi = lo + step;
    for (int i = 0; i < 270; ++i) {
      const Real mid = (lo + hi) / 2;
      (at(mid) > 0 ? lo : hi) = mid;
    }
    x = side * (cy + lo * cx);
    y = -side * (cx - lo * cy);
  }
};

Sign wide_turn(const TangentRef& p, const TangentRef& q) {
  const WideDirection d(p), e(q);
  const Real cross = d.x * e.y - d.y * e.x, size = sqrt((d.x * d.x + d.y * d.y) * (e.x * e.x + e.y * e.y));
  if (abs(cross) < size * Real("1e-65")) return Sign::zero;
  return cross > 0 ? Sign::positive : Sign::negative;
}

Ellipse circle(double x, double y, double r) { return Ellipse::from_axes({x, y}, {r, r}); }

TEST(Turn, CirclesWithKnownTangents) {
  // Directions at 30 degrees to the line of centres.
  const TangentRef left{circle(0, 0, 1), circle(4, 0, 1), true}, right{left.a, left.b, false};
  const TangentRef up{circle(7, 5, 2), circle(7, 13, 2), true},
      narrow{circle(0, 0, 1), circle(5, 0, 1), true};
  EXPECT_EQ(turn(left, right), Sign::negative);
  EXPECT_EQ(turn(right, left), Sign::positive);
  EXPECT_EQ(turn(left, up), Sign::positive);
  EXPECT_EQ(turn(right, up), Sign::positive);  // 150 degrees
  EXPECT_EQ(turn(left, narrow), Sign::negative);
  Rung rung = Rung::triage;
  EXPECT_EQ(turn(left, left, &rung), Sign::zero);
  EXPECT_EQ(rung, Rung::exact);
  EXPECT_FALSE(opposed(left, left));
  EXPECT_FALSE(opposed(left, right));
  // Exchanged bodies: the same line the other way.
  const TangentRef back{left.b, left.a, true};
  EXPECT_EQ(turn(left, back), Sign::zero);
  EXPECT_TRUE(opposed(left, back));
  // A right angle apart in total: 30 + 60; the tangents of (1, sqrt 3) are parallel to one of these only.
  const TangentRef slanted{circle(0, 0, 1), circle(0, 2, 1), true};
  EXPECT_EQ(turn(left, slanted), Sign::positive);
}

TEST(Turn, TouchingAndOverlappingBodies) {
  // Both edges lie in the common tangent x = 1.
  const Ellipse a = circle(0, 0, 1), b = circle(3, 0, 2);
  const TangentRef left{a, b, true}, right{a, b, false}, other{circle(0, 0, 1), circle(4, 0, 1), true};
  EXPECT_EQ(turn(left, right), Sign::zero);
  EXPECT_TRUE(opposed(left, right));
  EXPECT_FALSE(opposed(left, left));
  EXPECT_EQ(turn(left, other), Sign::negative);
  EXPECT_EQ(turn(right, other), Sign::positive);
  EXPECT_THROW((void)turn({a, circle(1, 0, 1), true}, left), InputError);
  EXPECT_THROW((void)turn(left, {a, circle(1, 0, 1), true}), InputError);
}

TEST(Turn, RandomPairsAgreeWithEightyDigits) {
  RandomBodies random(701);
  SCOPED_TRACE(random.trace());
  for (const double low : {1.0, 1e-3}) {
    Rungs rungs;
    for (int i = 0; i < share(60); ++i) {
      TangentRef t[2];
      for (TangentRef& r : t) {
        std::tie(r.a, r.b) =
            random.planar_scaled_from_touching(low, 10 * low * (1 / low), random.uniform(1.01, 4));
        r.left = random.coin();
      }
      ASSERT_EQ(rungs.turn(t[0], t[1]), wide_turn(t[0], t[1])) << "case " << i;
      ASSERT_EQ(vericone::turn({t[0].b, t[0].a, t[0].left}, t[1]), -vericone::turn(t[0], t[1])) << "law (2)";
      const auto moved = [&](const TangentRef& r, double scale) {
        return TangentRef{r.a.scaled(scale), r.b.scaled(scale), r.left};
      };
      for (const double scale : {0x1p-480, 0x1p480})
        ASSERT_EQ(vericone::turn(moved(t[0], scale), t[1]), vericone::turn(t[0], t[1])) << "law (3)";
      // Against the directions of the construction.
      const auto direction = [](const TangentRef& r) {
        const Sector s = sector_by_support(r.a, r.b);
        return r.left ? s.left.direction : s.right.direction;
      };
      const Vector2d d = direction(t[0]), e = direction(t[1]);
      const double cross = d.x() * e.y() - d.y() * e.x();
      if (std::abs(cross) > 1e-9) {
        ASSERT_EQ(vericone::turn(t[0], t[1]), as_sign(cross)) << "case " << i;
      }
    }
    rungs.print("turn, random, axes from " + std::to_string(low));
    EXPECT_GT(rungs.by[0], share(50));
  }
}

/// A pair with the inner tangent of direction M (side, 0), from integers; `left` says which of the two it is.
TangentRef tangent_along(RandomBodies& random, const Matrix2d& m, double scale) {
  for (;;) {
    Matrix2d ga, gb;
    const int ka = random.integer(1, 4), kb = random.integer(1, 4);
    ga << random.integer(-4, 4), random.integer(-4, 4), 0, ka;
    gb << random.integer(-4, 4), random.integer(-4, 4), 0, kb;
    if (ga(0, 0) == 0 || gb(0, 0) == 0) continue;
    const Matrix2d sa = ga * ga.transpose(), sb = gb * gb.transpose();
    const Vector2d c(random.integer(-20, 20), ka + kb);
    // q = c - S_A n / k_A - S_B n / k_B for n = (0, 1).
    const double along = ka * kb * c.x() - kb * sa(0, 1) - ka * sb(0, 1);
    if (along == 0) continue;
    const Vector2d home(random.integer(-9, 9), random.integer(-9, 9));
    const auto body = [&](const Matrix2d& s, const Vector2d& center) {
      return Ellipse::from_shape(scale * (m * center), scale * scale * (m * s * m.transpose()));
    };
    return {body(sa, home), body(sb, home + c), (along < 0) == (m.determinant() > 0)};
  }
}

TEST(Turn, ParallelTangentsFromIntegersAndTheirNeighbours) {
  RandomBodies random(702);
  SCOPED_TRACE(random.trace());
  Rungs ties, near;
  int neighbours[3] = {};
  for (int i = 0; i < share(120); ++i) {
    Matrix2d m;
    do {
      for (int k = 0; k < 4; ++k) m(k) = random.integer(-5, 5);
    } while (m.determinant() == 0);
    const double scale = i % 3 == 0 ? 0x1p-200 : i % 3 == 1 ? 1 : 0x1p200;
    const TangentRef p = tangent_along(random, m, 1), q = tangent_along(random, m, scale);
    ASSERT_EQ(ties.turn(p, q), Sign::zero) << "case " << i;
    const auto ahead = [](const TangentRef& t) {
      const Sector s = sector_by_support(t.a, t.b);
      return t.left ? s.left.direction : s.right.direction;
    };
    ASSERT_EQ(opposed(p, q), ahead(p).dot(ahead(q)) < 0);
    TangentRef moved = q;
    Vector2d center = q.b.center();
    for (int k = 0; k < 2; ++k)
      if (center(k) != 0) center(k) = testing::moved_by_ulps(center(k), random.integer(-8, 8));
    moved.b = Ellipse::from_shape(center, q.b.shape());
    const Sign s = near.turn(p, moved);
    ASSERT_EQ(s, wide_turn(p, moved)) << "case " << i;
    ++neighbours[static_cast<int>(s) + 1];
  }
  ties.print("turn, parallel");
  near.print("turn, neighbours of parallel");
  EXPECT_EQ(ties.by[2], ties.cases);
  EXPECT_GT(neighbours[0], share(20));
  EXPECT_GT(neighbours[2], share(20));
}

TEST(Turn, EveryRungDecides) {
  // The same pair with one circle grown by a part in 2^k: the tangent opens by about as much.
  struct Case {
    double part;
    Rung rung;
  };
  for (const Case& c :
       {Case{0x1p-10, Rung::triage}, Case{0x1p-40, Rung::interval}, Case{0x1p-52, Rung::exact}}) {
    const TangentRef p{circle(0, 0, 1), circle(5, 1, 2), true}, q{p.a, circle(5, 1, 2 * (1 + c.part)), true};
    Rung rung = Rung::triage;
    EXPECT_EQ(turn(p, q, &rung), Sign::positive) << c.part;
    EXPECT_EQ(rung, c.rung) << c.part;
    EXPECT_EQ(turn({p.a, p.b, false}, {q.a, q.b, false}, &rung), Sign::negative) << c.part;
    EXPECT_EQ(rung, c.rung) << c.part;
    Rungs().turn(p, q);
  }
}

TEST(Turn, LinearMapsWithPositiveDeterminant) {
  RandomBodies random(703);
  SCOPED_TRACE(random.trace());
  const auto small = [&] {
    for (;;) {
      Matrix2d ga, gb;
      for (Matrix2d* g : {&ga, &gb})
        for (int k = 0; k < 4; ++k) (*g)(k) = random.integer(-6, 6);
      if (ga.determinant() == 0 || gb.determinant() == 0) continue;
      const Ellipse a = Ellipse::from_shape({random.integer(-20, 20), random.integer(-20, 20)},
                                            ga * ga.transpose()),
                    b = Ellipse::from_shape({random.integer(-20, 20), random.integer(-20, 20)},
                                            gb * gb.transpose());
      if (relation<2>(a, b) != Relation::overlapping) return TangentRef{a, b, random.coin()};
    }
  };
  for (int i = 0; i < 200; ++i) {
    const TangentRef p = small(), q = small();
    Matrix2d m;
    do {
      for (int k = 0; k < 4; ++k) m(k) = random.integer(-5, 5);
    } while (m.determinant() <= 0);
    const auto image = [&](const TangentRef& t) {
      const auto body = [&](const Ellipse& e) {
        return Ellipse::from_shape(m * e.center(), m * e.shape() * m.transpose());
      };
      return TangentRef{body(t.a), body(t.b), t.left};
    };
    ASSERT_EQ(turn(image(p), image(q)), turn(p, q)) << "case " << i;
    ASSERT_EQ(turn(p, {q.a.translated({3, -5}), q.b.translated({3, -5}), q.left}), turn(p, q))
        << "case " << i;
  }
}

}  // namespace
}  // namespace vericone::order_turn_test
