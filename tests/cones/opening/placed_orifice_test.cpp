// SPDX-License-Identifier: BSD-3-Clause
//
// Openings of any outline: what orifice_test.cpp asks of circles by their normal.
#include <gtest/gtest.h>
#include <vericone/cones/opening/orifice.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "cones/ellipsoids/print_answers.h"
#include "cones/opening/random_openings.h"
#include "support/campaign.h"

namespace vericone::placed_orifice_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using testing::least_over_rim, testing::moved_by_ulps, testing::random_placed, testing::RandomBodies,
    testing::rim_point, testing::share;
using Axes = Eigen::Matrix<double, 3, 2>;

struct Shares {
  std::array<int, 3> rung{}, transit{};
  int total() const { return rung[0] + rung[1] + rung[2]; }
  void print(const char* what) const {
    std::cout << "[ shares   ] " << what << ": triage " << rung[0] << ", interval " << rung[1] << ", exact "
              << rung[2] << "; passes " << transit[0] << ", grazes " << transit[1] << ", blocked "
              << transit[2] << '\n';
  }
};

/// Laws (1), (3) and (5) of orifice.h.
Transit checked(const OrificeOracle& oracle, const Vector3d& w, Shares* shares = nullptr) {
  const Transit exact = oracle.exact_transit(w);
  Rung rung{};
  EXPECT_EQ(oracle.transit(w, &rung), exact);
  EXPECT_EQ(oracle.triage_transit(w).value_or(exact), exact);
  EXPECT_EQ(oracle.interval_transit(w).value_or(exact), exact);
  EXPECT_EQ(oracle.triage_transit(w).has_value(), rung == Rung::triage);
  EXPECT_NE(oracle.triage_transit(w).value_or(Transit::blocked), Transit::grazes);
  EXPECT_NE(oracle.interval_transit(w).value_or(Transit::blocked), Transit::grazes);
  EXPECT_EQ(oracle.transit(0x1p-60 * w), exact) << "law (1)";
  EXPECT_EQ(oracle.transit(0x1p200 * w), exact) << "law (1)";
  if (exact != Transit::blocked) {
    EXPECT_EQ(oracle.transit(-w), Transit::blocked) << "law (5)";
  }
  if (shares) {
    ++shares->rung[static_cast<int>(rung)];
    ++shares->transit[static_cast<int>(exact)];
  }
  return exact;
}

