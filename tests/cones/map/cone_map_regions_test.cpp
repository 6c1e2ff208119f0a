// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/cone_size.h>
#include <vericone/internal/cones/map/cell.h>

#include <map>
#include <set>

#include "cones/map/cone_map_checks.h"
#include "support/campaign.h"

namespace vericone::cone_map_regions_test {
namespace {

using Eigen::Vector3d;
using testing::cap, testing::DistanceClassifier, testing::RandomBodies, testing::ring, testing::share;

ConeMapOptions at(double resolution) {
  ConeMapOptions options;
  options.resolution = resolution;
  return options;
}

/// Enclosed by a loop about an axis, by the formula for star-shaped polygons; negative for clockwise ones.
double enclosed(const Vector3d& axis, const std::vector<Vector3d>& loop) {
  return polygon_solid_angle(axis, loop);
}

TEST(ConeMapRegions, ARingHasAHole) {
  const Vector3d axis(1, 2, -0.5);
  for (const double resolution : {0.1, 0.02, 0.004}) {
    const ConeMap map = cone_map(ring(axis, 0.4, 0.8), at(resolution));
    const auto all = regions(map);
    ASSERT_EQ(all.size(), 3);
    for (const ConeMapRegion& r : all) {
      EXPECT_TRUE(r.surely_separate);
      EXPECT_LE(r.solid_angle, r.most_solid_angle);
    }
    // Around the ring, the ring, and its hole.
    const double truth[] = {4 * std::numbers::pi - cap(0.8), cap(0.8) - cap(0.4), cap(0.4)};
    const Certified label[] = {Certified::out, Certified::in, Certified::out};
    const std::size_t loops[] = {1, 2, 1};
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(all[i].label, label[i]);
      EXPECT_LE(all[i].solid_angle, truth[i]);
      EXPECT_GE(all[i].most_solid_angle, truth[i]);
      EXPECT_EQ(all[i].boundary.size(), loops[i]);
    }
    // What the loops enclose is what the cells have in all, corners on longer edges included.
    EXPECT_NEAR(enclosed(axis, all[2].boundary[0]), all[2].solid_angle, 1e-11);
    EXPECT_NEAR(enclosed(axis, all[1].boundary[0]) + enclosed(axis, all[1].boundary[1]), all[1].solid_angle,
                1e-11);
    EXPECT_NEAR(enclosed(-axis, all[0].boundary[0]), all[0].solid_angle, 1e-11);
    const auto hole = region_around(map, axis);
    ASSERT_TRUE(hole);
    EXPECT_EQ(hole->cells, all[2].cells);
    EXPECT_EQ(hole->boundary, all[2].boundary);
    EXPECT_EQ(hole->solid_angle, all[2].solid_angle);
    EXPECT_EQ(hole->most_solid_angle, all[2].most_solid_angle);
    const AxisFrame frame(axis);
    EXPECT_EQ(region_around(map, std::cos(0.6) * frame.axis + std::sin(0.6) * frame.e1)->cells, all[1].cells);
    EXPECT_EQ(region_around(map, -axis)->cells, all[0].cells);
    EXPECT_FALSE(region_around(map, std::cos(0.4) * frame.axis + std::sin(0.4) * frame.e1));
  }
}

TEST(ConeMapRegions, ADoorInTheRingIsFoundOnceItIsResolved) {
  // The ring without the directions within 0.02 rad of a half-plane.
  const DistanceClassifier open([](const Vector3d& d) {
    const double t = std::acos(std::clamp(d.x(), -1.0, 1.0));
    const double wall = std::max(0.4 - t, t - 0.8);
    const double door =
        d.y() > 0 ? std::asin(std::abs(d.z())) : std::acos(std::clamp(std::abs(d.x()), 0.0, 1.0));
    return std::max(wall, 0.02 - door);
  });
  const ConeMap coarse = cone_map(open, at(0.15)), fine = cone_map(open, at(0.01));
  const auto inside = region_around(coarse, {1, 0, 0});
  ASSERT_TRUE(inside);
  EXPECT_FALSE(inside->surely_separate) << "the door may be there";
  EXPECT_LT(inside->solid_angle, cap(0.4));
  EXPECT_GT(inside->most_solid_angle, 4 * std::numbers::pi - (cap(0.8) - cap(0.4)));
  const auto found = region_around(fine, {1, 0, 0});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->surely_separate);
  EXPECT_EQ(found->cells, region_around(fine, {-1, 0, 0})->cells);
  EXPECT_EQ(found->boundary.size(), 1);
}

