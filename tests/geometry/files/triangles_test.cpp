// SPDX-License-Identifier: BSD-3-Clause
//
// Polygons cut into triangles: against crossing numbers and areas in whole numbers.
#include <gtest/gtest.h>
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "geometry/files/rings.h"
#include "support/random.h"

namespace vericone::files {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// `place`: into a plane of space; areas are told in the plane.
void expect_cut(testing::Random& random, const Ring& p, int place) {
  const auto in_space = [&](const Vector2d& x) -> Vector3d {
    switch (place) {
      case 0:
        return {x.x(), x.y(), 3};
      case 1:
        return {-1, x.x(), x.y()};
      case 2:
        return {x.y(), 7, x.x()};
      default:
        return {x.x(), x.x() + 2 * x.y(), x.y()};
    }
  };
  std::vector<Vector3d> points;
  for (const Vector2d& x : p) points.push_back(in_space(x));
  Face face(p.size());
  std::iota(face.begin(), face.end(), 0U);
  const auto triangles = triangles_of(points, {face});
  ASSERT_EQ(triangles.size(), p.size() - 2);
  double sum = 0;
  std::vector<Ring> cut;
  for (const auto& t : triangles) {
    cut.push_back({p[t[0]], p[t[1]], p[t[2]]});
    const double own = twice_area(cut.back());
    ASSERT_GE(own * twice_area(p), 0);  // all turn as the polygon does
    sum += own;
  }
  ASSERT_EQ(sum, twice_area(p));
  for (int i = 0; i < 100; ++i) {
    const Vector2d x(random.uniform(-30, 30), random.uniform(-30, 30));
    const auto holding =
        std::count_if(cut.begin(), cut.end(), [&](const Ring& t) { return crosses_odd(t, x); });
    ASSERT_EQ(holding, crosses_odd(p, x));
  }
}

TEST(Triangles, OfRandomPolygonsAreThePolygons) {
  testing::Random random(71);
  SCOPED_TRACE(random.trace());
  int dented = 0;
  for (int i = 0; i < testing::share(2000); ++i) {
    // About the origin, at whole coordinates, with corners on straight edges.
    Ring p;
    const int corners = random.integer(4, 24);
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * M_PI * k / corners, radius = random.uniform(4, 28);
      const Vector2d x(std::round(radius * std::cos(angle)), std::round(radius * std::sin(angle)));
      if (p.empty() || x != p.back()) p.push_back(x);
    }
    // Rounding may turn the order about the origin.
    bool ordered = p.size() > 3;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const Vector2d &a = p[k], &b = p[(k + 1) % p.size()];
      ordered = ordered && a.x() * b.y() - a.y() * b.x() > 0;
    }
    if (!ordered) continue;
    if (i % 3 == 0) std::reverse(p.begin(), p.end());
    std::rotate(p.begin(), p.begin() + random.integer(0, int(p.size()) - 1), p.end());
    ++dented;
    expect_cut(random, p, i % 4);
  }
  EXPECT_GT(dented, testing::share(1000));
}

TEST(Triangles, OfSlotsCombsSpiralsAndHoles) {
  testing::Random random(72);
  const Ring slot{{-3, -2}, {3, -2}, {3, 2}, {1, 2}, {1, -1}, {-1, -1}, {-1, 2}, {-3, 2}};
  Ring comb{{0, -1}};
  for (int i = 0; i < 12; ++i) comb.insert(comb.end(), {{2. * i, 5}, {2. * i + 1, 0}});
  comb.insert(comb.end(), {{24, 5}, {24, -1}});
  const Ring spiral{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 3}, {7, 3}, {7, 7}, {3, 7},
                    {3, 5}, {5, 5},  {5, 4},   {1, 4},  {1, 9}, {9, 9}, {9, 1}, {0, 1}};
  // A square hole, joined to the outside by an edge that is passed both ways.
  const Ring hole{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}, {-9, -9}, {-3, -3}, {-3, 3}, {3, 3}, {3, -3}, {-3, -3}};
  const Ring straight{{0, 0}, {2, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}, {0, 2}};
  for (const Ring& shape : {slot, comb, spiral, hole, straight})
    for (int turned = 0; turned < int(shape.size()); ++turned)
      for (const bool back : {false, true}) {
        Ring p = shape;
        std::rotate(p.begin(), p.begin() + turned, p.end());
        if (back) std::reverse(p.begin(), p.end());
        SCOPED_TRACE(::testing::Message()
                     << shape.size() << " corners from " << turned << (back ? ", back" : ""));
        expect_cut(random, p, turned % 4);
      }
}

using exact::Rational;

/// Twice the area as seen along z, in fractions.
Rational exact_twice_area(const std::vector<Vector3d>& points, std::span<const std::uint32_t> corners) {
  Rational sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector3d &a = points[corners[k]], &b = points[corners[(k + 1) % corners.size()]];
    sum += Rational(a.x()) * Rational(b.y()) - Rational(a.y()) * Rational(b.x());
  }
  return sum;
}

