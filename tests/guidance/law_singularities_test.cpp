// SPDX-License-Identifier: BSD-3-Clause
//
// What each law does where it has nothing to do, no effect, no limit, or too much to demand.
#include <gtest/gtest.h>
#include <vericone/guidance/laws.h>
#include <vericone/testing/random_bodies.h>

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <set>
#include <string>

#include "support/allocations.h"

namespace vericone::guidance::law_singularities_test {
namespace {

using std::numbers::pi;
using testing::RandomBodies;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A flies along x at 10 m/s towards B, 20 m ahead, which comes at 5 m/s from the direction beta.
PlanarState head_on(double beta = pi) {
  PlanarState s;
  s.r = 20;
  s.speed_a = 10;
  s.speed_b = 5;
  s.beta = beta;
  s.v_r = 5 * std::cos(beta) - 10;
  s.v_theta = 5 * std::sin(beta);
  return s;
}

PlaneCone opening(double psi, double theta_b = 0) { return {psi, theta_b}; }

LawOptions limited(double most, double side = 1) {
  LawOptions options;
  options.gain = 2;
  options.reference = 0.05;
  options.most = most;
  options.side = side;
  return options;
}

TEST(LawSingularities, OnTheBisectorTheSideIsChosen) {
  for (const double side : {1.0, -1.0, 0.5}) {
    const double sign = side < 0 ? -1 : 1;
    const LawCommand one = avoidance(head_on(), opening(0.6), limited(15, side));
    EXPECT_EQ(one.status, LawStatus::on_bisector);
    EXPECT_EQ(one.a, sign * 15);
    const CooperativeCommand both = cooperative_avoidance(head_on(), opening(0.6), limited(15, side), -0.5);
    EXPECT_EQ(both.status, LawStatus::on_bisector);
    EXPECT_EQ(both.a, sign * 15);
    EXPECT_EQ(both.b, -sign * 7.5);
    const CooperativeCommand greater = cooperative_avoidance(head_on(), opening(0.6), limited(15, side), 3);
    EXPECT_EQ(greater.a, sign * 5);
    EXPECT_EQ(greater.b, sign * 15);
    // Head on, both to their left turn the relative velocity the same way.
    const CooperativeCommand graze = cooperative_rendezvous(head_on(), opening(0.6), limited(15, side));
    EXPECT_EQ(graze.status, LawStatus::on_bisector);
    EXPECT_EQ(graze.a, sign * 15);
    EXPECT_NEAR(graze.b, sign * 15, 1e-12);
  }
  // Within rounding of it as well.
  const PlanarState nearly = head_on(pi + 1e-12);
  EXPECT_EQ(avoidance(nearly, opening(0.6), limited(15)).status, LawStatus::on_bisector);
}

TEST(LawSingularities, OnTheBisectorWithoutALimitNothing) {
  const LawOptions options = limited(kInfinity);
  EXPECT_EQ(avoidance(head_on(), opening(0.6), options).a, 0);
  EXPECT_EQ(cooperative_avoidance(head_on(), opening(0.6), options, 1).b, 0);
  const CooperativeCommand graze = cooperative_rendezvous(head_on(), opening(0.6), options);
  EXPECT_EQ(graze.a, 0);
  EXPECT_EQ(graze.b, 0);
}

TEST(LawSingularities, BesideTheBisectorTheNearSideAndMore) {
  for (const double part : {1e-7, -1e-7, 1e-3, -1e-3}) {
    const LawCommand command = avoidance(head_on(), opening(0.6, part), limited(15));
    EXPECT_EQ(command.status, LawStatus::saturated);
    EXPECT_EQ(std::abs(command.a), 15);
    EXPECT_GT(command.rates.by_lateral_a * command.a, 0);
    EXPECT_GT(command.demanded / command.a, 1);
    // Away from the bisector on the side where V is, the one that is nearer.
    EXPECT_EQ(command.a > 0, avoidance(head_on(), opening(0.6, 2 * part), limited(15)).a > 0);
    EXPECT_NE(command.a > 0, avoidance(head_on(), opening(0.6, -part), limited(15)).a > 0);
  }
}

/// A body that turns with its heading changes psi to first order even on the bisector.
TEST(LawSingularities, TurningWithItsHeadingIsAnEffectOnTheBisector) {
  PlaneCone cone = opening(0.6);
  cone.psi_rate_by_a = -0.02;
  const LawOptions options = limited(kInfinity);
  const LawCommand command = avoidance(head_on(), cone, options);
  EXPECT_EQ(command.status, LawStatus::steering);
  EXPECT_NEAR(0.5 * std::sin(0.6) * 0.02 * command.a, -2 * (command.rates.y - 0.05), 1e-12);
}

TEST(LawSingularities, InputsThatDoNotTurnTheRelativeVelocity) {
  PlanarState s = head_on();
  s.alpha = pi / 2;  // A's lateral acceleration is along V
  for (const double side : {1.0, -1.0}) {
    const LawCommand command = avoidance(s, opening(0.8, 0.2), limited(15, side));
    EXPECT_EQ(command.status, LawStatus::ineffective);
    EXPECT_EQ(command.a, side * 15);
  }
  EXPECT_EQ(avoidance(s, opening(0.8, 0.2), limited(kInfinity)).a, 0);
  // B still turns it: grazing together is possible, and the least pair leaves A alone.
  const CooperativeCommand graze = cooperative_rendezvous(s, opening(0.8, 0.2), limited(kInfinity));
  EXPECT_EQ(graze.status, LawStatus::steering);
  EXPECT_NEAR(graze.a, 0, 1e-12);
  EXPECT_GT(std::abs(graze.b), 1e-3);
  s.beta = pi / 2;
  const CooperativeCommand neither = cooperative_rendezvous(s, opening(0.8, 0.2), limited(15));
  EXPECT_EQ(neither.status, LawStatus::ineffective);
  EXPECT_EQ(neither.a, 15);
  EXPECT_EQ(neither.b, 0);
  // On the bisector, too.
  const CooperativeCommand middle = cooperative_rendezvous(s, opening(0.8), limited(15));
  EXPECT_EQ(middle.status, LawStatus::on_bisector);
  EXPECT_EQ(middle.a, 15);
  EXPECT_EQ(middle.b, 0);
}

/// The ratio at which the two bodies' effects cancel: (6.19) is singular, each alone is not.
TEST(LawSingularities, ARatioThatCancels) {
  const PlaneCone cone = opening(0.8, 0.2);
  const ConeRates f = cone_rates(head_on(), cone);
  const double mu = -f.by_lateral_a / f.by_lateral_b;
  const CooperativeCommand command = cooperative_avoidance(head_on(), cone, limited(15), mu);
  EXPECT_EQ(command.status, LawStatus::ineffective);
  EXPECT_EQ(std::max(std::abs(command.a), std::abs(command.b)), 15);
  EXPECT_EQ(command.b, mu * command.a);
  EXPECT_EQ(avoidance(head_on(), cone, limited(kInfinity)).status, LawStatus::steering);
}

TEST(LawSingularities, SaturationKeepsSignsAndRatios) {
  RandomBodies random(5101);
  SCOPED_TRACE(random.trace());
  int saturated = 0;
  for (int i = 0; i < 1000; ++i) {
    const PlanarState s = head_on(random.uniform(2, 4));
    const PlaneCone cone = opening(random.uniform(0.7, 2), random.uniform(-0.3, 0.3));
    const LawOptions free = limited(kInfinity), bound = limited(random.log_uniform(0.1, 100));
    const double most = bound.most * (1 + 1e-15), mu = random.uniform(-2, 2);
    const LawCommand one = avoidance(s, cone, bound);
    ASSERT_EQ(one.demanded, avoidance(s, cone, free).a);
    ASSERT_LE(std::abs(one.a), most);
    ASSERT_GE(one.a * one.demanded, 0);
    ASSERT_EQ(one.status == LawStatus::saturated, std::abs(one.demanded) > bound.most);
    saturated += one.status == LawStatus::saturated;
    const CooperativeCommand ratio = cooperative_avoidance(s, cone, bound, mu),
                             graze = cooperative_rendezvous(s, cone, bound);
    ASSERT_EQ(ratio.b, mu * ratio.a);
    for (const CooperativeCommand& c : {ratio, graze}) {
      ASSERT_LE(std::max(std::abs(c.a), std::abs(c.b)), most);
      ASSERT_GE(c.a * c.demanded_a, 0);
      ASSERT_NEAR(c.a * c.demanded_b, c.b * c.demanded_a, 1e-12 * std::abs(c.b * c.demanded_a));
    }
    const MatchingCommand match = matching_rendezvous(s, cone, bound, 1);
    ASSERT_LE(std::hypot(match.lateral, match.longitudinal), most);
    ASSERT_GE(match.lateral * match.demanded_lateral, 0);
    ASSERT_NEAR(match.lateral * match.demanded_longitudinal, match.longitudinal * match.demanded_lateral,
                1e-12 * std::abs(match.lateral * match.demanded_longitudinal));
  }
  EXPECT_GT(saturated, 100);
}

TEST(LawSingularities, ClearCommandsNothing) {
  const PlaneCone cone = opening(0.2, 0.4);  // V passes beside it
  LawOptions options = limited(15);
  const LawCommand command = avoidance(head_on(), cone, options);
  EXPECT_GT(command.rates.y, 0);
  EXPECT_EQ(command.status, LawStatus::clear);
  EXPECT_EQ(command.a, 0);
  EXPECT_EQ(cooperative_avoidance(head_on(), cone, options, 1).b, 0);
  // Avoidance may be asked to go on; grazing always goes on, inwards here.
  options.cease = command.rates.y + 0.01;
  options.reference = options.cease;
  EXPECT_NE(avoidance(head_on(), cone, options).a, 0);
  options.reference = 0;
  const CooperativeCommand graze = cooperative_rendezvous(head_on(), cone, options);
  EXPECT_LT(graze.rates.by_lateral_a * graze.a, 0);
}

TEST(LawSingularities, RecedingCommandsNothingButBraking) {
  PlanarState s = head_on(2.5);
  s.v_r *= -1;
  s.v_theta *= -1;
  const PlaneCone cone = opening(0.8);
  EXPECT_LT(cone_rates(s, cone).y, 0);
  EXPECT_EQ(avoidance(s, cone, limited(15)).status, LawStatus::receding);
  EXPECT_EQ(avoidance(s, cone, limited(15)).a, 0);
  EXPECT_EQ(cooperative_avoidance(s, cone, limited(15), 1).status, LawStatus::receding);
  const CooperativeCommand graze = cooperative_rendezvous(s, cone, limited(15));
  EXPECT_EQ(graze.status, LawStatus::receding);
  EXPECT_EQ(graze.a, 0);
  EXPECT_EQ(graze.b, 0);
}

/// Receding and on the bisector matching keeps y_2' = -K_2 y_2 alone, with an acceleration along V.
TEST(LawSingularities, MatchingWithoutYBrakes) {
  PlanarState away = head_on(2.5);
  away.v_r *= -1;
  away.v_theta *= -1;
  for (const auto& [s, status] :
       {std::pair{away, LawStatus::receding}, std::pair{head_on(), LawStatus::on_bisector}}) {
    const double k_2 = 0.7, v2 = s.v_r * s.v_r + s.v_theta * s.v_theta;
    const MatchingCommand command = matching_rendezvous(s, opening(0.8), limited(kInfinity), k_2);
    EXPECT_EQ(command.status, status);
    PlanarInputs inputs;
    inputs.lateral_a = command.lateral;
    inputs.longitudinal_a = command.longitudinal;
    PlanarRates rates = planar_rates(s, inputs);
    EXPECT_NEAR(2 * (s.v_r * rates.v_r + s.v_theta * rates.v_theta), -k_2 * v2, 1e-11);
    EXPECT_NEAR(std::hypot(command.lateral, command.longitudinal), 0.5 * k_2 * std::sqrt(v2), 1e-12);
  }
}

TEST(LawSingularities, WithoutRelativeVelocityNothing) {
  for (const double size : {0.0, 1e-310}) {
    PlanarState s = head_on(0);
    s.v_r = s.v_theta = size;
    PlaneCone cone = opening(0.8);
    cone.psi_rate = cone.theta_b_rate = cone.psi_rate_by_a = 1;
    const ConeRates f = cone_rates(s, cone);
    EXPECT_EQ(f.y, -std::pow(std::sin(0.4), 2));
    EXPECT_EQ(f.drift, 0);
    EXPECT_FALSE(f.colliding());
    EXPECT_EQ(avoidance(s, cone, limited(15)).status, LawStatus::no_relative_velocity);
    EXPECT_EQ(avoidance(s, cone, limited(15)).a, 0);
    EXPECT_EQ(cooperative_avoidance(s, cone, limited(15), 1).status, LawStatus::no_relative_velocity);
    EXPECT_EQ(cooperative_rendezvous(s, cone, limited(15)).status, LawStatus::no_relative_velocity);
    const MatchingCommand arrived = matching_rendezvous(s, cone, limited(15), 1);
    EXPECT_EQ(arrived.status, LawStatus::no_relative_velocity);
    EXPECT_EQ(arrived.longitudinal, 0);
    EXPECT_EQ(arrived.speed_squared, 0);
  }
}

/// Every command is a finite number within the limit, whatever finite state it gets, singular ones among
/// them.
TEST(LawSingularities, CommandsAreFinite) {
  const std::initializer_list<double> speeds{0, 5e-324, 2.3e-308, 1e-200, 1e-8, 1, 1e8, 1e150},
      angles{0, pi / 2, -pi / 2, pi, 1e-300, 0.3, 100}, openings{0, 1e-9, 1, pi};
  for (const double v : speeds)
    for (const double direction : angles)
      for (const double alpha : angles)
        for (const double theta_b : angles)
          for (const double psi : openings) {
            PlanarState s;
            s.r = 10;
            s.v_r = -v * std::cos(direction);
            s.v_theta = v * std::sin(direction);
            s.alpha = alpha;
            s.beta = 1;
            s.v_normal = s.plane_spin = 1;
            PlaneCone cone = opening(psi, theta_b);
            cone.psi_rate = cone.theta_b_rate = cone.theta_b_rate_by_a = 1;
            const LawOptions options = limited(15);
            const auto within = [](double a) { return std::abs(a) <= 15 * (1 + 1e-12); };
            EXPECT_TRUE(within(avoidance(s, cone, options).a));
            const CooperativeCommand ratio = cooperative_avoidance(s, cone, options, -0.5),
                                     graze = cooperative_rendezvous(s, cone, options);
            EXPECT_TRUE(within(ratio.a) && within(ratio.b) && within(graze.a) && within(graze.b));
            const MatchingCommand match = matching_rendezvous(s, cone, options, 1);
            ASSERT_TRUE(within(match.lateral) && within(match.longitudinal))
                << v << " " << direction << " " << alpha << " " << theta_b << " " << psi;
          }
}

/// Angles count from any axis and in any turn; a mirror image is answered by the mirror image.
TEST(LawSingularities, AxesTurnsAndMirrors) {
  RandomBodies random(5102);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 1000; ++i) {
    PlanarState s = head_on(random.uniform(2, 4));
    s.alpha = random.uniform(-1, 1);
    s.v_normal = random.uniform(-5, 5);
    s.plane_spin = random.uniform(-1, 1);
    const PlaneCone cone{random.uniform(0.7, 2), random.uniform(-0.3, 0.3), random.uniform(-1, 1),
                         random.uniform(-1, 1)};
    const LawOptions options = limited(kInfinity);
    const double a = avoidance(s, cone, options).a;
    PlanarState turned = s;
    PlaneCone turned_cone = cone;
    const double by = random.uniform(-50, 50);
    turned.theta += by;
    turned.alpha += by - 6 * pi;
    turned_cone.theta_b += by + 4 * pi;
    ASSERT_NEAR(avoidance(turned, turned_cone, options).a, a, 1e-9 * (1 + a * a));
    PlanarState mirrored = s;
    mirrored.v_theta *= -1;
    mirrored.alpha *= -1;
    mirrored.plane_spin *= -1;
    const PlaneCone mirrored_cone{cone.psi, -cone.theta_b, cone.psi_rate, -cone.theta_b_rate};
    ASSERT_EQ(avoidance(mirrored, mirrored_cone, options).a, -a);
  }
}

TEST(LawSingularities, NoAllocation) {
  const PlanarState states[] = {head_on(), head_on(2.5), PlanarState{}};
  const LawOptions options = limited(15);
  double sum = 0;
  const std::size_t before = testing::allocations();
  for (const PlanarState& s : states) {
    const PlaneCone cone = opening(0.8);
    sum += avoidance(s, cone, options).a + cooperative_avoidance(s, cone, options, 0.5).b +
           cooperative_rendezvous(s, cone, options).b + matching_rendezvous(s, cone, options, 1).lateral;
  }
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(LawSingularities, EveryStatusHasAName) {
  std::set<std::string> names;
  for (int i = 0; i <= static_cast<int>(LawStatus::no_sector); ++i)
    names.insert(to_string(static_cast<LawStatus>(i)));
  EXPECT_EQ(names.size(), 8u);
  EXPECT_FALSE(names.contains("?"));
}

}  // namespace
}  // namespace vericone::guidance::law_singularities_test
