// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/guidance/kinematics.h>
#include <vericone/internal/guidance/directions.h>

#include <numbers>

#include "guidance/motion.h"
#include "guidance/printed_formulas.h"

namespace vericone::guidance::kinematics_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using std::numbers::pi;
using testing::angle_between, testing::at_angle, testing::Errors, testing::Form, testing::Path;
using testing::RandomBodies, testing::richardson_derivative;

/// In parts of the shortest time in which anything changes.
constexpr double kStep = 0.02;
constexpr int kStates = 1000;

/// (5.8), (5.13), (5.15): every row, all four inputs.
TEST(Kinematics, PlanarRowsAreTheDerivativesOfCartesianMotion) {
  RandomBodies random(5081);
  SCOPED_TRACE(random.trace());
  Errors errors;
  for (int i = 0; i < kStates; ++i) {
    const PlanarInputs in{random.uniform(-15, 15), random.uniform(-15, 15), random.uniform(-15, 15),
                          random.uniform(-15, 15)};
    const double alpha = random.uniform(-7, 7), beta = random.uniform(-7, 7);
    const auto path = [&](const Vector2d& p, double speed, double heading, double lateral,
                          double longitudinal) {
      const Vector2d along = at_angle(heading), left(-along.y(), along.x());
      return Path<2>{p, speed * along, lateral * left + longitudinal * along};
    };
    const Path<2> a = path({random.uniform(-50, 50), random.uniform(-50, 50)}, random.uniform(1, 30), alpha,
                           in.lateral_a, in.longitudinal_a);
    const Path<2> b = path(a.p + random.log_uniform(1, 100) * random.direction_2d(), random.uniform(1, 30),
                           beta, in.lateral_b, in.longitudinal_b);
    const PlanarState s = planar_state({a.p, a.v, b.p, b.v});
    const auto sight = [&](double t) -> Vector2d { return b.position(t) - a.position(t); };
    const auto relative = [&](double t) -> Vector2d { return b.velocity(t) - a.velocity(t); };
    const auto along = [&](double t) { return relative(t).dot(sight(t).normalized()); };
    const auto across = [&](double t) {
      const Vector2d u = sight(t).normalized();
      return u.x() * relative(t).y() - u.y() * relative(t).x();
    };
    ASSERT_NEAR(s.r, sight(0).norm(), 1e-13 * s.r);
    ASSERT_NEAR(angle_between(at_angle(s.theta), sight(0)), 0, 1e-14);
    ASSERT_NEAR(s.v_r, along(0), 1e-13 * relative(0).norm());
    ASSERT_NEAR(s.v_theta, across(0), 1e-13 * relative(0).norm());
    ASSERT_NEAR(angle_between(at_angle(s.alpha), a.v), 0, 1e-14);
    ASSERT_NEAR(s.speed_b, b.v.norm(), 1e-13 * s.speed_b);

    const double v = relative(0).norm(), a_a = a.a.norm(), a_b = b.a.norm();
    const double h = kStep * std::min({s.r / v, v / (a_a + a_b), s.speed_a / a_a, s.speed_b / a_b,
                                       std::sqrt(s.r / (a_a + a_b))});
    const PlanarRates rates = planar_rates(s, in);
    const auto row = [&](double rate, double size, auto&& of) {
      errors.add(std::abs(rate - richardson_derivative(of, h)) / size);
    };
    const double change = v * v / s.r + a_a + a_b;
    row(rates.r, v, [&](double t) { return sight(t).norm(); });
    row(rates.theta, v / s.r, [&](double t) { return angle_between(sight(0), sight(t)); });
    row(rates.v_theta, change, across);
    row(rates.v_r, change, along);
    row(rates.alpha, a_a / s.speed_a, [&](double t) { return angle_between(a.v, a.velocity(t)); });
    row(rates.beta, a_b / s.speed_b, [&](double t) { return angle_between(b.v, b.velocity(t)); });
    row(rates.speed_a, a_a, [&](double t) { return a.velocity(t).norm(); });
    row(rates.speed_b, a_b, [&](double t) { return b.velocity(t).norm(); });
  }
  std::printf("(5.8), (5.13), (5.15), every row: worst relative error %.1e\n", errors.worst());
  EXPECT_LT(errors.worst(), 1e-6);
}

