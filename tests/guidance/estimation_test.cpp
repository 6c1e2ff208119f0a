// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/guidance/estimation/filters.h>
#include <vericone/guidance/robust_law.h>
#include <vericone/internal/geometry/decompositions.h>
#include <vericone/internal/guidance/estimation/constant_rate.h>
#include <vericone/internal/guidance/estimation/kalman.h>
#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "support/allocations.h"

namespace vericone::guidance::estimation_test {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// What a Kalman filter is: the mean and covariance of a Gaussian given the measurements. Here by
/// conditioning the joint distribution of all of them at once, without any recursion.
TEST(Estimation, FilterIsTheConditionalGaussianOfAllMeasurements) {
  constexpr int kSteps = 12;
  const double dt = 0.1, q = 0.7, r = 0.04, first = 1;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Matrix2d f, noise;
  f << 1, dt, 0, 1;
  noise << q * dt * dt * dt / 3, q * dt * dt / 2, q * dt * dt / 2, q * dt;
  std::vector<double> measured;
  for (int k = 0; k < kSteps; ++k) measured.push_back(std::sin(0.3 * k) + 0.2 * normal(random));

  ConstantRateOptions options;
  options.intensity = q;
  options.first_rate = first;
  options.gate = 1e9;
  ConstantRateFilter filter(options);
  for (int k = 0; k < kSteps; ++k) filter.step(measured[std::size_t(k)], r, k * dt);

  // Unknowns: the first value (known by its measurement alone), rate and the noises; the last state and all
  // measurements are linear in them.
  constexpr int kUnknown = 2 + 2 * (kSteps - 1);
  Eigen::MatrixXd prior = Eigen::MatrixXd::Zero(kUnknown, kUnknown);
  prior.topLeftCorner<2, 2>() << r, 0, 0, first * first;
  Eigen::MatrixXd state = Eigen::MatrixXd::Zero(2, kUnknown);  // of the unknowns
  state.topLeftCorner<2, 2>() = Matrix2d::Identity();
  Eigen::MatrixXd of_measured(kSteps - 1, kUnknown);
  for (int k = 1; k < kSteps; ++k) {
    prior.block<2, 2>(2 * k, 2 * k) = noise;
    state = (f * state).eval();
    state.block<2, 2>(0, 2 * k) = Matrix2d::Identity();
    of_measured.row(k - 1) = state.row(0);
  }
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(kUnknown), said(kSteps - 1);
  mean[0] = measured[0];
  for (int k = 1; k < kSteps; ++k) said[k - 1] = measured[std::size_t(k)];
  const Eigen::MatrixXd spread = of_measured * prior * of_measured.transpose() +
                                 r * Eigen::MatrixXd::Identity(kSteps - 1, kSteps - 1),
                        cross = state * prior * of_measured.transpose(), gain = cross * spread.inverse();
  const Vector2d expected = state * mean + gain * (said - of_measured * mean);
  const Matrix2d left = state * prior * state.transpose() - gain * cross.transpose();
  EXPECT_LT((filter.belief().mean - expected).norm(), 1e-11);
  EXPECT_LT((filter.belief().covariance - left).norm(), 1e-11);
}

TEST(Estimation, JosephsFormKeepsACovarianceWhereTheShortOneDoesNot) {
  // A measurement a million times better than the belief, a hundred times.
  Belief<2> belief;
  belief.covariance << 1, 0.999, 0.999, 1;
  const Eigen::Matrix<double, 1, 2> h(1, 1e-7);
  const Eigen::Matrix<double, 1, 1> z(0.0), r(1e-14);
  for (int k = 0; k < 100; ++k) {
    correct<2, 1>(belief, z, h, r);
    ASSERT_GE(symmetric_eigenvalues<2>(belief.covariance)[0], -1e-18) << k;
    ASSERT_EQ(belief.covariance(0, 1), belief.covariance(1, 0));
  }
}

TEST(Estimation, GateRefusesOutliersAndStartsAgainWhereItHasLostItsBody) {
  ConstantVelocityFilter filter({0, 30});
  const Matrix6 noise = 0.01 * Matrix6::Identity();
  Vector6 state = Vector6::Zero();
  state[3] = 1;
  double t = 0;
  const auto next = [&] {
    t += 0.1;
    state.head<3>() += 0.1 * state.tail<3>();
  };
  for (int k = 0; k < 20; ++k, next()) ASSERT_TRUE(filter.step(state, noise, t).accepted);
  Vector6 outlier = state;
  outlier[1] += 50;
  EXPECT_FALSE(filter.step(outlier, noise, t).accepted);
  EXPECT_LT((filter.position() - state.head<3>()).norm(), 1e-6);
  // It was somewhere else after all: five in a row, that one included.
  state[1] += 50;
  for (int k = 0; k < 4; ++k) {
    next();
    EXPECT_FALSE(filter.step(state, noise, t).accepted);
  }
  EXPECT_LT((filter.position() - state.head<3>()).norm(), 1e-9);
  next();
  EXPECT_TRUE(filter.step(state, noise, t).accepted);
}

/// Mean of the normalised estimation error squared over independent runs, at the last of `steps`.
double mean_nees(int runs, double intensity, double assumed) {
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  const double dt = 0.05, of_p = 0.5, of_v = 0.2;
  Matrix6 noise = Matrix6::Zero();
  noise.diagonal() << Vector3d::Constant(of_p * of_p), Vector3d::Constant(of_v * of_v);
  double sum = 0;
  for (int run = 0; run < runs; ++run) {
    ConstantVelocityFilter filter({assumed, 1e9});
    Vector6 truth;
    truth << 10, -5, 3, 2, 1, -4;
    for (int k = 0; k < 60; ++k) {
      if (k > 0) {
        // White acceleration exactly: velocity and position of a step by the Cholesky factor of their
        // covariance.
        for (int i = 0; i < 3; ++i) {
          const double a = normal(random), b = normal(random), q = std::sqrt(intensity);
          truth[i] += dt * truth[3 + i] + q * std::sqrt(dt * dt * dt / 3) * a;
          truth[3 + i] += q * (std::sqrt(3 * dt) / 2 * a + std::sqrt(dt) / 2 * b);
        }
      }
      Vector6 measured = truth;
      for (int i = 0; i < 3; ++i) {
        measured[i] += of_p * normal(random);
        measured[3 + i] += of_v * normal(random);
      }
      filter.step(measured, noise, k * dt);
    }
    sum += error_squared(filter.belief(), truth);
  }
  return sum / runs;
}

TEST(Estimation, StateFilterIsRightAboutItself) {
  // Chi-squared with 6 degrees of freedom; the mean of 1,000 is 6 -+ 0.11, three deviations: 5.67 to 6.33.
  for (const double intensity : {0.0, 0.5}) {
    const double nees = mean_nees(1000, intensity, intensity);
    EXPECT_GT(nees, 5.65) << intensity;
    EXPECT_LT(nees, 6.37) << intensity;
    RecordProperty("nees", std::to_string(nees));
  }
  // A filter that believes in a constant velocity which is not one is wrong about itself, and this notices.
  EXPECT_GT(mean_nees(200, 0.5, 0), 12);
}

/// A motion with an acceleration of at most `most` that changes at every step, measured with bounded errors.
struct BoundedRun {
  std::mt19937_64 random;
  double p, v, t = 0;
  explicit BoundedRun(unsigned seed) : random(seed), p(between(-50, 50)), v(between(-10, 10)) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  /// Extreme as often as not.
  double error(double bound) {
    const double x = between(-bound, bound);
    return between(0, 1) < 0.3 ? std::copysign(bound, x) : x;
  }
  void advance(double dt, double most) {
    // Two halves, each with its own constant acceleration: bang-bang comes up.
    for (int i = 0; i < 2; ++i) {
      const double a = error(most), h = 0.5 * dt;
      p += h * v + 0.5 * h * h * a;
      v += h * a;
    }
    t += dt;
  }
};

TEST(Estimation, PossibleMotionHoldsTheTrueOneForEverySequenceOfBoundedErrors) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    BoundedRun run(seed);
    const double of_p = std::exp(run.between(-6, 2)), of_v = std::exp(run.between(-6, 1)),
                 most = seed % 3 == 0 ? 0 : std::exp(run.between(-4, 2)), dt = std::exp(run.between(-6, -1));
    PossibleMotion possible({run.p - of_p, run.p + of_p}, {run.v - of_v, run.v + of_v});
    double width = possible.position().high - possible.position().low;
    for (int k = 0; k < 120; ++k) {
      run.advance(dt, most);
      possible.advance(dt, most);
      ASSERT_TRUE(possible.contains(run.p, run.v)) << seed << " step " << k;
      const double p = run.p + run.error(of_p), v = run.v + run.error(of_v);
      ASSERT_TRUE(possible.meet({p - of_p, p + of_p}, {v - of_v, v + of_v})) << seed << " step " << k;
      ASSERT_TRUE(possible.contains(run.p, run.v)) << seed << " step " << k;
      ASSERT_LE(possible.corners(), 24u);
      const Bounds ahead = possible.position_after(3);
      ASSERT_TRUE(ahead.low <= run.p + 3 * run.v && run.p + 3 * run.v <= ahead.high);
    }
    // And it says something: without acceleration never wider than one measurement.
    if (most == 0) {
      EXPECT_LE(possible.position().high - possible.position().low, width * (1 + 1e-9)) << seed;
    }
  }
}

