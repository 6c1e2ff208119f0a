// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/fitting/hull.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/quadric_side.h>
#include <vericone/testing/random_bodies.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <span>

namespace vericone::fitting::enclose_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ::testing::ElementsAre;
using testing::RandomBodies;

Assignment all_to_first(const Sample& sample) {
  return {std::vector<int>(sample.points.size(), 0), std::vector<int>(sample.triangles.size(), 0)};
}

std::vector<std::vector<Quadric>> quadrics(const std::vector<Piece>& pieces) {
  std::vector<std::vector<Quadric>> all;
  for (const Piece& p : pieces) all.push_back(p.quadrics);
  return all;
}

Piece piece_of(const CombinedEllipsoid& body) {
  Piece p;
  p.body = body;
  return p;
}

/// By the predicates of the geometry library, not by what is tested.
void expect_contains(const Piece& piece, const Vector3d& x) {
  ASSERT_NE(side<3>(piece.body, x), Sign::positive) << x.transpose();
  for (const Quadric& q : piece.quadrics) ASSERT_NE(exact_side<3>(q, x), Sign::positive) << x.transpose();
}

double largest_value(const Quadric& q, const std::vector<Vector3d>& points) {
  double largest = -1e300;
  for (const Vector3d& x : points) largest = std::max(largest, q.value(x));
  return largest;
}

/// Surfaces of the body that points are on are touched by the quadrics too, to rounding.
void expect_tight(const Piece& piece, const CombinedEllipsoid& body, const std::vector<Vector3d>& points) {
  const std::vector<Quadric> before = body.quadrics();
  ASSERT_EQ(piece.quadrics.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    if (largest_value(before[i], points) > -1e-12) {
      EXPECT_LT(std::abs(largest_value(piece.quadrics[i], points)), 1e-12) << i;
    }
}

/// A random ellipsoid with up to three hyperboloids that cut it, and points on its boundary, rounded.
struct Scan {
  CombinedEllipsoid body;
  std::vector<Vector3d> points;

  Scan(RandomBodies& random, double far, double scale) {
    const Vector3d center = far * random.direction();
    const Ellipsoid ellipsoid = Ellipsoid::from_axes(
        center, scale * Vector3d(random.uniform(0.5, 2), random.uniform(0.5, 2), random.uniform(0.5, 2)),
        random.rotation());
    std::vector<Delimiter<3>> delimiters;
    for (int n = random.integer(0, 3); n > 0; --n) {
      const Vector3d axis = random.direction();
      const Matrix3d r = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitX(), axis).toRotationMatrix();
      const double reach = 1 / (ellipsoid.factor().inverse() * axis).norm();
      const int sheets = random.integer(1, 2);
      if (sheets == 2)
        delimiters.push_back(hyperboloid(2, {random.uniform(0.3, 0.9) * reach, scale, scale}, r));
      else
        delimiters.push_back(hyperboloid(1, {scale, 0.4 * scale, 0.4 * scale}, r));
    }
    body = CombinedEllipsoid(ellipsoid, delimiters);
    for (int i = 0; i < 400; ++i) {
      const Vector3d u = random.direction();
      points.push_back(center + u / body.gauge(u));
    }
  }
};

TEST(Enclose, ScansOfBodiesAreInsideAfterAFewRoundings) {
  RandomBodies random(71);
  SCOPED_TRACE(random.trace());
  for (int n = 0; n < 150; ++n) {
    const double scale = std::pow(10, random.integer(-3, 3));
    const Scan scan(random, 3 * scale * random.uniform(), scale);
    const Sample sample{scan.points, {}};
    std::vector<Piece> pieces{piece_of(scan.body)};
    const double factor = enclose(pieces, sample, all_to_first(sample));
    EXPECT_LT(factor, 1 + 1e-14);
    EXPECT_GE(factor, 1);
    for (const Vector3d& x : scan.points) expect_contains(pieces[0], x);
    const Certificate c = check(quadrics(pieces), sample);
    EXPECT_TRUE(c.all_inside());
    EXPECT_FALSE(c.touching.empty());
    expect_tight(pieces[0], scan.body, scan.points);
  }
}

TEST(Enclose, LooseFitsAreInflatedByWhatIsMissingAndNoMore) {
  RandomBodies random(72);
  SCOPED_TRACE(random.trace());
  for (int n = 0; n < 60; ++n) {
    const Scan scan(random, random.uniform(0, 3), 1);
    const Sample sample{scan.points, {}};
    const double deflation = random.uniform(0.5, 0.99);
    std::vector<Piece> pieces{
        piece_of(scan.body.translated(-scan.body.center()).scaled(deflation).translated(scan.body.center()))};
    EXPECT_NEAR(enclose(pieces, sample, all_to_first(sample)) * deflation, 1, 1e-13);
    for (const Vector3d& x : scan.points) expect_contains(pieces[0], x);
    expect_tight(pieces[0], scan.body, scan.points);
  }
}

