// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "contraction_probe.h"

namespace vericone::testing::contraction_test {
namespace {

bool has_fma() {
#if defined(__x86_64__) && defined(__GNUC__)
  return __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

const double kX = 1 + 0x1p-30, kY = 1 + 0x1p-29;  // x y = 1 + 2^-30 + 2^-29 + 2^-59 does not fit

// The error bounds of the predicates count every rounding, so no target that uses the library may fuse.
TEST(Contraction, IsOffForUsersOfTheLibrary) {
  if (!has_fma()) GTEST_SKIP() << "no FMA on this processor";
  EXPECT_EQ(difference_of_products(kX, kY, kX, kY), 0);
}

TEST(Contraction, WouldBeSeenByTheProbe) {
  if (!has_fma()) GTEST_SKIP() << "no FMA on this processor";
  EXPECT_EQ(std::abs(difference_of_products_contracted(kX, kY, kX, kY)), 0x1p-59);
}

double inline_difference(double a, double b, double c, double d) { return a * b - c * d; }

// In the options of this build itself, whatever they are (the preset `fma` has FMA).
TEST(Contraction, IsOffInThisBuild) {
  volatile double x = kX, y = kY;
  EXPECT_EQ(inline_difference(x, y, x, y), 0);
}

}  // namespace
}  // namespace vericone::testing::contraction_test
