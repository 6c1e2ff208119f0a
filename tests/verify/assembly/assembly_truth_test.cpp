// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle of assemblies against figures with known answers: integers, Pythagorean triples, and the other
// exact constructions of this folder.
#include <gtest/gtest.h>
#include <vericone/internal/verify/assembly/truth.h>
#include <vericone/internal/verify/predicates/hull_truth.h>
#include <vericone/internal/verify/seeded_random.h>

#include <cmath>

namespace vericone::verify::assembly_truth_test {
namespace {

using Eigen::Vector3d;
using enum Membership;

constexpr double kInf = std::numeric_limits<double>::infinity();

double above(double x) { return std::nextafter(x, kInf); }
double below(double x) { return std::nextafter(x, -kInf); }

Ellipsoid ball(double radius) { return Ellipsoid::from_axes({0, 0, 0}, Vector3d::Constant(radius)); }

TruePieces triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return TruePieces::triangles({a, b, c}, {{0, 1, 2}});
}

/// With doubles as far as they are sure, and without.
template <typename Agent>
void expect_membership(const Agent& agent, const TruePieces& pieces, const Vector3d& w, Membership expected) {
  AssemblyTruth truth(agent, pieces);
  EXPECT_EQ(truth.membership(w), expected);
  truth.use_doubles(false);
  EXPECT_EQ(truth.membership(w), expected);
}

TEST(AssemblyTruth, BallPastCornerEdgeAndFace) {
  const double size = 5;
  for (const auto& [radius, expected] :
       {std::pair{size, on}, std::pair{above(size), in}, std::pair{below(size), out}}) {
    SCOPED_TRACE(radius);
    // Corner 5 beside (3, 4, 0) t; edge across, in the plane x = 20; face at the height 5.
    expect_membership(ball(radius), triangle({26, 43, 0}, {22, 46, 9}, {22, 46, -9}), {3, 4, 0}, expected);
    expect_membership(ball(radius), triangle({20, -1, 7}, {20, 7, 1}, {20, 10, 10}), {2, 0, 0}, expected);
    expect_membership(ball(radius), triangle({20, -10, 5}, {20, 10, 5}, {40, 0, 5}), {1, 0, 0}, expected);
    // Behind.
    expect_membership(ball(radius), triangle({20, -10, 5}, {20, 10, 5}, {40, 0, 5}), {-1, 0, 0}, out);
    // A point, and a segment twice the same corner.
    expect_membership(ball(radius), triangle({26, 43, 0}, {26, 43, 0}, {26, 43, 0}), {3, 4, 0}, expected);
    expect_membership(ball(radius), TruePieces::balls({{26, 43, 0}}, 0), {3, 4, 0}, expected);
    expect_membership(ball(radius - 2), TruePieces::balls({{26, 43, 0}}, 2), {3, 4, 0},
                      radius - 2 + 2 == radius ? expected : in);
    expect_membership(ball(radius), TruePieces::boxes({Box{{20, 5, -3}, {30, 9, 3}}}), {1, 0, 0}, expected);
  }
  // Through the middle of a face.
  expect_membership(ball(1e-3), triangle({20, -10, -10}, {20, 10, -10}, {20, 0, 20}), {1, 0, 0}, in);
}

TEST(AssemblyTruth, EllipsoidIsABallStretched) {
  // The unit ball beside the corner (20, 3/5, 4/5), lengths times 10, 15, 30.
  for (const auto& [corner, expected] :
       {std::pair{9.0, on}, std::pair{above(9), out}, std::pair{below(9), in}})
    expect_membership(Ellipsoid::from_axes({0, 0, 0}, {10, 15, 30}),
                      triangle({200, corner, 24}, {200, 20, 40}, {210, 20, 50}), {1, 0, 0}, expected);
}

TEST(AssemblyTruth, RelationIsThatOfTheNearestPiece) {
  TruePieces pieces = triangle({5, -1, -1}, {5, 3, -1}, {5, 0, 4});
  EXPECT_EQ(AssemblyTruth(ball(5), pieces).relation(), Relation::touching);
  EXPECT_EQ(AssemblyTruth(ball(below(5)), pieces).relation(), Relation::disjoint);
  pieces.hulls.push_back({{3, 0, 0}, {9, 0, 0}, {9, 1, 0}});
  EXPECT_EQ(AssemblyTruth(ball(below(5)), pieces).relation(), Relation::overlapping);
}

TEST(AssemblyTruth, PartsOfTheMotion) {
  const AssemblyTruth truth(ball(5), triangle({25, -9, -9}, {25, 9, -9}, {25, 0, 9}));
  const Vector3d w(1, 0, 0);
  EXPECT_EQ(truth.touched(Motion::until(20, w)), on);
  EXPECT_EQ(truth.touched(Motion::until(below(20), w)), out);
  EXPECT_EQ(truth.touched(Motion::at(above(20), w)), in);
  EXPECT_EQ(truth.touched(Motion::at(30, w)), on);
  EXPECT_EQ(truth.touched(Motion::at(above(30), w)), out);
  EXPECT_EQ(truth.touched(Motion::until(40, w)), in);
  // The present, grown.
  EXPECT_EQ(truth.touched(Motion{}, 20), on);
  EXPECT_EQ(truth.touched(Motion{}, below(20)), out);
  // Passing at 10 beside the corner (25, 9, -9): 9^2 + 9^2 = 162 of the squared distance to the axis.
  EXPECT_EQ(truth.touched(Motion::ray({-1, 0, 0}), below(20)), out);
  EXPECT_EQ(truth.touched(Motion::ray({-1, 0, 0}), 20), on);
}

TEST(AssemblyTruth, SectorsAndCellsOfDirections) {
  // A corner 5 above the quadrant x, y >= 0.
  const AssemblyTruth truth(ball(5), triangle({20, 30, 5}, {20, 35, 15}, {25, 30, 15}));
  EXPECT_EQ(truth.touched(Motion::any_of({{1, 0, 0}, {0, 1, 0}})), on);
  EXPECT_EQ(truth.touched(Motion::any_of({{1, 0, 0}, {1, 1, 0}})), out);
  EXPECT_EQ(truth.touched(Motion::any_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})), in);
  EXPECT_EQ(truth.touched(Motion::any_of({{1, 0, 0}, {0, 1, 0}, {0, 0, -1}})), on);
}

