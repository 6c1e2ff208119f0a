// SPDX-License-Identifier: BSD-3-Clause
#include "fit/cone/cone_bodies.h"
#include <vericone/testing/random_bodies.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vericone::cone_bodies_test {
namespace {

using Eigen::Vector3d;
using fitting::Piece;
using std::numbers::pi;
using testing::RandomBodies;

Ellipsoid ball(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

TEST(ConeOfPolyhedron, OfARectangleSeenByAPointIsKnown) {
  // Half sides a and b at the distance d: 4 asin(ab / sqrt((a^2+d^2)(b^2+d^2))).
  const double a = 0.7, b = 0.2, d = 1.5;
  const HullBody rectangle({{a, b, d}, {-a, b, d}, {-a, -b, d}, {a, -b, d}});
  const double exact = 4 * std::asin(a * b / std::sqrt((a * a + d * d) * (b * b + d * d)));
  const BodyCone cone = cone_of_polyhedron(ball({0, 0, 0}, 1e-9), rectangle, {0.1, 0.05, d});
  EXPECT_LT(cone.low, exact + 1e-8);  // the ball widens the cone by about 1e-9 rad
  EXPECT_GT(cone.high, exact);
  EXPECT_LT(cone.high - cone.low, 1e-3 * exact);
}

TEST(ConeOfPolyhedron, AgreesWithMapsWhereverTheAgentIs) {
  RandomBodies random(603);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 20; ++k) {
    std::vector<Vector3d> points;
    for (int i = random.integer(4, 30); i > 0; --i) points.push_back(random.in_box(1));
    Vector3d inside = Vector3d::Zero();
    for (const Vector3d& x : points) inside += x / double(points.size());
    const HullBody body(points);
    const Ellipsoid agent = random.ellipsoid(random.uniform(1.3, 4) * random.direction(), 0.1, 0.6);
    const AssemblyOracle oracle(agent, Assembly::polyhedra({body}));
    const BodyCone cone = cone_of_polyhedron(agent, body, inside);
    EXPECT_EQ(cone.disjoint, oracle.relation() == Relation::disjoint);
    const BodyCone map = cone_by_map(oracle, {.resolution = 0.01, .threads = 1, .progress = {}});
    EXPECT_LE(cone.low, map.high) << k;
    EXPECT_GE(cone.high, map.low) << k;
    if (cone.disjoint) {
      EXPECT_LT(cone.high - cone.low, 0.2 * (map.high - map.low)) << k;
    }
  }
}

TEST(ConeOfPieces, AFootprintIsACylinder) {
  Piece piece;
  piece.footprint = Ellipse::from_axes({0, 0}, {1, 1});
  piece.low = -1;
  piece.high = 2;
  // From far above the upper end is seen as a disc: a ball of radius 0.5 meets it as a disc of radius 1.5
  // where it reaches its rim, less where it sinks past the edge; 1.5 at most, 1 at least.
  const Ellipsoid agent = ball({0, 0, 10}, 0.5);
  const BodyCone cone = cone_of_pieces(agent, {piece}, 0.01, {});
  const double distance = 8;
  const auto disc = [&](double radius) { return 2 * pi * (1 - distance / std::hypot(distance, radius)); };
  EXPECT_GT(cone.low, disc(1));
  EXPECT_LT(cone.high, disc(1.6));
  EXPECT_LT(cone.high - cone.low, 1e-3 * cone.low);
  // The rim as a torus: the angle at which a ball of radius 1/2 at distance 8 just passes a rim of radius 1.
  const double rim = std::hypot(distance, 1.0);
  EXPECT_NEAR(cone.low, 2 * pi * (1 - std::cos(std::asin(1 / rim) + std::asin(0.5 / rim))), 1e-3);
}

TEST(ConeOfPieces, FootprintsThatAreApartAdd) {
  const auto at = [](double x) {
    Piece piece;
    piece.footprint = Ellipse::from_axes({x, 5}, {1, 0.5});
    piece.high = 2;
    return piece;
  };
  const Ellipsoid agent = ball({0, 0, 1}, 0.3);
  const BodyCone left = cone_of_pieces(agent, {at(-3)}, 0.01, {}),
                 right = cone_of_pieces(agent, {at(3)}, 0.01, {});
  EXPECT_NEAR(left.low, right.low, 1e-3 * left.low);  // mirrored
  const BodyCone both =
      cone_of_pieces(agent, {at(-3), at(3)}, 0.01, {.resolution = 0.004, .threads = 1, .progress = {}});
  EXPECT_LE(both.low, left.high + right.high);
  EXPECT_GE(both.high, left.low + right.low);
  EXPECT_LT(both.high - both.low, 0.03 * both.low);
}

}  // namespace
}  // namespace vericone::cone_bodies_test
