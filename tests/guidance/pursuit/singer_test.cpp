// SPDX-License-Identifier: BSD-3-Clause
//
// Singer's model against Van Loan's method in 50 digits, and its filter against truths that the model drives.
#include <gtest/gtest.h>
#include <vericone/guidance/estimation/filters.h>
#include <vericone/internal/guidance/estimation/kalman.h>
#include <vericone/testing/random_bodies.h>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "support/allocations.h"

namespace vericone::guidance::singer_test {
namespace {

using testing::RandomBodies;
namespace mp = boost::multiprecision;
using Digits50 = mp::number<mp::cpp_bin_float<50>, mp::et_off>;
using Block = std::array<std::array<Digits50, 6>, 6>;

Block product(const Block& x, const Block& y) {
  Block z{};
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k)
      for (int j = 0; j < 6; ++j) z[i][j] += x[i][k] * y[k][j];
  return z;
}

Block exponential(Block m) {
  constexpr int kHalvings = 8;
  for (auto& row : m)
    for (Digits50& x : row) x /= 1 << kHalvings;
  Block sum{}, term{};
  for (int i = 0; i < 6; ++i) sum[i][i] = term[i][i] = 1;
  for (int k = 1; k < 60; ++k) {
    term = product(term, m);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        term[i][j] /= k;
        sum[i][j] += term[i][j];
      }
  }
  for (int k = 0; k < kHalvings; ++k) sum = product(sum, sum);
  return sum;
}

struct VanLoan {
  std::array<std::array<Digits50, 3>, 3> transition{}, noise{};

  /// x''' = -alpha x'' + white noise of intensity 2 alpha sigma^2: exp([-F, G G' q; 0, F'] dt) holds F^-1 Q
  /// and the transposed transition.
  VanLoan(double alpha, double variance, double dt) {
    Block m{};
    const Digits50 t(dt), a(alpha);
    m[0][1] = m[1][2] = -t;
    m[2][2] = a * t;
    m[4][3] = m[5][4] = t;
    m[5][5] = -a * t;
    m[2][5] = 2 * a * Digits50(variance) * t;
    const Block e = exponential(m);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) transition[i][j] = e[3 + j][3 + i];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) noise[i][j] += transition[i][k] * e[k][3 + j];
  }
};

double relative(double x, const Digits50& truth) {
  if (truth == 0) return x == 0 ? 0 : HUGE_VAL;
  return static_cast<double>(mp::abs((Digits50(x) - truth) / truth));
}

TEST(Singer, EveryEntryAgainstVanLoanInFiftyDigits) {
  double of_transition = 0, of_noise = 0;
  for (const double dt : {1e-3, 0.01, 0.1, 1.0, 7.3})
    for (double x = 1e-9; x <= 10; x *= 1.35) {
      const double alpha = x / dt;
      const VanLoan truth(alpha, 0.1, dt);
      const Eigen::Matrix3d t = singer_transition(alpha, dt), q = singer_noise(alpha, 0.1, dt);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          of_transition = std::max(of_transition, relative(t(i, j), truth.transition[i][j]));
          of_noise = std::max(of_noise, relative(q(i, j), truth.noise[i][j]));
        }
    }
  std::printf("worst relative error: transition %.1e, noise %.1e\n", of_transition, of_noise);
  EXPECT_LT(of_transition, 1e-12);
  EXPECT_LT(of_noise, 1e-12);
}

/// The brackets as errata 4.3 has them, which is what the library's closed form is for large alpha dt only.
TEST(Singer, TheClosedFormLosesEveryDigitForSmallSteps) {
  const double alpha = 0.1, dt = 1e-3, x = alpha * dt, e = std::exp(-x);
  const double q11 = (1 - e * e + 2 * x + 2 * x * x * x / 3 - 2 * x * x - 4 * x * e) / std::pow(alpha, 4);
  const VanLoan truth(alpha, 1, dt);
  EXPECT_GT(relative(q11, truth.noise[0][0]), 1);
  EXPECT_LT(relative(singer_noise(alpha, 1, dt)(0, 0), truth.noise[0][0]), 1e-12);
}

TEST(Singer, KnownValues) {
  // MathWorks' singerProcessNoise (errata 4.3).
  const Eigen::Matrix3d q = singer_noise(1.0 / 20, 1, 1);
  const double known[] = {0.00486356, 0.01209188, 0.01585581, 0.03211199, 0.04757138, 0.09516258};
  int k = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j, ++k) {
      EXPECT_NEAR(q(i, j), known[k], 0.5e-8);
      EXPECT_EQ(q(i, j), q(j, i));
    }
  const Eigen::Matrix3d p = singer_noise(0.1, 0.1, 0.1);
  EXPECT_NEAR(p(0, 0) / 9.9446e-9, 1, 1e-5);
  EXPECT_NEAR(p(0, 1) / 2.4834e-7, 1, 1e-5);
  EXPECT_NEAR(p(0, 2) / 3.3002e-6, 1, 2e-5);
  EXPECT_NEAR(p(1, 1) / 6.6169e-6, 1, 1e-5);
  EXPECT_NEAR(p(1, 2) / 9.9006e-5, 1, 1e-5);
  EXPECT_NEAR(p(2, 2) / 1.98013e-3, 1, 1e-5);
}

