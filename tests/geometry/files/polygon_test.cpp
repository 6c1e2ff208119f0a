// SPDX-License-Identifier: BSD-3-Clause
//
// Polygons with dents and holes as convex pieces: against crossing numbers, and areas in whole numbers.
#include <gtest/gtest.h>
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/files/rings.h"
#include "support/random.h"

namespace vericone::files {
namespace {

using Eigen::Vector2d;

double turned(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool is_inside(const Polygon& polygon, const Vector2d& x) {
  return crosses_odd(polygon.outline, x) &&
         std::none_of(polygon.holes.begin(), polygon.holes.end(),
                      [&](const Ring& hole) { return crosses_odd(hole, x); });
}

/// Corners on whole numbers around a point that sees them all: simple, with dents and straight corners.
Ring star(testing::Random& random, const Vector2d& middle, double size, int count, bool clockwise) {
  Ring ring;
  double before = -10;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(0.1, 0.9)) / count,
                 far = size * random.uniform(0.3, 1);
    const Vector2d x(std::round(middle.x() + far * std::cos(angle)),
                     std::round(middle.y() + far * std::sin(angle)));
    const double at = std::atan2(x.y() - middle.y(), x.x() - middle.x());
    const double turn = at < -1e-9 ? at + 2 * std::numbers::pi : at;
    if (turn > before + 1e-6) ring.push_back(x), before = turn;
  }
  if (clockwise) std::reverse(ring.begin(), ring.end());
  return ring;
}

void expect_pieces(testing::Random& random, const Polygon& polygon, double size) {
  const auto pieces = convex_pieces(polygon);
  double area = std::abs(twice_area(polygon.outline)), covered = 0;
  for (const Ring& hole : polygon.holes) area -= std::abs(twice_area(hole));
  std::vector<Vector2d> corners = polygon.outline;
  for (const Ring& hole : polygon.holes) corners.insert(corners.end(), hole.begin(), hole.end());
  for (const Ring& piece : pieces) {
    const double own = twice_area(piece);
    EXPECT_GT(own, 0);
    covered += own;
    double around = 0;  // turned once, not twice
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Vector2d &a = piece[i], &b = piece[(i + 1) % piece.size()], &c = piece[(i + 2) % piece.size()];
      EXPECT_GE(turned(a, b, c), 0);
      around += std::atan2(turned(a, b, c), (b - a).dot(c - b));
      EXPECT_NE(std::find(corners.begin(), corners.end(), a), corners.end());
    }
    EXPECT_NEAR(around, 2 * std::numbers::pi, 1e-9);
  }
  EXPECT_EQ(covered, area);
  for (int i = 0; i < 200; ++i) {
    const Vector2d x(random.uniform(-size, size), random.uniform(-size, size));
    int holders = 0;
    for (const Ring& piece : pieces) holders += crosses_odd(piece, x);
    EXPECT_EQ(holders, int(is_inside(polygon, x))) << x.transpose();
  }
}

