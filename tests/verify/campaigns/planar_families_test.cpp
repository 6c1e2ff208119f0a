// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <vericone/internal/verify/predicates/exact_tangents.h>
#include <vericone/verify/planar/campaign.h>

#include <cmath>
#include <numbers>

namespace vericone::verify::planar_families_test {
namespace {

constexpr std::uint64_t kSeed = 20240611;
constexpr std::uint64_t kCases = 100;

std::string replay(PlanarFamily family, std::uint64_t index) {
  return std::string("planar_pair(") + name(family) + ", " + std::to_string(kSeed) + ", " +
         std::to_string(index) + ")";
}

/// The points of the boundary p + F (cos, sin), as offsets from `origin`, on the sides of the line along (c,
/// s): least and largest signed distance.
struct Sides {
  long double least = INFINITY, most = -INFINITY;

  Sides(const Ellipse& body, long double x, long double y, long double c, long double s) {
    constexpr int kPoints = 2000;
    for (int k = 0; k < kPoints; ++k) {
      const long double angle = 2 * std::numbers::pi_v<long double> * k / kPoints, u = std::cos(angle),
                        v = std::sin(angle);
      const long double px = body.center().x() - x + body.factor()(0, 0) * u + body.factor()(0, 1) * v,
                        py = body.center().y() - y + body.factor()(1, 0) * u + body.factor()(1, 1) * v;
      const long double side = c * py - s * px;
      least = std::min(least, side);
      most = std::max(most, side);
    }
  }
};

class EveryFamily : public ::testing::TestWithParam<PlanarFamily> {};

TEST_P(EveryFamily, TangentsLeaveTheBodiesOnOppositeSides) {
  for (std::uint64_t index = 0; index < kCases; ++index) {
    SCOPED_TRACE(replay(GetParam(), index));
    const auto [a, b] = planar_pair(GetParam(), kSeed, index);
    const ExactTangents exact = exact_inner_tangents(a, b);
    EXPECT_EQ(exact_relation(a, b), exact.relation);
    ASSERT_EQ(exact.tangents.has_value(), exact.relation == PlanarRelation::separated);
    if (GetParam() != PlanarFamily::nearly_touching && GetParam() != PlanarFamily::within_rounding &&
        GetParam() != PlanarFamily::thin_touching) {
      ASSERT_EQ(exact.relation, PlanarRelation::separated);
    }
    if (!exact.tangents) continue;
    const InnerTangents& t = *exact.tangents;

    EXPECT_GT(t.psi.lo(), 0);
    EXPECT_LT(t.psi.lo(), std::numbers::pi);
    EXPECT_LE(t.theta_b.hi(), std::nextafter(std::numbers::pi, 4.0));
    EXPECT_GT(t.theta_b.hi(), -std::numbers::pi);
    for (const EnclosedReal* e : {&t.psi, &t.theta_b, &t.right.direction, &t.left.direction})
      EXPECT_LE(std::nextafter(e->lo(), INFINITY), std::nextafter(e->hi(), INFINITY));

    for (const InnerTangent* line : {&t.right, &t.left}) {
      // The direction to more than double precision: the bodies may be 1e10 away.
      const long double angle =
          static_cast<long double>(line->direction.parts()[0]) + line->direction.parts()[1];
      const long double c = std::cos(angle), s = std::sin(angle);
      const long double turn = line == &t.left ? 1 : -1;  // B is to the right of the left edge
      const double xa = line->point_on_a[0].nearest(), ya = line->point_on_a[1].nearest(),
                   xb = line->point_on_b[0].nearest(), yb = line->point_on_b[1].nearest();
      const long double size_a = a.factor().norm(), size_b = b.factor().norm();
      const long double distance = (b.center() - a.center()).norm();
      // Rounding of the contact points, long double angles over the distance, and the thin axes of bodies
      // that are defined by their shape: the factor that the samples come from is a rounded one.
      const long double far = a.center().norm() + b.center().norm();
      const long double tolerance = 1e-15L * far + 1e-14L * (size_a + size_b) + 2e-19L * distance;

      const Sides side_a(a, xa, ya, c, s), side_b(b, xb, yb, c, s);
      EXPECT_GE(turn * (turn > 0 ? side_a.least : side_a.most), -tolerance);
      EXPECT_LE(turn * (turn > 0 ? side_b.most : side_b.least), tolerance);
      // It touches: a boundary sampled at 2000 points comes as near as (pi/2000)^2 / 2 of its size.
      EXPECT_LE(turn * (turn > 0 ? side_a.least : side_a.most), tolerance + 1.3e-6L * size_a);
      EXPECT_GE(turn * (turn > 0 ? side_b.most : side_b.least), -tolerance - 1.3e-6L * size_b);
      // Both contacts are on one line, that of the direction, and in this order.
      const long double dx = static_cast<long double>(xb) - xa, dy = static_cast<long double>(yb) - ya;
      EXPECT_LE(std::abs(c * dy - s * dx), tolerance + 4e-16L * (std::abs(xb) + std::abs(yb)));
      if (distance > 1.001L * tolerance) {
        EXPECT_GE(c * dx + s * dy, -tolerance);
      }
    }
    const double turned =
        std::remainder(t.left.direction.nearest() - t.right.direction.nearest(), 2 * std::numbers::pi);
    EXPECT_NEAR(turned < 0 ? turned + 2 * std::numbers::pi : turned, t.psi.nearest(), 2e-15);
  }
}

TEST_P(EveryFamily, IsReplayed) {
  for (std::uint64_t index = 0; index < 20; ++index) {
    const auto first = planar_pair(GetParam(), kSeed, index), again = planar_pair(GetParam(), kSeed, index);
    EXPECT_EQ(first.first.shape(), again.first.shape());
    EXPECT_EQ(first.second.shape(), again.second.shape());
    EXPECT_EQ(first.first.center(), again.first.center());
    EXPECT_EQ(first.second.center(), again.second.center());
    const auto other = planar_pair(GetParam(), kSeed + 1, index),
               next = planar_pair(GetParam(), kSeed, index + 1);
    EXPECT_NE(first.second.center(), other.second.center());
    EXPECT_NE(first.second.center(), next.second.center());
  }
}

INSTANTIATE_TEST_SUITE_P(Planar, EveryFamily, ::testing::ValuesIn(kAllPlanarFamilies),
                         [](const auto& family) { return std::string(name(family.param)); });

TEST(PlanarFamilies, CongruentAndProportionalAreSoExactly) {
  for (std::uint64_t index = 0; index < kCases; ++index) {
    const auto same = planar_pair(PlanarFamily::congruent, kSeed, index);
    EXPECT_EQ(same.first.shape(), same.second.shape()) << replay(PlanarFamily::congruent, index);
    EXPECT_EQ(same.first.factor(), same.second.factor());
    const auto scaled = planar_pair(PlanarFamily::proportional, kSeed, index);
    const double ratio = scaled.second.shape()(0, 0) / scaled.first.shape()(0, 0);
    EXPECT_EQ(ratio * scaled.first.shape(), scaled.second.shape())
        << replay(PlanarFamily::proportional, index);
  }
}

TEST(PlanarFamilies, SymmetricOnesHaveTheirBisectorOnTheAxis) {
  for (std::uint64_t index = 0; index < kCases; ++index) {
    SCOPED_TRACE(replay(PlanarFamily::symmetric, index));
    const auto [a, b] = planar_pair(PlanarFamily::symmetric, kSeed, index);
    const Eigen::Vector2d c = b.center() - a.center();
    ASSERT_TRUE((c.x() == 0) != (c.y() == 0));
    const InnerTangents t = exact_inner_tangents(a, b).tangents.value();
    EXPECT_EQ(t.theta_b.nearest(), std::atan2(c.y(), c.x()));
    EXPECT_EQ(a.shape()(0, 1), 0);
  }
}

TEST(PlanarFamilies, CommonAxesAreCommonExactly) {
  for (std::uint64_t index = 0; index < kCases; ++index) {
    const auto [a, b] = planar_pair(PlanarFamily::common_axes, kSeed, index);
    // Symmetric matrices have common eigenvectors iff they commute; the entries have few enough bits for
    // double.
    const Eigen::Matrix2d ab = a.shape() * b.shape();
    EXPECT_EQ(ab(0, 1), ab(1, 0)) << replay(PlanarFamily::common_axes, index);
  }
}

TEST(PlanarFamilies, NearlyTouchingIsOnTheSideItSays) {
  for (std::uint64_t index = 0; index < kCases; ++index) {
    const auto [a, b] = planar_pair(PlanarFamily::nearly_touching, kSeed, index);
    EXPECT_STREQ(name(exact_relation(a, b)), index % 4 == 3 ? "overlapping" : "separated")
        << replay(PlanarFamily::nearly_touching, index);
  }
}

TEST(PlanarFamilies, WithinRoundingIsOnBothSides) {
  int separated = 0;
  for (std::uint64_t index = 0; index < kCases; ++index) {
    const auto [a, b] = planar_pair(PlanarFamily::within_rounding, kSeed, index);
    if (exact_relation(a, b) == PlanarRelation::separated) ++separated;
  }
  EXPECT_GT(separated, 20);
  EXPECT_LT(separated, 80);
}

}  // namespace
}  // namespace vericone::verify::planar_families_test
