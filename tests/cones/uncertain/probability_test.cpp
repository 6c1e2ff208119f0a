// SPDX-License-Identifier: BSD-3-Clause
//
// Probabilities of collision: a published case, closed forms, draws.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/uncertain/probability.h>
#include <vericone/geometry/error.h>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>
#include <random>

#include "support/campaign.h"

namespace vericone::probability_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

double phi(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

Ellipsoid ball(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

/// States and covariances (km, km/s, km^2) of NASA CARA's test case "Omitron 1", its 20 m sphere, and what
/// its tools say: 2.70601573490125e-05 (CARA_Analysis_Tools, Pc2D_Foster_UnitTest).
TEST(Probability, TheOmitronCaseOfNasaCara) {
  const Vector3d r1(378.39559, 4305.721887, 5752.767554), v1(2.360800244, 5.580331936, -4.322349039);
  const Vector3d r2(374.5180598, 4307.560983, 5751.130418), v2(-5.388125081, -3.946827739, 3.322820358);
  Matrix3d c1, c2;
  c1 << 44.5757544811362, 81.6751751052616, -67.8687662707124, 81.6751751052616, 158.453402956163,
      -128.616921644857, -67.8687662707124, -128.616921644857, 105.490542562701;
  c2 << 2.31067077720423, 1.69905293875632, -1.4170164577661, 1.69905293875632, 1.24957388457206,
      -1.04174164279599, -1.4170164577661, -1.04174164279599, 0.869260558223714;
  ProbabilityOptions options;
  options.relative = 1e-5;
  const Probability p =
      probability_of_passing_through(ball(r1, 0.012), ball(r2, 0.008), v1 - v2, c1 + c2, options);
  EXPECT_NEAR(p.estimate / 2.70601573490125e-05, 1, 1e-5);
  EXPECT_LE(p.most - p.least, 1e-5 * p.most);
}

TEST(Probability, OfAnIsotropicErrorIsTheNoncentralChiSquare) {
  for (const double offset : {0.0, 0.3, 1.0, 3.0, 6.0})
    for (const double radius : {0.01, 0.5, 2.0, 5.0}) {
      const double sigma = 0.7;
      const Probability p =
          probability_of_passing_through(ball({0, 0, 0}, 0.25 * radius), ball({40, offset, 0}, 0.75 * radius),
                                         {9, 0, 0}, sigma * sigma * Matrix3d::Identity());
      const boost::math::non_central_chi_squared_distribution<double> chi(2,
                                                                          offset * offset / (sigma * sigma));
      const double truth = cdf(chi, radius * radius / (sigma * sigma));
      EXPECT_LE(p.least, truth * (1 + 1e-9)) << offset << " " << radius;
      EXPECT_GE(p.most, truth * (1 - 1e-9)) << offset << " " << radius;
      EXPECT_LE(p.most - p.least, 1.01e-4 * p.most);
      EXPECT_NEAR(p.estimate, truth, 1e-6 * truth);
    }
}

struct Random {
  std::mt19937_64 engine;
  std::normal_distribution<double> normal;
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  Vector3d vector() { return {normal(engine), normal(engine), normal(engine)}; }
  Matrix3d matrix() {
    Matrix3d m;
    for (double& x : m.reshaped()) x = normal(engine);
    return m;
  }
  Ellipsoid body(const Vector3d& center) {
    const Eigen::Quaterniond q(normal(engine), normal(engine), normal(engine), normal(engine));
    return Ellipsoid::from_axes(center, {between(0.2, 2), between(0.2, 2), between(0.2, 2)},
                                q.normalized().toRotationMatrix());
  }
  Matrix3d covariance(double size) {
    const Matrix3d m = size * matrix();
    const Matrix3d c = m * m.transpose();
    return 0.5 * (c + c.transpose());
  }
};

TEST(Probability, DrawsFallWithinTheBounds) {
  Random random{std::mt19937_64(2), {}};
  for (int i = 0; i < 6; ++i) {
    const Ellipsoid a = random.body(Vector3d::Zero()), b = random.body({12, random.between(-3, 3), 1});
    const Vector3d w(10, random.between(-1, 1), random.between(-1, 1));
    const Matrix3d c = random.covariance(random.between(0.3, 2));
    const Probability p = probability_of_passing_through(a, b, w, c);
    const Matrix3d root = c.llt().matrixL();
    const int draws = testing::campaign_size(20'000, 200'000);
    int hits = 0;
    for (int j = 0; j < draws; ++j) {
      const Vector3d d = root * random.vector();
      const Ellipsoid moved = b.translated(d);
      hits += clearance(a, moved, w).distance <= 0;
    }
    const double share = double(hits) / draws, spread = std::sqrt(p.estimate * (1 - p.estimate) / draws);
    EXPECT_NEAR(share, p.estimate, 4.5 * spread + 1e-9) << i;
  }
}

/// A position that is known but for one direction, or altogether.
TEST(Probability, OfErrorsAlongALine) {
  const Ellipsoid a = ball({0, 0, 0}, 1), b = ball({20, 3, 0}, 1);
  Matrix3d along = Matrix3d::Zero();
  along(1, 1) = 4;  // 2 m across the motion
  const Probability p = probability_of_passing_through(a, b, {5, 0, 0}, along);
  const double truth = phi((-3 + 2) / 2.0) - phi((-3 - 2) / 2.0);
  EXPECT_LE(p.least, truth);
  EXPECT_GE(p.most, truth);
  EXPECT_NEAR(p.estimate, truth, 1e-6);
  EXPECT_EQ(probability_of_passing_through(a, b, {5, 0, 0}, Matrix3d::Zero()).most, 0);
  EXPECT_EQ(probability_of_passing_through(a, ball({20, 1, 0}, 1), {5, 0, 0}, Matrix3d::Zero()).least, 1);
  // Errors along the motion change nothing.
  Matrix3d ahead = Matrix3d::Zero();
  ahead(0, 0) = 100;
  EXPECT_EQ(probability_of_passing_through(a, b, {5, 0, 0}, ahead).most, 0);
}

TEST(ProbabilityBound, NoShareOfDrawsIsAbove) {
  Random random{std::mt19937_64(3), {}};
  const int pairs = testing::campaign_size(20, 1000), draws = testing::campaign_size(2'000, 100'000);
  int useful = 0;
  for (int i = 0; i < pairs; ++i) {
    const Ellipsoid a = random.body(Vector3d::Zero());
    const Ellipsoid b =
        random.body(Vector3d(random.between(5, 15), random.between(-8, 8), random.between(-8, 8)));
    const Vector3d w(random.between(-3, 6), random.between(-2, 2), random.between(-2, 2));
    Eigen::Matrix<double, 6, 6> all;
    {
      Eigen::Matrix<double, 6, 6> m;
      for (double& x : m.reshaped()) x = random.normal(random.engine);
      m.topRows<3>() *= random.between(0.05, 0.8);
      m.bottomRows<3>() *= random.between(0.05, 0.5);
      all = m * m.transpose();
      all = (0.5 * (all + all.transpose())).eval();
    }
    GaussianErrors errors;
    errors.position = all.topLeftCorner<3, 3>();
    errors.velocity = all.bottomRightCorner<3, 3>();
    errors.cross = all.topRightCorner<3, 3>();
    const double horizon = i % 2 ? random.between(0.5, 5) : std::numeric_limits<double>::infinity();
    const ProbabilityBound bound = collision_probability_bound(a, b, w, errors, horizon);
    useful += bound.most < 0.5;
    const Eigen::Matrix<double, 6, 6> root = all.llt().matrixL();
    int hits = 0;
    for (int j = 0; j < draws; ++j) {
      Eigen::Matrix<double, 6, 1> x;
      for (double& value : x) value = random.normal(random.engine);
      x = (root * x).eval();
      const Ellipsoid moved = b.translated(x.head<3>());
      const auto time = time_to_contact(a, moved, w + x.tail<3>());
      hits += time && *time <= horizon;
    }
    const double share = double(hits) / draws;
    EXPECT_LE(share, bound.most + 4.5 * std::sqrt(share * (1 - share) / draws) + 1e-12) << i;
  }
  EXPECT_GT(useful, pairs / 4);
}

TEST(ProbabilityBound, TwoBallsThatPassHaveTheClosedForm) {
  // At rest relative to one another: the gap along the line of centres alone.
  GaussianErrors errors;
  errors.position = 0.25 * Matrix3d::Identity();
  const ProbabilityBound bound =
      collision_probability_bound(ball({0, 0, 0}, 1), ball({4, 0, 0}, 1), Vector3d::Zero(), errors);
  EXPECT_NEAR(bound.most / phi(-2 / 0.5), 1, 1e-9);
  EXPECT_GE(bound.most, phi(-2 / 0.5));
  EXPECT_EQ(
      collision_probability_bound(ball({0, 0, 0}, 1), ball({1, 0, 0}, 1), Vector3d::Zero(), errors).most, 1);
}

TEST(Probability, BadInputNamesItsField) {
  const Ellipsoid a = ball({0, 0, 0}, 1), b = ball({5, 0, 0}, 1);
  const auto field = [](auto call) -> std::string {
    try {
      call();
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  const Matrix3d one = Matrix3d::Identity();
  Matrix3d skew = one, negative = one;
  skew(0, 1) = 0.1;
  negative(2, 2) = -1e-6;
  EXPECT_EQ(field([&] { (void)probability_of_passing_through(a, b, Vector3d::Zero(), one); }),
            "relative_velocity");
  EXPECT_EQ(field([&] {
              (void)probability_of_passing_through(a, b, {1, 0, 0}, skew);
            }),
            "position_covariance");
  EXPECT_EQ(field([&] {
              (void)probability_of_passing_through(a, b, {1, 0, 0}, negative);
            }),
            "position_covariance");
  GaussianErrors errors;
  errors.velocity = negative;
  EXPECT_EQ(field([&] {
              (void)collision_probability_bound(a, b, {1, 0, 0}, errors);
            }),
            "velocity_covariance");
  errors.velocity = one;
  EXPECT_EQ(field([&] { (void)collision_probability_bound(a, b, {1, 0, 0}, errors, 0); }), "horizon");
  errors.cross = one;
  EXPECT_EQ(field([&] { (void)collision_probability_bound(a, b, {1, 0, 0}, errors); }), "cross_covariance");
}

}  // namespace
}  // namespace vericone::probability_test