TEST(Polygons, AreTheirConvexPieces) {
  testing::Random random(4101);
  SCOPED_TRACE(random.trace());
  int with_holes = 0;
  for (int i = 0; i < 400; ++i) {
    Polygon polygon{star(random, {0, 0}, 1000, random.integer(4, 40), random.integer(0, 1) == 1)};
    if (polygon.outline.size() < 3) continue;
    try {
      static_cast<void>(convex_pieces(polygon));
    } catch (const InputError&) {  // corners that were rounded onto one line through the middle
      continue;
    }
    const int holes = i % 4;
    for (int h = 0; h < 20 && int(polygon.holes.size()) < holes; ++h) {
      Polygon more = polygon;
      const double x = random.uniform(-600, 600), y = random.uniform(-600, 600),
                   size = random.uniform(20, 200);
      more.holes.push_back(star(random, {x, y}, size, random.integer(3, 12), random.integer(0, 1) == 1));
      try {
        static_cast<void>(convex_pieces(more));
        polygon = more;
      } catch (const InputError& e) {  // it meets something, or is no polygon
        EXPECT_TRUE(e.field().starts_with("holes[")) << e.what();
      }
    }
    with_holes += !polygon.holes.empty();
    expect_pieces(random, polygon, 1000);
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(with_holes, 150);
}

TEST(Polygons, OfGridsOfHolesShareLinesWithBridges) {
  testing::Random random(4102);
  Polygon plate{{{0, 0}, {70, 0}, {70, 70}, {0, 70}}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double x = 10 + 20 * i, y = 10 + 20 * j;
      plate.holes.push_back({{x, y}, {x + 10, y}, {x + 10, y + 10}, {x, y + 10}});
    }
  expect_pieces(random, plate, 70);
  EXPECT_LE(convex_pieces(plate).size(), 40U);  // the fewest are at least 10
  // A ring, an island's neighbours all on one line.
  expect_pieces(random, {{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{{3, 3}, {6, 3}, {6, 6}, {3, 6}}}}, 9);
}

TEST(Polygons, ThatAreConvexAreOnePiece) {
  EXPECT_EQ(convex_pieces({{{0, 0}, {4, 0}, {4, 2}, {0, 2}}}).size(), 1U);
  EXPECT_EQ(convex_pieces({{{0, 2}, {4, 2}, {4, 0}, {2, 0}, {0, 0}}}).size(), 1U);
  EXPECT_NE(raised({{{0, 0}, {4, 0}, {4, 2}, {0, 2}}}, 3).hull(), nullptr);
  const Body dented = raised({{{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {0, 1}}}, 3);
  ASSERT_NE(dented.assembly(), nullptr);
  EXPECT_EQ(dented.assembly()->size(), 2U);
  EXPECT_EQ(dented.support({0, 0, 1}), 3);
  // However small or large the numbers are.
  for (const int exponent : {-600, 600}) {
    Ring scaled;
    for (const Vector2d& x : Ring{{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {0, 1}})
      scaled.emplace_back(std::ldexp(x.x(), exponent), std::ldexp(x.y(), exponent));
    EXPECT_EQ(convex_pieces({scaled}).size(), 2U);
  }
}

TEST(Polygons, ThatAreNoneAreRefusedByName) {
  const auto field = [](const Polygon& polygon) {
    try {
      static_cast<void>(convex_pieces(polygon));
    } catch (const InputError& e) {
      return e.field();
    }
    return std::string();
  };
  const Ring square{{0, 0}, {8, 0}, {8, 8}, {0, 8}};
  const auto at = [](double x, double y) { return Ring{{x, y}, {x + 1, y}, {x, y + 1}}; };
  EXPECT_EQ(field({square}), "");
  EXPECT_EQ(field({{{0, 0}, {1, 0}}}), "outline");
  EXPECT_EQ(field({{{0, 0}, {1, 0}, {std::nan(""), 1}}}), "outline[2]");
  EXPECT_EQ(field({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}), "outline[2]");  // a bow tie
  EXPECT_EQ(field({{{0, 0}, {2, 0}, {4, 0}}}).substr(0, 8), "outline[");
  EXPECT_EQ(field({square, {at(2, 2)}}), "");
  EXPECT_EQ(field({square, {at(9, 2)}}), "holes[0]");
  EXPECT_EQ(field({square, {at(7, 2)}}).substr(0, 9), "holes[0][");  // touches an edge
  EXPECT_EQ(field({square, {at(2, 2), at(3, 2)}}).substr(0, 9), "holes[1][");
  EXPECT_EQ(field({square, {{{1, 1}, {7, 1}, {1, 7}}, at(2, 2)}}), "holes[1]");
  EXPECT_EQ(field({square, {at(2, 2), {{1, 1}, {7, 1}, {1, 7}}}}), "holes[0]");
  EXPECT_THROW(static_cast<void>(raised({square}, 0)), InputError);
}

}  // namespace
}  // namespace vericone::files
