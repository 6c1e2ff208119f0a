// SPDX-License-Identifier: BSD-3-Clause
//
// The chosen plane from step to step.
#include <gtest/gtest.h>
#include <vericone/guidance/plane_view.h>

#include <cmath>

#include "guidance/engagements.h"
#include "guidance/plane_merit.h"

namespace vericone::guidance::plane_follow_test {
namespace {

using Eigen::Vector3d;
using testing::line_of_sight, testing::merit, testing::RandomBodies;

TEST(PlaneChoice, FollowsTheOptimum) {
  RandomBodies random(7304);
  SCOPED_TRACE(random.trace());
  int compared = 0, elsewhere = 0;
  for (int i = 0; i < 40; ++i) {
    auto [a, b] = testing::moving_pair(random, 2, 4);
    b.now.velocity =
        a.now.velocity - random.uniform(1, 5) * (line_of_sight(a.now, b.now) + 0.2 * random.in_box(1));
    a.axes_rate *= 0.1, b.axes_rate *= 0.1;
    std::optional<Vector3d> before;
    for (int step = 0; step < 50; ++step) {
      const double t = 0.005 * step;
      const auto e = choose_plane(a.at(t), b.at(t), SectorMethod::true_cone, {}, before ? &*before : nullptr);
      ASSERT_TRUE(e);
      const auto afresh = choose_plane(a.at(t), b.at(t), SectorMethod::true_cone, {});
      const PlaneOptions opening;
      const double psi = -merit(a.at(t), b.at(t), SectorMethod::true_cone, opening, *e),
                   most = -merit(a.at(t), b.at(t), SectorMethod::true_cone, opening, *afresh);
      if (std::abs(most - psi) < 1e-6) {
        ++compared;
        EXPECT_LT(e->cross(*afresh).norm(), 1e-3) << i << " " << step;
        EXPECT_GT(psi, most - 1e-8);
      } else {
        ++elsewhere;
        EXPECT_LT(psi, most);
        // A local optimum is kept.
        const Vector3d side = 0.01 * line_of_sight(a.at(t), b.at(t)).cross(*e);
        EXPECT_GT(psi, -merit(a.at(t), b.at(t), SectorMethod::true_cone, opening, *e + side));
        EXPECT_GT(psi, -merit(a.at(t), b.at(t), SectorMethod::true_cone, opening, *e - side));
      }
      if (before) {
        EXPECT_GT(e->dot(*before), 0);
      }
      before = e;
    }
  }
  EXPECT_GT(compared, 1900);
}

TEST(PlaneChoice, AStaleAxisIsGivenUp) {
  RandomBodies random(7305);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    const auto [moving_a, moving_b] = testing::moving_pair(random, 1.5, 4);
    const BodyState a = moving_a.state(), b = moving_b.state();
    const auto best = choose_plane(a, b, SectorMethod::true_cone, {});
    ASSERT_TRUE(best);
    const Vector3d worst = line_of_sight(a, b).cross(*best);
    const auto e = choose_plane(a, b, SectorMethod::true_cone, {}, &worst);
    ASSERT_TRUE(e);
    EXPECT_GT(-merit(a, b, SectorMethod::true_cone, {}, *e),
              -merit(a, b, SectorMethod::true_cone, {}, worst));
  }
}

TEST(PlaneChoice, EveryOptimumIsFoundAgainFromNearby) {
  RandomBodies random(7310);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 100; ++i) {
    const auto [moving_a, moving_b] = testing::moving_pair(random, 1.5, 4);
    const BodyState a = moving_a.state(), b = moving_b.state();
    for (const SectorMethod method : {SectorMethod::true_cone, SectorMethod::slice})
      for (const PlaneChoice choice :
           {PlaneChoice::largest_opening, PlaneChoice::least_turn, PlaneChoice::least_y}) {
        PlaneOptions options;
        options.choice = choice;
        const auto best = choose_plane(a, b, method, options);
        ASSERT_TRUE(best);
        // Carried off by 0.004 rad, as between two steps.
        const Vector3d before = *best + random.uniform(-0.004, 0.004) * line_of_sight(a, b).cross(*best) +
                                0.01 * line_of_sight(a, b);
        const auto again = choose_plane(a, b, method, options, &before);
        ASSERT_TRUE(again);
        EXPECT_LT(merit(a, b, method, options, *again), merit(a, b, method, options, *best) + 1e-7)
            << to_string(choice) << " " << i;
        EXPECT_GT(again->dot(before), 0.99);
      }
  }
}

}  // namespace
}  // namespace vericone::guidance::plane_follow_test