TEST(Enclose, NothingMovesInwards) {
  Piece piece =
      piece_of(CombinedEllipsoid(Ellipsoid::from_axes({1, 2, 3}, {3, 2, 2}), {hyperboloid(2, {1, 1, 1})}));
  const CombinedEllipsoid before = piece.body;
  std::vector<Piece> pieces{piece};
  const Sample sample{{{1.5, 2, 3}, {1, 2.5, 3}}, {}};
  EXPECT_EQ(enclose(pieces, sample, all_to_first(sample)), 1);
  EXPECT_EQ(pieces[0].body.ellipsoid().factor(), before.ellipsoid().factor());
  EXPECT_EQ(pieces[0].body.delimiters()[0].level, 1);
  EXPECT_TRUE(check(quadrics(pieces), sample).touching.empty());
}

TEST(Enclose, DentsMoveForTrianglesAcrossThem) {
  // All corners are inside x^2 - y^2 - z^2 <= 1; the triangle crosses the dent at x = 1.25.
  const CombinedEllipsoid body(Ellipsoid::from_axes({0, 0, 0}, {8, 8, 8}), {hyperboloid(2, {1, 1, 1})});
  Sample sample{{{1.25, -2, -2}, {1.25, 4, -2}, {1.25, -2, 4}}, {}};
  std::vector<Piece> pieces{piece_of(body)};
  EXPECT_EQ(enclose(pieces, sample, all_to_first(sample)), 1);
  sample.triangles = {{{0, 1, 2}}};
  EXPECT_EQ(check(quadrics(pieces), sample).triangles_inside, 0U);
  EXPECT_EQ(enclose(pieces, sample, all_to_first(sample)), 1.25);
  EXPECT_EQ(pieces[0].body.delimiters()[0].level, 1.5625);
  EXPECT_TRUE(check(quadrics(pieces), sample).all_inside());
  // An edge alone: a triangle upright on it.
  sample.points = {{1.25, -2, 0}, {1.25, 4, 0}, {0, 1, 3}};
  pieces = {piece_of(body)};
  EXPECT_EQ(enclose(pieces, sample, all_to_first(sample)), 1.25);
  EXPECT_TRUE(check(quadrics(pieces), sample).all_inside());
}

TEST(Enclose, TrianglesOfMeshesStayInsideBodiesWithDents) {
  RandomBodies random(73);
  SCOPED_TRACE(random.trace());
  int moved = 0;
  for (int n = 0; n < 40; ++n) {
    const Scan scan(random, random.uniform(0, 3), 1);
    Sample sample{scan.points, {}};
    for (int t = 0; t < 60; ++t) {
      const int a = random.integer(0, 399), b = random.integer(0, 399), c = random.integer(0, 399);
      if (a != b && b != c && a != c)
        sample.triangles.push_back({std::uint32_t(a), std::uint32_t(b), std::uint32_t(c)});
    }
    std::vector<Piece> pieces{piece_of(scan.body)};
    const double factor = enclose(pieces, sample, all_to_first(sample));
    moved += factor > 1.001;
    const Certificate c = check(quadrics(pieces), sample);
    EXPECT_TRUE(c.all_inside());
    for (const auto& t : sample.triangles)
      for (int k = 0; k < 30; ++k) {
        const double u = random.uniform(), v = (1 - u) * random.uniform();
        const Vector3d x =
            u * sample.points[t[0]] + v * sample.points[t[1]] + (1 - u - v) * sample.points[t[2]];
        // The point is rounded, so it may lie outside by that.
        for (const Quadric& q : pieces[0].quadrics) ASSERT_LT(q.value(x), 1e-12);
        ASSERT_LT(pieces[0].body.gauge(x - pieces[0].body.center()), 1 + 1e-13);
      }
    // No more than needed: with the levels lowered by a part in 1e9 some triangle is out.
    if (factor > 1.001) {
      std::vector<std::vector<Quadric>> smaller{{}};
      for (const Quadric& q : pieces[0].quadrics) {
        Eigen::Matrix4d m = q.matrix();
        m(3, 3) += 1e-9;
        smaller[0].emplace_back(m);
      }
      EXPECT_LT(check(smaller, sample).triangles_inside, sample.triangles.size());
    }
  }
  EXPECT_GT(moved, 10);
}