TEST(Estimation, PossibleMotionIsTightWhereItCanBeComputedByHand) {
  // Known exactly, then any acceleration up to 2 for 3 s: position to 2 * 9 / 2, velocity to 6.
  PossibleMotion possible({0, 0}, {0, 0});
  possible.advance(3, 2);
  EXPECT_NEAR(possible.velocity().high, 6, 1e-12);
  // The parallelogram's corner (dt/2) 6 + 2 * 9 / 4 = 13.5 stands for 9: by half too much, as its bound says.
  EXPECT_NEAR(possible.position().high, 13.5, 1e-12);
  // Two sharp positions fix the velocity: (1 -+ 0.02) / 10.
  PossibleMotion two({-0.01, 0.01}, {-100, 100});
  two.advance(10, 0);
  ASSERT_TRUE(two.meet({0.99, 1.01}, {-100, 100}));
  EXPECT_LE(two.velocity().low, 0.098);  // outwards, by some units in the last place of what it began with
  EXPECT_GE(two.velocity().high, 0.102);
  EXPECT_NEAR(two.velocity().low, 0.098, 1e-10);
  EXPECT_NEAR(two.velocity().high, 0.102, 1e-10);
  // What cannot be is said, and changes nothing.
  const Bounds before = two.position();
  EXPECT_FALSE(two.meet({5, 6}, {-100, 100}));
  EXPECT_EQ(two.position().low, before.low);
}

