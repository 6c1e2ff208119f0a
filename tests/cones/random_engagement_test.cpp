// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/internal/cones/random_engagement.h>

#include <algorithm>
#include <cmath>

namespace vericone::engagements {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

constexpr std::uint64_t kSeed = 20261123;

TEST(RandomEngagement, DependOnSeedAndPositionAlone) {
  const auto numbers = [](std::uint64_t seed, std::uint64_t index) {
    Random random(seed, index);
    return Vector3d(random.uniform(), random.uniform(), random.uniform());
  };
  EXPECT_EQ(numbers(1, 5), numbers(1, 5));
  EXPECT_NE(numbers(1, 5), numbers(1, 6));
  EXPECT_NE(numbers(1, 5), numbers(2, 5));
  const auto [a, b] = random_engagement(kSeed, 7);
  const auto [again, b_again] = random_engagement(kSeed, 7);
  EXPECT_EQ(a.shape(), again.shape());
  EXPECT_EQ(b.center(), b_again.center());
}

TEST(RandomEngagement, NumbersDirectionsAndRotationsAreUniform) {
  constexpr int kCount = 20'000;
  Vector3d mean = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero(), turned = Matrix3d::Zero();
  double sum = 0;
  for (int i = 0; i < kCount; ++i) {
    Random random(kSeed, static_cast<std::uint64_t>(i));
    sum += random.uniform(2, 4);
    const Vector3d d = random.direction();
    const Matrix3d r = random.rotation();
    EXPECT_NEAR(d.norm(), 1, 1e-15);
    EXPECT_NEAR((r * r.transpose() - Matrix3d::Identity()).norm(), 0, 1e-14);
    EXPECT_GT(r.determinant(), 0);
    mean += d / kCount;
    second += d * d.transpose() / kCount;
    turned += r / kCount;
  }
  // Five standard deviations of means of numbers of size 1.
  const double slack = 5 / std::sqrt(kCount);
  EXPECT_NEAR(sum / kCount, 3, slack);
  EXPECT_LT(mean.norm(), slack);
  EXPECT_LT((second - Matrix3d::Identity() / 3).cwiseAbs().maxCoeff(), slack);
  EXPECT_LT(turned.cwiseAbs().maxCoeff(), slack);
}

TEST(RandomEngagement, EngagementsAreApartAndAsTheDistributionSays) {
  const Distribution near{{0.2, 0.5}, {1.5, 3}, Range{2, 20}};
  for (std::uint64_t i = 0; i < 500; ++i) {
    const auto [a, b] = random_engagement(kSeed, i);
    const Vector3d c = b.center() - a.center(), d = c.normalized();
    const double apart = c.norm() / (a.radius(d) + b.radius(d));
    EXPECT_GE(apart, 1.5 - 1e-12);
    EXPECT_LE(apart, 3 + 1e-12);
    for (const Ellipsoid& body : {a, b}) {
      EXPECT_GE(body.semi_axes().minCoeff(), 1 - 1e-12);
      EXPECT_LE(body.semi_axes().maxCoeff(), 10 + 1e-12);
    }
    const auto [p, q] = random_engagement(kSeed, i, near);
    const double distance = (q.center() - p.center()).norm();
    EXPECT_TRUE(distance >= 2 - 1e-12 && distance <= 20 + 1e-12) << distance;
    EXPECT_LE(q.semi_axes().maxCoeff(), 0.5 + 1e-12);
    const Ellipsoid agent = random_agent(b, kSeed, i);
    const Vector3d w = (b.center() - agent.center()).normalized();
    EXPECT_GT((b.center() - agent.center()).norm(), 1.5 * (agent.radius(w) + b.radius(w)) * (1 - 1e-12));
  }
}

TEST(RandomEngagement, DelimitedObstaclesHaveTheEllipsoidsOfThePlainOnes) {
  for (const auto& [kind, count] :
       {std::pair(ObstacleKind::ellipsoid, 0), std::pair(ObstacleKind::biconcave, 1),
        std::pair(ObstacleKind::biconvex, 1), std::pair(ObstacleKind::star, 3)})
    for (std::uint64_t i = 0; i < 50; ++i) {
      const auto [a, b] = random_engagement(kSeed, i);
      const auto [agent, obstacle] = random_combined_engagement(kind, kSeed, i);
      EXPECT_EQ(agent.center(), a.center());
      EXPECT_EQ(obstacle.ellipsoid().shape(), b.shape());
      EXPECT_EQ(obstacle.ellipsoid().center(), b.center());
      EXPECT_EQ(obstacle.delimiters().size(), static_cast<std::size_t>(count));
    }
}

}  // namespace
}  // namespace vericone::engagements
