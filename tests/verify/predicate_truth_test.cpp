// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracles against answers known in closed form, so that they can fail on their own.
#include <gtest/gtest.h>
#include <vericone/internal/verify/predicates/hull_truth.h>
#include <vericone/internal/verify/predicates/truth.h>

#include <chrono>
#include <cmath>
#include <limits>

namespace vericone::verify::predicate_truth_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Ellipsoid ball(const Vector3d& p, double r) { return Ellipsoid::from_axes(p, {r, r, r}); }
Ellipse disc(const Vector2d& p, double r) { return Ellipse::from_axes(p, {r, r}); }

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
double down(double x) { return std::nextafter(x, -std::numeric_limits<double>::infinity()); }

// Powers of two, so that 5 s is five times s; about 1e-150 to 1e150.
const double kScales[] = {1, 0x1p-100, 0x1p100, 0x1p-498, 0x1p498};

TEST(PositionTruth, BallsInEveryPosition) {
  using P = TruePosition;
  for (const double s : {1.0, 0x1p-490, 0x1p490}) {
    SCOPED_TRACE(s);
    // Distance 3 (2/3, 1/3, 2/3) = 3.
    const Vector3d c = s * Vector3d(2, 1, 2), p(s * 5, s * -7, s * 11);
    const auto position = [&](double r_a, double r_b) {
      return position_truth<3>(ball(p, s * r_a), ball(p + c, s * r_b));
    };
    EXPECT_EQ(position(1, 2), P::touching);
    EXPECT_EQ(position(1, down(2)), P::disjoint);
    EXPECT_EQ(position(1, up(2)), P::crossing);
    EXPECT_EQ(position(1, 4), P::a_inside_b_touching);
    EXPECT_EQ(position(1, up(4)), P::a_inside_b);
    EXPECT_EQ(position(1, down(4)), P::crossing);
    EXPECT_EQ(position(4, 1), P::b_inside_a_touching);
    EXPECT_EQ(position(5, 1), P::b_inside_a);
    EXPECT_EQ(position(3, 3), P::crossing);
    EXPECT_EQ(position_truth<3>(ball(p, s), ball(p, s)), P::equal);
    EXPECT_EQ(position_truth<3>(ball(p, s), ball(p, up(s))), P::a_inside_b);
    EXPECT_EQ(position_truth<3>(ball(p, s * 2), ball(p, s)), P::b_inside_a);
  }
}

TEST(PositionTruth, EllipsesAboutOneCentre) {
  using P = TruePosition;
  const auto at = [](double x, double y) { return Ellipse::from_axes({3, 4}, {x, y}); };
  EXPECT_EQ(position_truth<2>(at(2, 1), at(2, 3)), P::a_inside_b_touching);  // in two points
  EXPECT_EQ(position_truth<2>(at(2, 3), at(2, 1)), P::b_inside_a_touching);
  EXPECT_EQ(position_truth<2>(at(2, 1), at(1, 2)), P::crossing);
  EXPECT_EQ(position_truth<2>(at(2, 1), at(up(2), up(1))), P::a_inside_b);
  EXPECT_EQ(position_truth<2>(at(2, 1), at(2, 1)), P::equal);
}

TEST(PositionTruth, OsculatingFromInside) {
  // The circle of curvature at the end (0, 0) of the axis 4 of an ellipse 4, 2 has radius 2^2 / 4 = 1.
  const Ellipse big = Ellipse::from_axes({4, 0}, {4, 2});
  EXPECT_EQ(position_truth<2>(disc({1, 0}, 1), big), TruePosition::a_inside_b_touching);
  EXPECT_EQ(position_truth<2>(big, disc({1, 0}, 1)), TruePosition::b_inside_a_touching);
  const double r = up(1);
  EXPECT_EQ(position_truth<2>(disc({r, 0}, r), big), TruePosition::crossing);
  EXPECT_EQ(position_truth<2>(disc({down(1), 0}, down(1)), big), TruePosition::a_inside_b_touching);
}

