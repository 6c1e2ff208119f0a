// SPDX-License-Identifier: BSD-3-Clause
//
// Both ways to a planar sector against each other, against 50 digits and under symmetries.
#include <gtest/gtest.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/LU>

#include <iostream>
#include <numbers>

#include "cones/planar/reference_sector.h"
#include "support/campaign.h"

namespace vericone::sector_property_test {
namespace {

using Eigen::Matrix2d, Eigen::Vector2d;
using std::numbers::pi;
using testing::RandomBodies, testing::ReferenceSector, testing::share;

double turn_between(double x, double y) { return std::abs(std::remainder(x - y, 2 * pi)); }
double cross(const Vector2d& x, const Vector2d& y) { return x.x() * y.y() - x.y() * y.x(); }

RandomBodies::PlanarPair ordinary(RandomBodies& random) {
  return random.planar_scaled_from_touching(0.5, 10, random.uniform(1.05, 5));
}
RandomBodies::PlanarPair thin(RandomBodies& random) {
  return random.planar_scaled_from_touching(1e-6, 1, random.uniform(1.05, 5));
}
RandomBodies::PlanarPair distant(RandomBodies& random) {
  return random.planar_scaled_from_touching(0.5, 10, random.log_uniform(1e3, 1e9));
}
RandomBodies::PlanarPair nearly_touching(RandomBodies& random) {
  return random.planar_scaled_from_touching(0.5, 10, 1 + random.log_uniform(1e-12, 1e-3));
}
RandomBodies::PlanarPair congruent(RandomBodies& random) {
  const Ellipse a = random.ellipse({0, 0}, 0.5, 10);
  return {a, a.translated(random.uniform(2.01, 5) * 10 * random.direction_2d())};
}
RandomBodies::PlanarPair proportional(RandomBodies& random) {
  const Ellipse a = random.ellipse({0, 0}, 0.5, 10);
  return {
      a,
      a.scaled(random.log_uniform(1e-3, 1)).translated(random.uniform(2.01, 5) * 10 * random.direction_2d())};
}
/// Common axes, centres on one of them: the pencil has a member that is a double line for circles.
RandomBodies::PlanarPair coaxial(RandomBodies& random) {
  const Matrix2d r = rotation_2d(random.uniform(-pi, pi));
  const Vector2d pa(random.uniform(1, 5), random.uniform(1, 5)),
      pb(random.uniform(1, 5), random.uniform(1, 5));
  return {Ellipse::from_axes({0, 0}, pa, r),
          Ellipse::from_axes((pa.x() + pb.x()) * random.uniform(1.01, 4) * r.col(0), pb, r)};
}
RandomBodies::PlanarPair by_shape(RandomBodies& random) {
  const auto [a, b] = random.planar_scaled_from_touching(1e-3, 1, random.uniform(1.05, 5));
  return {Ellipse::from_shape(a.center(), a.shape()), Ellipse::from_shape(b.center(), b.shape())};
}

struct Family {
  const char* name;
  RandomBodies::PlanarPair (*draw)(RandomBodies&);
  // Bounds on the relative error of psi and the error of theta_b: by supports, by degenerate conics.
  double support, conics;
};

constexpr double kUlp = 0x1p-52;

class SectorFamilies : public ::testing::TestWithParam<Family> {};

TEST_P(SectorFamilies, AgreeWithFiftyDigits) {
  RandomBodies random(551);
  SCOPED_TRACE(random.trace());
  double worst[2][2] = {};
  int missing = 0;
  for (int i = 0; i < share(150); ++i) {
    const auto [a, b] = GetParam().draw(random);
    const ReferenceSector exact(a, b);
    const Sector s = sector_by_support(a, b);
    ASSERT_EQ(s.relation, Relation::disjoint);
    const auto conics = sector_by_degenerate_conics(a, b);
    missing += !conics.has_value();
    for (const int method : {0, 1}) {
      if (method == 1 && !conics) continue;
      const Sector& sector = method == 0 ? s : *conics;
      worst[method][0] = std::max(worst[method][0], exact.relative_error_of_psi(sector.psi));
      worst[method][1] = std::max(worst[method][1], exact.error_of_theta_b(sector.theta_b));
    }
  }
  std::cout << "[ accuracy ] " << GetParam().name << ": supports psi " << worst[0][0] << " theta_b "
            << worst[0][1] << ", degenerate conics " << worst[1][0] << ", " << worst[1][1]
            << ", without answer " << missing << "\n";
  EXPECT_LE(worst[0][0], GetParam().support);
  EXPECT_LE(worst[0][1], GetParam().support);
  EXPECT_LE(worst[1][0], GetParam().conics);
  EXPECT_LE(worst[1][1], GetParam().conics);
  EXPECT_EQ(missing, 0);
}

INSTANTIATE_TEST_SUITE_P(Planar, SectorFamilies,
                         ::testing::Values(Family{"ordinary", ordinary, 8 * kUlp, 1e-12},
                                           Family{"thin", thin, 8 * kUlp, 1e-12},
                                           Family{"distant", distant, 8 * kUlp, 1e-12},
                                           Family{"nearly_touching", nearly_touching, 8 * kUlp, 1e-8},
                                           Family{"congruent", congruent, 8 * kUlp, 1e-12},
                                           Family{"proportional", proportional, 8 * kUlp, 1e-12},
                                           Family{"coaxial", coaxial, 8 * kUlp, 1e-12},
                                           Family{"by_shape", by_shape, 8 * kUlp, 1e-12}),
                         [](const auto& family) { return std::string(family.param.name); });

/// A line through p along d that the body touches at p: p on the boundary, d in the tangent there.
void expect_tangent(const Ellipse& body, const Vector2d& p, const Vector2d& d) {
  const double size = body.factor().norm();
  const Vector2d u = body.factor().inverse() * (p - body.center()), t = body.factor().inverse() * d;
  ASSERT_NEAR(u.norm(), 1, 1e-12 * (1 + body.center().norm() / size));
  ASSERT_NEAR(u.dot(t) / t.norm(), 0, 1e-7) << "touching, not crossing";
}

TEST(SectorLaws, EdgesAreInnerTangents) {
  RandomBodies random(552);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 5000; ++i) {
    const auto [a, b] = ordinary(random);
    const Sector support = sector_by_support(a, b), conics = sector_by_degenerate_conics(a, b).value();
    ASSERT_NEAR(support.psi, conics.psi, 1e-12);
    ASSERT_LE(turn_between(support.theta_b, conics.theta_b), 1e-12);
    for (const Sector* s : {&support, &conics})
      for (const SectorEdge* e : {&s->left, &s->right}) {
        ASSERT_NO_FATAL_FAILURE(expect_tangent(a, e->point_on_a, e->direction)) << "case " << i;
        ASSERT_NO_FATAL_FAILURE(expect_tangent(b, e->point_on_b, e->direction)) << "case " << i;
        const Vector2d between = e->point_on_b - e->point_on_a;
        ASSERT_NEAR(cross(e->direction, between), 0, 1e-12 * (1 + between.norm())) << "one line";
        ASSERT_GT(e->direction.dot(between), 0) << "from A to B";
        ASSERT_NEAR(e->normal.dot(e->direction), 0, 1e-15);
        const double side_a = a.center().dot(e->normal) - e->point_on_a.dot(e->normal),
                     side_b = b.center().dot(e->normal) - e->point_on_a.dot(e->normal);
        ASSERT_LT(side_a, 0) << "A on the low side";
        ASSERT_GT(side_b, 0) << "B on the high side";
        const double angle = std::atan2(e->direction.y(), e->direction.x());
        ASSERT_LE(turn_between(angle, s->theta_b + (e == &s->left ? 0.5 : -0.5) * s->psi), 1e-14);
      }
    ASSERT_GT(cross(support.right.direction, support.left.direction), -1e-15);
    ASSERT_GT(support.left.normal.dot(support.right.direction), 0) << "normals point into the sector";
  }
}

TEST(SectorLaws, SwappingTheBodiesTurnsTheSectorByHalfATurn) {
  RandomBodies random(553);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 5000; ++i) {
    const auto [a, b] = i % 3 == 0 ? ordinary(random) : i % 3 == 1 ? thin(random) : distant(random);
    const Sector ab = sector_by_support(a, b), ba = sector_by_support(b, a);
    ASSERT_NEAR(ab.psi / ba.psi, 1, 8 * kUlp) << "case " << i;
    ASSERT_LE(turn_between(ab.theta_b, ba.theta_b + pi), 8 * kUlp) << "case " << i;
  }
}

