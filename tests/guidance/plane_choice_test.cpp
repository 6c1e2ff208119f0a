// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/cone_geometry.h>
#include <vericone/guidance/plane_view.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "guidance/engagements.h"
#include "guidance/plane_merit.h"
#include "support/allocations.h"

namespace vericone::guidance::plane_choice_test {
namespace {

using Eigen::Vector3d;
using testing::ellipsoid_of, testing::line_of_sight, testing::merit, testing::RandomBodies;

constexpr PlaneChoice kSearched[] = {PlaneChoice::largest_opening, PlaneChoice::least_turn,
                                     PlaneChoice::least_y, PlaneChoice::wind_aware};
constexpr PlaneChoice kAll[] = {
    PlaneChoice::largest_opening, PlaneChoice::least_turn,         PlaneChoice::least_y,
    PlaneChoice::wind_aware,      PlaneChoice::steepest_clearance, PlaneChoice::of_motion};

TEST(PlaneChoice, IsTheBestOf3600Planes) {
  RandomBodies random(7301);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 24; ++i) {
    const auto [moving_a, moving_b] = testing::moving_pair(random, 1.2, 4);
    const BodyState a = moving_a.state(), b = moving_b.state();
    const AxisFrame frame(b.position - a.position);
    for (const SectorMethod method : {SectorMethod::true_cone, SectorMethod::slice})
      for (const PlaneChoice choice : kSearched) {
        PlaneOptions options;
        options.choice = choice;
        options.wind = random.direction();
        const auto e = choose_plane(a, b, method, options);
        ASSERT_TRUE(e);
        ASSERT_NEAR(e->norm(), 1, 1e-14);
        ASSERT_NEAR(e->dot(frame.axis), 0, 1e-14);
        double best = std::numeric_limits<double>::infinity();
        for (int j = 0; j < 3600; ++j) {
          const double azimuth = std::numbers::pi * j / 3600;
          best = std::min(best, merit(a, b, method, options,
                                      std::cos(azimuth) * frame.e1 + std::sin(azimuth) * frame.e2));
        }
        // A smooth optimum is flat to 1e-8 at 1e-4 rad; the wind's bound is not.
        EXPECT_LE(merit(a, b, method, options, *e), best + (choice == PlaneChoice::wind_aware ? 1e-3 : 1e-8))
            << to_string(choice) << " " << i;
      }
  }
}

TEST(PlaneChoice, TheUnrefinedChoiceIsTheBestCandidate) {
  RandomBodies random(7302);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 100; ++i) {
    const auto [moving_a, moving_b] = testing::moving_pair(random, 1.2, 4);
    const BodyState a = moving_a.state(), b = moving_b.state();
    const AxisFrame frame(b.position - a.position);
    PlaneOptions options;
    options.refine = false;
    options.planes = random.integer(1, 40);
    const auto all = all_planes(a, b, SectorMethod::true_cone, options.planes);
    ASSERT_EQ(all.size(), std::size_t(options.planes));
    for (std::size_t j = 0; j < all.size(); ++j) {
      const PlaneCandidate& candidate = all[j];
      EXPECT_NEAR(candidate.azimuth, std::numbers::pi * double(j) / options.planes, 1e-15);
      const auto view =
          plane_view(a, b, std::cos(candidate.azimuth) * frame.e1 + std::sin(candidate.azimuth) * frame.e2,
                     SectorMethod::true_cone, RateMethod::none);
      ASSERT_TRUE(view);
      EXPECT_NEAR(candidate.psi, view->cone.psi, 1e-12);
      EXPECT_NEAR(candidate.theta_b, view->cone.theta_b, 1e-12);
      const ConeRates rates = cone_rates(view->state, view->cone);
      EXPECT_NEAR(candidate.y, rates.y, 1e-12);
      EXPECT_NEAR(candidate.v_r_hat, rates.v_r_hat, 1e-11);
    }
    // The choice counts its candidates from the plane of motion.
    const Vector3d w = a.velocity - b.velocity, e1 = (w - w.dot(frame.axis) * frame.axis).normalized();
    Vector3d best = Vector3d::Zero();
    double widest = 0;
    for (int j = 0; j < options.planes; ++j) {
      const double azimuth = std::numbers::pi * j / options.planes;
      const Vector3d across = std::cos(azimuth) * e1 + std::sin(azimuth) * frame.axis.cross(e1);
      const auto view = plane_view(a, b, across, SectorMethod::true_cone, RateMethod::none);
      ASSERT_TRUE(view);
      if (view->cone.psi > widest + 1e-12) {
        widest = view->cone.psi;
        best = across;
      }
    }
    const auto e = choose_plane(a, b, SectorMethod::true_cone, options);
    ASSERT_TRUE(e);
    EXPECT_LT((*e - best).norm(), 1e-13);
  }
}