TEST(RelationTruth, TakesTheMatrixThatDefinesTheBody) {
  // sqrt(2) squared is not 2 in doubles: by the factor or by the shape, the answers differ.
  const double r = std::sqrt(2.0);
  ASSERT_NE(r * r, 2);
  const Eigen::Matrix2d s = 2 * Eigen::Matrix2d::Identity();
  const Vector2d c(2, 2);  // |c|^2 = 8 = (2 sqrt 2)^2
  EXPECT_EQ(relation_truth<2>(Ellipse::from_shape({0, 0}, s), Ellipse::from_shape(c, s)), Relation::touching);
  // The double above sqrt(2) makes the discs larger, the one below smaller.
  const double above = static_cast<long double>(r) * r > 2 ? r : up(r), below = down(above);
  EXPECT_EQ(relation_truth<2>(disc({0, 0}, above), disc(c, above)), Relation::overlapping);
  EXPECT_EQ(relation_truth<2>(disc({0, 0}, below), disc(c, below)), Relation::disjoint);
}

TEST(ConeTruth, BallsGrazedByIntegerVelocities) {
  // Radii 1 + 2 = 3 at distance 5: the cone has the slope 3/4.
  for (const double s : kScales) {
    SCOPED_TRACE(s);
    const ConeTruth cone(ball({0, 0, 0}, s), ball({5 * s, 0, 0}, 2 * s));
    ASSERT_EQ(cone.relation(), Relation::disjoint);
    for (const double v : {1.0, 0x1p-400, 0x1p400}) {
      EXPECT_EQ(cone.membership({v, 0, 0}), Membership::in);
      EXPECT_EQ(cone.membership({4 * v, 3 * v, 0}), Membership::on);
      EXPECT_EQ(cone.membership({4 * v, 0, -3 * v}), Membership::on);
      EXPECT_EQ(cone.membership({20 * v, 9 * v, 12 * v}), Membership::on);
      EXPECT_EQ(cone.membership({20 * v, 9 * v, up(12 * v)}), Membership::out);
      EXPECT_EQ(cone.membership({20 * v, 9 * v, down(12 * v)}), Membership::in);
      EXPECT_EQ(cone.membership({up(4 * v), 3 * v, 0}), Membership::in);
      EXPECT_EQ(cone.membership({0, v, 0}), Membership::out);
      EXPECT_EQ(cone.membership({-v, 0, 0}), Membership::out);
      EXPECT_EQ(cone.membership({-4 * v, 3 * v, 0}), Membership::out);
    }
    EXPECT_EQ(cone.membership(Vector3d::Zero()), Membership::out);
    // The difference of the velocities is not rounded.
    EXPECT_EQ(cone.membership(Vector3d(4 + 0x1p50, 3, 0), Vector3d(0x1p50, 0, 0)), Membership::on);
  }
}

TEST(ConeTruth, AffineImagesKeepTheAnswer) {
  Eigen::Matrix3d m;
  m << 3, -1, 4, 1, 5, -9, 2, 6, -5;
  const auto image = [&](const Vector3d& p, double r) {
    return Ellipsoid::from_shape(m * p, r * r * (m * m.transpose()));
  };
  const ConeTruth cone(image({7, 7, 7}, 1), image({12, 7, 7}, 2));
  EXPECT_EQ(cone.membership(m * Vector3d(4, 3, 0)), Membership::on);
  EXPECT_EQ(cone.membership(m * Vector3d(20, -9, 12)), Membership::on);
  EXPECT_EQ(cone.membership(m * Vector3d(41, 30, 0)), Membership::in);
  EXPECT_EQ(cone.membership(m * Vector3d(40, 31, 0)), Membership::out);
  EXPECT_EQ(cone.membership(m * Vector3d(-40, -30, 0)), Membership::out);
}

TEST(ConeTruth, AlongTheCentresOfEqualBodies) {
  // F vanishes identically: both shadows are the same ellipse.
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {1, 2, 3});
  const ConeTruth cone(a, a.translated({10, 0, 0}));
  EXPECT_EQ(cone.membership({1, 0, 0}), Membership::in);
  EXPECT_EQ(cone.membership({-1, 0, 0}), Membership::out);
}

