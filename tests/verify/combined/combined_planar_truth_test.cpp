// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <vericone/internal/cones/combined/sector.h>
#include <vericone/internal/verify/combined/planar_families.h>
#include <vericone/internal/verify/combined/planar_truth.h>
#include <vericone/internal/verify/predicates/exact_tangents.h>
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/verify/planar/campaign.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace vericone::verify::combined_planar_truth_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using std::numbers::pi;

Vector2d turned(const Vector2d& d, double angle) { return rotation_2d(angle) * d; }
Vector2d at(double angle) { return {std::cos(angle), std::sin(angle)}; }

void expect_edges(const CombinedEllipse& a, const CombinedEllipse& b, const Sector& sector,
                  double tolerance) {
  const CombinedPlanarTruth truth(a, b);
  EXPECT_EQ(truth.disjoint(), true);
  EXPECT_TRUE(truth.contains(turned(sector.left.direction, -tolerance)));
  EXPECT_FALSE(truth.contains(turned(sector.left.direction, tolerance)));
  EXPECT_TRUE(truth.contains(turned(sector.right.direction, tolerance)));
  EXPECT_FALSE(truth.contains(turned(sector.right.direction, -tolerance)));
}

TEST(CombinedPlanarTruth, Discs) {
  const Ellipse a = Ellipse::from_axes(Vector2d(1, 2), Vector2d(1, 1)),
                b = Ellipse::from_axes(Vector2d(4, 6), Vector2d(1.5, 1.5));
  const CombinedPlanarTruth truth(a, b);
  EXPECT_EQ(truth.disjoint(), true);
  EXPECT_TRUE(truth.contains(Vector2d(3, 4)));
  EXPECT_FALSE(truth.contains(Vector2d(-3, -4)));
  // Half opening 30 degrees exactly; as doubles the directions miss it by a rounding.
  const double line = std::atan2(4, 3);
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(truth.contains(at(line + side * (pi / 6 - 1e-14))));
    EXPECT_FALSE(truth.contains(at(line + side * (pi / 6 + 1e-14))));
  }
  // Touching is in, the cone is closed: radii sqrt(2), and (1, 3) is at 2 sqrt(2) from the line along (-1,
  // 1).
  const Eigen::Matrix2d shape = 2 * Eigen::Matrix2d::Identity();
  const CombinedPlanarTruth grazing(Ellipse::from_shape(Vector2d(0, 0), shape),
                                    Ellipse::from_shape(Vector2d(1, 3), shape));
  EXPECT_TRUE(grazing.contains(Vector2d(-1, 1)));
  EXPECT_FALSE(grazing.contains(Vector2d(-1, 1 - 0x1p-53)));
  EXPECT_TRUE(grazing.contains(Vector2d(-1, 1 + 0x1p-52)));
}

TEST(CombinedPlanarTruth, Relations) {
  const CombinedEllipse mouth = dented_conic(Vector2d::Zero(), 6, 2, 0.9, 0);
  const auto disc = [](double x, double y, double r) {
    return Ellipse::from_axes(Vector2d(x, y), Vector2d(r, r));
  };
  EXPECT_EQ(CombinedPlanarTruth(disc(3.5, 0, 0.25), mouth).disjoint(), true);
  EXPECT_EQ(CombinedPlanarTruth(disc(1.5, 0, 0.25), mouth).disjoint(), false);
  EXPECT_EQ(CombinedPlanarTruth(disc(6, 1.9, 0.25), mouth).disjoint(), false);
  EXPECT_EQ(CombinedPlanarTruth(disc(0, 0, 100), mouth).disjoint(), false);
  EXPECT_EQ(CombinedPlanarTruth(mouth, disc(0, 0, 100)).disjoint(), false);
  EXPECT_EQ(CombinedPlanarTruth(disc(0, 9, 1), mouth).disjoint(), true);
  // The neck is at 6 sqrt(0.1), and the pinch is a point.
  const double neck = 6 * std::sqrt(0.1);
  EXPECT_EQ(CombinedPlanarTruth(disc(neck + 0.01 + 1e-9, 0, 0.01), mouth).disjoint(), true);
  EXPECT_EQ(CombinedPlanarTruth(disc(neck + 0.01 - 1e-9, 0, 0.01), mouth).disjoint(), false);
  const CombinedEllipse pinched = dented_conic(Vector2d::Zero(), 6, 2, 1, 0);
  EXPECT_EQ(CombinedPlanarTruth(pinched, disc(1, 0, 0.25)).disjoint(), true);
  EXPECT_EQ(CombinedPlanarTruth(disc(1, 0, 0.25), pinched).disjoint(), true);
  EXPECT_EQ(CombinedPlanarTruth(pinched, disc(1, 0, 0.35)).disjoint(), false);
  EXPECT_EQ(CombinedPlanarTruth(disc(0.3, 0, 0.25), pinched).disjoint(), false);
  // Touching: not decided rather than guessed.
  EXPECT_EQ(CombinedPlanarTruth(disc(0, 0, 1), disc(2, 0, 1)).disjoint(), std::nullopt);
}

