// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/testing/random_bodies.h>

#include <cmath>
#include <numbers>

#include "cones/ellipsoids/richardson.h"

namespace vericone::sector_rates_test {
namespace {

using Eigen::Matrix2d, Eigen::Vector2d;
using std::numbers::pi;
using testing::RandomBodies, testing::richardson_derivative;

/// The body t seconds later.
Ellipse moved(const Ellipse& body, const Vector2d& v, double omega, const Matrix2d& shape_rate, double t) {
  const Matrix2d r = rotation_2d(omega * t);
  Matrix2d s = r * body.shape() * r.transpose() + t * shape_rate;
  s(1, 0) = s(0, 1);
  return Ellipse::from_shape(body.center() + t * v, s);
}

SectorRates numerical_rates(const Ellipse& a, const Ellipse& b, const PlanarMotion& m, double h) {
  const Sector now = sector_by_support(a, b);
  const auto at = [&](double t) {
    return sector_by_support(moved(a, m.v_a, m.omega_a, m.shape_rate_a, t),
                             moved(b, m.v_b, m.omega_b, m.shape_rate_b, t));
  };
  return {richardson_derivative([&](double t) { return at(t).psi; }, h),
          richardson_derivative([&](double t) { return std::remainder(at(t).theta_b - now.theta_b, 2 * pi); },
                                h)};
}

Matrix2d symmetric(RandomBodies& random, double size) {
  const double off = random.uniform(-size, size);
  return (Matrix2d() << random.uniform(-size, size), off, off, random.uniform(-size, size)).finished();
}

TEST(SectorRates, EveryKindOfMotion) {
  RandomBodies random(561);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 2000; ++i) {
    const auto [a, b] = random.planar_scaled_from_touching(1, 4, random.uniform(1.3, 4));
    PlanarMotion m;
    const int kind = i % 8;
    if (kind == 0 || kind >= 6) m.v_a = random.direction_2d();
    if (kind == 1 || kind >= 6) m.v_b = random.direction_2d();
    if (kind == 2 || kind >= 6) m.omega_a = random.uniform(-1, 1);
    if (kind == 3 || kind >= 6) m.omega_b = random.uniform(-1, 1);
    if (kind == 4 || kind >= 6) m.shape_rate_a = symmetric(random, 0.3);
    if (kind == 5 || kind >= 6) m.shape_rate_b = symmetric(random, 0.3);
    const Sector s = sector_by_support(a, b);
    const SectorRates exact = sector_rates(s, a, b, m), numerical = numerical_rates(a, b, m, 0.02);
    const double scale = std::max({1e-2, std::abs(exact.psi), std::abs(exact.theta_b)});
    ASSERT_NEAR(exact.psi, numerical.psi, 1e-8 * scale) << "case " << i;
    ASSERT_NEAR(exact.theta_b, numerical.theta_b, 1e-8 * scale) << "case " << i;
    const SectorRates conics = sector_rates(sector_by_degenerate_conics(a, b).value(), a, b, m);
    ASSERT_NEAR(exact.psi, conics.psi, 1e-10 * scale) << "case " << i;
    ASSERT_NEAR(exact.theta_b, conics.theta_b, 1e-10 * scale) << "case " << i;
  }
}

TEST(SectorRates, CirclesInClosedForm) {
  RandomBodies random(562);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    const double r1 = random.uniform(0.1, 3), r2 = random.uniform(0.1, 3), reach = r1 + r2;
    const Vector2d c = reach * random.uniform(1.1, 10) * random.direction_2d();
    const Ellipse a = Ellipse::from_axes({0, 0}, Vector2d::Constant(r1)),
                  b = Ellipse::from_axes(c, Vector2d::Constant(r2));
    PlanarMotion m{random.direction_2d(), random.direction_2d(), random.uniform(-9, 9),
                   random.uniform(-9, 9)};
    m.shape_rate_a = 2 * r1 * random.uniform(-1, 1) * Matrix2d::Identity();  // r' = S' / (2 r)
    const double reach_rate = m.shape_rate_a(0, 0) / (2 * r1), d = c.norm();
    const Vector2d c_rate = m.v_b - m.v_a;
    const double d_rate = c.dot(c_rate) / d, turn = (c.x() * c_rate.y() - c.y() * c_rate.x()) / (d * d);
    const SectorRates rates = sector_rates(sector_by_support(a, b), a, b, m);
    // psi = 2 asin(reach / d).
    const double expected = 2 * (reach_rate - reach * d_rate / d) / std::sqrt(d * d - reach * reach);
    ASSERT_NEAR(rates.psi, expected, 1e-13) << "case " << i;
    ASSERT_NEAR(rates.theta_b, turn, 1e-13) << "case " << i;
  }
}

TEST(SectorRates, SymmetricPairsKeepTheirBisector) {
  RandomBodies random(563);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 500; ++i) {
    const Ellipse a = Ellipse::from_axes({0, 0}, Vector2d(random.uniform(1, 3), random.uniform(1, 3)));
    const Ellipse b =
        Ellipse::from_axes({random.uniform(7, 20), 0}, Vector2d(random.uniform(1, 3), random.uniform(1, 3)));
    PlanarMotion m;
    m.v_a = {random.uniform(-1, 1), 0};
    m.v_b = {random.uniform(-1, 1), 0};
    m.shape_rate_b = Vector2d(random.uniform(-1, 1), random.uniform(-1, 1)).asDiagonal();
    ASSERT_NEAR(sector_rates(sector_by_support(a, b), a, b, m).theta_b, 0, 1e-15) << "case " << i;
    // Mirrored turning of the two bodies turns nothing but the bisector; psi is stationary.
    PlanarMotion turning;
    turning.omega_a = 1;
    ASSERT_NEAR(sector_rates(sector_by_support(a, b), a, b, turning).psi, 0, 1e-14) << "case " << i;
  }
}

TEST(SectorRates, ACommonMotionTurnsTheSectorAsAWhole) {
  RandomBodies random(564);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 500; ++i) {
    const auto [a, b] = random.planar_scaled_from_touching(1, 4, random.uniform(1.1, 4));
    const double omega = random.uniform(-2, 2);
    const auto spun = [&](const Vector2d& p) { return Vector2d(-omega * p.y(), omega * p.x()); };
    PlanarMotion m{spun(a.center()) + Vector2d(1, 2), spun(b.center()) + Vector2d(1, 2), omega, omega};
    const SectorRates rates = sector_rates(sector_by_support(a, b), a, b, m);
    ASSERT_NEAR(rates.psi, 0, 1e-12) << "case " << i;
    ASSERT_NEAR(rates.theta_b, omega, 1e-12) << "case " << i;
  }
}

}  // namespace
}  // namespace vericone::sector_rates_test