TEST(PlaneChoice, OfEquallyGoodPlanesThatOfMotionIsTaken) {
  RandomBodies random(7303);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    auto [moving_a, moving_b] = testing::moving_pair(random, 4, 8);
    moving_a.semi_axes.setConstant(random.uniform(1, 2));
    moving_b.semi_axes.setConstant(random.uniform(1, 2));
    const BodyState a = moving_a.state(), b = moving_b.state();
    const AxisFrame frame(b.position - a.position);
    for (const SectorMethod method : {SectorMethod::true_cone, SectorMethod::slice}) {
      const auto e = choose_plane(a, b, method, {});
      ASSERT_TRUE(e);
      const Vector3d w = a.velocity - b.velocity;
      EXPECT_LT((*e - (w - w.dot(frame.axis) * frame.axis).normalized()).norm(), 1e-13);
      // And where all are equal none is left.
      const Vector3d before = random.direction();
      const auto next = choose_plane(a, b, method, {}, &before);
      ASSERT_TRUE(next);
      EXPECT_LT((*next - (before - before.dot(frame.axis) * frame.axis).normalized()).norm(), 1e-13);
    }
  }
}

TEST(PlaneChoice, ThePlaneOfMotionTellsCollisions) {
  RandomBodies random(7306);
  SCOPED_TRACE(random.trace());
  int colliding = 0;
  for (int i = 0; i < 2000; ++i) {
    auto [moving_a, moving_b] = testing::moving_pair(random, 1.2, 4);
    moving_b.now.velocity =
        moving_a.now.velocity -
        random.uniform(0.1, 5) * (line_of_sight(moving_a.now, moving_b.now) + random.in_box(0.7));
    const BodyState a = moving_a.state(), b = moving_b.state();
    const Membership truth = ConeOracle(ellipsoid_of(a), ellipsoid_of(b)).membership(a.velocity, b.velocity);
    colliding += truth == Membership::in;
    PlaneOptions options;
    options.choice = PlaneChoice::of_motion;
    const auto e = choose_plane(a, b, SectorMethod::true_cone, options);
    ASSERT_TRUE(e);
    const auto view = plane_view(a, b, *e, SectorMethod::true_cone, RateMethod::none);
    ASSERT_TRUE(view);
    EXPECT_NEAR(view->state.v_normal, 0, 1e-13 * (1 + a.velocity.norm()));
    EXPECT_EQ(cone_rates(view->state, view->cone).colliding(), truth == Membership::in) << i;
    // On the plane of least turn, too, a colliding pair looks colliding.
    options.choice = PlaneChoice::least_turn;
    const auto least = choose_plane(a, b, SectorMethod::true_cone, options);
    const auto nearest = plane_view(a, b, *least, SectorMethod::true_cone, RateMethod::none);
    ASSERT_TRUE(nearest);
    if (truth == Membership::in) {
      EXPECT_TRUE(cone_rates(nearest->state, nearest->cone).colliding()) << i;
    }
  }
  EXPECT_GT(colliding, 300);
  EXPECT_LT(colliding, 1700);
}

/// m(w) by trying all normals.
double least_shift(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w) {
  const AxisFrame frame(w);
  const auto gap = [&](double angle) {
    const Vector3d n = std::cos(angle) * frame.e1 + std::sin(angle) * frame.e2;
    return n.dot(b.center() - a.center()) - a.radius(n) - b.radius(n);
  };
  double best = 0;
  for (int j = 1; j < 720; ++j)
    if (gap(std::numbers::pi * j / 360) > gap(best)) best = std::numbers::pi * j / 360;
  double low = best - 0.02, high = best + 0.02;
  for (int k = 0; k < 100; ++k) {
    const double x = low + (high - low) / 3, y = high - (high - low) / 3;
    (gap(x) < gap(y) ? low : high) = gap(x) < gap(y) ? x : y;
  }
  return gap(0.5 * (low + high));
}

