// SPDX-License-Identifier: BSD-3-Clause
//
// The robust law against its own inequalities (7.20)-(7.24), against all gains of a grid, and against the
// system it is for. An interior-point solver is asked in robust_law_sdp_test.cpp.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/guidance/robust_law.h>
#include <Eigen/Eigenvalues>
#include <complex>
#include <limits>

#include "guidance/robust_problems.h"
#include "support/allocations.h"

namespace vericone::guidance::robust_law_test {
namespace {

/// The least eigenvalue in parts of the largest entry.
double definiteness(const Eigen::Matrix4d& m) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(m).eigenvalues()(0) / m.cwiseAbs().maxCoeff();
}

/// The least of (7.22) and (7.23) over the corners, at a gain, z = 1.
double slack(const RobustInstance& x, double gain, double gamma) {
  double least = 1;
  for (const Eigen::Vector3d& c : printed_corners(x.model)) {
    least = std::min(least, definiteness(decay_lmi(c, 1, gain, gamma, x.options)));
    least = std::min(least, definiteness(attenuation_lmi(c, 1, gain, gamma, x.options.mu)));
  }
  return least;
}

/// The least Gamma at a gain (z = 1) by halving on the inequalities themselves; infinite where there is none.
double least_gamma(const RobustInstance& x, double gain) {
  // The set of Gamma that fit is an interval: look for a point of it on a fine scale, then for its lower end.
  double fits = 0;
  for (double e = -6; e <= 8 && fits == 0; e += 0.05)
    if (slack(x, gain, std::pow(10, e)) >= -1e-13) fits = std::pow(10, e);
  if (fits == 0) return std::numeric_limits<double>::infinity();
  double low = fits / 1.13, high = fits;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (slack(x, gain, middle) >= -1e-13 ? high : low) = middle;
  }
  return high;
}

TEST(RobustLaw, ItsAnswerSatisfiesTheInequalitiesAndNoOtherGainIsBetter) {
  std::mt19937_64 random(7);
  int solved = 0;
  for (int i = 0; i < 300; ++i) {
    const RobustInstance x = random_instance(random);
    const RobustCorrection found = robust_correction(x.z, x.low, x.high, x.model, x.options);
    if (found.status != RobustStatus::solved) continue;
    ++solved;
    EXPECT_GE(found.delta, x.low);
    EXPECT_LE(found.delta, x.high);
    EXPECT_NEAR(found.delta, found.gain * x.z, 1e-12 * std::abs(found.delta));
    EXPECT_LE(found.norm, std::sqrt(x.options.mu) * (1 + 1e-12));
    const double gamma = found.gamma / (x.z * x.z);
    EXPECT_GE(slack(x, found.gain, gamma), -1e-12) << i;
    EXPECT_LT(slack(x, found.gain, gamma * (1 - 1e-6)), 0) << i;
    if (i % 10 != 0) continue;
    for (const double share : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
      const double gain = (x.low + share * (x.high - x.low)) / x.z;
      EXPECT_GE(least_gamma(x, gain), gamma * (1 - 1e-7)) << i << " gain " << gain;
    }
  }
  EXPECT_GT(solved, 100);
  EXPECT_LT(solved, 280);
}

TEST(RobustLaw, WhereItHasNoAnswerNoGainOfAGridHasOne) {
  std::mt19937_64 random(8);
  int seen[5] = {};
  for (int i = 0; i < 100; ++i) {
    RobustInstance x = random_instance(random);
    x.options.mu /= 10;
    const RobustCorrection found = robust_correction(x.z, x.low, x.high, x.model, x.options);
    ++seen[static_cast<int>(found.status)];
    if (found.status == RobustStatus::solved) continue;
    EXPECT_EQ(found.delta, 0);
    // Without the limits of the actuator where it is not they that are named.
    const bool saturation = found.status == RobustStatus::saturation;
    const Eigen::Vector3d c = printed_corners(x.model)[0];
    const double widest = (1 + c(0)) / std::abs(c(1));
    const double from = saturation ? x.low / x.z : -widest, to = saturation ? x.high / x.z : widest;
    for (int j = 0; j <= 10; ++j) {
      const double gain = from + (to - from) * j / 10;
      EXPECT_FALSE(std::isfinite(least_gamma(x, gain))) << i << " " << to_string(found.status) << " " << gain;
    }
  }
  EXPECT_GT(seen[static_cast<int>(RobustStatus::saturation)], 5);
  EXPECT_GT(seen[static_cast<int>(RobustStatus::attenuation)], 5);
}

/// One state, a gain: the largest amplification of a sinusoid, which the H-infinity norm is.
TEST(RobustLaw, NoSinusoidIsAmplifiedMoreThanTheNormSaysAndOneIsAsMuch) {
  std::mt19937_64 random(9);
  int tried = 0;
  for (int i = 0; i < 200; ++i) {
    RobustInstance x = random_instance(random);
    x.options.attenuation = i % 2 ? Attenuation::stated : Attenuation::printed;
    const RobustCorrection found = robust_correction(x.z, x.low, x.high, x.model, x.options);
    if (found.status != RobustStatus::solved) continue;
    ++tried;
    double most = 0;
    for (const Eigen::Vector3d& c : printed_corners(x.model))
      for (int j = 0; j <= 100; ++j) {
        const std::complex<double> e = std::polar(1.0, 3.14159265358979323846 * j / 100);
        most = std::max(most, std::abs(c(2) / (e - (c(0) + c(1) * found.gain))));
      }
    EXPECT_NEAR(most, found.norm, 1e-9 * found.norm);
    EXPECT_LE(most, (i % 2 ? x.options.mu : std::sqrt(x.options.mu)) * (1 + 1e-9));
  }
  EXPECT_GT(tried, 50);
}