TEST(ConeMapRegions, TheWholeSphere) {
  const ConeMap map = cone_map(ring({1, 0, 0}, -1, 4), at(0.1));
  const auto all = regions(map);
  ASSERT_EQ(all.size(), 1);
  EXPECT_EQ(all[0].label, Certified::in);
  EXPECT_TRUE(all[0].boundary.empty());
  EXPECT_TRUE(all[0].surely_separate);
  EXPECT_NEAR(all[0].solid_angle, 4 * std::numbers::pi, 1e-13);
  const ConeMap unknown = cone_map(DistanceClassifier([](const Vector3d&) { return 0.0; }), at(1));
  EXPECT_TRUE(regions(unknown).empty());
  EXPECT_FALSE(region_around(unknown, {0, 1, 0}));
}

/// Cells of one label joined by stepping over their edges and about their corners in many places: another way
/// to find the regions.
std::vector<std::set<std::uint32_t>> regions_by_steps(const ConeMap& map) {
  std::vector<std::set<std::uint32_t>> neighbours(map.cells.size());
  for (std::uint32_t c = 0; c < map.cells.size(); ++c) {
    const DirectionCell cell = map.cell(c);
    for (int k = 0; k < 3; ++k) {
      const Vector3d &a = cell[k], &b = cell[(k + 1) % 3], out = -a.cross(b).normalized();
      const auto step_to = [&](const Vector3d& d) {
        const auto other = static_cast<std::uint32_t>(cell_at(map, d));
        neighbours[c].insert(other);
        neighbours[other].insert(c);
        return other;
      };
      for (int s = 1; s < 16; s += 2) EXPECT_NE(step_to(((16 - s) * a + s * b) / 16 + 1e-9 * out), c);
      const Vector3d ahead = (b - a).normalized();
      for (int s = 0; s < 24; ++s) {
        const double turn = 2 * std::numbers::pi * (s + 0.5) / 24;
        step_to(a + 1e-9 * (std::cos(turn) * ahead + std::sin(turn) * out));
      }
    }
  }
  std::vector<std::set<std::uint32_t>> result;
  std::vector<char> seen(map.cells.size());
  for (std::uint32_t c = 0; c < map.cells.size(); ++c) {
    if (seen[c] || map.cells[c].label == Certified::undecided) continue;
    std::vector<std::uint32_t> stack{c};
    seen[c] = true;
    auto& region = result.emplace_back();
    while (!stack.empty()) {
      const std::uint32_t at_cell = stack.back();
      stack.pop_back();
      region.insert(at_cell);
      for (const std::uint32_t n : neighbours[at_cell])
        if (!seen[n] && map.cells[n].label == map.cells[c].label) {
          seen[n] = true;
          stack.push_back(n);
        }
    }
  }
  return result;
}

