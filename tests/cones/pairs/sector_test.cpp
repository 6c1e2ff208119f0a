// SPDX-License-Identifier: BSD-3-Clause
//
// Sectors of any two bodies on planes, against verdicts of velocities in the plane and against moved bodies.
#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "support/campaign.h"

namespace vericone::sector_test {
namespace {

using Eigen::Vector3d;
using testing::any_body;
using testing::any_pose;
using testing::campaign_size;
using testing::RandomBodies;

Vector3d direction(const PlaneSector& s, double angle) {
  return std::cos(angle) * s.line_of_sight + std::sin(angle) * s.across;
}

bool collides(Verdict verdict) { return verdict == Verdict::in || verdict == Verdict::on; }

class EveryPairSector : public ::testing::TestWithParam<std::tuple<BodyKind, BodyKind>> {};

TEST_P(EveryPairSector, HoldsTheConeOnItsPlane) {
  const auto [first, second] = GetParam();
  RandomBodies random(1700 + 7 * static_cast<std::uint64_t>(first) + static_cast<std::uint64_t>(second));
  SCOPED_TRACE(random.trace());
  const Vector3d still = Vector3d::Zero();
  int seen = 0, exact = 0, sharp = 0, missing = 0;
  for (int i = 0; i < campaign_size(1, 60); ++i) {
    const Placed a(any_body(random, first), any_pose(random, 0.5)),
        b(any_body(random, second), any_pose(random, random.uniform(6, 12)));
    const Pair pair(a, b), exchanged(b, a);
    if (pair.relation() != Relation::disjoint) continue;
    const Vector3d across = random.direction();
    const auto sector = pair.sector(across);
    const auto mirrored = exchanged.sector(b.middle(), a.middle(), -across);
    ASSERT_EQ(sector.has_value(), mirrored.has_value()) << i;
    missing += !sector;
    if (!sector) continue;
    ++seen;
    exact += pair.guarantee().exact;
    const PlaneSector& s = *sector;
    ASSERT_NEAR(s.line_of_sight.dot(s.across), 0, 1e-14);
    ASSERT_NEAR(s.distance, (b.middle() - a.middle()).norm(), 1e-12 * s.distance);
    for (const double side : {1.0, -1.0}) {
      const PlaneSector::Edge &edge = side > 0 ? s.left : s.right,
                              &image = side > 0 ? mirrored->left : mirrored->right;
      ASSERT_NEAR(edge.angle, image.angle, edge.error + image.error + 1e-12) << "pair " << i;
      sharp += edge.error < 1e-6;
      const double beyond = edge.angle + edge.error + 1e-9, inside = edge.angle - edge.error - 1e-9;
      ASSERT_FALSE(collides(pair.verdict(direction(s, side * beyond), still))) << "pair " << i;
      ASSERT_NE(pair.verdict(direction(s, side * inside), still), Verdict::out) << "pair " << i;
      if (edge.normal.isZero(0)) continue;
      const Vector3d d = direction(s, side * edge.angle);
      ASSERT_NEAR(edge.normal.norm(), 1, 1e-12);
      ASSERT_NEAR(edge.normal.dot(d), 0, 1e-9) << "pair " << i;
      ASSERT_NEAR(edge.contact.normalized().dot(d), 1, 1e-9) << "pair " << i;
      ASSERT_NEAR((a.middle() + edge.on_a + edge.contact - b.middle() - edge.on_b).norm(), 0, 1e-12);
    }
    // Nothing outside, whatever gaps there are inside.
    for (int k = 0; k < 40; ++k) {
      const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
      if (angle > s.left.angle + s.left.error + 1e-9 || angle < -s.right.angle - s.right.error - 1e-9) {
        ASSERT_FALSE(collides(pair.verdict(direction(s, angle), still))) << "pair " << i << " at " << angle;
      }
    }
  }
  EXPECT_GT(seen, 0);
  EXPECT_LE(missing, seen);
  EXPECT_GE(sharp, 2 * exact);
}

Placed moved(const Placed& body, const Twist& twist, double t) {
  const double angle = t * twist.omega.norm();
  Placed later = body;
  const Vector3d reference = body.middle();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (angle != 0) turn = Eigen::AngleAxisd(angle, twist.omega.normalized()).toRotationMatrix();
  later.pose.rotation = turn * body.pose.rotation;
  later.pose.position = reference + t * twist.velocity + turn * (body.pose.position - reference);
  return later;
}

TEST_P(EveryPairSector, RatesAreThoseOfMovedBodies) {
  const auto [first, second] = GetParam();
  RandomBodies random(1800 + 7 * static_cast<std::uint64_t>(first) + static_cast<std::uint64_t>(second));
  SCOPED_TRACE(random.trace());
  int right = 0, asked = 0, exact = 0;
  // Sectors of certified pairs take long, and few of them have rates.
  const auto slow = [](BodyKind kind) { return kind == BodyKind::combined || kind == BodyKind::pieces; };
  const bool one = slow(first) || slow(second);
  for (int i = 0; i < campaign_size(one ? 1 : 8, 60); ++i) {
    const Placed a(any_body(random, first), any_pose(random, 0.5)),
        b(any_body(random, second), any_pose(random, random.uniform(6, 12)));
    const Vector3d across = random.direction();
    const Twist of_a{random.direction(), random.direction()}, of_b{random.direction(), random.direction()};
    const auto at = [&](double t) -> std::optional<PlaneSector> {
      const Placed p = moved(a, of_a, t), q = moved(b, of_b, t);
      const auto now = Pair(a, b).sector(across);
      if (!now) return std::nullopt;
      const Vector3d u = (q.middle() - p.middle()).normalized();
      // e is carried along with the line of sight.
      const Vector3d e = Eigen::Quaterniond::FromTwoVectors(now->line_of_sight, u) * now->across;
      return Pair(p, q).sector(p.middle(), q.middle(), e);
    };
    const auto now = at(0);
    exact += now && Pair(a, b).guarantee().exact;
    if (!now || !now->has_contacts()) continue;
    const auto rates = sector_rates(*now, of_a, of_b);
    ASSERT_TRUE(rates.has_value());
    constexpr double kStep = 1e-4;
    const auto before = at(-kStep), after = at(kStep);
    if (!before || !after) continue;
    ++asked;
    const double left = (after->left.angle - before->left.angle) / (2 * kStep),
                 across_sight = (after->right.angle - before->right.angle) / (2 * kStep);
    // At corners the difference is of two contacts.
    const double slack = 2e-4 * (of_a.omega.norm() + of_b.omega.norm() + 1);
    right += std::abs(rates->left - left) < slack && std::abs(rates->right - across_sight) < slack;
  }
  EXPECT_GE(asked, exact - 1);
  EXPECT_GE(right, one ? 0.9 * asked - 1 : 0.7 * asked) << "of " << asked;
}

std::string kinds_on_plane(const ::testing::TestParamInfo<EveryPairSector::ParamType>& info) {
  return std::string(to_string(std::get<0>(info.param))) + "_" + to_string(std::get<1>(info.param));
}
INSTANTIATE_TEST_SUITE_P(Kinds, EveryPairSector,
                         ::testing::Combine(::testing::ValuesIn(kBodyKinds), ::testing::ValuesIn(kBodyKinds)),
                         kinds_on_plane);

TEST(PairSector, IsThatOfTheFamilyAndRefusesWhatIsNoPlane) {
  const Ellipsoid a, b = Ellipsoid::from_axes({10, 0, 0}, Vector3d::Constant(2));
  const Pair pair{Body(a), Body(b)};
  const auto sector = pair.sector({0, 1, 0});
  ASSERT_TRUE(sector);
  EXPECT_EQ(sector->left.angle, true_sector(a, b, {0, 1, 0}).left.angle);
  EXPECT_NEAR(sector->psi(), 2 * std::asin(0.3), 1e-15);
  const auto rates = sector_rates(*sector, {{1, 0, 0}, Vector3d::Zero()}, Twist());
  ASSERT_TRUE(rates);
  // sin(psi/2) = 3/r, and r falls by 1 m/s.
  EXPECT_NEAR(rates->left, 0.03 / std::cos(std::asin(0.3)), 1e-14);
  EXPECT_THROW(pair.sector({1, 0, 0}), InputError);
  EXPECT_THROW(pair.sector({1, 2, 3}, {1, 2, 3}, {0, 1, 0}), InputError);
  EXPECT_FALSE(Pair(Body(a), Body(a)).sector({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
}

TEST(PairSector, OfAnObstacleBesideTheLineOfSight) {
  // The reference point is where nothing is: the cone lies on one side of the line to it.
  const Pair pair{Body(Ellipsoid::from_axes({0, 0, 0}, Vector3d::Constant(1))),
                  Body(Ellipsoid::from_axes({10, 10, 0}, Vector3d::Constant(1)))};
  const auto sector = pair.sector({0, 0, 0}, {10, 0, 0}, {0, 1, 0});
  ASSERT_TRUE(sector);
  const double half = std::asin(2 / std::sqrt(200.0)), middle = std::numbers::pi / 4;
  EXPECT_NEAR(sector->left.angle, middle + half, 1e-8);
  EXPECT_NEAR(-sector->right.angle, middle - half, 1e-8);
}

}  // namespace
}  // namespace vericone::sector_test