/// Exchanging the bodies asks A's arcs and corners for B's and back.
TEST(CombinedPlanarTruth, ExchangedBodies) {
  for (const CombinedPlanarFamily family : kAllCombinedPlanarFamilies)
    for (std::uint64_t i = 0; i < 60; ++i) {
      const auto [a, b] = combined_planar_pair(family, 7, i);
      const CombinedPlanarTruth truth(a, b), exchanged(b, a);
      ASSERT_EQ(truth.disjoint(), exchanged.disjoint()) << name(family) << " " << i;
      if (truth.disjoint() != true) continue;
      const Sector s = combined_sector(a, b).sector;
      SeededRandom random(1, 7, i);
      for (int k = 0; k < 12; ++k) {
        const double near = (k % 2 ? 1 : -1) * s.psi / 2 + random.uniform(-1e-3, 1e-3) * s.psi;
        const Vector2d w = at(k < 6 ? s.theta_b + near : random.uniform(-pi, pi));
        ASSERT_EQ(truth.contains(w), exchanged.contains(-w)) << name(family) << " " << i;
      }
    }
}

/// Without corners there is another exact way.
TEST(CombinedPlanarTruth, EllipsesAgainstExactTangents) {
  for (const PlanarFamily family : {PlanarFamily::regular, PlanarFamily::common_axes, PlanarFamily::thin,
                                    PlanarFamily::nearly_touching, PlanarFamily::far_from_origin})
    for (std::uint64_t i = 0; i < 30; ++i) {
      const auto [a, b] = planar_pair(family, 11, i);
      const Sector s = sector_by_support(a, b);
      if (s.relation == Relation::disjoint) expect_edges(a, b, s, 1e-14);
      const std::optional<bool> disjoint = CombinedPlanarTruth(a, b).disjoint();
      if (disjoint) {
        EXPECT_EQ(*disjoint, s.relation == Relation::disjoint) << name(family) << " " << i;
      }
    }
}

/// Source, 5.4.2, for all k: psi and theta_b as the truth has them, to 1e-10.
TEST(CombinedPlanarTruth, OfTheSourceForAllK) {
  const Ellipse f1 = Ellipse::from_axes(Vector2d::Zero(), Vector2d(6, 2), rotation_2d(pi / 4));
  for (int i = 0; i <= 100; ++i) {
    SCOPED_TRACE(i);
    const CombinedEllipse f2 = dented_conic(Vector2d(45, 0), 6, 2, i / 100.0, 2 * pi / 3);
    const Sector s = combined_sector(f1, f2).sector;
    // Each edge to 4e-11, so psi to 8e-11 and theta_b to 4e-11; they are these edges' to a rounding.
    expect_edges(f1, f2, s, 4e-11);
    const double left = std::atan2(s.left.direction.y(), s.left.direction.x()),
                 right = std::atan2(s.right.direction.y(), s.right.direction.x());
    EXPECT_NEAR(s.psi, left - right, 1e-15);
    EXPECT_NEAR(s.theta_b, (left + right) / 2, 1e-15);
  }
}

/// The largest distance from a corner to the nearest one of the exact corners, as a part of their sizes.
double corner_error(const CombinedEllipse& body, const std::vector<ExactCorner>& exact) {
  const std::vector<Corner> found = corners(body);
  EXPECT_EQ(found.size(), exact.size());
  double worst = 0;
  for (const ExactCorner& e : exact) {
    const Vector2d point(0.5 * (e.x.lo + e.x.hi), 0.5 * (e.y.lo + e.y.hi));
    EXPECT_LT(std::max(e.x.hi - e.x.lo, e.y.hi - e.y.lo), 1e-15 * point.norm());
    double nearest = 1e300;
    for (const Corner& f : found)
      if (f.first == e.first && f.second == e.second)
        nearest = std::min(nearest, (f.point - body.center() - point).norm());
    worst = std::max(worst, nearest / point.norm());
  }
  return worst;
}

TEST(ExactCorners, OfTheDentedConic) {
  const auto exact = exact_corners(dented_conic(Vector2d(3, 4), 6, 2, 0.25, 0));
  ASSERT_EQ(exact.size(), 4u);
  for (const ExactCorner& e : exact) {
    EXPECT_NEAR(std::abs(e.x.lo), 6, 1e-14);  // (+-a_c, +-b_c sqrt(k)), errata 3.5
    EXPECT_NEAR(std::abs(e.y.hi), 1, 1e-14);
  }
}