TEST(Enclose, FarFromTheOriginTheBodyStaysTight) {
  RandomBodies random(74);
  SCOPED_TRACE(random.trace());
  for (const double far : {1e3, 5e6}) {
    double most = 0;
    for (int n = 0; n < 20; ++n) {
      const Scan scan(random, far, 1);
      const Sample sample{scan.points, {}};
      std::vector<Piece> pieces{piece_of(scan.body)};
      // Points are rounded to the grid of their coordinates.
      EXPECT_LT(enclose(pieces, sample, all_to_first(sample)), 1 + 8 * 0x1p-53 * far);
      for (const Vector3d& x : scan.points) expect_contains(pieces[0], x);
      EXPECT_TRUE(check(quadrics(pieces), sample).all_inside());
      for (const Quadric& q : pieces[0].quadrics) {
        // From the centre outwards along random directions: how much farther the quadric's surface is than
        // the body's, where the body's is that of the same surface.
        const Quadric alone[] = {q};
        const std::size_t i = static_cast<std::size_t>(&q - pieces[0].quadrics.data());
        const CombinedEllipsoid& body = pieces[0].body;
        for (int k = 0; k < 20; ++k) {
          const Vector3d u = random.direction();
          const Matrix3d inverse = body.ellipsoid().factor().inverse();
          const double square =
              i == 0 ? (inverse * u).squaredNorm()
                     : u.dot(body.delimiters()[i - 1].matrix * u) / body.delimiters()[i - 1].level;
          if (!(square > 0.1)) continue;
          const double r = 1 / std::sqrt(square);
          double low = 0.5, high = 2;
          for (int step = 0; step < 40; ++step) {
            const double mid = 0.5 * (low + high);
            (side<3>(std::span<const Quadric>(alone), Vector3d(body.center() + mid * r * u)) == Sign::positive
                 ? high
                 : low) = mid;
          }
          most = std::max(most, low - 1);
        }
      }
    }
    RecordProperty("inflation_at_" + std::to_string(int(far)), std::to_string(most));
    std::cout << "quadrics of bodies of 1 m at " << far << " m are larger by up to " << most << "\n";
    EXPECT_LT(most, far < 1e4 ? 1e-9 : 1e-4);
  }
}

TEST(Enclose, MarginsAreAddedExactlyToBalls) {
  RandomBodies random(75);
  SCOPED_TRACE(random.trace());
  for (int n = 0; n < 30; ++n) {
    const Vector3d center = random.in_box(3);
    Sample sample;
    double radius = 0;
    for (int i = 0; i < 100; ++i) {
      sample.points.push_back(center + random.in_box(1));
      radius = std::max(radius, (sample.points.back() - center).norm());
    }
    const double margin = random.log_uniform(1e-6, 1);
    std::vector<Piece> pieces{piece_of(Ellipsoid::from_axes(center, {0.1, 0.1, 0.1}, random.rotation()))};
    const double factor = enclose(pieces, sample, all_to_first(sample), margin);
    EXPECT_NEAR(0.1 * factor / (radius + margin), 1, 1e-13);
    const Certificate c = check(quadrics(pieces), sample, margin);
    EXPECT_TRUE(c.all_inside());
    EXPECT_EQ(c.margins_inside, 100U);
  }
}

TEST(Enclose, BallsAboutScansAreInsideBodiesWithDents) {
  RandomBodies random(76);
  SCOPED_TRACE(random.trace());
  for (int n = 0; n < 60; ++n) {
    const Scan scan(random, random.uniform(0, 3), 1);
    const Sample sample{scan.points, {}};
    std::vector<Piece> pieces{piece_of(scan.body)};
    const double margin = random.log_uniform(1e-6, 0.1);
    const double factor = enclose(pieces, sample, all_to_first(sample), margin);
    EXPECT_GT(factor, 1);
    EXPECT_TRUE(check(quadrics(pieces), sample, margin).all_inside());
    for (const Vector3d& x : scan.points)
      for (int k = 0; k < 20; ++k) expect_contains(pieces[0], x + margin * (1 - 1e-9) * random.direction());
  }
}

TEST(Enclose, FootprintsAndTheirHeights) {
  RandomBodies random(77);
  SCOPED_TRACE(random.trace());
  for (const bool planar : {true, false})
    for (const double margin : {0.0, 0.01}) {
      Piece piece;
      piece.footprint = random.ellipse({3, -2}, 0.5, 2);
      piece.low = planar ? 7 : -0.1;
      piece.high = planar ? 7 : 0.1;
      Sample sample;
      for (int i = 0; i < 300; ++i) {
        const Eigen::Vector2d x = piece.footprint->support_point(random.direction_2d());
        sample.points.emplace_back(x.x(), x.y(), planar ? 7 : random.uniform(-0.3, 0.7));
      }
      std::vector<Piece> pieces{piece};
      const double factor = enclose(pieces, sample, all_to_first(sample), margin);
      if (margin == 0) {
        EXPECT_LT(factor, 1 + 1e-14);
      }
      EXPECT_EQ(pieces[0].quadrics.size(), planar ? 1U : 2U);
      EXPECT_TRUE(check(quadrics(pieces), sample, margin).all_inside());
      for (const Vector3d& x : sample.points) {
        ASSERT_NE(side<2>(*pieces[0].footprint, Eigen::Vector2d(x.head<2>())), Sign::positive);
        if (planar) continue;
        ASSERT_LE(pieces[0].low, x.z() - margin);
        ASSERT_GE(pieces[0].high, x.z() + margin);
      }
    }
}

