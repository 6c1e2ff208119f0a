// SPDX-License-Identifier: BSD-3-Clause
//
// The figures that the source prints of its fish, in open loop.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/track.h>
#include <vericone/vehicles/fish.h>
#include <cmath>
#include <numbers>

#include "swimming.h"

namespace vericone::vehicles::fish_test {
namespace {

TEST(Fish, SpeedsAreThoseOfTheTable) {
  for (const auto& [amplitude, speed] : {std::pair{20.0, 0.130}, {30.0, 0.197}, {35.0, 0.231}}) {
    const Flown flown = fly(trial(amplitude, 0), 60);
    EXPECT_NEAR(flown.mean_speed(50, 60) / speed, 1, 0.01) << amplitude;
  }
}

TEST(Fish, TurnsAreThoseOfTheTable) {
  for (const auto& [amplitude, bias] : {std::pair{20.0, 50.8}, {25.0, 40.7}, {30.0, 33.8}}) {
    const Flown flown = fly(trial(amplitude, bias), 60);
    EXPECT_NEAR(flown.mean_turn(40, 60) / (-30.6 * kDegree), 1, 0.01) << amplitude;
  }
}

}  // namespace
}  // namespace vericone::vehicles::fish_test