/// What the projection of a motion in space adds; the source's rows without it are wrong.
TEST(Kinematics, ProjectedRowsKnowThatThePlaneMoves) {
  RandomBodies random(5082);
  SCOPED_TRACE(random.trace());
  Errors errors, without;
  for (int i = 0; i < kStates; ++i) {
    const Path<3> c{random.log_uniform(1, 100) * random.direction(),
                    random.uniform(1, 30) * random.direction(), random.in_box(10)};
    PlanarState s;
    s.plane_spin = random.uniform(-2, 2);
    const Vector3d u = c.p.normalized();
    const Vector3d e = u.cross(random.direction()).normalized();
    // The whole relative acceleration as one of B with its heading along e.
    s.r = c.p.norm();
    s.v_r = c.v.dot(u);
    s.v_theta = c.v.dot(e);
    s.v_normal = c.v.dot(u.cross(e));
    s.beta = pi / 2;
    const auto axes = [&](double t) {
      const Vector3d now = c.position(t).normalized();
      const Vector3d carried =
          Eigen::AngleAxisd(s.plane_spin * t, now) * (testing::least_rotation(u, now) * e);
      return std::pair{now, carried};
    };
    PlanarInputs in;
    in.longitudinal_b = c.a.dot(e);
    in.lateral_b = -c.a.dot(u);
    const double h = kStep * std::min({s.r / c.v.norm(), c.v.norm() / c.a.norm(),
                                       1 / (1 + std::abs(s.plane_spin)), std::sqrt(s.r / c.a.norm())});
    const double v_r = richardson_derivative([&](double t) { return c.velocity(t).dot(axes(t).first); }, h);
    const double v_theta =
        richardson_derivative([&](double t) { return c.velocity(t).dot(axes(t).second); }, h);
    const double size = c.v.squaredNorm() / s.r + c.a.norm() + std::abs(s.plane_spin) * c.v.norm();
    const PlanarRates rates = planar_rates(s, in);
    errors.add(std::abs(rates.v_r - v_r) / size);
    errors.add(std::abs(rates.v_theta - v_theta) / size);
    s.v_normal = 0;
    const PlanarRates printed = planar_rates(s, in);
    without.add(std::hypot(printed.v_r - v_r, printed.v_theta - v_theta) / size);
  }
  std::printf("(5.8) of projections: worst relative error %.1e; without the plane's motion: median %.1e\n",
              errors.worst(), without.median());
  EXPECT_LT(errors.worst(), 1e-6);
  EXPECT_GT(without.median(), 1e-2);
}

/// (6.10), every row and the rates of headings and speeds; the printed V_phi row on the same states.
TEST(Kinematics, SpatialRowsAreTheDerivativesOfCartesianMotion) {
  RandomBodies random(6101);
  SCOPED_TRACE(random.trace());
  Errors errors, printed;
  for (int i = 0; i < kStates; ++i) {
    const Path<3> a{random.in_box(50), random.uniform(1, 30) * random.direction(),
                    random.uniform(0, 15) * random.direction()};
    const Path<3> b{a.p + random.log_uniform(1, 100) * random.direction(),
                    random.uniform(1, 30) * random.direction(), random.uniform(0, 15) * random.direction()};
    const SpatialState s = spatial_state({a.p, a.v, b.p, b.v});
    // The axes of (6.10) from their definition: east, north and up of the line of sight.
    const auto sight = [&](double t) -> Vector3d { return b.position(t) - a.position(t); };
    const auto relative = [&](double t) -> Vector3d { return b.velocity(t) - a.velocity(t); };
    const auto east = [&](double t) { return Vector3d::UnitZ().cross(sight(t)).normalized(); };
    const auto azimuth_from = [](const Vector3d& from, const Vector3d& to) {
      return angle_between(from.head<2>(), to.head<2>());
    };
    const auto elevation = [](const Vector3d& v) { return std::atan2(v.z(), v.head<2>().norm()); };
    const double level = sight(0).head<2>().norm() / s.r;
    const double level_a = a.v.head<2>().norm() / a.v.norm(), level_b = b.v.head<2>().norm() / b.v.norm();
    const double v = relative(0).norm(), a_a = a.a.norm(), a_b = b.a.norm();
    const double h = kStep * std::min({s.r * level / v, v / (a_a + a_b), s.speed_a * level_a / a_a,
                                       s.speed_b * level_b / a_b, std::sqrt(s.r * level / (a_a + a_b))});
    const SpatialRates rates = spatial_rates(s, directed(a.a), directed(b.a));
    ASSERT_FALSE(rates.at_pole);
    const auto row = [&](double rate, double size, auto&& of) {
      errors.add(std::abs(rate - richardson_derivative(of, h)) / size);
    };
    const double change = v * v / (s.r * level) + a_a + a_b;
    const auto v_phi = [&](double t) { return relative(t).dot(sight(t).normalized().cross(east(t))); };
    row(rates.r, v, [&](double t) { return sight(t).norm(); });
    row(rates.theta, v / (s.r * level), [&](double t) { return azimuth_from(sight(0), sight(t)); });
    row(rates.phi, v / s.r, [&](double t) { return elevation(sight(t)); });
    row(rates.v_theta, change, [&](double t) { return relative(t).dot(east(t)); });
    row(rates.v_phi, change, v_phi);
    row(rates.v_r, change, [&](double t) { return relative(t).dot(sight(t).normalized()); });
    const auto body = [&](const Path<3>& path, double level_of, const Direction& rate, double speed_rate) {
      const double size = path.a.norm() / path.v.norm();
      row(rate.azimuth, size / level_of, [&](double t) { return azimuth_from(path.v, path.velocity(t)); });
      row(rate.elevation, size, [&](double t) { return elevation(path.velocity(t)); });
      row(speed_rate, path.a.norm(), [&](double t) { return path.velocity(t).norm(); });
    };
    body(a, level_a, rates.heading_a, rates.speed_a);
    body(b, level_b, rates.heading_b, rates.speed_b);
    const DirectedAcceleration of_a = directed(a.a), of_b = directed(b.a);
    ASSERT_NEAR(rates.v_phi, row_6_10_v_phi(s, of_a, of_b, Form::corrected), 1e-12 * change);
    printed.add(std::abs(row_6_10_v_phi(s, of_a, of_b, Form::printed) - richardson_derivative(v_phi, h)) /
                change);
  }
  std::printf("(6.10), every row: worst relative error %.1e; printed V_phi row: median %.1e\n",
              errors.worst(), printed.median());
  EXPECT_LT(errors.worst(), 1e-6);
  EXPECT_GT(printed.median(), 1e-2);
}