TEST(PlaneChoice, SteepestClearanceHoldsItsGradient) {
  RandomBodies random(7307);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 100; ++i) {
    auto [moving_a, moving_b] = testing::moving_pair(random, 1.5, 4);
    if (i % 4 == 0) moving_a.semi_axes.setConstant(1), moving_b.semi_axes.setConstant(1);
    moving_b.now.velocity =
        moving_a.now.velocity -
        random.uniform(1, 5) * (line_of_sight(moving_a.now, moving_b.now) + random.in_box(0.5));
    const BodyState a = moving_a.state(), b = moving_b.state();
    PlaneOptions options;
    options.choice = PlaneChoice::steepest_clearance;
    const auto e = choose_plane(a, b, SectorMethod::true_cone, options);
    ASSERT_TRUE(e);
    const Vector3d u = line_of_sight(a, b), w = a.velocity - b.velocity;
    Vector3d gradient;
    const double h = 1e-4 * w.norm();
    for (int k = 0; k < 3; ++k)
      gradient(k) = (least_shift(ellipsoid_of(a), ellipsoid_of(b), w + h * Vector3d::Unit(k)) -
                     least_shift(ellipsoid_of(a), ellipsoid_of(b), w - h * Vector3d::Unit(k))) /
                    (2 * h);
    EXPECT_NEAR(gradient.dot(u.cross(*e)) / gradient.norm(), 0, 1e-5) << i;
    if (i % 4 == 0) {
      // Of spheres it is the plane of motion.
      options.choice = PlaneChoice::of_motion;
      EXPECT_LT(choose_plane(a, b, SectorMethod::true_cone, options)->cross(*e).norm(), 1e-7);
    }
  }
}

TEST(PlaneChoice, EveryChoiceIsDeterministicWithoutAllocation) {
  RandomBodies random(7308);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 50; ++i) {
    const auto [moving_a, moving_b] = testing::moving_pair(random, 1.5, 4);
    const BodyState a = moving_a.state(), b = moving_b.state();
    for (const PlaneChoice choice : kAll)
      for (const SectorMethod method : {SectorMethod::true_cone, SectorMethod::slice}) {
        PlaneOptions options;
        options.choice = choice;
        options.wind = Vector3d(0, 3, 0);
        const Vector3d before = random.direction();
        const std::size_t allocated = testing::allocations();
        const auto once = choose_plane(a, b, method, options), again = choose_plane(a, b, method, options);
        const auto next = choose_plane(a, b, method, options, &before);
        EXPECT_EQ(testing::allocations(), allocated) << to_string(choice);
        ASSERT_TRUE(once && again && next);
        EXPECT_EQ(*once, *again);
        EXPECT_GE(next->dot(before), -1e-12) << to_string(choice);
      }
  }
}

TEST(PlaneChoice, SingularCases) {
  RandomBodies random(7309);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 50; ++i) {
    auto [moving_a, moving_b] = testing::moving_pair(random, 1.5, 4);
    const AxisFrame frame(moving_b.now.position - moving_a.now.position);
    for (const PlaneChoice choice : kAll) {
      PlaneOptions options;
      options.choice = choice;
      // No relative velocity: the first plane, or the largest opening.
      moving_b.now.velocity = moving_a.now.velocity;
      const auto still = choose_plane(moving_a.state(), moving_b.state(), SectorMethod::true_cone, options);
      ASSERT_TRUE(still);
      const auto widest = choose_plane(moving_a.state(), moving_b.state(), SectorMethod::true_cone, {});
      if (choice == PlaneChoice::of_motion || choice == PlaneChoice::steepest_clearance) {
        EXPECT_EQ(*still, *widest);
      }
      if (choice == PlaneChoice::least_turn) {
        EXPECT_LT((*still - frame.e1).norm(), 1e-14);
      }
      // Straight at the centre: no plane of motion.
      moving_b.now.velocity = moving_a.now.velocity - 3 * frame.axis;
      const auto head_on = choose_plane(moving_a.state(), moving_b.state(), SectorMethod::true_cone, options);
      ASSERT_TRUE(head_on);
      if (choice == PlaneChoice::of_motion) {
        EXPECT_EQ(*head_on, *widest);
      }
      // Overlapping bodies have no sector on any plane.
      auto into = moving_b;
      into.now.position = moving_a.now.position + 0.5 * frame.axis;
      if (choice != PlaneChoice::of_motion && choice != PlaneChoice::steepest_clearance) {
        EXPECT_FALSE(choose_plane(moving_a.state(), into.state(), SectorMethod::true_cone, options));
      }
      into.now.position = moving_a.now.position;
      EXPECT_FALSE(choose_plane(moving_a.state(), into.state(), SectorMethod::true_cone, options));
    }
  }
}

}  // namespace
}  // namespace vericone::guidance::plane_choice_test