TEST(Triangles, OfEdgesThatAreStraightButForRoundingAddUpInFractions) {
  testing::Random random(73);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < testing::share(300); ++i) {
    // A star about the origin with two corners at the thirds of each edge, rounded to one side or the other.
    std::vector<Vector3d> points;
    const int tips = random.integer(4, 12);
    std::vector<Vector2d> star;
    for (int k = 0; k < tips; ++k) {
      const double angle = (2 * M_PI * k + random.uniform(0, 3)) / tips;
      star.push_back(random.uniform(1, 9) * Vector2d(std::cos(angle), std::sin(angle)));
    }
    for (int k = 0; k < tips; ++k)
      for (int third = 0; third < 3; ++third) {
        const Vector2d x = star[k] + third / 3. * (star[(k + 1) % tips] - star[k]);
        points.emplace_back(x.x(), x.y(), 0.125 * x.x());
      }
    Face face(points.size());
    std::iota(face.begin(), face.end(), 0U);
    if (i % 2 == 0) std::reverse(face.begin(), face.end());
    std::rotate(face.begin(), face.begin() + random.integer(0, int(face.size()) - 1), face.end());
    const Rational whole = exact_twice_area(points, face);
    Rational sum = 0;
    const auto triangles = triangles_of(points, {face});
    for (const auto& t : triangles) {
      const Rational own = exact_twice_area(points, t);
      ASSERT_GE(own * whole, 0) << i;  // in fractions: no triangle turns the other way by a rounding
      sum += own;
    }
    ASSERT_EQ(sum, whole) << i;
    ASSERT_EQ(triangles.size(), points.size() - 2);
  }
}

TEST(Triangles, OfAPolygonOfManyCornersAreCutInTime) {
  // A corridor that winds up, of 20,000 corners: each ear is told by the corners near it.
  std::vector<Vector3d> points;
  constexpr int kSteps = 10'000;
  for (int k = 0; k < 2 * kSteps; ++k) {
    const int step = k < kSteps ? k : 2 * kSteps - 1 - k;
    const double angle = 0.1 * step, radius = 1 + 0.2 * angle + (k < kSteps ? 0 : 0.3);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  Face face(points.size());
  std::iota(face.begin(), face.end(), 0U);
  const auto triangles = triangles_of(points, {face});
  ASSERT_EQ(triangles.size(), points.size() - 2);
  const Rational whole = exact_twice_area(points, face);
  ASSERT_TRUE(std::all_of(triangles.begin(), triangles.end(),
                          [&](const auto& t) { return exact_twice_area(points, t) * whole >= 0; }));
}

TEST(Triangles, OfAPolygonThatCrossesItselfAlongOneAxisAlone) {
  std::vector<Vector3d> pentagram;
  for (int k = 0; k < 5; ++k) pentagram.emplace_back(std::cos(0.8 * M_PI * k), std::sin(0.8 * M_PI * k), 1);
  EXPECT_THROW((void)triangles_of(pentagram, {{0, 1, 2, 3, 4}}), InputError);
  const std::vector<Vector3d> eight{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}};
  EXPECT_THROW((void)triangles_of(eight, {{0, 1, 2, 3}}), InputError);
  // The same seen along z, but along y a trapezium.
  const std::vector<Vector3d> bent{{0, 0, 0}, {2, 2, 0.5}, {2, 0, 1.5}, {0, 2, 1.9}};
  const auto triangles = triangles_of(bent, {{0, 1, 2, 3}});
  ASSERT_EQ(triangles.size(), 2U);
  double area = 0;
  for (const auto& t : triangles) area += (bent[t[1]] - bent[t[0]]).cross(bent[t[2]] - bent[t[0]]).y();
  EXPECT_DOUBLE_EQ(std::abs(area), 2 * (1.9 + 1));
}

TEST(Triangles, CornersThatAreNoPointsAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, nan, 0}};
  for (const Face& face : {Face{0, 1, 2, 4}, Face{0, 1, 4}, Face{0, 1, 2, 3}}) try {
      (void)triangles_of(points, {{0, 1, 2}, face});
      ADD_FAILURE() << "no error";
    } catch (const InputError& e) {
      EXPECT_EQ(e.field(), face.size() == 3 ? "faces[1][2]" : "faces[1][3]");
    }
}

TEST(Triangles, StayFansWhereThatIsTheFace) {
  const std::vector<Vector3d> points{{0, 0, 0}, {2, 0, 0.1}, {2, 1, 0}, {0, 1, 0.1}, {1, 0, 0}, {1, 0, 0}};
  using T = std::array<std::uint32_t, 3>;
  EXPECT_EQ(triangles_of(points, {{0, 1, 2, 3}}), (std::vector<T>{{0, 1, 2}, {0, 2, 3}}));  // not flat
  EXPECT_EQ(triangles_of(points, {{0, 4, 5, 4}}), (std::vector<T>{{0, 4, 5}, {0, 5, 4}}));  // no area
  EXPECT_EQ(triangles_of(points, {{3, 2, 1}}), (std::vector<T>{{3, 2, 1}}));
  try {
    (void)triangles_of(points, {{0, 1, 2}, {0, 1, 3, 2}});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "faces[1]: got face 1, a polygon of 4 corners that crosses itself, must be one that "
                 "does not, as seen along one of the coordinate axes");
  }
}

}  // namespace
}  // namespace vericone::files
