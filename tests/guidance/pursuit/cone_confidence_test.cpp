// SPDX-License-Identifier: BSD-3-Clause
//
// Probability of the cone and bounds of y against draws.
#include <gtest/gtest.h>
#include <vericone/guidance/pursuit/pursuit_law.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "support/allocations.h"
#include "support/campaign.h"

namespace vericone::guidance::cone_confidence_test {
namespace {

using Eigen::Matrix4d, Eigen::Vector2d, Eigen::Vector4d;
using testing::RandomBodies;

struct Engagement {
  EnclosingEllipse ellipse;
  Vector2d position, velocity;
  Matrix4d covariance;
};

/// `noise`: deviations in metres and m/s are drawn up to this size; correlated.
Engagement random_engagement(RandomBodies& random, double noise) {
  Engagement g;
  EnclosingEllipse& e = g.ellipse;
  e.a = random.uniform(4, 30);
  e.b = e.a * random.uniform(0.1, 1);
  e.angle = random.uniform(-3, 3);
  e.centre = random.uniform(0, 200) * random.direction_2d();
  e.centre_rate = random.uniform(0, 25) * random.direction_2d();
  g.position = random.uniform(0, 50) * random.direction_2d();
  // Most of them aimed at the ellipse, more or less.
  const Vector2d to = e.centre + random.uniform(0, 1.5) * e.a * random.direction_2d() - g.position;
  g.velocity =
      e.centre_rate + (random.integer(0, 3) ? Vector2d(random.uniform(0.02, 0.3) * to)
                                            : Vector2d(random.uniform(0, 15) * random.direction_2d()));
  Matrix4d l;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      l(i, j) = random.log_uniform(1e-2, 1) * random.uniform(-1, 1) * noise * (i < 2 ? 2 : 0.5);
  g.covariance = l * l.transpose();
  return g;
}

double drawn(const Engagement& g, int draws, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const Matrix4d l = g.covariance.llt().matrixL();
  int in = 0;
  for (int i = 0; i < draws; ++i) {
    const Vector4d d = l * Vector4d(normal(engine), normal(engine), normal(engine), normal(engine));
    in += miss_distance(g.position + d.head<2>() - g.ellipse.centre,
                        g.velocity + d.tail<2>() - g.ellipse.centre_rate, g.ellipse) < 0;
  }
  return double(in) / draws;
}

TEST(ConeConfidence, ProbabilityAgainstDraws) {
  RandomBodies random(4401);
  SCOPED_TRACE(random.trace());
  const int cases = testing::campaign_size(12, 400);
  constexpr int kDraws = 1'000'000;
  double worst = 0, sum = 0;
  int between = 0;
  for (int i = 0; i < cases; ++i) {
    const Engagement g = random_engagement(random, random.log_uniform(0.3, 8));
    const double p = cone_confidence(g.position, g.velocity, g.ellipse, g.covariance).probability;
    const double truth = drawn(g, kDraws, 1000 + std::uint64_t(i));
    worst = std::max(worst, std::abs(p - truth));
    sum += std::abs(p - truth);
    between += truth > 0.01 && truth < 0.99;
  }
  std::printf("%d cases, %d of them between 1 and 99 %%: worst error %.4f, mean %.5f\n", cases, between,
              worst, sum / cases);
  EXPECT_GT(between, cases / 4);
  EXPECT_LT(worst, 0.015);
}

TEST(ConeConfidence, WithoutNoiseItIsTheCone) {
  RandomBodies random(4402);
  SCOPED_TRACE(random.trace());
  int in = 0;
  for (int i = 0; i < 2000; ++i) {
    const Engagement g = random_engagement(random, 1);
    const double m =
        miss_distance(g.position - g.ellipse.centre, g.velocity - g.ellipse.centre_rate, g.ellipse);
    const ConeConfidence c = cone_confidence(g.position, g.velocity, g.ellipse, Matrix4d::Zero());
    EXPECT_EQ(c.probability, m < 0 ? 1 : 0) << m;
    in += m < 0;
    const PursuitStep step = pursuit_law(g.position, g.velocity, g.ellipse, Vector2d::Zero(), {});
    EXPECT_NEAR(c.y_low, step.y1, 1e-9 * (std::abs(step.y1) + 1));
    EXPECT_NEAR(c.y_high, step.y1, 1e-9 * (std::abs(step.y1) + 1));
  }
  EXPECT_GT(in, 200);
}

/// Every state within 3 deviations has its y between the bounds; the bounds are not idle.
TEST(ConeConfidence, BoundsHoldWithinTheDeviations) {
  RandomBodies random(4403);
  SCOPED_TRACE(random.trace());
  int outside = 0;
  double used = 0;
  constexpr int kCases = 300;
  for (int i = 0; i < kCases; ++i) {
    const Engagement g = random_engagement(random, random.log_uniform(0.05, 5));
    const ConeConfidence c = cone_confidence(g.position, g.velocity, g.ellipse, g.covariance, 3);
    const Matrix4d l = g.covariance.llt().matrixL();
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = 0; k < 1000; ++k) {
      Vector4d n;
      n << random.direction_2d() * random.uniform(), random.direction_2d();
      n[2] *= random.uniform(-1, 1);
      const Vector4d d = l * (3 * n.normalized() * (k % 4 ? 1 : random.uniform()));
      const double y =
          pursuit_law(g.position + d.head<2>(), g.velocity + d.tail<2>(), g.ellipse, Vector2d::Zero(), {}).y1;
      outside += y < c.y_low - 1e-9 * std::abs(c.y_low) || y > c.y_high + 1e-9 * std::abs(c.y_high);
      low = std::min(low, y);
      high = std::max(high, y);
    }
    used += (high - low) / (c.y_high - c.y_low) / kCases;
  }
  std::printf("bounds of y: %.0f %% of their width is reached on average\n", 100 * used);
  EXPECT_EQ(outside, 0);
  EXPECT_GT(used, 0.2);
}

TEST(ConeConfidence, AllocatesNothing) {
  RandomBodies random(4404);
  const Engagement g = random_engagement(random, 1);
  double sum = cone_confidence(g.position, g.velocity, g.ellipse, g.covariance).probability;
  const std::size_t before = testing::allocations();
  sum += cone_confidence(g.position, g.velocity, g.ellipse, g.covariance).probability;
  sum += pursuit_law(g.position, g.velocity, g.ellipse, Vector2d::Zero(), {}).m;
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_TRUE(std::isfinite(sum));
}

}  // namespace
}  // namespace vericone::guidance::cone_confidence_test