Ellipsoid sphere(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

PlacedOpening scaled(const PlacedOpening& placed, double by_axes, double by_outline) {
  PlacedOpening r = placed;
  r.axes *= by_axes;
  r.center *= by_axes * by_outline;
  const Opening& o = placed.opening;
  if (o.polygonal()) {
    std::vector<Vector2d> p = o.vertices();
    for (Vector2d& v : p) v *= by_outline;
    r.opening = Opening::polygon(p);
  } else {
    r.opening = Opening::ellipse(o.semi_axes() * by_outline);
  }
  return r;
}

/// With the scales and reflections that change no answer, laws (2) and (4).
void expect(const Ellipsoid& agent, const PlacedOpening& placed, const Vector3d& w, Transit answer) {
  EXPECT_EQ(checked(OrificeOracle(agent, placed), w), answer);
  for (const double axes : {0x1p-240, -1.0, 0x1p-30, 0x1p200})
    for (const double outline : {0x1p-200, 1.0, 0x1p240})
      EXPECT_EQ(checked(OrificeOracle(agent.scaled(std::abs(axes) * outline),
                                      [&] {
                                        PlacedOpening p = scaled(placed, std::abs(axes), outline);
                                        if (axes < 0) p.axes.col(1) *= -1;  // the outline mirrored
                                        return p;
                                      }()),
                        w),
                axes < 0 ? OrificeOracle(agent,
                                         [&] {
                                           PlacedOpening p = placed;
                                           p.axes.col(1) *= -1;
                                           return p;
                                         }())
                               .exact_transit(w)
                         : answer)
          << axes << ' ' << outline;
}

PlacedOpening in_xy(Opening opening, const Vector3d& center) {
  return {std::move(opening), center, Axes::Identity()};
}

TEST(PlacedOrifice, SquaresExactly) {
  const Opening square = Opening::polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  const auto at = [&](double x, double y, double radius, const Vector3d& w) {
    return checked(OrificeOracle(sphere({x, y, -8}, radius), in_xy(square, {0, 0, 0})), w);
  };
  const Vector3d ahead(0, 0, 1);
  EXPECT_EQ(at(0, 0, 1, ahead), Transit::grazes) << "four edges";
  EXPECT_EQ(at(0.25, 0, 0.75, ahead), Transit::grazes) << "one edge";
  EXPECT_EQ(at(0.25, 0.25, 0.5, ahead), Transit::passes);
  EXPECT_EQ(at(3, 0, 0.5, ahead), Transit::blocked) << "the wall";
  EXPECT_EQ(at(3, 0, 2, ahead), Transit::blocked) << "touches the rim from outside";
  EXPECT_EQ(at(0, 0, 0.5, -ahead), Transit::blocked);
  EXPECT_EQ(at(0, 0, 0.5, {1, 0, 0}), Transit::blocked);
  for (int ulps = 1; ulps <= 8; ++ulps) {
    EXPECT_EQ(at(0, 0, moved_by_ulps(1, ulps), ahead), Transit::blocked);
    EXPECT_EQ(at(0, 0, moved_by_ulps(1, -ulps), ahead), Transit::passes);
    EXPECT_EQ(at(0.25, 0, moved_by_ulps(0.75, ulps), ahead), Transit::blocked);
    EXPECT_EQ(at(0.25, 0, moved_by_ulps(0.75, -ulps), ahead), Transit::passes);
    EXPECT_EQ(at(moved_by_ulps(0.25, ulps), 0, 0.75, ahead), Transit::blocked);
    EXPECT_EQ(at(0.25, 0, 0.75, {0x1p-56 * ulps, 0, 1}), Transit::blocked);
    EXPECT_EQ(at(0.25, 0, 0.75, {-0x1p-56 * ulps, 0, 1}), Transit::passes);
  }
  expect(sphere({0, 0, -8}, 1), in_xy(square, {0, 0, 0}), ahead, Transit::grazes);
  expect(sphere({0.5, 0, -8}, 0.25), in_xy(square, {0, 0, 0}), ahead, Transit::passes);
  expect(sphere({0.5, 0, -8}, 0.75), in_xy(square, {0, 0, 0}), ahead, Transit::blocked);
}

TEST(PlacedOrifice, AVertexThatJutsIn) {
  // The vertex (3, 4) is 5 from the origin, and its edges lead away.
  const auto notched = [](double x, double y) {
    return Opening::polygon({{-9, -9}, {9, -9}, {9, 4}, {x, y}, {3, 9}, {-9, 9}});
  };
  const auto at = [&](double x, double y, double radius) {
    return checked(OrificeOracle(sphere({0, 0, -20}, radius), in_xy(notched(x, y), {0, 0, 0})), {0, 0, 3});
  };
  EXPECT_FALSE(notched(3, 4).convex());
  EXPECT_EQ(at(3, 4, 5), Transit::grazes);
  for (int ulps = 1; ulps <= 8; ++ulps) {
    EXPECT_EQ(at(3, 4, moved_by_ulps(5, ulps)), Transit::blocked);
    EXPECT_EQ(at(3, 4, moved_by_ulps(5, -ulps)), Transit::passes);
    EXPECT_EQ(at(moved_by_ulps(3, ulps), 4, 5), Transit::passes);
    EXPECT_EQ(at(3, moved_by_ulps(4, -ulps), 5), Transit::blocked);
  }
  // In the arm beside it, and where the hull of the outline would let it pass.
  EXPECT_EQ(checked(OrificeOracle(sphere({6, 6, -20}, 1), in_xy(notched(3, 4), {0, 0, 0})), {0, 0, 1}),
            Transit::blocked);
  EXPECT_EQ(checked(OrificeOracle(sphere({6, 0, -20}, 3), in_xy(notched(3, 4), {0, 0, 0})), {0, 0, 1}),
            Transit::grazes);
}

TEST(PlacedOrifice, ACircleIsTheOneByItsNormal) {
  // (4, 0, -3) and (0, 5, 0) are five long: the opening of radius 5 in the wall with the normal (3, 0, 4).
  Axes tilted;
  tilted << 4, 0, 0, 5, -3, 0;
  const Vector3d w(0, 0, 1);
  const auto both = [&](const Ellipsoid& agent, const Vector3d& velocity) {
    const OrificeOracle placed(agent, {Opening::circle(1), {0, 0, 0}, tilted}),
        by_normal(agent, Orifice{{0, 0, 0}, {3, 0, 4}, 5});
    const Transit answer = checked(placed, velocity);
    EXPECT_EQ(by_normal.transit(velocity), answer);
    EXPECT_EQ(by_normal.side(), placed.side());
    return answer;
  };
  EXPECT_EQ(both(sphere({0, 0, -100}, 4), w), Transit::grazes);
  EXPECT_EQ(both(sphere({0, 2, -100}, 3), w), Transit::grazes);
  EXPECT_EQ(both(sphere({1, 0, -100}, 3), w), Transit::grazes);
  EXPECT_EQ(both(Ellipsoid::from_shape({0, 1.5, -100}, 12. * Matrix3d::Identity()), w), Transit::grazes);
  for (int ulps = 1; ulps <= 8; ++ulps) {
    EXPECT_EQ(both(sphere({0, 0, -100}, moved_by_ulps(4, ulps)), w), Transit::blocked);
    EXPECT_EQ(both(sphere({0, 0, -100}, moved_by_ulps(4, -ulps)), w), Transit::passes);
  }
  expect(sphere({0, 2, -100}, 3), {Opening::circle(1), {0, 0, 0}, tilted}, w, Transit::grazes);
  EXPECT_EQ(OrificeOracle(sphere({0, 0, 5}, 4), {Opening::circle(1), {0, 0, 0}, tilted}).side(),
            WallSide::touching);
  RandomBodies random(1920);
  SCOPED_TRACE(random.trace());
  std::array<int, 3> seen{};
  for (int i = 0; i < share(2000); ++i) {
    const Ellipsoid agent = random.ellipsoid(10 * random.direction() + random.in_box(2), 0.3, 4);
    ++seen[static_cast<int>(both(agent, random.uniform(0, 6) * random.direction() - agent.center()))];
  }
  EXPECT_GT(seen[0], share(100));
  EXPECT_GT(seen[2], share(100));
}

TEST(PlacedOrifice, EllipsesExactly) {
  const auto at = [&](const Vector2d& axes, double x, double y, double radius) {
    return checked(OrificeOracle(sphere({x, y, -20}, radius), in_xy(Opening::ellipse(axes), {0, 0, 0})),
                   {0, 0, 1});
  };
  EXPECT_EQ(at({4, 2}, 0, 0, 2), Transit::grazes) << "two points";
  EXPECT_EQ(at({4, 2}, 3, 0, 1), Transit::grazes) << "at the end, osculating: 2^2 / 4 = 1";
  EXPECT_EQ(at({4, 2}, 3.5, 0, 0.5), Transit::grazes);
  EXPECT_EQ(at({4, 2}, 2, 0, 2), Transit::blocked);
  for (int ulps = 1; ulps <= 8; ++ulps) {
    EXPECT_EQ(at({4, 2}, 0, 0, moved_by_ulps(2, ulps)), Transit::blocked);
    EXPECT_EQ(at({4, 2}, 0, 0, moved_by_ulps(2, -ulps)), Transit::passes);
    EXPECT_EQ(at({4, moved_by_ulps(2, ulps)}, 0, 0, 2), Transit::passes);
    EXPECT_EQ(at({4, moved_by_ulps(2, -ulps)}, 0, 0, 2), Transit::blocked);
    EXPECT_EQ(at({4, 2}, 3.5, 0, moved_by_ulps(0.5, ulps)), Transit::blocked);
  }
  // An ellipsoid that fills it: equal shadows, and one unit more or less.
  const auto filling = [&](const Vector3d& semi) {
    return checked(
        OrificeOracle(Ellipsoid::from_axes({0, 0, -20}, semi), in_xy(Opening::ellipse({4, 2}), {0, 0, 0})),
        {0, 0, 1});
  };
  EXPECT_EQ(filling({4, 2, 7}), Transit::grazes);
  EXPECT_EQ(filling({moved_by_ulps(4, 1), 2, 7}), Transit::blocked);
  EXPECT_EQ(filling({moved_by_ulps(4, -1), moved_by_ulps(2, -1), 7}), Transit::passes);
  expect(sphere({3, 0, -20}, 1), in_xy(Opening::ellipse({4, 2}), {0, 0, 0}), {0, 0, 1}, Transit::grazes);
}

/// Without shadows: the swept agent misses the rim iff the line through each rim point along w misses the
/// agent. Least squared distance in units of the agent, minus one. `through`: the centre line passes within.
struct BruteForce {
  double least;
  bool through;
};
BruteForce brute_force(const Ellipsoid& agent, const PlacedOpening& placed, const Vector3d& w) {
  const Matrix3d inverse = agent.factor().inverse();
  const Vector3d u = inverse * w;
  const double least = least_over_rim(
      [&](double t) {
        const Vector3d x = inverse * (rim_point(placed, t) - agent.center());
        return x.cross(u).squaredNorm() / u.squaredNorm();
      },
      placed.opening.polygonal() ? 32 * int(placed.opening.vertices().size()) : 360);
  Matrix3d own;
  own << placed.axes, w;
  const Vector3d meets = own.inverse() * (agent.center() - placed.center);
  return {least - 1, meets.z() < 0 && placed.opening.depth(meets.head<2>()) > 0};
}

TEST(PlacedOrifice, AgreesWithTheRimItself) {
  RandomBodies random(1921);
  SCOPED_TRACE(random.trace());
  for (const int kind : {0, 1, 2}) {
    Shares shares;
    int near = 0;
    for (int i = 0; i < share(3000); ++i) {
      const Ellipsoid agent = random.ellipsoid(random.in_box(5), i % 3 ? 0.1 : 0.01, 0.5);
      const PlacedOpening placed =
          random_placed(random, kind, agent.center() + random.uniform(1, 10) * random.direction());
      const OrificeOracle oracle(agent, placed);
      if (oracle.side() != WallSide::clear) continue;
      Vector3d w = placed.center + random.uniform(0, 1.2) * random.direction() - agent.center();
      if (i % 50 == 0) w = -w;
      const Transit answer = checked(oracle, w, &shares);
      const BruteForce brute = brute_force(agent, placed, w);
      if (std::abs(brute.least) < 1e-6) {
        ++near;
        continue;
      }
      ASSERT_EQ(answer, brute.least > 0 && brute.through ? Transit::passes : Transit::blocked)
          << "case " << i;
    }
    shares.print(kind == 0 ? "circles" : kind == 1 ? "ellipses" : "polygons");
    EXPECT_LT(near, 20);
    EXPECT_GT(shares.transit[0], share(150));
    EXPECT_GT(shares.transit[2], share(500));
    EXPECT_GT(shares.rung[0], shares.total() * 99 / 100);
  }
}

TEST(PlacedOrifice, RungsAgreeWithinRoundingsOfTheBoundary) {
  RandomBodies random(1922);
  SCOPED_TRACE(random.trace());
  for (const int kind : {0, 1, 2})
    for (const double low : {0.1, 1e-5}) {
      Shares shares;
      for (int i = 0; i < share(80); ++i) {
        const double scale = std::ldexp(1.0, random.integer(-200, 200));
        const Ellipsoid agent = random.ellipsoid(random.in_box(5), low, 1);
        PlacedOpening placed =
            random_placed(random, kind, agent.center() + random.uniform(3, 10) * random.direction());
        const Vector3d w = placed.center + 0.1 * random.direction() - agent.center();
        // The least size that passes.
        const auto oracle = [&](double size) {
          PlacedOpening sized = placed;
          sized.axes *= size * scale;
          sized.center *= scale;
          return OrificeOracle(agent.scaled(scale), sized);
        };
        if (oracle(1).side() != WallSide::clear) continue;
        double fails = 0.01, passes = 1e6;
        if (oracle(passes).transit(w) == Transit::blocked) continue;  // moves away
        while (moved_by_ulps(fails, 1) < passes) {
          const double mid = 0.5 * (fails + passes);
          (oracle(mid).transit(w) == Transit::blocked ? fails : passes) = mid;
        }
        for (const int ulps : {-64, -8, -1, 0, 1, 8, 64})
          checked(oracle(moved_by_ulps(passes, ulps)), w, &shares);
        if (HasFailure()) FAIL() << "case " << i;
      }
      shares.print(kind == 0 ? "circles near" : kind == 1 ? "ellipses near" : "polygons near");
      EXPECT_GT(shares.total(), share(100));
      EXPECT_GT(shares.transit[0] + shares.transit[1], share(50));
      EXPECT_GT(shares.transit[2], share(50));
    }
}

TEST(PlacedOrifice, ManyVerticesAreTheCircle) {
  constexpr int kVertices = 4096;
  std::vector<Vector2d> inner, outer;
  const double out = 1 / std::cos(std::numbers::pi / kVertices);
  for (int i = 0; i < kVertices; ++i) {
    const double t = 2 * std::numbers::pi * i / kVertices;
    inner.emplace_back((1 - 1e-12) * std::cos(t), (1 - 1e-12) * std::sin(t));
    outer.emplace_back(out * (1 + 1e-12) * std::cos(t), out * (1 + 1e-12) * std::sin(t));
  }
  const Opening inscribed = Opening::polygon(inner), circumscribed = Opening::polygon(outer);
  EXPECT_TRUE(inscribed.convex());
  RandomBodies random(1923);
  SCOPED_TRACE(random.trace());
  int differ = 0, passes = 0;
  for (int i = 0; i < share(800); ++i) {
    const Ellipsoid agent = random.ellipsoid(random.in_box(5), 0.05, 0.9);
    PlacedOpening placed =
        random_placed(random, 0, agent.center() + random.uniform(2, 8) * random.direction());
    placed.opening = Opening::circle(1);
    const Vector3d w = placed.center + 0.3 * random.direction() - agent.center();
    const auto of = [&](const Opening& opening) {
      placed.opening = opening;
      return OrificeOracle(agent, placed).transit(w) == Transit::passes;
    };
    const bool small = of(inscribed), circle = of(Opening::circle(1)), large = of(circumscribed);
    ASSERT_LE(small, circle) << "case " << i;
    ASSERT_LE(circle, large) << "case " << i;
    differ += small != large;
    passes += circle;
  }
  EXPECT_GT(passes, share(50));
  EXPECT_LE(differ, 2);
}

TEST(PlacedOrifice, BadInput) {
  const Ellipsoid agent = sphere({0, 0, 0}, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto field = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const InputError& e) {
      return e.field();
    }
    return "none";
  };
  PlacedOpening placed = in_xy(Opening::circle(1), {0, 0, 9});
  EXPECT_EQ(field([&] { (void)OrificeOracle(agent, placed).transit({0, nan, 0}); }), "agent_velocity[1]");
  placed.axes.col(1).setZero();
  EXPECT_EQ(field([&] { OrificeOracle(agent, placed); }), "orifice.axes");
  placed.axes(0, 1) = nan;
  EXPECT_EQ(field([&] { OrificeOracle(agent, placed); }), "orifice.axes[1][0]");
  placed.center.x() = nan;
  EXPECT_EQ(field([&] { OrificeOracle(agent, placed); }), "orifice.center[0]");
}

}  // namespace
}  // namespace vericone::placed_orifice_test
