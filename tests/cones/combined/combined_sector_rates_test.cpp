// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/sector.h>

#include <cmath>
#include <numbers>

#include "cones/ellipsoids/richardson.h"
#include "support/campaign.h"
#include "support/random_combined.h"

namespace vericone::combined_sector_rates_test {
namespace {

using Eigen::Matrix2d, Eigen::Vector2d;
using std::numbers::pi;
using testing::random_combined, testing::RandomBodies, testing::richardson_derivative, testing::share;

/// The same arc, or the same corner: another one of the same two conics is not within `reach`.
bool same_touches(const CombinedSector& x, const CombinedSector& y, double reach) {
  const auto same = [reach](const Touch& s, const Vector2d& p, const Touch& t, const Vector2d& q) {
    return s.corner == t.corner && s.first == t.first && s.second == t.second && (p - q).norm() < reach;
  };
  const auto &l = x.sector.left, &r = x.sector.right, &m = y.sector.left, &s = y.sector.right;
  return same(x.left_a, l.point_on_a, y.left_a, m.point_on_a) &&
         same(x.left_b, l.point_on_b, y.left_b, m.point_on_b) &&
         same(x.right_a, r.point_on_a, y.right_a, s.point_on_a) &&
         same(x.right_b, r.point_on_b, y.right_b, s.point_on_b);
}

/// Short lines turn too fast for differences.
double shortest_line(const Sector& s) {
  return std::min((s.left.point_on_b - s.left.point_on_a).norm(),
                  (s.right.point_on_b - s.right.point_on_a).norm());
}

/// Rates by differences of sectors at times t around 0; nothing where an edge changes what it touches.
template <typename At>
std::optional<SectorRates> numerical(At&& at, double h, double reach) {
  const CombinedSector now = at(0.0);
  bool smooth = true;
  const auto value = [&](double t, bool psi) {
    const CombinedSector s = at(t);
    smooth = smooth && s.sector.relation == Relation::disjoint && same_touches(s, now, reach);
    return psi ? s.sector.psi : std::remainder(s.sector.theta_b - now.sector.theta_b, 2 * pi);
  };
  const SectorRates rates{richardson_derivative([&](double t) { return value(t, true); }, h),
                          richardson_derivative([&](double t) { return value(t, false); }, h)};
  return smooth ? std::optional(rates) : std::nullopt;
}

Matrix2d symmetric(RandomBodies& random, double size) {
  const double off = random.uniform(-size, size);
  return (Matrix2d() << random.uniform(-size, size), off, off, random.uniform(-size, size)).finished();
}

struct Change {
  Vector2d v = Vector2d::Zero();
  double omega = 0;
  Matrix2d shape = Matrix2d::Zero();
  std::vector<DelimiterRate<2>> delimiters;
};

Change random_change(RandomBodies& random, const CombinedEllipse& body, int kind) {
  Change c;
  if (kind == 0 || kind >= 4) c.v = random.direction_2d();
  if (kind == 1 || kind >= 4) c.omega = random.uniform(-1, 1);
  if (kind == 2 || kind >= 4) c.shape = symmetric(random, 0.3);
  if (kind == 3 || kind >= 4)
    for (std::size_t i = 0; i < body.delimiters().size(); ++i) {
      const Matrix2d rate = symmetric(random, 0.1 * body.delimiters()[i].matrix.norm());
      c.delimiters.push_back({rate, body.delimiters()[i].level > 0 ? random.uniform(-0.1, 0.1) : 0});
    }
  return c;
}

CombinedEllipse later(const CombinedEllipse& body, const Change& c, double t) {
  const Matrix2d r = rotation_2d(c.omega * t);
  const auto turned = [&](const Matrix2d& m) -> Matrix2d {
    const Matrix2d image = r * m * r.transpose();
    return 0.5 * (image + image.transpose());
  };
  std::vector<Delimiter<2>> delimiters = body.delimiters();
  for (std::size_t i = 0; i < c.delimiters.size(); ++i) {
    delimiters[i].matrix += t * c.delimiters[i].matrix;
    delimiters[i].level += t * c.delimiters[i].level;
  }
  for (Delimiter<2>& d : delimiters) d.matrix = turned(d.matrix);
  return CombinedEllipse::trusted(
      Ellipse::from_shape(body.center() + t * c.v, turned(body.ellipsoid().shape() + t * c.shape)),
      delimiters);
}

TEST(CombinedSectorRates, EveryKindOfChange) {
  RandomBodies random(5231);
  SCOPED_TRACE(random.trace());
  int compared = 0, corners = 0, in_mouth = 0;
  for (int i = 0; i < share(6000); ++i) {
    const CombinedEllipse a = random_combined(random, Vector2d::Zero());
    const CombinedEllipse b = random_combined(random, random.uniform(2, 14) * random.direction_2d());
    const Change change_a = random_change(random, a, i % 6), change_b = random_change(random, b, i / 6 % 6);
    const CombinedSector s = combined_sector(a, b);
    if (s.sector.relation != Relation::disjoint) continue;
    if (shortest_line(s.sector) < 1) continue;
    const auto differences = numerical(
        [&](double t) { return combined_sector(later(a, change_a, t), later(b, change_b, t)); }, 4e-3, 0.1);
    if (!differences) continue;
    ++compared;
    corners += s.left_a.corner + s.left_b.corner + s.right_a.corner + s.right_b.corner;
    in_mouth += s.hulls_overlap;
    const PlanarMotion motion{change_a.v,     change_b.v,     change_a.omega,
                              change_b.omega, change_a.shape, change_b.shape};
    const SectorRates exact =
        combined_sector_rates(s, a, b, motion, change_a.delimiters, change_b.delimiters);
    const double scale = std::max({1e-1, std::abs(exact.psi), std::abs(exact.theta_b)});
    ASSERT_NEAR(exact.psi, differences->psi, 1e-8 * scale) << "case " << i;
    ASSERT_NEAR(exact.theta_b, differences->theta_b, 1e-8 * scale) << "case " << i;
  }
  EXPECT_GT(compared, share(2000));
  EXPECT_GT(corners, 1000);
  EXPECT_GT(in_mouth, 10);
}

/// The source's pulsating obstacle (5.4.2), k = |sin(2 t + pi/2)|, flying and turning past F1.
TEST(CombinedSectorRates, ThePulsatingConic) {
  const double a_c = 6, b_c = 2, omega_a = 0.3, omega_b = -0.2;
  const Vector2d v_a = 25 * Vector2d(std::cos(pi / 4), std::sin(pi / 4)),
                 v_b = 20 * Vector2d(std::cos(2 * pi / 3), std::sin(2 * pi / 3));
  const auto k = [](double t) { return std::abs(std::sin(2 * t + pi / 2)); };
  const auto f1 = [&](double t) {
    return Ellipse::from_axes(t * v_a, Vector2d(6, 2), rotation_2d(pi / 4 + omega_a * t));
  };
  const auto f2 = [&](double t) {
    return dented_conic(Vector2d(45, 0) + t * v_b, a_c, b_c, k(t), 2 * pi / 3 + omega_b * t);
  };
  int compared = 0;
  for (int i = 0; i < 150; ++i) {
    const double t = 0.01 * i;
    const double to_kink = std::abs(std::remainder(2 * t - pi / 2, pi)) / 2;  // where k = 0
    if (to_kink < 0.03) continue;
    const CombinedEllipse a = f1(t), b = f2(t);
    const CombinedSector s = combined_sector(a, b);
    if (s.sector.relation != Relation::disjoint || shortest_line(s.sector) < 4) continue;
    const auto differences =
        numerical([&](double h) { return combined_sector(f1(t + h), f2(t + h)); }, 5e-3, 0.3);
    if (!differences) continue;
    // S = (1 + k) S_1, level 1 - k.
    const double sine = std::sin(2 * t + pi / 2);
    const double k_rate = 2 * std::cos(2 * t + pi / 2) * (sine < 0 ? -1 : 1);
    PlanarMotion motion{v_a, v_b, omega_a, omega_b};
    motion.shape_rate_b = k_rate / (1 + k(t)) * b.ellipsoid().shape();
    const SectorRates exact = combined_sector_rates(s, a, b, motion, {}, {{Matrix2d::Zero(), -k_rate}});
    const double scale = std::max({0.1, std::abs(exact.psi), std::abs(exact.theta_b)});
    EXPECT_NEAR(exact.psi, differences->psi, 1e-7 * scale) << "t = " << t;
    EXPECT_NEAR(exact.theta_b, differences->theta_b, 1e-7 * scale) << "t = " << t;
    ++compared;
  }
  EXPECT_GT(compared, 60);
}

TEST(CombinedSectorRates, EllipsesAsBefore) {
  RandomBodies random(5232);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 300; ++i) {
    const auto [a, b] = random.planar_scaled_from_touching(1, 6, random.uniform(1.1, 3));
    const PlanarMotion motion{random.direction_2d(), random.direction_2d(),  random.uniform(-1, 1),
                              random.uniform(-1, 1), symmetric(random, 0.3), symmetric(random, 0.3)};
    const CombinedSector s = combined_sector(a, b);
    const SectorRates combined = combined_sector_rates(s, a, b, motion),
                      plain = sector_rates(s.sector, a, b, motion);
    const double scale = std::max({1.0, std::abs(plain.psi), std::abs(plain.theta_b)});
    ASSERT_NEAR(combined.psi, plain.psi, 1e-12 * scale) << "case " << i;
    ASSERT_NEAR(combined.theta_b, plain.theta_b, 1e-12 * scale) << "case " << i;
  }
}

TEST(CombinedSectorRates, RefusesASectorOfOtherBodies) {
  const CombinedEllipse a = Ellipse(), b = Ellipse::from_axes({5, 1}, {1, 2});
  const CombinedSector own = combined_sector(a, b);
  for (const int conic : {-1, 1, 2'147'483'647})
    for (Touch CombinedSector::*touch : {&CombinedSector::left_a, &CombinedSector::left_b,
                                         &CombinedSector::right_a, &CombinedSector::right_b}) {
      CombinedSector other = own;
      (other.*touch).second = conic;
      EXPECT_THROW((void)combined_sector_rates(other, a, b, {}), InputError);
    }
}

}  // namespace
}  // namespace vericone::combined_sector_rates_test