TEST(ConeMapRegions, AgreeWithSteppingOverEdges) {
  RandomBodies random(5);
  SCOPED_TRACE(random.trace());
  std::size_t found = 0;
  for (int k = 0; k < share(4); ++k) {
    std::vector<std::pair<Vector3d, double>> blobs;
    for (int i = 0; i < 12; ++i) blobs.emplace_back(random.direction(), random.uniform(0.05, 0.7));
    // Within an odd number of the blobs.
    const DistanceClassifier classifier([&](const Vector3d& d) {
      double nearest = 4;
      int count = 0;
      for (const auto& [centre, radius] : blobs) {
        const double edge = std::atan2(centre.cross(d).norm(), centre.dot(d)) - radius;
        nearest = std::min(nearest, std::abs(edge));
        count += edge < 0;
      }
      return count % 2 ? -nearest : nearest;
    });
    const ConeMap map = cone_map(classifier, at(0.15));
    const auto expected = regions_by_steps(map);
    const auto all = regions(map);
    found += all.size();
    ASSERT_EQ(all.size(), expected.size());
    double sum = 0;
    for (const ConeMapRegion& r : all) {
      const std::set<std::uint32_t> cells(r.cells.begin(), r.cells.end());
      EXPECT_TRUE(std::find(expected.begin(), expected.end(), cells) != expected.end());
      EXPECT_TRUE(std::is_sorted(r.cells.begin(), r.cells.end()));
      double size = 0;
      for (const auto c : r.cells) {
        EXPECT_EQ(map.cells[c].label, r.label);
        size += solid_angle(map.cell(c));
      }
      EXPECT_NEAR(r.solid_angle, size, 1e-13);
      sum += size;
      // Each loop closed by short steps, each step along a cell of the region, on its left.
      for (const auto& loop : r.boundary)
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const Vector3d &a = loop[i], &b = loop[(i + 1) % loop.size()], left = a.cross(b).normalized();
          EXPECT_TRUE(cells.contains(static_cast<std::uint32_t>(cell_at(map, 0.5 * (a + b) + 1e-9 * left))));
          EXPECT_FALSE(cells.contains(static_cast<std::uint32_t>(cell_at(map, 0.5 * (a + b) - 1e-9 * left))));
        }
    }
    EXPECT_NEAR(sum, map.safe + map.colliding, 1e-12);
  }
  EXPECT_GT(found, share(40));
}

TEST(ConeMapRegions, WhereARegionTouchesItselfInACorner) {
  // The five faces of the icosahedron about corner 0: safe, undecided, safe, undecided, undecided.
  ConeMap map = cone_map(DistanceClassifier([](const Vector3d&) { return 0.0; }), at(1.2));
  ASSERT_EQ(map.cells.size(), 20);
  std::map<std::uint32_t, std::size_t> starting;  // by the corner after 0
  for (std::size_t i = 0; i < 20; ++i)
    for (int k = 0; k < 3; ++k)
      if (map.cells[i].corners[k] == 0) starting[map.cells[i].corners[(k + 1) % 3]] = i;
  std::uint32_t next = starting.begin()->first;
  for (int place = 0; place < 5; ++place) {
    auto& cell = map.cells[starting.at(next)];
    if (place == 0 || place == 2) cell.label = Certified::out;
    const auto k = std::find(cell.corners.begin(), cell.corners.end(), 0u) - cell.corners.begin();
    next = cell.corners[(k + 2) % 3];
  }
  const auto all = regions(map);
  ASSERT_EQ(all.size(), 1);
  EXPECT_EQ(all[0].cells.size(), 2);
  ASSERT_EQ(all[0].boundary.size(), 1) << "no hole";
  EXPECT_EQ(all[0].boundary[0].size(), 6);
  EXPECT_TRUE(all[0].surely_separate);
  EXPECT_NEAR(all[0].most_solid_angle, 4 * std::numbers::pi, 1e-12);
}

TEST(ConeMapRegions, WhatIsNoDivisionOfTheSphereIsRefused) {
  const ConeMap whole = cone_map(ring({1, 0, 0}, -1, 4), at(1));
  ConeMap map = whole;
  map.cells[3].corners[1] = 99;
  EXPECT_THROW((void)regions(map), InputError);
  EXPECT_THROW((void)cell_at(map, whole.corners[whole.cells.back().corners[0]]), InputError);
  map = whole;
  map.cells.pop_back();
  EXPECT_THROW((void)regions(map), InputError) << "a hole";
  map = whole;
  std::swap(map.cells[0].corners[0], map.cells[0].corners[1]);
  EXPECT_THROW((void)regions(map), InputError) << "a cell seen from within";
  map = whole;
  map.between[4] = {0, 1};  // corners 4 and 1 divide each other's edges, without end
  map.between[1] = {0, 4};
  map.cells[0].corners = {0, 1, 4};
  EXPECT_THROW((void)regions(map), InputError);
  map = whole;
  map.between[0] = {0, 99};
  EXPECT_THROW((void)regions(map), InputError);
}

}  // namespace
}  // namespace vericone::cone_map_regions_test