TEST(ConeTruth, ANormalAlongTheSecondBasisVector) {
  // Boundary normals along the axes: the root of F is at 0 or at infinity, whichever axis is which.
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      for (const double sign : {1.0, -1.0}) {
        // Radii add to 3 along j, the centres are 3 apart along j and 10 along i: moving along i grazes.
        Vector3d c = Vector3d::Zero(), w = c;
        c(i) = 10, c(j) = 3 * sign, w(i) = 1;
        EXPECT_EQ(ConeTruth(ball({0, 0, 0}, 1), ball(c, 2)).membership(w), Membership::on);
        c(j) = up(3) * sign;
        EXPECT_EQ(ConeTruth(ball({0, 0, 0}, 1), ball(c, 2)).membership(w), Membership::out);
        c(j) = down(3) * sign;
        EXPECT_EQ(ConeTruth(ball({0, 0, 0}, 1), ball(c, 2)).membership(w), Membership::in);
      }
    }
}

TEST(ConeTruth, BallsWithinAHorizon) {
  // Radii 1 + 2 = 3, 5 apart: along x contact from 2 to 8; along (20, 15, 0) they graze at 4/25, no double.
  const double ever = std::numeric_limits<double>::infinity();
  for (const double s : kScales) {
    SCOPED_TRACE(s);
    const ConeTruth cone(ball({0, 0, 0}, s), ball({5 * s, 0, 0}, 2 * s));
    const auto within = [&](const Vector3d& w, double from, double until) {
      return cone.within(s * w, Vector3d::Zero(), {from, until});
    };
    const Vector3d ahead(1, 0, 0), grazing(20, 15, 0);
    EXPECT_EQ(within(ahead, 0, 2), Membership::on);
    EXPECT_EQ(within(ahead, 0, down(2)), Membership::out);
    EXPECT_EQ(within(ahead, 0, up(2)), Membership::in);
    EXPECT_EQ(within(ahead, 2, 2), Membership::on);
    EXPECT_EQ(within(ahead, 2, 3), Membership::in);
    EXPECT_EQ(within(ahead, 0, 8), Membership::in);
    EXPECT_EQ(within(ahead, 0, 9), Membership::in);
    EXPECT_EQ(within(ahead, 8, 9), Membership::on);
    EXPECT_EQ(within(ahead, 8, ever), Membership::on);
    EXPECT_EQ(within(ahead, up(8), ever), Membership::out);
    EXPECT_EQ(within(ahead, 3, 4), Membership::in);
    EXPECT_EQ(within(-ahead, 0, ever), Membership::out);
    EXPECT_EQ(within(grazing, 0, 0.125), Membership::out);
    EXPECT_EQ(within(grazing, 0, 0.25), Membership::on);
    EXPECT_EQ(within(grazing, 0.25, 1), Membership::out);
    EXPECT_EQ(within(Vector3d::Zero(), 0, ever), Membership::out);
  }
  // A difference of velocities that no double is; grazing exactly at an end.
  const ConeTruth cone(ball({0, 0, 0}, 1), ball({5, 0, 0}, 2));
  EXPECT_EQ(cone.within(Vector3d(20 + 0x1p50, 15, 0), Vector3d(0x1p50, 0, 0), {0, 1}), Membership::on);
  EXPECT_EQ(ConeTruth(ball({0, 0, 0}, 1), ball({4, 3, 0}, 2)).within({16, 0, 0}, {0, 0, 0}, {0.25, 0.25}),
            Membership::on);
}

