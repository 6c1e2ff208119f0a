// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/hull_body.h>

#include <gtest/gtest.h>
#include <limits>

namespace vericone::hull_body_test {
namespace {

using Eigen::Vector3d;

std::string refused_field(std::vector<Vector3d> points) {
  try {
    const HullBody body(std::move(points));
  } catch (const InputError& error) {
    return error.field();
  }
  return "accepted";
}

TEST(HullBody, TakesAnyFinitePoints) {
  EXPECT_EQ(refused_field({{1, 2, 3}}), "accepted");
  EXPECT_EQ(refused_field({{1, 2, 3}, {1, 2, 3}}), "accepted");
  EXPECT_EQ(refused_field({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), "accepted");
  EXPECT_EQ(refused_field({{-1e308, 1e308, 5e-324}}), "accepted");
}

TEST(HullBody, NamesWhatItRefuses) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused_field({}), "points");
  EXPECT_EQ(refused_field({{0, 0, 0}, {0, nan, 0}}), "points[1][1]");
  EXPECT_EQ(refused_field({{0, 0, inf}}), "points[0][2]");
  EXPECT_EQ(refused_field({{0, 0, 0}, {1, 1, 1}, {-inf, nan, 0}}), "points[2][0]");
  EXPECT_EQ(refused_field({{1e308, 0, 0}}), "accepted");
  EXPECT_THROW(HullBody({{1e308, 0, 0}}).scaled(10), InputError);
}

TEST(HullBody, BoxHasItsEightCorners) {
  const HullBody box = HullBody::box({-1, -2, -3}, {4, 5, 6});
  ASSERT_EQ(box.size(), 8U);
  EXPECT_EQ(box.support({1, 0, 0}), 4);
  EXPECT_EQ(box.support({-1, -1, -1}), 6);
  EXPECT_EQ(box.support({1, 1, -1}), 12);
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(box.points()[i], box.points()[j]);
}

TEST(HullBody, MovesAndScalesItsPoints) {
  const HullBody body({{1, 2, 3}, {-1, 0, 4}});
  EXPECT_EQ(body.translated({1, 1, 1}).points()[1], Vector3d(0, 1, 5));
  EXPECT_EQ(body.scaled(-2).points()[0], Vector3d(-2, -4, -6));
}

}  // namespace
}  // namespace vericone::hull_body_test
