// SPDX-License-Identifier: BSD-3-Clause
//
// The noise of the error dynamics, (7.1)-(7.13): the identity that defines it, its derivatives against
// differences, its deviations against draws, and what they miss at the noise that 7.2 prints.
#include <gtest/gtest.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/guidance/robust_law.h>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "support/campaign.h"

namespace vericone::guidance::noise_test {
namespace {

using std::numbers::pi;

constexpr std::array<double Measured::*, 7> kFields{
    &Measured::v_r, &Measured::v_theta,  &Measured::theta,       &Measured::theta_b,
    &Measured::psi, &Measured::psi_rate, &Measured::theta_b_rate};

struct Case {
  PlanarState state;
  PlaneCone cone;
  double gain;
};

/// Off the bisector and off the singular headings, where nothing is measured to be singular either.
Case random_case(std::mt19937_64& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  while (true) {
    Case c{};
    c.state.r = between(5, 100);
    c.state.theta = between(-pi, pi);
    c.state.v_r = between(-40, 40);
    c.state.v_theta = between(-40, 40);
    c.state.alpha = between(-pi, pi);
    c.cone.theta_b = c.state.theta + between(-0.5, 0.5);
    c.cone.psi = between(0.1, 2);
    c.cone.psi_rate = between(-1, 1);
    c.cone.theta_b_rate = between(-1, 1);
    c.gain = between(0.5, 5);
    const double direction = c.state.theta + std::atan2(c.state.v_theta, c.state.v_r);
    if (std::hypot(c.state.v_r, c.state.v_theta) > 5 &&
        std::abs(std::sin(2 * (direction - c.cone.theta_b))) > 0.3 &&
        std::abs(std::cos(c.state.alpha - direction)) > 0.3)
      return c;
  }
}

/// 7.2 with m(t) of deviation 1/3; the rates' noise is not printed.
Measured printed_noise(const PlanarState& s) {
  const double degree = pi / 180;
  return {
      0.4 * std::abs(s.v_r) / 3, 0.4 * std::abs(s.v_theta) / 3, 3 * degree / 3, degree / 3, degree / 3, 0, 0};
}

Measured draw(const Measured& deviations, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Measured errors;
  for (const auto field : kFields) errors.*field = deviations.*field * normal(random);
  return errors;
}

TEST(Noise, TheLawOfAMeasuredStateLeavesTheErrorDynamics) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    Case c = random_case(random);
    const double reference = 0.1;
    const Measured errors = draw({3, 3, 0.05, 0.02, 0.02, 0.1, 0.1}, random);
    const NoiseTerms noise = noise_terms(c.state, c.cone, errors, c.gain);
    const MeasuredState seen = measured(c.state, c.cone, errors);
    LawOptions options;
    options.gain = c.gain;
    options.reference = reference;
    const ConeRates truth = cone_rates(c.state, c.cone), wrong = cone_rates(seen.state, seen.cone);
    // (6.17) of what is seen, commanded whatever y is.
    const double command = (-c.gain * (wrong.y - reference) - wrong.drift) / wrong.by_lateral_a;
    const double z = truth.y - reference, rate = truth.drift + truth.by_lateral_a * command;
    EXPECT_NEAR(noise.delta_y, wrong.y - truth.y, 1e-13);
    const double expected = -c.gain * noise.a * z + noise.v;
    EXPECT_NEAR(rate, expected, 1e-10 * (1 + std::abs(rate) + std::abs(noise.a) * c.gain)) << i;
  }
}

TEST(Noise, GradientsAreTheDerivatives) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 500; ++i) {
    const Case c = random_case(random);
    const NoiseGradients g = noise_gradients(c.state, c.cone, c.gain);
    for (const auto field : kFields) {
      Measured up, down;
      up.*field = 1e-5, down.*field = -1e-5;
      const NoiseTerms p = noise_terms(c.state, c.cone, up, c.gain),
                       m = noise_terms(c.state, c.cone, down, c.gain);
      EXPECT_NEAR(g.y.*field, (p.delta_y - m.delta_y) / 2e-5, 1e-7) << i;
      EXPECT_NEAR(g.a.*field, (p.a - m.a) / 2e-5, 1e-6 * (1 + std::abs(g.a.*field))) << i;
      EXPECT_NEAR(g.v.*field, (p.v - m.v) / 2e-5, 1e-6 * (1 + std::abs(g.v.*field))) << i;
    }
  }
}

TEST(Noise, DeviationsAreThoseOfDrawsWhereNoiseIsSmall) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 3; ++i) {
    const Case c = random_case(random);
    Measured small = printed_noise(c.state);
    small.psi_rate = small.theta_b_rate = 0.05;
    for (const auto field : kFields) small.*field /= 100;
    const NoiseGradients g = noise_gradients(c.state, c.cone, c.gain);
    std::array<double, 3> sums{};
    const int draws = testing::campaign_size(200'000, 1'000'000);
    for (int j = 0; j < draws; ++j) {
      const NoiseTerms terms = noise_terms(c.state, c.cone, draw(small, random), c.gain);
      const std::array<double, 3> values{terms.delta_y, terms.a - 1, terms.v};
      for (std::size_t k = 0; k < 3; ++k) sums[k] += values[k] * values[k];
    }
    const std::array<double, 3> expected{deviation(g.y, small), deviation(g.a, small), deviation(g.v, small)};
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(sums[k] / draws / (expected[k] * expected[k]), 1, 0.01) << i << " " << k;
  }
}