TEST(RobustLaw, TheContainingPolytopeKeepsItsPromiseForEveryNoiseOfTheModel) {
  std::mt19937_64 random(10);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int tried = 0, broken_by_printed = 0;
  for (int i = 0; i < 2000; ++i) {
    RobustInstance x = random_instance(random);
    x.model.a_low = between(-0.5, 0.9), x.model.a_high = between(1.1, 2);
    x.model.b_low = between(0.2, 0.9) * x.model.b_high;
    x.model.dt *= 3;
    x.options.attenuation = Attenuation::stated;
    const auto keeps = [&](const RobustCorrection& found) {
      for (int j = 0; j < 50; ++j) {
        const double a = between(x.model.a_low, x.model.a_high), b = between(x.model.b_low, x.model.b_high);
        const double rate = x.model.gain * a, d = (1 - std::exp(-rate * x.model.dt)) / rate;
        const double c = std::exp(-rate * x.model.dt) + x.model.sign_b * b * d * found.gain;
        if (!(std::abs(c) < 1) || d / (1 - std::abs(c)) > x.options.mu * (1 + 1e-12)) return false;
        // The cost of z(0) = 1 without noise, and its bound.
        const double cost =
            (x.options.state_weight + x.options.input_weight * found.gain * found.gain) / (1 - c * c);
        if (cost > found.gamma / (x.z * x.z) * (1 + 1e-12)) return false;
      }
      return true;
    };
    x.options.polytope = Polytope::printed;
    const RobustCorrection printed = robust_correction(x.z, x.low, x.high, x.model, x.options);
    broken_by_printed += printed.status == RobustStatus::solved && !keeps(printed);
    x.options.polytope = Polytope::containing;
    const RobustCorrection found = robust_correction(x.z, x.low, x.high, x.model, x.options);
    if (found.status != RobustStatus::solved) continue;
    ++tried;
    EXPECT_TRUE(keeps(found)) << i;
  }
  EXPECT_GT(tried, 200);
  EXPECT_GT(broken_by_printed, 20);  // smaller |b| is not among its corners
}

TEST(RobustLaw, NothingToCorrectIsNothing) {
  RobustModel model;
  RobustOptions options;
  options.mu = 100;
  model.a_low = 0.9, model.a_high = 1.1, model.b_low = 0.5;
  const RobustCorrection found = robust_correction(0, -1, 1, model, options);
  EXPECT_EQ(found.status, RobustStatus::solved);
  EXPECT_EQ(found.delta, 0);
  EXPECT_EQ(found.gamma, 0);
  EXPECT_EQ(robust_correction(0, 0.5, 1, model, options).status, RobustStatus::saturation);
}

TEST(RobustLaw, TurnsWithTheSignOfB) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 100; ++i) {
    RobustInstance x = random_instance(random);
    const RobustCorrection one = robust_correction(x.z, x.low, x.high, x.model, x.options);
    x.model.sign_b = -x.model.sign_b;
    const RobustCorrection other = robust_correction(x.z, -x.high, -x.low, x.model, x.options);
    EXPECT_EQ(one.status, other.status);
    EXPECT_NEAR(one.delta, -other.delta, 1e-9 * std::abs(one.delta));
    EXPECT_NEAR(one.gamma, other.gamma, 1e-12 * one.gamma);
  }
}

TEST(RobustLaw, NoAllocation) {
  std::mt19937_64 random(12);
  const RobustInstance x = random_instance(random);
  const std::size_t before = testing::allocations();
  double sum = 0;
  for (int i = 0; i < 10; ++i) sum += robust_correction(x.z, x.low, x.high, x.model, x.options).gamma;
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_GE(sum, 0);
}

TEST(RobustLaw, BadInputNamesItsField) {
  const auto field = [](auto change) -> std::string {
    RobustModel model;
    RobustOptions options;
    change(model, options);
    try {
      check(model, options);
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  EXPECT_EQ(field([](auto&, auto&) {}), "");
  EXPECT_EQ(field([](auto& m, auto&) { m.dt = 0; }), "dt");
  EXPECT_EQ(field([](auto& m, auto&) { m.b_low = 2; }), "b_min");
  EXPECT_EQ(field([](auto& m, auto&) { m.gain = -1; }), "K");
  EXPECT_EQ(field([](auto& m, auto&) { m.a_low = 2; }), "a");
  EXPECT_EQ(field([](auto& m, auto&) { m.sign_b = 0; }), "sign_b");
  EXPECT_EQ(field([](auto&, auto& o) { o.mu = 0; }), "mu");
  EXPECT_EQ(field([](auto&, auto& o) { o.state_weight = 0; }), "Q");
  EXPECT_EQ(field([](auto&, auto& o) { o.input_weight = -1; }), "R");
}

}  // namespace
}  // namespace vericone::guidance::robust_law_test
