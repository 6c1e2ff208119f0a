// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle of hulls against answers known in closed form.
#include <gtest/gtest.h>
#include <vericone/internal/verify/predicates/hull_truth.h>

#include <cmath>

namespace vericone::verify::hull_truth_test {
namespace {

using Eigen::Vector3d;

Ellipsoid ball(const Vector3d& p, double r) { return Ellipsoid::from_axes(p, {r, r, r}); }
double up(double x) { return std::nextafter(x, 1e300); }
double down(double x) { return std::nextafter(x, -1e300); }
const HullBody kCube = HullBody::box({-1, -1, -1}, {1, 1, 1});

TEST(HullTruth, BallAndCube) {
  // The face x = -1 is 4 away, the edge's nearest point (-1, 1) from (-4, 5) is (3, -4): 5.
  EXPECT_EQ(HullTruth(ball({-5, 0, 0}, 4), kCube).relation(), Relation::touching);
  EXPECT_EQ(HullTruth(ball({-5, 0, 0}, down(4)), kCube).relation(), Relation::disjoint);
  EXPECT_EQ(HullTruth(ball({-5, 0, 0}, up(4)), kCube).relation(), Relation::overlapping);
  EXPECT_EQ(HullTruth(kCube, ball({-4, 5, 0}, 5)).relation(), Relation::touching);
  EXPECT_EQ(HullTruth(kCube, ball({-4, 5, 0}, up(5))).relation(), Relation::overlapping);
  EXPECT_EQ(HullTruth(ball({0, 0, 0}, 0.5), kCube).relation(), Relation::overlapping);
}

TEST(HullTruth, GrazingAFaceAnEdgeAndACorner) {
  const HullTruth along_face(ball({-10, 0, 3}, 2), kCube);  // moving along x, z = 1 is grazed
  EXPECT_EQ(along_face.membership({1, 0, 0}), Membership::on);
  EXPECT_EQ(along_face.membership({1, 0, 1e-300}), Membership::out);
  EXPECT_EQ(along_face.membership({1, 0, -1e-300}), Membership::in);
  EXPECT_EQ(along_face.membership({-1, 0, 0}), Membership::out);
  EXPECT_EQ(along_face.membership(Vector3d::Zero()), Membership::out);
  // Past the edge y = z = 1 at the distance (3, 4): 5.
  EXPECT_EQ(HullTruth(ball({-10, 4, 5}, 5), kCube).membership({1, 0, 0}), Membership::on);
  EXPECT_EQ(HullTruth(ball({-10, 4, 5}, down(5)), kCube).membership({1, 0, 0}), Membership::out);
  EXPECT_EQ(HullTruth(ball({-10, 4, 5}, up(5)), kCube).membership({1, 0, 0}), Membership::in);
  // The same seen from the other body.
  EXPECT_EQ(HullTruth(kCube, ball({-10, 4, 5}, 5)).membership({-1, 0, 0}), Membership::on);
  EXPECT_EQ(HullTruth(kCube, ball({-10, 4, 5}, 5)).membership({1, 0, 0}), Membership::out);
  // A single point, and two that are the same.
  const HullBody point({Vector3d(5, 3, 0), Vector3d(5, 3, 0)});
  EXPECT_EQ(HullTruth(ball({0, 0, 0}, 3), point).membership({1, 0, 0}), Membership::on);
  EXPECT_EQ(HullTruth(ball({0, 0, 0}, up(3)), point).membership({1, 0, 0}), Membership::in);
}

TEST(HullTruth, TwoCubes) {
  const HullBody far = HullBody::box({9, -1, -1}, {11, 1, 1});
  const HullTruth cubes(kCube, far);
  ASSERT_EQ(cubes.relation(), Relation::disjoint);
  EXPECT_EQ(cubes.membership({1, 0, 0}), Membership::in);
  EXPECT_EQ(cubes.membership({4, 1, 0}), Membership::on);  // from the face 8 away, sideways 2
  EXPECT_EQ(cubes.membership({4, 1, 1}), Membership::on);
  EXPECT_EQ(cubes.membership({4, up(1), 0}), Membership::out);
  EXPECT_EQ(cubes.membership({4, down(1), 0}), Membership::in);
  EXPECT_EQ(cubes.membership({-4, 1, 0}), Membership::out);
  EXPECT_EQ(HullTruth(kCube, HullBody::box({1, 1, 1}, {2, 2, 2})).relation(), Relation::touching);
  EXPECT_EQ(HullTruth(kCube, HullBody::box({up(1), 1, 1}, {2, 2, 2})).relation(), Relation::disjoint);
  EXPECT_EQ(HullTruth(kCube, HullBody::box({down(1), 0, 0}, {2, 2, 2})).relation(), Relation::overlapping);
}

TEST(HullTruth, FlatBodies) {
  const HullBody plate({Vector3d(5, -1, -1), Vector3d(5, 1, -1), Vector3d(5, 0, 1)});
  const HullBody origin;
  EXPECT_EQ(HullTruth(origin, plate).membership({1, 0, 0}), Membership::in);
  EXPECT_EQ(HullTruth(origin, plate).membership({5, 0, 1}), Membership::on);
  EXPECT_EQ(HullTruth(origin, plate).membership({5, 0, up(1)}), Membership::out);
  // A segment spans a cone without interior.
  const HullBody segment({Vector3d(5, -1, 0), Vector3d(5, 1, 0)});
  EXPECT_EQ(HullTruth(origin, segment).membership({1, 0, 0}), Membership::on);
  EXPECT_EQ(HullTruth(origin, segment).membership({1, 0, 1e-300}), Membership::out);
  // Crossing a polygon overlaps, lying in its plane touches.
  EXPECT_EQ(HullTruth(HullBody({Vector3d(4, 0, 0), Vector3d(6, 0, 0)}), plate).relation(),
            Relation::overlapping);
  EXPECT_EQ(HullTruth(HullBody({Vector3d(5, 0, 0), Vector3d(5, 0, 9)}), plate).relation(),
            Relation::touching);
}

}  // namespace
}  // namespace vericone::verify::hull_truth_test
