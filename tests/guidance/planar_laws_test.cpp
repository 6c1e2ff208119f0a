// SPDX-License-Identifier: BSD-3-Clause
//
// The planar laws against what they promise, y' = -K (y - w): their commands are flown by bodies on Cartesian
// paths and y is computed from those bodies' sectors alone. What the source prints wrongly is flown on the
// same states.
#include <gtest/gtest.h>
#include <vericone/guidance/laws.h>

#include "guidance/law_promises.h"
#include "guidance/planar_engagement.h"
#include "guidance/printed_formulas.h"

namespace vericone::guidance::planar_laws_test {
namespace {

using testing::Equation, testing::Errors, testing::Form, testing::PlanarEngagement, testing::RandomBodies,
    testing::SourceTerms;
using testing::kStates, testing::random_options, testing::relative_error, testing::wanted_rate;

/// Bodies that neither turn by their accelerations nor are turned by them: what the source's forms cover.
PlanarEngagement without_turning_by_acceleration(RandomBodies& random) {
  PlanarEngagement e = testing::random_planar_engagement(random, 0.95);
  e.a.with_heading = e.b.with_heading = false;
  return e;
}

/// (5.9), (5.10).
TEST(PlanarLaws, BisectorQuantities) {
  RandomBodies random(5091);
  SCOPED_TRACE(random.trace());
  Errors hat, y, printed;
  for (std::size_t i = 0; i < kStates; ++i) {
    const PlanarEngagement e = testing::random_planar_engagement(random, 3);
    const PlanarState s = e.state();
    const PlaneCone cone = e.cone();
    const ConeRates f = cone_rates(s, cone);
    const Eigen::Vector2d v = e.relative(0), b = testing::at_angle(cone.theta_b);
    const Eigen::Vector2d right(v.dot(b), b.x() * v.y() - b.y() * v.x());
    const auto error = [&](const Eigen::Vector2d& of) { return (of - right).norm() / v.norm(); };
    hat.add(error({f.v_r_hat, f.v_theta_hat}));
    hat.add(error(testing::equation_5_9(s.v_r, s.v_theta, s.theta, cone.theta_b, Form::corrected)));
    printed.add(error(testing::equation_5_9(s.v_r, s.v_theta, s.theta, cone.theta_b, Form::printed)));
    y.add(std::abs(f.y - e.y(0)));
    y.add(std::abs(testing::equation_5_10(s.v_r, s.v_theta, s.theta, cone.theta_b, cone.psi) - e.y(0)));
  }
  std::printf("(5.9): worst %.1e, printed median %.1e; (5.10): worst %.1e\n", hat.worst(), printed.median(),
              y.worst());
  EXPECT_LT(hat.worst(), 1e-13);
  EXPECT_LT(y.worst(), 1e-13);
  EXPECT_GT(printed.median(), 1e-2);
}

/// (5.11) with all four accelerations, in and out of the cone, approaching and not.
TEST(PlanarLaws, TheRateOfYUnderAnyAccelerations) {
  RandomBodies random(5111);
  SCOPED_TRACE(random.trace());
  Errors errors;
  for (std::size_t i = 0; i < kStates; ++i) {
    PlanarEngagement e = testing::random_planar_engagement(random, 6);
    const double a = random.uniform(-15, 15), b = random.uniform(-15, 15), p = random.uniform(-15, 15),
                 q = random.uniform(-15, 15);
    e.apply(a, b, p, q);
    const ConeRates f = cone_rates(e.state(), e.cone());
    const double terms[] = {f.drift, f.by_lateral_a * a, f.by_lateral_b * b, f.by_longitudinal_a * p,
                            f.by_longitudinal_b * q};
    double rate = 0, size = 0;
    for (const double term : terms) {
      rate += term;
      size += std::abs(term);
    }
    errors.add(std::abs(rate - e.y_rate()) / size);
  }
  std::printf("(5.11), any accelerations: worst relative error %.1e\n", errors.worst());
  EXPECT_LT(errors.worst(), 1e-6);
}

/// (5.12).
TEST(PlanarLaws, AvoidanceDoesWhatItPromises) {
  RandomBodies random(5121);
  SCOPED_TRACE(random.trace());
  Errors errors, still, form;
  for (std::size_t i = 0; i < kStates; ++i) {
    PlanarEngagement e = testing::random_planar_engagement(random, 0.95);
    const LawOptions options = random_options(random);
    const LawCommand command = avoidance(e.state(), e.cone(), options);
    ASSERT_EQ(command.status, LawStatus::steering) << i;
    e.apply(command.a, 0);
    errors.add(relative_error(e.y_rate(), wanted_rate(command.rates, options)));

    PlanarEngagement plain = e;
    plain.a.with_heading = plain.b.with_heading = false;
    const double a = avoidance(plain.state(), plain.cone(), options).a;
    const SourceTerms terms(plain.state(), plain.cone(), options.gain, options.reference);
    form.add(std::abs(a - law_5_12(terms)) / std::abs(a));
    // What (5.12) commands a body that turns with its heading, its turning left out.
    if (e.a.with_heading) {
      PlaneCone left_out = e.cone();
      left_out.psi_rate_by_a = left_out.theta_b_rate_by_a = 0;
      e.apply(avoidance(e.state(), left_out, options).a, 0);
      still.add(relative_error(e.y_rate(), wanted_rate(command.rates, options)));
    }
  }
  std::printf("(5.12): worst relative error %.1e; own turning left out: median %.1e; N1, N2, D1, D2: %.1e\n",
              errors.worst(), still.median(), form.worst());
  EXPECT_LT(errors.worst(), 1e-6);
  EXPECT_LT(form.worst(), 1e-10);
  EXPECT_GT(still.median(), 1e-2);
}

/// (5.14).
TEST(PlanarLaws, CooperativeRendezvousDoesWhatItPromises) {
  RandomBodies random(5141);
  SCOPED_TRACE(random.trace());
  Errors errors, printed, equation;
  while (equation.count() < kStates) {
    PlanarEngagement e = testing::random_planar_engagement(random, 1.4);
    const LawOptions options = random_options(random);
    const ConeRates f = cone_rates(e.state(), e.cone());
    if (f.v_r_hat >= 0) continue;
    const CooperativeCommand command = cooperative_rendezvous(e.state(), e.cone(), options);
    ASSERT_EQ(command.status, LawStatus::steering) << equation.count();
    e.apply(command.a, command.b);
    errors.add(relative_error(e.y_rate(), wanted_rate(f, options)));

    PlanarEngagement plain = without_turning_by_acceleration(random);
    const SourceTerms terms(plain.state(), plain.cone(), options.gain, options.reference);
    const Equation right = equation_5_14(terms, Form::corrected);
    const CooperativeCommand pair = cooperative_rendezvous(plain.state(), plain.cone(), options);
    const Eigen::Vector2d least = right.least();
    equation.add((Eigen::Vector2d(pair.a, pair.b) - least).norm() / least.norm());
    plain.apply(pair.a, pair.b);
    errors.add(relative_error(plain.y_rate(), wanted_rate(pair.rates, options)));
    const Eigen::Vector2d wrong = equation_5_14(terms, Form::printed).least();
    plain.apply(wrong.x(), wrong.y());
    printed.add(relative_error(plain.y_rate(), wanted_rate(pair.rates, options)));
  }
  std::printf("(5.14): worst relative error %.1e, printed median %.1e; A11..C11 as corrected: %.1e\n",
              errors.worst(), printed.median(), equation.worst());
  EXPECT_LT(errors.worst(), 1e-6);
  EXPECT_LT(equation.worst(), 1e-10);
  EXPECT_GT(printed.median(), 1e-2);
}

/// (5.16), (5.17).
TEST(PlanarLaws, MatchingRendezvousDoesWhatItPromises) {
  RandomBodies random(5161);
  SCOPED_TRACE(random.trace());
  Errors of_y, of_speed, printed, equations;
  for (std::size_t i = 0; i < kStates; ++i) {
    PlanarEngagement e = testing::random_planar_engagement(random, 0.95);
    const LawOptions options = random_options(random);
    const double k_2 = random.uniform(0.1, 3);
    const MatchingCommand command = matching_rendezvous(e.state(), e.cone(), options, k_2);
    ASSERT_EQ(command.status, LawStatus::steering) << i;
    e.apply(command.lateral, 0, command.longitudinal);
    const double v2 = e.relative(0).squaredNorm();
    ASSERT_NEAR(command.speed_squared, v2, 1e-12 * v2);
    of_y.add(relative_error(e.y_rate(), wanted_rate(command.rates, options)));
    of_speed.add(std::abs(e.speed_squared_rate() + k_2 * v2) / (k_2 * v2));

    PlanarEngagement plain = without_turning_by_acceleration(random);
    const SourceTerms terms(plain.state(), plain.cone(), options.gain, options.reference);
    const Eigen::Vector2d right = solved(equation_5_16(terms), equation_5_17(terms, k_2, Form::corrected));
    const MatchingCommand pair = matching_rendezvous(plain.state(), plain.cone(), options, k_2);
    equations.add((Eigen::Vector2d(pair.lateral, pair.longitudinal) - right).norm() / right.norm());
    const auto speed_error = [&] {
      return std::abs(plain.speed_squared_rate() + k_2 * pair.speed_squared) / (k_2 * pair.speed_squared);
    };
    plain.apply(pair.lateral, 0, pair.longitudinal);
    of_y.add(relative_error(plain.y_rate(), wanted_rate(pair.rates, options)));
    of_speed.add(speed_error());
    const Eigen::Vector2d wrong = solved(equation_5_16(terms), equation_5_17(terms, k_2, Form::printed));
    plain.apply(wrong.x(), 0, wrong.y());
    printed.add(speed_error());
  }
  std::printf("(5.16): worst relative error %.1e; (5.17): %.1e, printed median %.1e; as corrected: %.1e\n",
              of_y.worst(), of_speed.worst(), printed.median(), equations.worst());
  EXPECT_LT(of_y.worst(), 1e-6);
  EXPECT_LT(of_speed.worst(), 1e-6);
  EXPECT_LT(equations.worst(), 1e-10);
  EXPECT_GT(printed.median(), 1e-2);
}

/// (6.18), (6.19) in the plane.
TEST(PlanarLaws, CooperativeAvoidanceDoesWhatItPromises) {
  RandomBodies random(6191);
  SCOPED_TRACE(random.trace());
  Errors errors, printed, form;
  for (std::size_t i = 0; i < kStates; ++i) {
    PlanarEngagement e = testing::random_planar_engagement(random, 0.95);
    const LawOptions options = random_options(random);
    const double mu = random.uniform(-2, 2);
    const CooperativeCommand command = cooperative_avoidance(e.state(), e.cone(), options, mu);
    ASSERT_EQ(command.status, LawStatus::steering) << i;
    ASSERT_EQ(command.b, mu * command.a);
    e.apply(command.a, command.b);
    errors.add(relative_error(e.y_rate(), wanted_rate(command.rates, options)));

    PlanarEngagement plain = without_turning_by_acceleration(random);
    const SourceTerms terms(plain.state(), plain.cone(), options.gain, options.reference);
    const CooperativeCommand pair = cooperative_avoidance(plain.state(), plain.cone(), options, mu);
    form.add(std::abs(pair.a - law_6_19(terms, mu, Form::corrected)) / std::abs(pair.a));
    plain.apply(pair.a, pair.b);
    errors.add(relative_error(plain.y_rate(), wanted_rate(pair.rates, options)));
    const double wrong = law_6_19(terms, mu, Form::printed);
    plain.apply(wrong, mu * wrong);
    printed.add(relative_error(plain.y_rate(), wanted_rate(pair.rates, options)));
  }
  std::printf("(6.18), (6.19): worst relative error %.1e, printed median %.1e; as corrected: %.1e\n",
              errors.worst(), printed.median(), form.worst());
  EXPECT_LT(errors.worst(), 1e-6);
  EXPECT_LT(form.worst(), 1e-10);
  EXPECT_GT(printed.median(), 1e-2);
}

}  // namespace
}  // namespace vericone::guidance::planar_laws_test