TEST(SectorLaws, AffineImagesHaveTheImagesOfTheEdges) {
  RandomBodies random(554);
  SCOPED_TRACE(random.trace());
  int reflections = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto [a, b] = ordinary(random);
    Matrix2d m;
    do
      for (int j = 0; j < 4; ++j) m(j) = random.uniform(-2, 2);
    while (std::abs(m.determinant()) < 0.3);
    const auto image = [&](const Ellipse& e) {
      Matrix2d s = m * e.shape() * m.transpose();
      s(1, 0) = s(0, 1);
      return Ellipse::from_shape(m * e.center(), s);
    };
    const bool reflected = m.determinant() < 0;
    reflections += reflected;
    const Sector s = sector_by_support(a, b);
    for (const Sector& t :
         {sector_by_support(image(a), image(b)), sector_by_degenerate_conics(image(a), image(b)).value()}) {
      const Vector2d left = (m * (reflected ? s.right : s.left).direction).normalized(),
                     right = (m * (reflected ? s.left : s.right).direction).normalized();
      ASSERT_LT((t.left.direction - left).norm(), 1e-11) << "case " << i;
      ASSERT_LT((t.right.direction - right).norm(), 1e-11) << "case " << i;
    }
  }
  EXPECT_GT(reflections, 1000);
}

TEST(SectorLaws, ScaleAndRotation) {
  RandomBodies random(555);
  SCOPED_TRACE(random.trace());
  for (const double scale : {1e-100, 1e-9, 1e9, 1e100}) {
    for (int i = 0; i < 500; ++i) {
      const auto [a, b] = ordinary(random);
      const Sector s = sector_by_support(a, b), t = sector_by_support(a.scaled(scale), b.scaled(scale));
      ASSERT_NEAR(t.psi, s.psi, 1e-13) << "case " << i << " scale " << scale;
      ASSERT_LE(turn_between(t.theta_b, s.theta_b), 1e-13);
      const auto conics = sector_by_degenerate_conics(a.scaled(scale), b.scaled(scale));
      ASSERT_TRUE(conics.has_value());
      ASSERT_NEAR(conics->psi, s.psi, 1e-12) << "case " << i << " scale " << scale;
    }
  }
}

}  // namespace
}  // namespace vericone::sector_property_test