TEST(Kinematics, PlanarStatesAndBack) {
  RandomBodies random(5083);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < kStates; ++i) {
    const Cartesian<2> m{{random.uniform(-99, 99), random.uniform(-99, 99)},
                         random.uniform(0, 30) * random.direction_2d(),
                         {random.uniform(-99, 99), random.uniform(-99, 99)},
                         random.uniform(0, 30) * random.direction_2d()};
    const Cartesian<2> back = cartesian(planar_state(m), m.p_a);
    ASSERT_LT((back.p_b - m.p_b).norm(), 1e-12);
    ASSERT_LT((back.v_a - m.v_a).norm(), 1e-13);
    ASSERT_LT((back.v_b - m.v_b).norm(), 1e-13);
  }
  const PlanarState rest = planar_state({{0, 0}, {0, 0}, {-2, 0}, {-0.0, -0.0}});
  EXPECT_EQ(rest.alpha, 0);
  EXPECT_EQ(rest.beta, 0);
  EXPECT_EQ(rest.r, 2);
  const PlanarRates rates = planar_rates(rest, {1, 2, 3, 4});
  EXPECT_EQ(rates.alpha, 0);
  EXPECT_EQ(rates.beta, 0);
  EXPECT_EQ(rates.speed_a, 2);
}

TEST(Kinematics, SpatialStatesAndBackAlsoAtPoles) {
  RandomBodies random(6102);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < kStates; ++i) {
    const auto direction = [&]() -> Vector3d {  // every third vertical, every third within 1e-8 of it
      const Vector3d up(0, 0, random.coin() ? 1 : -1);
      const int kind = random.integer(0, 2);
      return kind == 0 ? random.direction() : kind == 1 ? up : (up + 1e-8 * random.direction()).normalized();
    };
    const Vector3d p_a = random.in_box(20);
    const Cartesian<3> m{p_a, random.uniform(0, 30) * direction(), p_a + random.uniform(1, 50) * direction(),
                         random.uniform(0, 30) * direction()};
    const SpatialState s = spatial_state(m);
    const Cartesian<3> back = cartesian(s, m.p_a);
    ASSERT_LT((back.p_b - m.p_b).norm(), 2e-14 * 50);
    ASSERT_LT((back.v_a - m.v_a).norm(), 2e-14 * 30);
    ASSERT_LT((back.v_b - m.v_b).norm(), 2e-14 * 30);
    // V in the axes of (6.10) at whatever azimuth was given.
    const Vector3d u = unit_vector({s.theta, s.phi}), east(-std::sin(s.theta), std::cos(s.theta), 0);
    const Vector3d v = s.v_r * u + s.v_theta * east + s.v_phi * u.cross(east);
    ASSERT_LT((v - (m.v_b - m.v_a)).norm(), 1e-13 * 60);
    ASSERT_LE(std::abs(s.phi), pi / 2);
    ASSERT_LE(std::abs(s.theta), pi);
  }
}