TEST(ExactCorners, OfRandomBodies) {
  int bodies = 0;
  for (const CombinedPlanarFamily family :
       {CombinedPlanarFamily::one_hyperbola, CombinedPlanarFamily::several, CombinedPlanarFamily::dented,
        CombinedPlanarFamily::pinched, CombinedPlanarFamily::waist})
    for (std::uint64_t i = 0; i < 100; ++i) {
      // About the origin, so that the offsets carry no rounding of the centre.
      const CombinedEllipse drawn = combined_planar_pair(family, 13, i).second;
      const CombinedEllipse body = drawn.translated(-drawn.center());
      const auto exact = exact_corners(body);
      ASSERT_LT(corner_error(body, exact), 1e-12) << name(family) << " " << i;
      bodies += !exact.empty();
    }
  EXPECT_GT(bodies, 400);
}

TEST(ExactCorners, OfSections) {
  SeededRandom random(2, 17, 0);
  int sections = 0;
  for (int i = 0; i < 200; ++i) {
    const auto axes = [&](double low, double high) {
      const double x = random.uniform(low, high), y = random.uniform(low, high);
      return Vector3d(x, y, random.uniform(low, high));
    };
    const Vector3d outer = axes(1, 6);
    const Ellipsoid ellipsoid = Ellipsoid::from_axes(Vector3d::Zero(), outer, random.rotation());
    std::vector<Delimiter<3>> delimiters;
    const int count = random.integer(1, 2);
    for (int k = 0; k < count; ++k) {
      const int sheets = random.integer(1, 2);
      const Vector3d semi = axes(0.3, 0.9);
      delimiters.push_back(hyperboloid(sheets, semi, random.rotation()));
    }
    const CombinedEllipsoid body(ellipsoid, delimiters);
    const Eigen::Matrix3d frame = random.rotation();
    const CombinedEllipse section = central_section(body, frame.col(0), frame.col(1), Vector2d::Zero());
    // A delimiter that misses the plane changes the numbering.
    if (section.delimiters().size() != body.delimiters().size()) continue;
    ASSERT_LT(corner_error(section, exact_section_corners(body, frame.col(0), frame.col(1))), 1e-12) << i;
    ++sections;
  }
  EXPECT_GT(sections, 100);
}

/// Who is right where the source's choice of tangents differs from combined_sector().
struct Dispute {
  const char* why;
  Ellipse a;
  CombinedEllipse b;
  TangentChoice choice;
  double ours, theirs;  // psi
};

TEST(SectorBySource, WhoIsRight) {
  const auto agent = [](double a, double b) { return Ellipse::from_axes(Vector2d::Zero(), Vector2d(a, b)); };
  const CombinedEllipse slim(Ellipse::from_axes(Vector2d(12, 4), Vector2d(6, 2)),
                             {hyperbola(Vector2d(1, 3), 3 * pi / 4)});
  const CombinedEllipse cut(Ellipse::from_axes(Vector2d(-4, 4), Vector2d(5, 2)),
                            {{Vector2d(1.0 / 9, 1.0 / 25).asDiagonal().toDenseMatrix(), 1}});
  const Dispute disputes[] = {
      {"the corner that counts is not one of the two nearest to the lost point", agent(1, 1), slim,
       TangentChoice::printed, 0.43811, 0.32349},
      {"the ellipses intersect: the corners nearest to the middle of the centres", agent(3, 1),
       dented_conic(Vector2d(6, 0), 2, 4, 0.5, pi / 4), TangentChoice::printed, 3.12312, 2.60666},
      {"both tangents of one corner pass step 4, yet nothing grazes", agent(1, 1),
       dented_conic(Vector2d(8, 2), 2, 2, 0.5, pi / 4), TangentChoice::keep_both, 0.86313, 0.57303},
      {"the delimiter is an ellipse, and its arc is touched", agent(1, 1), cut, TangentChoice::by_sides,
       1.38182, 1.35222},
  };
  for (const Dispute& d : disputes) {
    SCOPED_TRACE(d.why);
    const Sector ours = combined_sector(d.a, d.b).sector;
    const auto theirs = sector_by_source(d.a, d.b, d.choice);
    ASSERT_TRUE(theirs);
    EXPECT_NEAR(ours.psi, d.ours, 5e-6);
    EXPECT_NEAR(theirs->psi, d.theirs, 5e-6);
    expect_edges(d.a, d.b, ours, 1e-12);
    // A direction that collides and that the source's sector leaves out.
    const bool left = (theirs->left.direction - ours.left.direction).norm() > 1e-6;
    const Vector2d between = left ? Vector2d(theirs->left.direction + ours.left.direction)
                                  : Vector2d(theirs->right.direction + ours.right.direction);
    EXPECT_TRUE(CombinedPlanarTruth(d.a, d.b).contains(between));
    const double off = std::remainder(std::atan2(between.y(), between.x()) - theirs->theta_b, 2 * pi);
    EXPECT_GT(std::abs(off), theirs->psi / 2);
  }
}

}  // namespace
}  // namespace vericone::verify::combined_planar_truth_test
