// SPDX-License-Identifier: BSD-3-Clause
//
// Ship domains against their sources, and the side of passing against ships that sail past each other.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/ships/ships.h>
#include <cmath>
#include <numbers>

namespace vericone::ships::domain_test {

using Eigen::Vector2d;
using engagements::Random;

constexpr double kPi = std::numbers::pi;

/// How far a domain reaches from the ship along a bearing, counter-clockwise from ahead.
double along(const Domain& domain, double bearing) {
  const Ellipse body = domain.about(Vector2d::Zero(), 0);
  const Vector2d u(std::cos(bearing), std::sin(bearing));
  const Eigen::Matrix2d quadric = body.shape().inverse();
  const double a = u.dot(quadric * u), b = u.dot(quadric * body.center()),
               c = body.center().dot(quadric * body.center()) - 1;
  return (b + std::sqrt(b * b - a * c)) / a;
}

TEST(Domains, ReachAsFarAsTheirSourcesSay) {
  const double length = 150;
  const Domain coldwell = Domain::coldwell(length);
  const Ellipse about = coldwell.about(Vector2d(1000, 2000), kPi / 2);  // to the north
  const auto support = [&](double x, double y) {
    const Vector2d n(x, y);
    return about.support(n) - n.dot(Vector2d(1000, 2000));
  };
  EXPECT_NEAR(support(0, 1), 6.1 * length, 1e-9);
  EXPECT_NEAR(support(0, -1), 3.9 * length, 1e-9);
  EXPECT_NEAR(support(1, 0), 3.25 * length, 1e-9);  // starboard is to the east
  EXPECT_NEAR(support(-1, 0), 1.75 * length, 1e-9);
  EXPECT_NEAR(along(Domain::fujii(length), 0), 4 * length, 1e-9);
  EXPECT_NEAR(along(Domain::fujii(length), kPi / 2), 1.6 * length, 1e-9);
  EXPECT_NEAR(along(Domain::coldwell_overtaking(length), 0), 6 * length, 1e-9);
  EXPECT_NEAR(along(Domain::coldwell_overtaking(length), -kPi / 2), 1.75 * length, 1e-9);
}

TEST(Domains, OfGoodwinContainsHerSectors) {
  for (int k = 0; k < 3600; ++k) {
    const double bearing = k * kPi / 1800;
    const double sector = bearing <= 112.5 * kPi / 180 ? 0.7 : bearing >= 247.5 * kPi / 180 ? 0.85 : 0.45;
    EXPECT_GE(along(Domain::goodwin(), bearing), sector * 1852) << k;
  }
  // No larger than it need be: the sectors' own area is 1.60 square miles.
  EXPECT_LT(Domain::goodwin().half.prod() * kPi, 2.01 * 1852 * 1852);
}

/// What becomes of two bodies that keep a relative velocity: nearer than apart, or the side of b.
enum class Passed { meets, port, starboard };
Passed by_sailing(const Ellipse& a, const Ellipse& b, const Vector2d& w) {
  // b's centre seen from a's: along w until the gap along normals of the line is told: the strips of both
  // bodies across w.
  const Vector2d c = b.center() - a.center(), across(-w.y(), w.x());
  const double offset = across.dot(c), wide = a.radius(across) + b.radius(across);
  if (std::abs(offset) <= wide) return Passed::meets;
  return offset > 0 ? Passed::port : Passed::starboard;
}

TEST(SideOfPassing, IsTheHalfOfVelocitiesThatPassThere) {
  Random random(3, 0);
  int passed = 0, wrong_side = 0, met = 0;
  for (int i = 0; i < 300; ++i) {
    const Ellipse a = Domain::coldwell(150).about({0, 0}, random.uniform(-kPi, kPi));
    const double far = random.uniform(2000, 9000), angle = random.uniform(-kPi, kPi);
    const Ellipse b = Ellipse::from_axes(far * Vector2d(std::cos(angle), std::sin(angle)), {75, 12},
                                         rotation_2d(random.uniform(-kPi, kPi)));
    const Vector2d v_b(random.uniform(-8, 8), random.uniform(-8, 8));
    const VelocityHalfPlane port = pass_with(Side::port, a, b, v_b),
                            starboard = pass_with(Side::starboard, a, b, v_b);
    for (int k = 0; k < 100; ++k) {
      const Vector2d v(random.uniform(-9, 9), random.uniform(-9, 9)), w = v - v_b;
      if (w.dot(b.center() - a.center()) <= 0) continue;  // they come no nearer
      // The others go by or meet; towards b the half-planes of both sides and the cone are all there is.
      const Passed truth = by_sailing(a, b, w);
      const double of_port = port.normal.dot(v) - port.offset,
                   of_starboard = starboard.normal.dot(v) - starboard.offset;
      ASSERT_EQ(of_port > 0, truth == Passed::port) << i;
      ASSERT_EQ(of_starboard > 0, truth == Passed::starboard) << i;
      (truth == Passed::port ? passed : truth == Passed::meets ? met : wrong_side) += 1;
    }
  }
  EXPECT_GT(passed, 1000);
  EXPECT_GT(wrong_side, 1000);
  EXPECT_GT(met, 500);
}

TEST(SideOfPassing, NeedsBodiesThatAreApart) {
  const Ellipse a = Domain::fujii(150).about({0, 0}, 0), b = Domain::fujii(150).about({100, 0}, 1);
  EXPECT_THROW(pass_with(Side::port, a, b, Vector2d::Zero()), InputError);
}

}  // namespace vericone::ships::domain_test
