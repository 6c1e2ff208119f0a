// SPDX-License-Identifier: BSD-3-Clause
//
// (6.17) to (6.19) on planes through the line of sight of ellipsoids: commands are flown in Cartesian
// coordinates, y is computed from the true cone's sector on the plane that is carried along.
#include <gtest/gtest.h>
#include <vericone/guidance/laws.h>

#include "guidance/law_promises.h"
#include "guidance/printed_formulas.h"
#include "guidance/spatial_engagement.h"

namespace vericone::guidance::spatial_laws_test {
namespace {

using testing::Errors, testing::Form, testing::RandomBodies, testing::SourceTerms, testing::SpatialEngagement;
using testing::kStates, testing::random_options, testing::relative_error, testing::wanted_rate;

/// An engagement that stays in a plane of symmetry of both bodies and of the motion: what the source's forms,
/// which know nothing of the plane's motion, cover without error.
SpatialEngagement in_a_fixed_plane(RandomBodies& random) {
  SpatialEngagement e = testing::random_spatial_engagement(random, 0.95);
  const Eigen::Vector3d n = e.sight(0).cross(e.across);
  const auto keep = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d { return v - v.dot(n) * n; };
  e.plane_spin = 0;
  for (testing::SpatialBody* body : {&e.a, &e.b}) {
    body->with_heading = false;
    body->path.v = keep(body->path.v);
    body->omega = body->omega.dot(n) * n;
    const Eigen::Matrix3d reflection = Eigen::Matrix3d::Identity() - 2 * n * n.transpose();
    const Eigen::Matrix3d s = body->at_start.shape(),
                          symmetric = 0.5 * (s + reflection * s * reflection.transpose());
    body->at_start = Ellipsoid::from_shape(body->path.p, 0.5 * (symmetric + symmetric.transpose()));
    body->growth.setZero();
  }
  return e;
}

TEST(SpatialLaws, TheRateOfYUnderAnyAccelerations) {
  RandomBodies random(6151);
  SCOPED_TRACE(random.trace());
  Errors errors;
  for (std::size_t i = 0; i < kStates; ++i) {
    SpatialEngagement e = testing::random_spatial_engagement(random, 6);
    const double a = random.uniform(-15, 15), b = random.uniform(-15, 15);
    e.apply(a, b);
    const ConeRates f = cone_rates(e.state(), e.cone());
    ASSERT_NEAR(f.y, e.y(0), 1e-13);
    const double rate = f.drift + f.by_lateral_a * a + f.by_lateral_b * b;
    const double size = std::abs(f.drift) + std::abs(f.by_lateral_a * a) + std::abs(f.by_lateral_b * b);
    errors.add(std::abs(rate - e.y_rate()) / size);
  }
  std::printf("(6.15), any lateral accelerations: worst relative error %.1e\n", errors.worst());
  EXPECT_LT(errors.worst(), 1e-6);
}

/// (6.17); beside it with the plane held fixed, as the source has it, and with A's own turning left out.
TEST(SpatialLaws, AvoidanceDoesWhatItPromises) {
  RandomBodies random(6171);
  SCOPED_TRACE(random.trace());
  Errors errors, fixed_plane, rigid;
  for (std::size_t i = 0; i < kStates; ++i) {
    SpatialEngagement e = testing::random_spatial_engagement(random, 0.95);
    const LawOptions options = random_options(random);
    const LawCommand command = avoidance(e.state(), e.cone(), options);
    ASSERT_EQ(command.status, LawStatus::steering) << i;
    const double wanted = wanted_rate(command.rates, options);
    const auto flown = [&](const PlanarState& s, const PlaneCone& cone) {
      e.apply(avoidance(s, cone, options).a, 0);
      return relative_error(e.y_rate(), wanted);
    };
    errors.add(flown(e.state(), e.cone()));
    PlanarState fixed = e.state();
    fixed.v_normal = fixed.plane_spin = 0;
    fixed_plane.add(flown(fixed, e.cone()));
    if (e.a.with_heading) {
      PlaneCone left_out = e.cone();
      left_out.psi_rate_by_a = left_out.theta_b_rate_by_a = 0;
      rigid.add(flown(e.state(), left_out));
    }
  }
  std::printf(
      "(6.17): worst relative error %.1e; plane held fixed: median %.1e; own turning left out: %.1e\n",
      errors.worst(), fixed_plane.median(), rigid.median());
  EXPECT_LT(errors.worst(), 1e-6);
  EXPECT_GT(fixed_plane.median(), 1e-2);
  EXPECT_GT(rigid.median(), 1e-2);
}

/// (6.18), (6.19).
TEST(SpatialLaws, CooperativeAvoidanceDoesWhatItPromises) {
  RandomBodies random(6192);
  SCOPED_TRACE(random.trace());
  Errors errors;
  for (std::size_t i = 0; i < kStates; ++i) {
    SpatialEngagement e = testing::random_spatial_engagement(random, 0.95);
    const LawOptions options = random_options(random);
    const double mu = random.uniform(-2, 2);
    const CooperativeCommand command = cooperative_avoidance(e.state(), e.cone(), options, mu);
    ASSERT_EQ(command.status, LawStatus::steering) << i;
    e.apply(command.a, command.b);
    errors.add(relative_error(e.y_rate(), wanted_rate(command.rates, options)));
  }
  std::printf("(6.18), (6.19) in space: worst relative error %.1e\n", errors.worst());
  EXPECT_LT(errors.worst(), 1e-6);
}

/// Where the source's neglect of the plane's motion is none: the printed (6.17) is right, (6.19) is not.
TEST(SpatialLaws, PrintedFormsOnAFixedPlane) {
  RandomBodies random(6193);
  SCOPED_TRACE(random.trace());
  Errors law_617, law_619, printed_617, printed_619;
  while (law_617.count() < kStates) {
    SpatialEngagement e = in_a_fixed_plane(random);
    if (relation(e.a.at(0), e.b.at(0)) != Relation::disjoint) continue;
    const LawOptions options = random_options(random);
    const double mu = random.uniform(-2, 2);
    const ConeRates f = cone_rates(e.state(), e.cone());
    if (!f.colliding()) continue;
    const SourceTerms terms(e.state(), e.cone(), options.gain, options.reference);
    const double wanted = wanted_rate(f, options);
    const auto flown = [&](double a, double b) {
      e.apply(a, b);
      return relative_error(e.y_rate(), wanted);
    };
    const auto pair = cooperative_avoidance(e.state(), e.cone(), options, mu);
    law_617.add(flown(avoidance(e.state(), e.cone(), options).a, 0));
    law_619.add(flown(pair.a, pair.b));
    printed_617.add(flown(law_5_12(terms), 0));
    const double wrong = law_6_19(terms, mu, Form::printed);
    printed_619.add(flown(wrong, mu * wrong));
  }
  std::printf("fixed plane: (6.17) %.1e, as printed %.1e; (6.19) %.1e, as printed median %.1e\n",
              law_617.worst(), printed_617.worst(), law_619.worst(), printed_619.median());
  EXPECT_LT(law_617.worst(), 1e-6);
  EXPECT_LT(printed_617.worst(), 1e-6);
  EXPECT_LT(law_619.worst(), 1e-6);
  EXPECT_GT(printed_619.median(), 1e-2);
}

}  // namespace
}  // namespace vericone::guidance::spatial_laws_test
