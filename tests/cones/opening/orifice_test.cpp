// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/opening/orifice.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/opening/facing_orifice.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <iostream>
#include <limits>
#include <numbers>

#include "cones/ellipsoids/print_answers.h"
#include "support/campaign.h"

namespace vericone::orifice_test {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using testing::moved_by_ulps, testing::RandomBodies, testing::share;

struct Shares {
  std::array<int, 3> rung{}, transit{};
  int total() const { return rung[0] + rung[1] + rung[2]; }
  void print(const char* what) const {
    std::cout << "[ shares   ] " << what << ": triage " << rung[0] << ", interval " << rung[1] << ", exact "
              << rung[2] << "; passes " << transit[0] << ", grazes " << transit[1] << ", blocked "
              << transit[2] << '\n';
  }
};

/// Laws (1) and (3), and (5).
Transit checked(const OrificeOracle& oracle, const Vector3d& w, Shares* shares = nullptr) {
  const Transit exact = oracle.exact_transit(w);
  Rung rung{};
  EXPECT_EQ(oracle.transit(w, &rung), exact);
  EXPECT_EQ(oracle.triage_transit(w).value_or(exact), exact);
  EXPECT_EQ(oracle.interval_transit(w).value_or(exact), exact);
  EXPECT_EQ(oracle.triage_transit(w).has_value(), rung == Rung::triage);
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

void expect(const Ellipsoid& agent, const Orifice& orifice, const Vector3d& w, Transit answer, Rung by) {
  const OrificeOracle oracle(agent, orifice);
  EXPECT_EQ(checked(oracle, w), answer);
  Rung rung{};
  oracle.transit(w, &rung);
  EXPECT_EQ(rung, by);
  for (const double scale : {0x1p-490, 0x1p-40, 0x1p490}) {
    const Orifice large{scale * orifice.center, -scale * orifice.normal, scale * orifice.radius};
    EXPECT_EQ(checked(OrificeOracle(agent.scaled(scale), large), w), answer) << "laws (2), (4): " << scale;
  }
}

Ellipsoid sphere(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

TEST(Orifice, EveryRung) {
  const Ellipsoid agent = sphere({0, 0, 0}, 1);
  const Orifice facing{{10, 0, 0}, {1, 0, 0}, 3};
  expect(agent, facing, {1, 0, 0}, Transit::passes, Rung::triage);
  expect(agent, facing, {1, 0.1, 0}, Transit::passes, Rung::triage);
  expect(agent, facing, {1, 0.25, 0}, Transit::blocked, Rung::triage);  // cuts the rim
  expect(agent, facing, {1, 2, 0}, Transit::blocked, Rung::triage);     // hits the wall
  expect(agent, facing, {-1, 0, 0}, Transit::blocked, Rung::triage);    // moves away
  expect(agent, facing, {0, 0, 0}, Transit::blocked, Rung::triage);
  expect(agent, facing, {0, 1, 0}, Transit::blocked, Rung::exact);  // along the wall
  // The same size: only straight ahead, touching all around.
  const Orifice tight{{10, 0, 0}, {1, 0, 0}, 1};
  expect(agent, tight, {1, 0, 0}, Transit::grazes, Rung::exact);
  expect(agent, tight, {1, 0x1p-500, 0}, Transit::blocked, Rung::exact);
  expect(agent, {{10, 0, 0}, {1, 0, 0}, moved_by_ulps(1, 1)}, {1, 0, 0}, Transit::passes, Rung::exact);
  expect(agent, {{10, 0, 0}, {1, 0, 0}, moved_by_ulps(1, -1)}, {1, 0, 0}, Transit::blocked, Rung::exact);
  expect(agent, {{10, 0, 0}, {1, 0, 0}, 1 + 0x1p-43}, {1, 0, 0}, Transit::passes, Rung::interval);
  expect(agent, {{10, 0, 0}, {1, 0, 0}, 1 - 0x1p-49}, {1, 0, 0}, Transit::blocked, Rung::interval);
}

TEST(Orifice, OffCentreInAFacingWall) {
  // w along the normal: the shadows are discs, the agent's of radius 1 and off centre by 5.
  const auto at = [](double radius, const Vector3d& center) {
    return OrificeOracle(sphere(center, 1), {{0, 0, 10}, {0, 0, 7}, radius});
  };
  EXPECT_EQ(checked(at(6, {3, 4, 0}), {0, 0, 1}), Transit::grazes);
  EXPECT_EQ(checked(at(14, {5, 12, 0}), {0, 0, 3}), Transit::grazes);
  for (int ulps = 1; ulps <= 8; ++ulps) {
    EXPECT_EQ(checked(at(moved_by_ulps(6, ulps), {3, 4, 0}), {0, 0, 1}), Transit::passes);
    EXPECT_EQ(checked(at(moved_by_ulps(6, -ulps), {3, 4, 0}), {0, 0, 1}), Transit::blocked);
    EXPECT_EQ(checked(at(6, {3, moved_by_ulps(4, ulps), 0}), {0, 0, 1}), Transit::blocked);
    EXPECT_EQ(checked(at(6, {3, moved_by_ulps(4, -ulps), 0}), {0, 0, 1}), Transit::passes);
    EXPECT_EQ(checked(at(6, {3, 4, 0}), {0, -0x1p-50 * ulps, 1}), Transit::passes)
        << "drifting back to the axis";
    EXPECT_EQ(checked(at(6, {3, 4, 0}), {0, 0x1p-50 * ulps, 1}), Transit::blocked);
  }
}

TEST(Orifice, TiltedWall) {
  // Normal (3, 0, 4)/5 and w = e_z: the opening's shadow has semi-axes 4/5 r along x and r along y.
  const auto at = [](double offset_x, double offset_y, double agent_radius) {
    return OrificeOracle(sphere({offset_x, offset_y, -100}, agent_radius), {{0, 0, 0}, {3, 0, 4}, 5});
  };
  const Vector3d w(0, 0, 1);
  EXPECT_EQ(checked(at(0, 0, 4), w), Transit::grazes) << "touches the rim at two points";
  EXPECT_EQ(checked(at(0, 0, 4.5), w), Transit::blocked) << "smaller than the opening, cuts its rim";
  EXPECT_EQ(facing_orifice_transit({0, 0, 100}, 4.5, 5, w), Transit::passes) << "what (2.2) says of it";
  EXPECT_EQ(checked(at(0, 2, 3), w), Transit::grazes) << "3.2 curved, 3 at the long end";
  EXPECT_EQ(checked(at(0, -2, 3), w), Transit::grazes);
  EXPECT_EQ(checked(at(1, 0, 3), w), Transit::grazes);
  EXPECT_EQ(checked(at(1, 0, 2.5), w), Transit::passes);
  EXPECT_EQ(checked(at(1, 1, 3), w), Transit::blocked);
  // Two points off the centre: r^2 = 16 (1 - h^2/9) on the axis of the longer one; h = 9/5: r = 16/5.
  const Ellipsoid two = Ellipsoid::from_shape({0, 1.5, -100}, 12. * Matrix3d::Identity());  // h = 3/2
  EXPECT_EQ(checked(OrificeOracle(two, {{0, 0, 0}, {3, 0, 4}, 5}), w), Transit::grazes);
  for (int ulps = 1; ulps <= 8; ++ulps) {
    for (const int sign : {-1, 1}) {
      const Transit expected = sign > 0 ? Transit::blocked : Transit::passes;
      EXPECT_EQ(checked(at(0, 0, moved_by_ulps(4, sign * ulps)), w), expected);
      const Ellipsoid near =
          Ellipsoid::from_shape(two.center(), moved_by_ulps(12, sign * ulps) * Matrix3d::Identity());
      EXPECT_EQ(checked(OrificeOracle(near, {{0, 0, 0}, {3, 0, 4}, 5}), w), expected);
    }
  }
}

TEST(Orifice, EllipsoidsExactlyTangent) {
  // An ellipsoid whose shadow along w = e_x is an axis-aligned ellipse with semi-axes 2 and 4.
  const Ellipsoid agent = Ellipsoid::from_axes({0, 0, 0}, {8, 2, 4});
  const auto at = [&](double y, double radius) {
    return checked(OrificeOracle(agent, {{20, y, 0}, {5, 0, 0}, radius}), {1, 0, 0});
  };
  EXPECT_EQ(at(0, 4), Transit::grazes) << "two points";
  EXPECT_EQ(at(0, 4 + 0x1p-30), Transit::passes);
  EXPECT_EQ(at(0, 4 - 0x1p-30), Transit::blocked);
  // The farthest point from (y, 0) on the ellipse: r^2 = 16 (1 + y^2/12) while y <= 6.
  EXPECT_EQ(at(3, std::sqrt(28.) - 1e-9), Transit::blocked);
  EXPECT_EQ(at(3, std::sqrt(28.) + 1e-9), Transit::passes);
  EXPECT_EQ(at(6, 8), Transit::grazes) << "osculating: y = 6, r = 8";
  EXPECT_EQ(at(8, 10), Transit::grazes) << "curved more than the opening";
  EXPECT_EQ(at(5, 7), Transit::blocked) << "tangent at the point on the axis, curved less there";
}

TEST(Orifice, SideOfTheWall) {
  const Orifice orifice{{0, 0, 0}, {3, 0, 4}, 5};
  const auto side = [&](const Vector3d& center, double radius) {
    return OrificeOracle(sphere(center, radius), orifice).side();
  };
  EXPECT_EQ(side({0, 0, 5}, 4), WallSide::touching);
  EXPECT_EQ(side({0, 0, -5}, 4), WallSide::touching);
  EXPECT_EQ(side({0, 0, 5}, moved_by_ulps(4, 1)), WallSide::cut);
  EXPECT_EQ(side({0, 0, 5}, moved_by_ulps(4, -1)), WallSide::clear);
  EXPECT_EQ(side({4, 0, -3}, 1), WallSide::cut) << "centre in the plane";
  // Touching the plane, one still passes; cut by it, none does.
  const Orifice facing{{0, 0, 0}, {0, 0, 1}, 2};
  const OrificeOracle touching(sphere({0, 0, -1}, 1), facing), cut(sphere({0, 0, -0.5}, 1), facing);
  EXPECT_EQ(checked(touching, {0, 0, 1}), Transit::passes);
  EXPECT_EQ(checked(touching, {0, 0, -1}), Transit::blocked);
  EXPECT_EQ(checked(cut, {0, 0, 1}), Transit::blocked);
  EXPECT_EQ(checked(cut, {0, 0, -1}), Transit::blocked);
}

/// Without shadows: the swept agent misses the rim iff the line through each rim point along w misses the
/// agent, by the quadric's value at its closest point. Least value over the rim, minus one: negative where
/// the rim is cut. `through`: whether the centre line passes within the opening.
struct BruteForce {
  double least;
  bool through;
};
BruteForce brute_force(const Ellipsoid& agent, const Orifice& orifice, const Vector3d& w) {
  const Vector3d n = orifice.normal.normalized(), e = n.unitOrthogonal(), f = n.cross(e);
  const Matrix3d inverse = agent.factor().inverse();
  const Vector3d u = inverse * w;  // the agent is the unit ball here
  const auto distance2 = [&](double t) {
    const Vector3d rim = orifice.center + orifice.radius * (std::cos(t) * e + std::sin(t) * f);
    const Vector3d x = inverse * (rim - agent.center());
    return x.cross(u).squaredNorm() / u.squaredNorm();
  };
  double best = 0, least = distance2(0);
  constexpr int kSamples = 720;
  for (int i = 1; i < kSamples; ++i) {
    const double t = 2 * std::numbers::pi * i / kSamples;
    if (distance2(t) < least) {
      least = distance2(t);
      best = t;
    }
  }
  for (double step = std::numbers::pi / kSamples; step > 1e-9; step *= 0.5)
    for (const double t : {best - step, best + step})
      if (distance2(t) < least) {
        least = distance2(t);
        best = t;
      }
  const Vector3d c = orifice.center - agent.center();
  const double time = n.dot(c) / n.dot(w);
  return {least - 1, time > 0 && (time * w - c).norm() < orifice.radius};
}

TEST(Orifice, AgreesWithTheRimItself) {
  RandomBodies random(911);
  SCOPED_TRACE(random.trace());
  Shares shares;
  int near = 0;
  for (int i = 0; i < share(10000); ++i) {
    const double low = i % 3 == 0 ? 0.01 : 0.3;
    const Ellipsoid agent =
        i % 2 ? sphere(random.in_box(5), random.uniform(low, 1)) : random.ellipsoid(random.in_box(5), low, 1);
    const Orifice orifice{agent.center() + random.uniform(2, 10) * random.direction(),
                          random.log_uniform(1e-3, 1e3) * random.direction(), random.uniform(0.5, 3)};
    const OrificeOracle oracle(agent, orifice);
    if (oracle.side() != WallSide::clear) continue;
    const Vector3d w =
        orifice.center + random.uniform(0, 1.2) * orifice.radius * random.direction() - agent.center();
    const Transit answer = checked(oracle, i % 50 ? w : Vector3d(-w), &shares);
    const BruteForce brute = brute_force(agent, orifice, i % 50 ? w : Vector3d(-w));
    if (std::abs(brute.least) < 1e-6) {
      ++near;
      continue;
    }
    ASSERT_EQ(answer, brute.least > 0 && brute.through ? Transit::passes : Transit::blocked) << "case " << i;
  }
  shares.print("random agents and openings");
  EXPECT_LT(near, 50);
  EXPECT_GT(shares.transit[0], share(1000));
  EXPECT_GT(shares.transit[2], 1000);
  EXPECT_GT(shares.rung[0], shares.total() * 999 / 1000);
}

TEST(Orifice, RungsAgreeWithinRoundingsOfTheBoundary) {
  RandomBodies random(912);
  SCOPED_TRACE(random.trace());
  for (const double low : {0.3, 1e-5}) {
    Shares shares;
    for (int i = 0; i < share(150); ++i) {
      const double scale = std::ldexp(1.0, random.integer(-400, 400));
      const Ellipsoid agent = random.ellipsoid(random.in_box(5), low, 1);
      const Vector3d center = agent.center() + random.uniform(3, 10) * random.direction(),
                     normal = random.direction();
      const Vector3d w = center + 0.3 * random.direction() - agent.center();
      const auto oracle = [&](double radius) {
        return OrificeOracle(agent.scaled(scale), {scale * center, normal, scale * radius});
      };
      if (oracle(1).side() != WallSide::clear) continue;
      double fails = 0.01, passes = 1e6;
      if (oracle(passes).transit(w) == Transit::blocked) continue;  // moves away
      while (moved_by_ulps(fails, 1) < passes) {
        const double mid = 0.5 * (fails + passes);
        (oracle(mid).transit(w) == Transit::blocked ? fails : passes) = mid;
      }
      for (const int ulps : {-8, -1, 0, 1, 8}) {
        const double radius = moved_by_ulps(passes, ulps);
        const Transit answer = checked(oracle(radius), w, &shares);
        ASSERT_EQ(answer == Transit::blocked, ulps < 0) << "case " << i << ", ulps " << ulps;
      }
      if (HasFailure()) FAIL() << "case " << i;
    }
    shares.print("within 8 ulps of the boundary");
    EXPECT_GT(shares.total(), share(200));
  }
}

TEST(Orifice, BadInput) {
  const Ellipsoid agent = sphere({0, 0, 0}, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto field = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const InputError& e) {
      return e.field();
    }
    return "none";
  };
  EXPECT_EQ(field([&] { OrificeOracle(agent, {{0, nan, 9}, {0, 0, 1}, 1}); }), "orifice.center[1]");
  EXPECT_EQ(field([&] { OrificeOracle(agent, {{0, 0, 9}, {0, 0, inf}, 1}); }), "orifice.normal[2]");
  EXPECT_EQ(field([&] { OrificeOracle(agent, {{0, 0, 9}, {0, 0, 0}, 1}); }), "orifice.normal");
  EXPECT_EQ(field([&] { OrificeOracle(agent, {{0, 0, 9}, {0, 0, 1}, 0}); }), "orifice.radius");
  EXPECT_EQ(field([&] { OrificeOracle(agent, {{0, 0, 9}, {0, 0, 1}, inf}); }), "orifice.radius");
  const OrificeOracle oracle(agent, {{0, 0, 9}, {0, 0, 1}, 2});
  EXPECT_EQ(field([&] { oracle.transit({nan, 0, 1}); }), "agent_velocity[0]");
  EXPECT_EQ(field([&] { facing_orifice_transit({0, 0, 9}, -1, 2, {0, 0, 1}); }), "agent_radius");
  EXPECT_EQ(field([&] { facing_orifice_transit({0, 0, 9}, 1, nan, {0, 0, 1}); }), "opening_radius");
  EXPECT_EQ(field([&] { facing_orifice_transit({0, inf, 9}, 1, 2, {0, 0, 1}); }), "center_line[1]");
  EXPECT_EQ(field([&] { facing_orifice_transit({0, 0, 9}, 1, 2, {0, 0, nan}); }), "agent_velocity[2]");
}

Transit checked_facing(const Vector3d& c, double ra, double rb, const Vector3d& w, Rung by) {
  const Transit exact = exact_facing_orifice_transit(c, ra, rb, w);
  Rung rung{};
  EXPECT_EQ(facing_orifice_transit(c, ra, rb, w, &rung), exact);
  EXPECT_EQ(rung, by);
  EXPECT_EQ(triage_facing_orifice_transit(c, ra, rb, w).value_or(exact), exact);
  EXPECT_EQ(interval_facing_orifice_transit(c, ra, rb, w).value_or(exact), exact);
  for (const double s : {0x1p-400, 0x1p400})
    EXPECT_EQ(facing_orifice_transit(s * c, s * ra, s * rb, w / s), exact);
  return exact;
}

TEST(FacingOrifice, EveryRung) {
  // |c x w| = 3 |w| for c = (3, 4, 0), w = (0, 1, 0).
  const Vector3d c(3, 4, 0), w(0, 1, 0);
  EXPECT_EQ(checked_facing(c, 1, 5, w, Rung::triage), Transit::passes);
  EXPECT_EQ(checked_facing(c, 1, 3, w, Rung::triage), Transit::blocked);
  EXPECT_EQ(checked_facing(c, 1, 5, -w, Rung::triage), Transit::blocked);
  EXPECT_EQ(checked_facing(c, 5, 1, w, Rung::triage), Transit::blocked) << "larger than the opening";
  EXPECT_EQ(checked_facing(c, 1, 4, w, Rung::exact), Transit::grazes);
  for (int ulps = 1; ulps <= 8; ++ulps) {
    EXPECT_EQ(exact_facing_orifice_transit(c, 1, moved_by_ulps(4, ulps), w), Transit::passes);
    EXPECT_EQ(facing_orifice_transit(c, 1, moved_by_ulps(4, ulps), w), Transit::passes);
    EXPECT_EQ(exact_facing_orifice_transit(c, 1, moved_by_ulps(4, -ulps), w), Transit::blocked);
    EXPECT_EQ(facing_orifice_transit(c, 1, moved_by_ulps(4, -ulps), w), Transit::blocked);
  }
  // Far away: |c x w| / |w| = 9/5 is what remains of 2.4e4.
  const Vector3d far(30000, 40003, 0), toward(3, 4, 0);
  EXPECT_EQ(checked_facing(far, 1, 2.8 + 0x1p-24, toward, Rung::interval), Transit::passes);
  EXPECT_EQ(checked_facing(far, 1, 2.8 - 0x1p-24, toward, Rung::interval), Transit::blocked);
  EXPECT_EQ(checked_facing(c, 2, 2, c, Rung::exact), Transit::grazes);
  EXPECT_EQ(checked_facing({1, 1, 0}, 1, 3, {1, -1, 0}, Rung::exact), Transit::blocked);
}

TEST(FacingOrifice, CallsSafeWhatCutsATiltedRim) {
  RandomBodies random(913);
  SCOPED_TRACE(random.trace());
  int safe = 0, cuts = 0, passes_but_refused = 0;
  for (int i = 0; i < 20000; ++i) {
    const double ra = random.uniform(0.2, 1), rb = ra * random.uniform(1, 3);
    const Orifice orifice{random.uniform(4, 12) * random.direction(), random.direction(), rb};
    const OrificeOracle oracle(sphere({0, 0, 0}, ra), orifice);
    if (oracle.side() != WallSide::clear) continue;
    const Vector3d w = orifice.center + random.uniform(0, 1) * rb * random.direction();
    const Transit truth = oracle.transit(w);
    const Transit facing = facing_orifice_transit(orifice.center, ra, rb, w);
    if (facing == Transit::passes) {
      ++safe;
      cuts += truth == Transit::blocked;
    } else {
      passes_but_refused += truth != Transit::blocked;
    }
  }
  std::cout << "[ rates    ] (2.2) says passes: " << safe
            << " of 20000; of these the sphere cuts the rim or hits the wall in " << cuts << " ("
            << 100. * cuts / safe << " %); passes refused " << passes_but_refused << '\n';
  EXPECT_GT(cuts, safe / 10);
  EXPECT_EQ(passes_but_refused, 0) << "a tilted opening has the smaller shadow";
  // Where the wall faces the velocity, both are the same.
  for (int i = 0; i < 2000; ++i) {
    const Vector3d axis = Vector3d::Unit(i % 3) * random.uniform(0.1, 10),
                   c = 8 * axis.normalized() + random.in_box(1.5);
    const double ra = random.uniform(0.2, 1), rb = random.uniform(0.2, 3);
    ASSERT_EQ(OrificeOracle(sphere({0, 0, 0}, ra), {c, axis, rb}).transit(axis),
              facing_orifice_transit(c, ra, rb, axis))
        << "case " << i;
  }
}

}  // namespace
}  // namespace vericone::orifice_test