TEST(Kinematics, AtAPoleTheAzimuthIsTheOneBefore) {
  SpatialState before;
  before.theta = 9.5;
  before.heading_a = {-8, 0.2};
  before.heading_b = {20, 0.1};
  const Cartesian<3> m{{1, 2, 3}, {0, 0, -4}, {1, 2, 8}, {0, 0, 0}};
  const SpatialState s = spatial_state(m, &before);
  EXPECT_EQ(s.theta, 9.5);
  EXPECT_EQ(s.phi, pi / 2);
  EXPECT_EQ(s.heading_a.azimuth, -8);
  EXPECT_EQ(s.heading_a.elevation, -pi / 2);
  EXPECT_EQ(s.heading_b.azimuth, 20);  // at rest: the whole direction
  EXPECT_EQ(s.heading_b.elevation, 0.1);
  EXPECT_EQ(spatial_state(m).theta, 0);
  const SpatialRates rates = spatial_rates(s, directed({1, 0, 0}), directed({0, 0, 2}));
  EXPECT_TRUE(rates.at_pole);
  EXPECT_EQ(rates.theta, 0);
  EXPECT_EQ(rates.v_theta, 0);
  EXPECT_EQ(rates.v_phi, 0);
  EXPECT_EQ(rates.heading_a.azimuth, 0);
  // A flies down and is pulled along x; its elevation is that towards the azimuth -8.
  EXPECT_NEAR(rates.heading_a.elevation, std::cos(-8.0) / 4, 1e-15);
  EXPECT_NEAR(rates.v_r, 2, 1e-15);
  EXPECT_TRUE(std::isfinite(rates.phi));
  EXPECT_EQ(rates.heading_b.azimuth, 0);
}

/// An engagement straight over the pole: (6.10) has no rates there, states through Cartesian motion do not
/// notice.
TEST(Kinematics, OverThePoleThroughCartesianMotion) {
  for (const double beside : {0.0, 1e-12, 1e-3}) {
    const Path<3> a{{0, 0, 0}, {3, 0, 0}, {0, 0, 0}}, b{{-2, beside, 10}, {5, 0, 1}, {0, 0.5, 0}};
    SpatialState s = spatial_state({a.p, a.v, b.p, b.v});
    const double dt = 0.125;  // 1 s to the pole: exact in binary
    for (int i = 1; i <= 16; ++i) {
      Cartesian<3> m = cartesian(s, a.position((i - 1) * dt));
      m.p_a += dt * m.v_a;
      m.p_b += dt * m.v_b + 0.5 * dt * dt * b.a;
      m.v_b += dt * b.a;
      s = spatial_state(m, &s);
      const Vector3d c = b.position(i * dt) - a.position(i * dt), v = b.velocity(i * dt) - a.velocity(i * dt);
      ASSERT_NEAR(s.r, c.norm(), 1e-12);
      ASSERT_NEAR(s.v_r, v.dot(c.normalized()), 1e-12);
      ASSERT_NEAR(std::hypot(s.v_theta, s.v_phi), v.cross(c.normalized()).norm(), 1e-12);
      ASSERT_LT((s.r * unit_vector({s.theta, s.phi}) - c).norm(), 1e-12);
    }
  }
}

TEST(Kinematics, WrapAround) {
  EXPECT_EQ(unwrapped(3, 2.5), 3);
  EXPECT_NEAR(unwrapped(-3.1, 3.1), 2 * pi - 3.1, 1e-15);
  EXPECT_NEAR(unwrapped(3.1, -3.1), 3.1 - 2 * pi, 1e-15);
  EXPECT_NEAR(unwrapped(0.25, 40), 0.25 + 12 * pi, 1e-14);
  // Two turns of a bearing, in steps of 1 degree, without a jump.
  SpatialState s = spatial_state({{0, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {1, 0, 0}});
  for (int i = 1; i <= 720; ++i) {
    const double angle = i * pi / 180;
    const Vector3d direction(std::cos(angle), std::sin(angle), 0.3);
    const SpatialState next = spatial_state({{0, 0, 0}, -direction, direction, direction}, &s);
    ASSERT_NEAR(next.theta - s.theta, pi / 180, 1e-12) << i;
    ASSERT_NEAR(next.heading_a.azimuth - s.heading_a.azimuth, pi / 180, 1e-12) << i;
    s = next;
  }
  EXPECT_NEAR(s.theta, 4 * pi, 1e-12);
  // Zeros with a sign: (-pi, pi] is half open.
  EXPECT_EQ(direction_of({-1, -0.0, 0}).azimuth, pi);
  EXPECT_EQ(direction_of({-1, 0.0, -0.0}).elevation, 0);
  EXPECT_EQ(direction_of({0, -0.0, 2}, {1.5, 0}).azimuth, 1.5);
  EXPECT_EQ(direction_of({0, 0, 0}, {1.5, 0.5}).elevation, 0.5);
  EXPECT_EQ(directed({0, 0, 0}).magnitude, 0);
}

TEST(Kinematics, OneCentreIsAMistakeOfTheObstacle) {
  try {
    planar_state({{1, 2}, {0, 0}, {1, 2}, {3, 0}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), "obstacle.center");
  }
  EXPECT_THROW(spatial_state({{1, 2, 0}, {0, 0, 0}, {1, 2, 0}, {3, 0, 0}}), InputError);
}

}  // namespace
}  // namespace vericone::guidance::kinematics_test