TEST(Enclose, EachPieceContainsItsOwn) {
  RandomBodies random(78);
  SCOPED_TRACE(random.trace());
  Sample sample;
  Assignment assignment;
  for (int i = 0; i < 600; ++i) {
    sample.points.push_back(Vector3d(i % 3 * 4.0, 0, 0) + random.direction());
    assignment.points.push_back(i % 3 - (i % 3 == 2 ? 3 : 0));  // a third to none
  }
  std::vector<Piece> pieces{piece_of(Ellipsoid::from_axes({0, 0, 0}, {0.5, 0.5, 0.5})),
                            piece_of(Ellipsoid::from_axes({4, 0, 0}, {0.7, 0.7, 0.7})),
                            piece_of(Ellipsoid::from_axes({9, 9, 9}, {1, 1, 1}))};
  EXPECT_NEAR(enclose(pieces, sample, assignment), 2, 1e-14);
  EXPECT_NEAR(pieces[1].body.ellipsoid().semi_axes()(0), 1, 1e-14);
  EXPECT_EQ(pieces[2].body.ellipsoid().semi_axes()(0), 1);  // nothing to contain
  EXPECT_EQ(pieces[2].quadrics.size(), 1U);
  const Certificate c = check(quadrics(pieces), sample);
  EXPECT_EQ(c.points_inside, 400U);
  EXPECT_DOUBLE_EQ(c.coverage(), 2.0 / 3);
}

TEST(Enclose, TheOrderOfThePointsChangesNothing) {
  RandomBodies random(79);
  SCOPED_TRACE(random.trace());
  for (int n = 0; n < 10; ++n) {
    const Scan scan(random, random.uniform(0, 3), 1);
    Sample one{scan.points, {}}, other = one;
    std::reverse(other.points.begin(), other.points.end());
    std::vector<Piece> a{piece_of(scan.body)}, b = a;
    EXPECT_EQ(enclose(a, one, all_to_first(one), 1e-3 * (n % 2)),
              enclose(b, other, all_to_first(other), 1e-3 * (n % 2)));
    for (std::size_t i = 0; i < a[0].quadrics.size(); ++i)
      EXPECT_EQ(a[0].quadrics[i].matrix(), b[0].quadrics[i].matrix());
  }
}

TEST(Enclose, ThinAndFlatBodies) {
  RandomBodies random(80);
  SCOPED_TRACE(random.trace());
  for (const double thin : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const Ellipsoid body = Ellipsoid::from_axes(random.in_box(1), {1, 0.5, thin}, random.rotation());
    // More than are evaluated exactly, all over the surface and not only at the rim, where normals point.
    Sample sample;
    const Matrix3d normals = body.factor().inverse().transpose();
    for (int i = 0; i < 8000; ++i) sample.points.push_back(body.support_point(normals * random.direction()));
    std::vector<Piece> pieces{piece_of(body)};
    // Rounded to the grid of coordinates, points are outside by an ulp over the thickness.
    EXPECT_LT(enclose(pieces, sample, all_to_first(sample)), 1 + 1e-15 / thin);
    for (std::size_t i = 0; i < sample.points.size(); i += 20) expect_contains(pieces[0], sample.points[i]);
    EXPECT_TRUE(check(quadrics(pieces), sample).all_inside());
  }
}

TEST(Enclose, SaysWhatIsWrongWithItsInput) {
  const auto field = [](const Sample& sample, const Assignment& assignment, double margin) -> std::string {
    std::vector<Piece> pieces(1);
    try {
      enclose(pieces, sample, assignment, margin);
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  const Sample two{{{1, 2, 3}, {4, 5, 6}}, {}};
  EXPECT_EQ(field(two, {{0}, {}}, 0), "assignment.points");
  EXPECT_EQ(field(two, {{0, 1}, {}}, 0), "assignment.points");
  EXPECT_EQ(field(two, {{0, -2}, {}}, 0), "assignment.points");
  EXPECT_EQ(field(two, {{0, 0}, {0}}, 0), "assignment.triangles");
  EXPECT_EQ(field(two, {{0, 0}, {}}, std::nan("")), "margin");
  EXPECT_EQ(field(two, {{0, -1}, {}}, 0), "");
}

}  // namespace
}  // namespace vericone::fitting::enclose_test
