// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/vehicle.h>
#include <algorithm>

#include "random.h"

namespace vericone::simulation::current_test {
namespace {

using Eigen::Vector3d;

TEST(Current, IsWhatItIsMadeOf) {
  const Current water({1, 2, 3}, {{0.1, -0.2}, 4});
  EXPECT_TRUE(water.velocity(4, 7) == Vector3d(1, 2, 3));
  EXPECT_TRUE(water.velocity(6, 7).isApprox(Vector3d(1.2, 1.6, 3), 1e-15));
  EXPECT_TRUE(water.acceleration(3).isZero(0));
  EXPECT_TRUE(Current().velocity(5, 5).isZero(0));
}

TEST(Current, GustsAreSmoothBoundedAndOfTheirSeed) {
  SCOPED_TRACE("seed 41");
  Random random(41);
  double largest = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Current water(Vector3d::Zero(), {}, {0.1, 2, 20, seed, seed % 2 == 0});
    const Current same(Vector3d::Zero(), {}, {0.1, 2, 20, seed, seed % 2 == 0});
    for (int i = 0; i < 1000; ++i) {
      const double t = random.uniform(0, 1000), d = 1e-4;
      const Vector3d v = water.velocity(0, t);
      largest = std::max(largest, v.norm());
      EXPECT_LE(v.norm(), 0.1);
      EXPECT_TRUE(v == same.velocity(3, t));
      EXPECT_EQ(v.z() == 0, seed % 2 == 0);
      const Vector3d slope = (water.velocity(0, t + d) - water.velocity(0, t - d)) / (2 * d);
      EXPECT_LE((slope - water.acceleration(t)).norm(), 1e-7);
    }
  }
  EXPECT_GT(largest, 0.05);
}

TEST(Current, MostIsABound) {
  SCOPED_TRACE("seed 42");
  Random random(42);
  for (int i = 0; i < 100; ++i) {
    const Current water(random.vector(1), {random.vector(1).head<2>(), random.uniform(-2, 2)},
                        {random.uniform(0, 1), 1, 5, std::uint64_t(i), false});
    const double most = water.most(-1, 2);
    for (int j = 0; j < 100; ++j)
      EXPECT_LE(water.velocity(random.uniform(-1, 2), random.uniform(0, 100)).norm(), most);
  }
}

TEST(Current, BadOnesAreNamed) {
  const auto refused = [](const Shear& shear, const Gusts& gusts) -> std::string {
    try {
      static_cast<void>(Current(Vector3d::Zero(), shear, gusts));
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  EXPECT_EQ(refused({}, {-1}), "gusts.most");
  EXPECT_EQ(refused({}, {1, 0}), "gusts.shortest");
  EXPECT_EQ(refused({}, {1, 5, 2}), "gusts.longest");
  EXPECT_EQ(refused({{1.0 / 0.0, 0}, 0}, {}), "shear.rate");
  EXPECT_EQ(refused({}, {}), "");
}

}  // namespace
}  // namespace vericone::simulation::current_test