TEST(Singer, NoTimeAndNoManoeuvre) {
  EXPECT_EQ(singer_transition(0.1, 0), Eigen::Matrix3d::Identity().eval());
  EXPECT_EQ(singer_noise(0.1, 1, 0), Eigen::Matrix3d::Zero().eval());
  Eigen::Matrix3d constant;
  constant << 1, 0.5, 0.125, 0, 1, 0.5, 0, 0, 1;
  EXPECT_EQ(singer_transition(0, 0.5), constant);
  EXPECT_EQ(singer_noise(0, 1, 0.5), Eigen::Matrix3d::Zero().eval());
}

/// Correlations, so that metres and m/s^2 count alike.
bool definite(const SingerFilter::Covariance& p) {
  if (!p.diagonal().allFinite() || !(p.diagonal().minCoeff() > 0)) return false;
  const Eigen::Matrix<double, 6, 1> s = p.diagonal().cwiseSqrt().cwiseInverse();
  return Eigen::LLT<SingerFilter::Covariance>(s.asDiagonal() * p * s.asDiagonal()).info() == Eigen::Success;
}

TEST(SingerFilter, CovarianceStaysDefiniteOverAMillionSteps) {
  RandomBodies random(3091);
  SCOPED_TRACE(random.trace());
  SingerFilter filter;
  filter.start(SingerFilter::State::Zero(), SingerFilter::Covariance::Zero(), 0);
  double time = 0;
  int indefinite = 0, asymmetric = 0;
  const std::size_t before = testing::allocations();
  for (int i = 0; i < 1'000'000; ++i) {
    // Frames of 10 ms, and now and then a gap of up to ten minutes.
    time += i % 997 == 996 ? random.log_uniform(0.1, 600) : 0.01;
    std::optional<Eigen::Vector2d> measured;
    const int kind = i % 7;
    if (kind < 4) measured = Eigen::Vector2d(random.uniform(-1e3, 1e3), random.uniform(-1e3, 1e3));
    const double r = kind == 0 ? 1e-8 : kind == 1 ? 1e6 : 1;
    if (kind == 5)
      filter.step_as_source(10 * Eigen::Matrix2d::Identity(), time);
    else
      filter.step(measured, r * Eigen::Matrix2d::Identity(), time);
    const SingerFilter::Covariance& p = filter.belief().covariance;
    indefinite += !definite(p);
    asymmetric += !((p - p.transpose()).cwiseAbs().maxCoeff() <= 1e-12 * p.cwiseAbs().maxCoeff());
  }
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_EQ(indefinite, 0);
  EXPECT_EQ(asymmetric, 0);
}

double normal(RandomBodies& random) {
  return std::sqrt(-2 * std::log(1 - random.uniform())) * std::cos(2 * M_PI * random.uniform());
}
template <int N>
Eigen::Matrix<double, N, 1> normals(RandomBodies& random) {
  Eigen::Matrix<double, N, 1> x;
  for (int i = 0; i < N; ++i) x[i] = normal(random);
  return x;
}

/// 1,000 runs of 30 s, the truth driven by Van Loan's noise, a third of the frames hidden.
TEST(SingerFilter, ErrorsAreWhatTheCovarianceSays) {
  RandomBodies random(3092);
  SCOPED_TRACE(random.trace());
  constexpr int kRuns = 1000, kSteps = 300;
  constexpr double kDt = 0.1, kSpread = 0.7;
  const SingerOptions options;
  const VanLoan model(options.alpha, 1, kDt);
  Eigen::Matrix3d transition, noise;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      transition(i, j) = static_cast<double>(model.transition[i][j]);
      noise(i, j) = static_cast<double>(model.noise[i][j]);
    }
  const Eigen::Matrix3d half = noise.llt().matrixL();
  double sums[3]{}, squared[3]{};  // NEES of ours; how the source's way with hidden targets does
  for (int run = 0; run < kRuns; ++run) {
    SingerFilter::State truth = SingerFilter::State::Zero();
    SingerFilter::Covariance first = SingerFilter::Covariance::Zero();
    first.diagonal() << 1, 4, options.variance.x(), 1, 4, options.variance.y();
    truth += first.cwiseSqrt() * normals<6>(random);
    SingerFilter filter(options), source(options);
    filter.start(SingerFilter::State::Zero(), first, 0);
    source.start(SingerFilter::State::Zero(), first, 0);
    int looked = 0;
    for (int i = 1; i <= kSteps; ++i) {
      for (int axis = 0; axis < 2; ++axis) {
        const Eigen::Vector3d next = transition * truth.segment<3>(3 * axis) +
                                     std::sqrt(options.variance[axis]) * (half * normals<3>(random));
        truth.segment<3>(3 * axis) = next;
      }
      const Eigen::Matrix2d r = kSpread * kSpread * Eigen::Matrix2d::Identity();
      std::optional<Eigen::Vector2d> measured;
      if (i % 60 < 40) measured = Eigen::Vector2d(truth[0], truth[3]) + kSpread * normals<2>(random);
      filter.step(measured, r, i * kDt);
      if (measured)
        source.step(measured, r, i * kDt);
      else
        source.step_as_source(10 * Eigen::Matrix2d::Identity(), i * kDt);
      if (i == 30 || i == 119 || i == kSteps) {
        sums[looked] += error_squared<6>(filter.belief(), truth);
        squared[looked++] += error_squared<6>(source.belief(), truth);
      }
    }
  }
  // Chi-squared of 6,000 degrees over 1,000: 6 -+ 1.96 sqrt(12 / 1000).
  const double band = 1.96 * std::sqrt(12.0 / kRuns);
  for (int k = 0; k < 3; ++k) {
    std::printf("NEES %.3f (6 -+ %.3f); the source's way: %.1f\n", sums[k] / kRuns, band, squared[k] / kRuns);
    EXPECT_NEAR(sums[k] / kRuns, 6, band);
  }
  EXPECT_GT(squared[1] / kRuns, 6 + 3 * band);  // hidden for 2 s and sure of itself
}

