// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's planar sectors against the exact tangents. The bounds are those of
// docs/measured/planar-accuracy.md, which is to be renewed when one of them changes.
#include <gtest/gtest.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/internal/verify/planar/methods.h>
#include <vericone/internal/verify/predicates/exact_tangents.h>
#include <vericone/internal/verify/seeded_random.h>

#include <cmath>
#include <numbers>

namespace vericone::verify::planar_methods_test {
namespace {

constexpr std::uint64_t kSeed = 20250301;
constexpr std::uint64_t kCases = 300;

/// Bound on the relative error of psi by degenerate conics.
double degenerate_conics_bound(PlanarFamily family) {
  switch (family) {
    case PlanarFamily::nearly_touching:
    case PlanarFamily::thin_touching:
      return 5e-9;
    case PlanarFamily::within_rounding:
      return 1e-7;
    default:
      return 1e-12;
  }
}

class PlanarMethods : public ::testing::TestWithParam<PlanarFamily> {};

TEST_P(PlanarMethods, SupportIsRightToAFewUlps) {
  const PlanarFamilyReport r = run_planar_family(answer_by_support, GetParam(), kCases, kSeed);
  SCOPED_TRACE(to_markdown({&r, 1}));
  EXPECT_EQ(r.wrong_relations, 0);
  EXPECT_EQ(r.not_answered, 0);
  EXPECT_GT(r.compared, kCases / 4);
  EXPECT_LE(r.psi_relative.error, 1e-15);
  EXPECT_LE(r.psi_ulps.error, 4);
  EXPECT_LE(r.theta_b.error, 2e-15);
  EXPECT_LE(r.edge.error, 2e-15);
}

TEST_P(PlanarMethods, DegenerateConicsAreRightOrDecline) {
  const PlanarFamilyReport r = run_planar_family(answer_by_degenerate_conics, GetParam(), kCases, kSeed);
  SCOPED_TRACE(to_markdown({&r, 1}));
  EXPECT_EQ(r.wrong_relations, 0);
  EXPECT_LE(r.psi_relative.error, degenerate_conics_bound(GetParam()));
  // It declines only where the gap is a few roundings.
  EXPECT_LE(r.not_answered, GetParam() == PlanarFamily::within_rounding ? kCases / 2 : 0);
}

INSTANTIATE_TEST_SUITE_P(Planar, PlanarMethods, ::testing::ValuesIn(kAllPlanarFamilies),
                         [](const auto& family) { return std::string(name(family.param)); });

/// A body that moves, turns and changes its semi-axes at constant rates.
struct MovingEllipse {
  Eigen::Vector2d center, velocity, axes, axes_rate;
  double angle, omega;

  Ellipse at(double t) const {
    return Ellipse::from_axes(center + t * velocity, axes + t * axes_rate, rotation_2d(angle + t * omega));
  }
  /// Rate of the shape matrix beyond turning.
  Eigen::Matrix2d shape_rate() const {
    const Eigen::Matrix2d r = rotation_2d(angle);
    return 2 * r * axes.cwiseProduct(axes_rate).asDiagonal() * r.transpose();
  }
};

MovingEllipse moving_ellipse(SeededRandom& random, bool turning, bool changing) {
  MovingEllipse e;
  for (int i = 0; i < 2; ++i) {
    e.center(i) = random.uniform(-10, 10);
    e.velocity(i) = random.uniform(-5, 5);
    e.axes(i) = random.uniform(1, 10);
    const double rate = random.uniform(-1, 1);
    e.axes_rate(i) = changing ? rate : 0;
  }
  e.angle = random.uniform(-3, 3);
  const double omega = random.uniform(-2, 2);
  e.omega = turning ? omega : 0;
  return e;
}

TEST(SectorRates, AgreeWithDifferencesOfTheExactTangents) {
  constexpr double kStep = 1e-3;
  double worst = 0;
  int compared = 0;
  for (std::uint64_t index = 0; index < 300; ++index) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + " index " + std::to_string(index));
    SeededRandom random(200, kSeed, index);
    const bool turning = index % 3 != 0, changing = index % 3 == 2;
    MovingEllipse a = moving_ellipse(random, turning, changing),
                  b = moving_ellipse(random, turning, changing);
    const Eigen::Vector2d along = random.direction<2>();
    const double distance = random.uniform(1.3, 4) * (a.at(0).radius(along) + b.at(0).radius(along));
    b.center = a.center + distance * along;

    const Sector sector = sector_by_support(a.at(0), b.at(0));
    ASSERT_EQ(sector.relation, Relation::disjoint);
    PlanarMotion motion;
    motion.v_a = a.velocity, motion.v_b = b.velocity;
    motion.omega_a = a.omega, motion.omega_b = b.omega;
    motion.shape_rate_a = a.shape_rate(), motion.shape_rate_b = b.shape_rate();
    const SectorRates rates = sector_rates(sector, a.at(0), b.at(0), motion);

    // The time over which the sector changes: small for fast bodies at a small gap.
    const Eigen::Vector2d gap = sector.right.point_on_b - sector.right.point_on_a;
    const double h = kStep * std::min(1.0, gap.norm() / 20);
    // (f(-2h) - 8 f(-h) + 8 f(h) - f(2h)) / 12 h, with all parts of the exact values.
    double psi = 0, theta = 0;
    const EnclosedReal at_0 = exact_inner_tangents(a.at(0), b.at(0)).tangents.value().theta_b;
    bool apart = true;
    for (const auto& [offset, weight] : {std::pair(-2, 1.0), {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
      const auto t = exact_inner_tangents(a.at(offset * h), b.at(offset * h)).tangents;
      if (!t) {
        apart = false;
        break;
      }
      psi += weight * -t->psi.error(sector.psi);
      theta += weight * -t->theta_b.angle_error(at_0.parts()[0], at_0.parts()[1]);
    }
    if (!apart) continue;
    ++compared;
    psi /= 12 * h, theta /= 12 * h;
    const double scale = std::max({std::abs(psi), std::abs(theta), 0.1});
    worst = std::max({worst, std::abs(rates.psi - psi) / scale, std::abs(rates.theta_b - theta) / scale});
    EXPECT_NEAR(rates.psi, psi, 1e-8 * scale);
    EXPECT_NEAR(rates.theta_b, theta, 1e-8 * scale);
  }
  EXPECT_GT(compared, 280);
  RecordProperty("worst_relative", std::to_string(worst));
  std::printf("worst relative difference %.2g over %d pairs\n", worst, compared);
}

}  // namespace
}  // namespace vericone::verify::planar_methods_test