TEST(Noise, OneRandomNumberForAllErrorsIsAnotherVariance) {
  std::mt19937_64 random(4);
  const Case c = random_case(random);
  Measured small = printed_noise(c.state);
  for (const auto field : kFields) small.*field /= 100;
  const NoiseGradients g = noise_gradients(c.state, c.cone, c.gain);
  std::normal_distribution<double> normal;
  double sum = 0;
  for (int j = 0; j < 100'000; ++j) {
    Measured errors = small;
    const double m = normal(random);
    for (const auto field : kFields) errors.*field *= m;
    const double dy = noise_terms(c.state, c.cone, errors, c.gain).delta_y;
    sum += dy * dy / 100'000;
  }
  const double expected = common_deviation(g.y, small);
  EXPECT_NEAR(sum / (expected * expected), 1, 0.03);
  EXPECT_GT(std::abs(expected / deviation(g.y, small) - 1), 0.05);
}

/// A and B of 7.2 at the start: both ellipses of 6 m and 2 m, along their headings (errata 4).
Case start_of_7_2() {
  const double degree = pi / 180, a = 45 * degree, b = 120 * degree;
  const Ellipse body_a = Ellipse::from_axes({0, 0}, {6, 2}, rotation_2d(a)),
                body_b = Ellipse::from_axes({45, 0}, {6, 2}, rotation_2d(b));
  Case c{};
  Cartesian<2> motion;
  motion.v_a = 25 * Eigen::Vector2d(std::cos(a), std::sin(a));
  motion.p_b = {45, 0};
  motion.v_b = 20 * Eigen::Vector2d(std::cos(b), std::sin(b));
  c.state = planar_state(motion);
  const Sector sector = sector_by_support(body_a, body_b);
  c.cone.psi = sector.psi;
  c.cone.theta_b = sector.theta_b;
  c.gain = 3.4;
  return c;
}

TEST(Noise, AtThePrintedNoiseTheLinearisationOfAHoldsLittle) {
  const Case c = start_of_7_2();
  EXPECT_NEAR(cone_rates(c.state, c.cone).y, -0.0452, 5e-5);  // printed
  const Measured noise = printed_noise(c.state);
  const NoiseGradients g = noise_gradients(c.state, c.cone, c.gain);
  EXPECT_NEAR(deviation(g.a, noise), 1.11, 0.005);
  std::mt19937_64 random(5);
  constexpr int kDraws = 200'000;
  int wrong_sign = 0, within = 0, y_within = 0;
  double squares = 0;
  const double sign = std::copysign(1, cone_rates(c.state, c.cone).by_lateral_a);
  for (int i = 0; i < kDraws; ++i) {
    const Measured errors = draw(noise, random);
    const NoiseTerms terms = noise_terms(c.state, c.cone, errors, c.gain);
    const MeasuredState seen = measured(c.state, c.cone, errors);
    wrong_sign += std::copysign(1, cone_rates(seen.state, seen.cone).by_lateral_a) != sign;
    within += std::abs(terms.a - 1) <= 3 * deviation(g.a, noise);
    y_within += std::abs(terms.delta_y) <= 3 * deviation(g.y, noise);
    squares += (terms.a - 1) * (terms.a - 1);
  }
  // "The sign of b is known", "E[a] = 1", "a high percentage within 3 sigma": none holds here. A normal
  // distribution has 99.7 % within.
  EXPECT_NEAR(double(wrong_sign) / kDraws, 0.172, 0.004);
  EXPECT_NEAR(double(within) / kDraws, 0.853, 0.004);
  EXPECT_GT(std::sqrt(squares / kDraws), 5 * deviation(g.a, noise));
  EXPECT_LT(double(y_within) / kDraws, 0.995);
  std::cout << "7.2 at t = 0: sign of D_1 D_2 wrong in " << 100.0 * wrong_sign / kDraws
            << " %, a within 3 deviations " << 100.0 * within / kDraws << " %, y within "
            << 100.0 * y_within / kDraws << " %\n";
}

TEST(Noise, TheRangeOfTheModelIsAroundTheTruth) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 100; ++i) {
    const Case c = random_case(random);
    Measured small = printed_noise(c.state);
    for (const auto field : kFields) small.*field /= 20;
    const NoiseRange range = noise_range(c.state, c.cone, small);
    // (7.16): z' = ... + b times what is added to the command.
    EXPECT_NEAR(range.b, cone_rates(c.state, c.cone).by_lateral_a, 1e-12);
    const MeasuredState seen = measured(c.state, c.cone, draw(small, random));
    const NoiseRange about = noise_range(seen.state, seen.cone, small);
    EXPECT_GE(about.b_high * 1.02, std::abs(range.b));
    EXPECT_LE(about.b_low * 0.98, std::abs(range.b));
  }
}

}  // namespace
}  // namespace vericone::guidance::noise_test