TEST(SingerFilter, StartsWithTheFirstMeasurement) {
  SingerFilter filter;
  const Eigen::Matrix2d r = Eigen::Matrix2d::Identity();
  EXPECT_FALSE(filter.step(std::nullopt, r, 0).accepted);
  EXPECT_FALSE(filter.started());
  EXPECT_TRUE(filter.step(Eigen::Vector2d(3, -4), r, 1).accepted);
  EXPECT_TRUE(filter.started());
  EXPECT_EQ(filter.position(), Eigen::Vector2d(3, -4));
  EXPECT_EQ(filter.velocity(), Eigen::Vector2d(0, 0));
  EXPECT_EQ(filter.position_covariance(), r);
  Eigen::Matrix4d motion = Eigen::Matrix4d::Zero();
  motion.diagonal() << 1, 1, 900, 900;
  EXPECT_EQ(filter.motion_covariance(), motion);
  const Innovation<2> hidden = filter.step(std::nullopt, r, 2);
  EXPECT_FALSE(hidden.accepted);
  EXPECT_TRUE(std::isnan(hidden.nis));
  EXPECT_EQ(filter.time(), 2);
  // Where it went, its velocity says: in the place of (x, x') and of (y, y') alone.
  const Eigen::Matrix4d moved = filter.motion_covariance();
  EXPECT_GT(moved(0, 2), 100);
  EXPECT_GT(moved(1, 3), 100);
  EXPECT_EQ(moved(0, 1), 0);
  EXPECT_EQ(moved(0, 3), 0);
}

/// Nothing seen: the mean goes on as predicted, the source's falls behind; and predicted() changes nothing.
TEST(SingerFilter, HiddenTargets) {
  SingerFilter ours, source;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d at(2.0 * i, -0.01 * i * i);
    ours.step(at, Eigen::Matrix2d::Identity(), 0.1 * i);
    source.step(at, Eigen::Matrix2d::Identity(), 0.1 * i);
  }
  const Belief<6> before = ours.belief(), later = ours.predicted(10);
  EXPECT_EQ(ours.belief().mean, before.mean);
  for (int i = 50; i <= 100; ++i) {
    ours.step(std::nullopt, Eigen::Matrix2d::Identity(), 0.1 * i);
    source.step_as_source(10 * Eigen::Matrix2d::Identity(), 0.1 * i);
  }
  EXPECT_GT(ours.position().x() - source.position().x(), 10);
  EXPECT_LT((ours.belief().mean - later.mean).norm(), 1e-9);
  EXPECT_LT((ours.belief().covariance - later.covariance).norm(), 1e-9 * later.covariance.norm());
  EXPECT_GT(ours.position_covariance()(0, 0), 4 * source.position_covariance()(0, 0));
}

TEST(SingerFilter, GateRefuses) {
  SingerOptions options;
  options.gate = 16;
  SingerFilter filter(options);
  for (int i = 0; i < 100; ++i) filter.step(Eigen::Vector2d(i, 0), Eigen::Matrix2d::Identity(), 0.1 * i);
  EXPECT_FALSE(filter.step(Eigen::Vector2d(0, 500), Eigen::Matrix2d::Identity(), 10).accepted);
  EXPECT_TRUE(filter.step(Eigen::Vector2d(101, 0), Eigen::Matrix2d::Identity(), 10.1).accepted);
}

}  // namespace
}  // namespace vericone::guidance::singer_test
