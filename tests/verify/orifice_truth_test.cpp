// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle of openings against answers known in closed form.
#include <gtest/gtest.h>
#include <vericone/internal/verify/predicates/orifice_truth.h>

#include <cmath>

namespace vericone::verify::orifice_truth_test {
namespace {

using Eigen::Vector3d;

double up(double x) { return std::nextafter(x, 1e300); }
double down(double x) { return std::nextafter(x, -1e300); }

Transit ball_through(const Vector3d& p, double a, double r, const Vector3d& w,
                     const Vector3d& normal = {0, 0, 1}) {
  return orifice_truth(Ellipsoid::from_axes(p, {a, a, a}), {0, 0, 0}, normal, r, w);
}

TEST(OrificeTruth, BallStraightThrough) {
  // Off the axis by 5 = |(3, 4)|, so that 5 + 2 = 7 is the least opening.
  const Vector3d p(3, 4, -9), w(0, 0, 1);
  EXPECT_EQ(ball_through(p, 2, 7, w), Transit::grazes);
  EXPECT_EQ(ball_through(p, 2, down(7), w), Transit::blocked);
  EXPECT_EQ(ball_through(p, 2, up(7), w), Transit::passes);
  EXPECT_EQ(ball_through(p, 2, 7, w, {0, 0, -3}), Transit::grazes);
  EXPECT_EQ(ball_through(p, 2, 70, -w), Transit::blocked);
  EXPECT_EQ(ball_through(p, 2, 70, {1, 0, 0}), Transit::blocked);
  EXPECT_EQ(ball_through(p, 2, 70, {0, 0, 0}), Transit::blocked);
  EXPECT_EQ(ball_through({0, 0, -1}, 2, 70, w), Transit::blocked);  // in the wall already
  EXPECT_EQ(ball_through({0, 0, -2}, 2, 70, w), Transit::passes);   // touches the plane
  // On the axis: the ball fills the opening all round, F is a square.
  EXPECT_EQ(ball_through({0, 0, -9}, 2, 2, w), Transit::grazes);
  EXPECT_EQ(ball_through({0, 0, -9}, 2, up(2), w), Transit::passes);
  EXPECT_EQ(ball_through({0, 0, -9}, 2, down(2), w), Transit::blocked);
}

TEST(OrificeTruth, BallAtAnAngle) {
  // Along (4, 0, 3) the unit ball cuts the plane in an ellipse with the semi-axis 5/3 along x, 1 along y.
  const Vector3d w(4, 0, 3), p(-12, 0, -9);
  EXPECT_EQ(ball_through(3 * p, 3, 5, w), Transit::grazes);
  EXPECT_EQ(ball_through(3 * p, 3, up(5), w), Transit::passes);
  EXPECT_EQ(ball_through(3 * p, 3, down(5), w), Transit::blocked);
  EXPECT_EQ(ball_through(3 * p + Vector3d(2, 0, 0), 3, 7, w), Transit::grazes);
  EXPECT_EQ(ball_through(3 * p + Vector3d(2, 0, 0), 3, down(7), w), Transit::blocked);
  // Off the axis along y: x = 5 cos t, y = 3 sin t + b is farthest where 16 sin t = 3 b; b = 16/3 sin t.
  // With sin t = 1/2: b = 8/3, |.|^2 = 25 3/4 + (3/2 + 8/3)^2 = 18.75 + 17.361.. = 325/9 (times 3: b = 8).
  const double r2 = 325;  // of the opening for the ball of radius 9
  EXPECT_EQ(ball_through(9 * p + Vector3d(0, 8, 0), 9, up(std::sqrt(r2)), w), Transit::passes);
  EXPECT_EQ(ball_through(9 * p + Vector3d(0, 8, 0), 9, down(std::sqrt(r2)), w), Transit::blocked);
}

TEST(OrificeTruth, OpeningsOfAnyOutline) {
  const auto through = [](const Opening& opening, const Vector3d& p, double a, const Vector3d& w) {
    return orifice_truth(Ellipsoid::from_axes(p, {a, a, a}),
                         {opening, {0, 0, 0}, Eigen::Matrix<double, 3, 2>::Identity()}, w);
  };
  const Vector3d w(0, 0, 1);
  EXPECT_EQ(through(Opening::circle(7), {3, 4, -9}, 2, w), Transit::grazes);
  EXPECT_EQ(through(Opening::circle(7), {3, 4, -9}, up(2), w), Transit::blocked);
  EXPECT_EQ(through(Opening::circle(7), {3, 4, -9}, down(2), w), Transit::passes);
  EXPECT_EQ(through(Opening::circle(7), {3, 4, -9}, 2, -w), Transit::blocked);
  EXPECT_EQ(through(Opening::ellipse({4, 2}), {3, 0, -9}, 1, w), Transit::grazes) << "osculating";
  EXPECT_EQ(through(Opening::ellipse({4, 2}), {3, 0, -9}, up(1), w), Transit::blocked);
  const Opening notched = Opening::polygon({{-9, -9}, {9, -9}, {9, 4}, {3, 4}, {3, 9}, {-9, 9}});
  EXPECT_EQ(through(notched, {0, 0, -9}, 5, w), Transit::grazes) << "a vertex";
  EXPECT_EQ(through(notched, {0, 0, -9}, up(5), w), Transit::blocked);
  EXPECT_EQ(through(notched, {0, 0, -9}, down(5), w), Transit::passes);
  EXPECT_EQ(through(notched, {6, 0, -9}, 3, w), Transit::grazes) << "an edge";
  EXPECT_EQ(through(notched, {6, 7, -9}, 1, w), Transit::blocked) << "the wall";
  EXPECT_EQ(through(notched, {20, 0, -9}, 1, w), Transit::blocked);
}

}  // namespace
}  // namespace vericone::verify::orifice_truth_test
