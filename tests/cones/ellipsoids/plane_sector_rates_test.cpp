// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <vericone/testing/random_bodies.h>

#include <cmath>

#include "cones/ellipsoids/richardson.h"
#include "support/campaign.h"

namespace vericone::plane_sector_rates_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using testing::RandomBodies, testing::richardson_derivative, testing::share;

/// The body t seconds later.
Ellipsoid moved(const Ellipsoid& body, const Vector3d& v, const Vector3d& omega, const Matrix3d& shape_rate,
                double t) {
  const double speed = omega.norm();
  const Matrix3d r =
      speed > 0 ? Eigen::AngleAxisd(speed * t, omega / speed).toRotationMatrix() : Matrix3d::Identity();
  const Matrix3d s = r * body.shape() * r.transpose() + t * shape_rate;
  return Ellipsoid::from_shape(body.center() + t * v, 0.5 * (s + s.transpose()));
}

/// The sector t seconds later. The second axis turns with the line of sight without spinning about it, plus
/// the plane's spin; to first order in t that is all that its derivative depends on.
PlaneSector later(const PlaneSector& s, const Ellipsoid& a, const Ellipsoid& b, const SpatialMotion& m,
                  double t) {
  const Vector3d c = b.center() - a.center();
  const Vector3d turning = s.line_of_sight.cross(m.v_b - m.v_a) / c.norm() + m.plane_spin * s.line_of_sight;
  return true_sector(moved(a, m.v_a, m.omega_a, m.rate_a->shape, t),
                     moved(b, m.v_b, m.omega_b, m.rate_b->shape, t), s.across + t * turning.cross(s.across));
}

Matrix3d symmetric(RandomBodies& random, double size) {
  Matrix3d m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) m(i, j) = m(j, i) = random.uniform(-size, size);
  return m;
}

TEST(PlaneSectorRates, EveryKindOfMotion) {
  RandomBodies random(631);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < share(880); ++i) {
    // Also pairs whose line of centres does not separate them.
    const auto [a, b] = random.scaled_from_touching(1, 3, random.uniform(1.3, 4));
    const PlaneSector s = true_sector(a, b, random.direction());
    const Vector3d out_of_plane = s.line_of_sight.cross(s.across);
    BodyRate rate_a, rate_b;
    SpatialMotion m;
    m.rate_a = &rate_a;
    m.rate_b = &rate_b;
    const int kind = i % 11;
    const bool all = kind >= 9;
    if (kind == 0 || all) m.v_a = random.direction();
    if (kind == 1 || all) m.v_b = random.direction();
    if (kind == 2) m.v_b = out_of_plane;
    if (kind == 3) m.v_b = s.line_of_sight;
    if (kind == 4 || all) m.omega_a = random.in_box(1);
    if (kind == 5 || all) m.omega_b = random.in_box(1);
    if (kind == 6 || all) rate_a.shape = symmetric(random, 0.2);
    if (kind == 7 || all) rate_b.shape = symmetric(random, 0.2);
    if (kind == 8 || all) m.plane_spin = random.uniform(-1, 1);
    const PlaneSectorRates rates = true_sector_rates(s, a, b, m);
    const auto rate = [&, &a = a, &b = b](auto&& of) {
      return richardson_derivative([&](double t) { return of(later(s, a, b, m, t)); }, 0.01);
    };
    const double scale = 1e-8 * std::max({0.1, std::abs(rates.left), std::abs(rates.right)});
    ASSERT_NEAR(rates.left, rate([](const PlaneSector& p) { return p.left.angle; }), scale) << "case " << i;
    ASSERT_NEAR(rates.right, rate([](const PlaneSector& p) { return p.right.angle; }), scale) << "case " << i;
    ASSERT_NEAR(rates.psi(), rate([](const PlaneSector& p) { return p.psi(); }), 2 * scale) << "case " << i;
    ASSERT_NEAR(rates.theta_b(), rate([](const PlaneSector& p) { return p.theta_b(); }), scale)
        << "case " << i;
    ASSERT_NEAR(rates.line_of_sight,
                rate([&](const PlaneSector& p) { return p.line_of_sight.dot(s.across); }), scale)
        << "case " << i;
  }
}

TEST(PlaneSectorRates, SpheresInClosedForm) {
  RandomBodies random(632);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    const double r1 = random.uniform(0.1, 3), r2 = random.uniform(0.1, 3), reach = r1 + r2;
    const Vector3d c = reach * random.uniform(1.1, 10) * random.direction();
    const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, Vector3d::Constant(r1)),
                    b = Ellipsoid::from_axes(c, Vector3d::Constant(r2));
    SpatialMotion m{random.direction(), random.direction(), random.in_box(3), random.in_box(3)};
    m.plane_spin = random.uniform(-2, 2);
    BodyRate rate_b;
    m.rate_b = &rate_b;
    rate_b.shape = 2 * r2 * random.uniform(-1, 1) * Matrix3d::Identity();  // r' = S' / (2 r)
    const PlaneSector s = true_sector(a, b, random.direction());
    const PlaneSectorRates rates = true_sector_rates(s, a, b, m);
    const double d = c.norm(), d_rate = c.dot(m.v_b - m.v_a) / d, reach_rate = rate_b.shape(0, 0) / (2 * r2);
    const double half_rate = (reach_rate - reach * d_rate / d) / std::sqrt(d * d - reach * reach);
    ASSERT_NEAR(rates.left, half_rate, 1e-12) << "case " << i;
    ASSERT_NEAR(rates.right, half_rate, 1e-12) << "case " << i;
  }
}

TEST(PlaneSectorRates, ACommonMotionChangesNothingButTheLineOfSight) {
  RandomBodies random(633);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    const auto [a, b] = random.scaled_from_touching(1, 3, random.uniform(1.1, 4));
    const Vector3d omega = random.in_box(2), drift = random.in_box(5);
    const PlaneSector s = true_sector(a, b, random.direction());
    SpatialMotion m{omega.cross(a.center()) + drift, omega.cross(b.center()) + drift, omega, omega};
    m.plane_spin = omega.dot(s.line_of_sight);  // the plane turns with everything else
    const PlaneSectorRates rates = true_sector_rates(s, a, b, m);
    ASSERT_NEAR(rates.left, 0, 1e-11) << "case " << i;
    ASSERT_NEAR(rates.right, 0, 1e-11) << "case " << i;
    ASSERT_NEAR(rates.line_of_sight, omega.dot(s.line_of_sight.cross(s.across)), 1e-12) << "case " << i;
  }
}

}  // namespace
}  // namespace vericone::plane_sector_rates_test
