// SPDX-License-Identifier: BSD-3-Clause
//
// What functions require of their callers is checked where assertions are, and there alone.
#include <gtest/gtest.h>
#include <vericone/geometry/interval.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <vericone/internal/geometry/mesh/mesh_section.h>
#include <vericone/internal/geometry/requires.h>

#include <array>
#include <limits>
#include <vector>

namespace vericone::requires_test {
namespace {

using Eigen::Vector3d;

#ifdef NDEBUG

TEST(Requires, IsNotEvenAskedInRelease) {
  int asked = 0;
  VERICONE_REQUIRES(++asked < 0);
  EXPECT_EQ(asked, 0);
}

#else

TEST(RequiresDeathTest, EndsTheProgramWithOneLine) {
  const auto half_of = [](int even) {
    VERICONE_REQUIRES(even % 2 == 0);
    return even / 2;
  };
  EXPECT_EQ(half_of(4), 2);
  EXPECT_DEATH(half_of(3), "^vericone: operator\\(\\)\\(\\) requires even % 2 == 0\n$");
}

TEST(RequiresDeathTest, WhatCommentsSay) {
  EXPECT_DEATH(static_cast<void>(Interval::between(2, 1)), "between\\(\\) requires");
  EXPECT_DEATH(static_cast<void>(exact::grid_exponent(std::numeric_limits<double>::infinity(), 0)),
               "grid_exponent\\(\\) requires");
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  const std::array<std::array<std::uint32_t, 3>, 1> beyond{{{0, 1, 3}}};
  EXPECT_DEATH(static_cast<void>(mesh_section(points, beyond, PlaneFrame{})), "mesh_section\\(\\) requires");
}

#endif

}  // namespace
}  // namespace vericone::requires_test