TEST(HullTruth, BoxesAndABallWithinAHorizon) {
  const double ever = std::numeric_limits<double>::infinity();
  for (const double s : kScales) {
    SCOPED_TRACE(s);
    const HullBody cube = HullBody::box(Vector3d(-s, -s, -s), Vector3d(s, s, s)),
                   far = HullBody::box(Vector3d(4 * s, -s, -s), Vector3d(6 * s, s, s));
    const Vector3d w(s, 0, 0), still = Vector3d::Zero();
    for (const HullTruth& truth : {HullTruth(cube, far), HullTruth(ball({0, 0, 0}, s), far)}) {
      EXPECT_EQ(truth.within(w, still, {0, 3}), Membership::on);
      EXPECT_EQ(truth.within(w, still, {0, down(3)}), Membership::out);
      EXPECT_EQ(truth.within(w, still, {0, up(3)}), Membership::in);
      EXPECT_EQ(truth.within(w, still, {7, ever}), Membership::on);
      EXPECT_EQ(truth.within(w, still, {up(7), ever}), Membership::out);
      EXPECT_EQ(truth.within(w, still, {0, ever}), Membership::in);
      EXPECT_EQ(truth.within(-w, still, {0, ever}), Membership::out);
    }
    const HullTruth reversed(far, ball({0, 0, 0}, s));
    EXPECT_EQ(reversed.within(-w, still, {0, 3}), Membership::on);
    EXPECT_EQ(reversed.within(-w, still, {0, up(3)}), Membership::in);
    EXPECT_EQ(reversed.within(w, still, {0, ever}), Membership::out);
  }
}

TEST(SectorTruth, DiscsGrazedByIntegerVelocities) {
  for (const double s : kScales) {
    SCOPED_TRACE(s);
    const SectorTruth sector(disc({0, 0}, s), disc({5 * s, 0}, 2 * s)),
        upward(disc({0, 0}, s), disc({0, 5 * s}, 2 * s));
    ASSERT_EQ(sector.relation(), Relation::disjoint);
    for (const double side : {1.0, -1.0}) {
      EXPECT_EQ(sector.membership({4, 3 * side}), Membership::on);
      EXPECT_EQ(sector.membership({4, up(3) * side}), Membership::out);
      EXPECT_EQ(sector.membership({4, down(3) * side}), Membership::in);
      EXPECT_EQ(sector.membership({-4, 3 * side}), Membership::out);
      EXPECT_EQ(upward.membership({3 * side, 4}), Membership::on);
      EXPECT_EQ(upward.membership({up(3) * side, 4}), Membership::out);
      EXPECT_EQ(upward.membership({3 * side, -4}), Membership::out);
    }
    EXPECT_EQ(sector.membership(Vector2d::Zero()), Membership::out);
  }
}

TEST(SectorTruth, ANormalAlongY) {
  // The upper edge is horizontal: its normal is the root at infinity.
  const SectorTruth sector(disc({0, 0}, 1), disc({10, -3}, 2));
  EXPECT_EQ(sector.membership({1, 0}), Membership::on);
  EXPECT_EQ(sector.membership({1, 1e-300}), Membership::out);
  EXPECT_EQ(sector.membership({1, -1e-300}), Membership::in);
  EXPECT_EQ(sector.membership({-1, 0}), Membership::out);
}

TEST(SideTruth, PointsOfASphere) {
  const Ellipsoid body = ball({1, 2, 3}, 3);
  EXPECT_EQ(side_truth<3>(body, Vector3d(3, 3, 5)), Sign::zero);
  EXPECT_EQ(side_truth<3>(body, Vector3d(3, 3, up(5))), Sign::positive);
  EXPECT_EQ(side_truth<3>(body, Vector3d(3, 3, down(5))), Sign::negative);
  const Quadric q(Eigen::Vector4d(1, 1, 1, -9).asDiagonal().toDenseMatrix());
  EXPECT_EQ(side_truth<3>(q, Vector3d(2, 1, -2)), Sign::zero);
  EXPECT_EQ(side_truth<3>(q, Vector3d(2, 1, -up(2))), Sign::positive);
  EXPECT_EQ(side_truth<3>(q, Vector3d(2, 1e-320, 2)), Sign::negative);
}

TEST(Truth, BodiesThatAreNotApartHaveNoCone) {
  EXPECT_THROW((void)ConeTruth(ball({0, 0, 0}, 1), ball({1, 0, 0}, 1)).membership(Vector3d(1, 0, 0)),
               std::logic_error);
  EXPECT_THROW((void)SectorTruth(disc({0, 0}, 1), disc({2, 0}, 1)).membership(Vector2d(1, 0)),
               std::logic_error);
}

}  // namespace
}  // namespace vericone::verify::predicate_truth_test