TEST(Estimation, FiltersOfTheSourceFollowYAndItsRates) {
  // psi grows at 0.3 rad/s, theta_b at -0.1, noise of 1 deg / 3: after a second the rates are right to a few
  // hundredths, where differences of one step are off by 0.8 rad/s.
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  PlaneFilterOptions options;
  options.y = options.rates = true;
  PlaneFilters filters(options);
  const double sigma = 1.0 / 3 * std::numbers::pi / 180;
  Measured deviations;
  deviations.psi = deviations.theta_b = sigma;
  PlanarState state;
  state.r = 40;
  state.v_r = -30;
  state.v_theta = -2;
  PlaneCone cone;
  double y = 0, truth = 0;
  for (int k = 0; k < 150; ++k) {
    const double t = 0.01 * k;
    PlaneCone exact;
    exact.psi = 0.4 + 0.3 * t;
    exact.theta_b = 0.05 - 0.1 * t;
    truth = cone_rates(state, exact).y;
    cone = exact;
    cone.psi += sigma * normal(random);
    cone.theta_b += sigma * normal(random);
    y = filters.step(state, cone, 0, deviations, t);
  }
  EXPECT_NEAR(cone.psi_rate, 0.3, 0.08);
  EXPECT_NEAR(cone.theta_b_rate, -0.1, 0.08);
  EXPECT_NEAR(y, truth, 3e-3);
}

TEST(Estimation, NothingIsAllocated) {
  ConstantVelocityFilter state;
  ConstantRateFilter rate;
  const Vector6 at = Vector6::Ones();
  const Matrix6 noise = Matrix6::Identity();
  state.step(at, noise, 0);
  rate.step(1, 1, 0);
  const auto before = vericone::testing::allocations();
  for (int k = 1; k < 10; ++k) {
    state.step(at, noise, 0.1 * k);
    rate.step(1, 1, 0.1 * k);
  }
  EXPECT_EQ(vericone::testing::allocations(), before);
}

}  // namespace
}  // namespace vericone::guidance::estimation_test