TEST(AssemblyTruth, TwoHulls) {
  const HullBody cube = HullBody::box({-1, -1, -1}, {1, 1, 1});
  const auto at = [](double y) { return TruePieces::boxes({Box{{10, y, -1}, {12, y + 2, 1}}}); };
  expect_membership(cube, at(1), {1, 0, 0}, on);
  expect_membership(cube, at(below(1)), {1, 0, 0}, in);
  expect_membership(cube, at(above(1)), {1, 0, 0}, out);
  const AssemblyTruth truth(cube, at(0));
  EXPECT_EQ(truth.touched(Motion::until(9, {1, 0, 0})), on);
  EXPECT_EQ(truth.touched(Motion::at(above(9), {1, 0, 0})), in);
  EXPECT_EQ(truth.touched(Motion::until(below(9), {1, 0, 0})), out);
  EXPECT_EQ(truth.touched(Motion{}, 9), on);
  EXPECT_EQ(AssemblyTruth(cube, TruePieces::boxes({Box{{1, 0, 0}, {2, 2, 2}}})).relation(),
            Relation::touching);
  // To fly through a plate is in, along its edge or in its plane on.
  const HullBody point({{0, 0, 0}});
  const TruePieces plate = triangle({5, -1, -1}, {5, 3, -1}, {5, 0, 4});
  expect_membership(point, plate, {1, 0, 0}, in);
  expect_membership(point, plate, {5, 1, -1}, on);
  expect_membership(point, plate, {-1, 0, 0}, out);
  expect_membership(point, triangle({5, -1, 0}, {5, 3, 0}, {9, 0, 0}), {1, 0, 0}, on);
  EXPECT_EQ(AssemblyTruth(cube, TruePieces::balls({{10, 4, 5}}, 5)).membership({1, 0, 0}), on);
}

TEST(AssemblyTruth, AgreesWithHullTruthAndWithItselfWithoutDoubles) {
  int in_count = 0, out_count = 0;
  for (std::uint64_t index = 0; index < 40; ++index) {
    SCOPED_TRACE(index);
    SeededRandom random(900, 1, index);
    std::vector<Vector3d> points;
    std::vector<Box> boxes;
    for (int i = 0; i < 6; ++i) {
      const Vector3d c = random.uniform(6, 12) * random.direction<3>();
      for (int k = 0; k < 3; ++k) points.push_back(c + random.uniform(0.1, 3) * random.direction<3>());
      boxes.push_back({c, c + Vector3d::Constant(random.uniform(0, 3))});
    }
    Vector3d axes;
    for (int i = 0; i < 3; ++i) axes(i) = random.uniform(0.3, 2);
    const Ellipsoid ellipsoid = Ellipsoid::from_axes({0, 0, 0}, axes, random.rotation());
    std::vector<Vector3d> corners;
    for (int i = 0; i < 6; ++i) corners.push_back(random.uniform(0.5, 2) * random.direction<3>());
    const HullBody hull(corners);
    for (const TruePieces& pieces :
         {TruePieces::triangles(points, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}}),
          TruePieces::boxes(boxes)}) {
      Vector3d w = pieces.hulls[index % pieces.hulls.size()].front();
      w += random.uniform(0, 5) * random.direction<3>();
      const auto compare = [&](const auto& agent) {
        AssemblyTruth truth(agent, pieces), all(agent, pieces);
        all.use_doubles(false);
        for (std::size_t i = 0; i < pieces.hulls.size(); ++i) {
          const HullTruth one(agent, HullBody(pieces.hulls[i]));
          const Membership m = all.touched(i, Motion::ray(w));
          EXPECT_EQ(truth.touched(i, Motion::ray(w)), m);
          (m == out ? out_count : in_count) += 1;
          if (one.relation() == Relation::disjoint) {
            EXPECT_EQ(one.membership(w), m);
          } else {
            EXPECT_EQ(all.touched(i, Motion{}), in);
          }
        }
        EXPECT_EQ(truth.relation(), all.relation());
        EXPECT_EQ(truth.membership(w), all.membership(w));
      };
      compare(ellipsoid);
      compare(hull);
    }
  }
  EXPECT_GT(in_count, 50);
  EXPECT_GT(out_count, 50);
}

}  // namespace
}  // namespace vericone::verify::assembly_truth_test
