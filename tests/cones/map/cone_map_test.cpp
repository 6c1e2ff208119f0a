// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/map/cell.h>
#include <vericone/internal/cones/map/classifiers.h>

#include <atomic>
#include <stdexcept>

#include "cones/map/cone_map_checks.h"

namespace vericone::cone_map_test {
namespace {

using Eigen::Vector3d;
using testing::cap, testing::RandomBodies, testing::ring;

constexpr double kSphere = 4 * std::numbers::pi;

ConeMapOptions at(double resolution) {
  ConeMapOptions options;
  options.resolution = resolution;
  return options;
}

bool same(const ConeMap& a, const ConeMap& b) {
  return a.corners == b.corners && a.between == b.between && a.asked == b.asked &&
         std::equal(
             a.cells.begin(), a.cells.end(), b.cells.begin(), b.cells.end(),
             [](const auto& x, const auto& y) { return x.corners == y.corners && x.label == y.label; }) &&
         a.colliding == b.colliding && a.safe == b.safe && a.undecided == b.undecided;
}

TEST(ConeMap, CellsCoverTheSphere) {
  RandomBodies random(1);
  SCOPED_TRACE(random.trace());
  const ConeMap map = cone_map(ring({1, 2, 3}, 0.3, 0.7), at(0.02));
  for (std::size_t i = 0; i < map.corners.size(); ++i) {
    EXPECT_LE(map.corners[i].norm(), 1);
    EXPECT_GE(map.corners[i].norm(), 0.79);
    const auto [a, b] = map.between[i];
    EXPECT_EQ(2 * map.corners[i], map.corners[a] + map.corners[b]) << "not exact";
  }
  double sum = 0;
  std::array<int, 3> count{};
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const double area = solid_angle(map.cell(i));
    EXPECT_GT(area, 0);
    sum += area;
    ++count[static_cast<int>(map.cells[i].label)];
  }
  EXPECT_NEAR(sum, kSphere, 1e-12);
  EXPECT_NEAR(map.colliding + map.safe + map.undecided, kSphere, 1e-12);
  EXPECT_GT(*std::min_element(count.begin(), count.end()), 50);
  // Every direction is in one cell; on an edge in two, seen without rounding.
  for (int k = 0; k < 300; ++k) {
    const Vector3d d = random.direction();
    int containing = 0;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const auto [a, b, c] = map.cell(i);
      containing += d.dot(a.cross(b)) > 0 && d.dot(b.cross(c)) > 0 && d.dot(c.cross(a)) > 0;
    }
    EXPECT_EQ(containing, 1);
    const auto [a, b, c] = map.cell(cell_at(map, 1e-200 * d));
    EXPECT_TRUE(d.dot(a.cross(b)) > 0 && d.dot(b.cross(c)) > 0 && d.dot(c.cross(a)) > 0);
  }
}

TEST(ConeMap, PartsOfTheSameLabelAreOneCell) {
  const ConeMap safe = cone_map(ring({1, 0, 0}, -2, -1), at(0.001));
  EXPECT_EQ(safe.cells.size(), 20);
  EXPECT_NEAR(safe.safe, kSphere, 1e-14);
  // A classifier that is slow to see it: undecided at first, safe in the end.
  struct Slow : DirectionClassifier {
    Certified classify(const DirectionCell& cell, const Frontier&, Frontier&) const override {
      return solid_angle(cell) < 1e-3 ? Certified::out : Certified::undecided;
    }
  };
  const ConeMap slow = cone_map(Slow(), at(0.001));
  EXPECT_EQ(slow.cells.size(), 20);
  EXPECT_GT(slow.asked, 10'000);
  EXPECT_EQ(slow.corners.size(), 12);
}

TEST(ConeMap, BallAgainstBallConvergesToItsCircularCone) {
  const double half_angle = std::asin(3.0 / 7.0);
  const EllipsoidClassifier balls(Ellipsoid::from_axes({1, 2, 3}, {1, 1, 1}),
                                  Ellipsoid::from_axes({1 + 2, 2 + 3, 3 + 6}, {2, 2, 2}));
  double before = kSphere;
  for (double resolution = 0.2; resolution > 1e-3; resolution *= 0.5) {
    const ConeMap map = cone_map(balls, at(resolution));
    EXPECT_TRUE(map.complete);
    EXPECT_LE(map.colliding, cap(half_angle) + 1e-12);
    EXPECT_GE(map.colliding + map.undecided, cap(half_angle) - 1e-12);
    // A band as wide as the cells: its area halves with the resolution.
    const double rim = 2 * std::numbers::pi * std::sin(half_angle);
    EXPECT_LT(map.undecided, 1.1 * rim * resolution);
    EXPECT_LT(map.undecided, 0.7 * before);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      if (map.cells[i].label != Certified::undecided) continue;
      const DirectionCell cell = map.cell(i);
      for (int k = 0; k < 3; ++k)
        ASSERT_LE(cell[k].normalized().cross(cell[(k + 1) % 3].normalized()).norm(), resolution);
    }
    before = map.undecided;
  }
}

TEST(ConeMap, MillionsOfCells) {
  ConeMapOptions options = at(5e-5);
  options.most_cells = 3'000'000;
  const ConeMap map = cone_map(ring({0.3, 1, -0.2}, 0.5, 0.8), options);
  EXPECT_TRUE(map.complete);
  EXPECT_GT(map.cells.size(), 1'000'000);
  EXPECT_NEAR(map.colliding + map.safe + map.undecided, kSphere, 1e-12);
  EXPECT_LE(map.colliding, cap(0.8) - cap(0.5));
  EXPECT_GE(map.colliding + map.undecided, cap(0.8) - cap(0.5));
}

TEST(ConeMap, MostCellsAreSpentOnTheLargestFirst) {
  for (const std::uint64_t most : {20, 23, 24, 500, 5000}) {
    ConeMapOptions options = at(1e-4);
    options.most_cells = most;
    const ConeMap map = cone_map(ring({1, 2, 0}, 0.3, 0.9), options);
    EXPECT_LE(map.asked, most);
    EXPECT_GT(map.asked + 4, most);
    EXPECT_FALSE(map.complete);
    EXPECT_LE(map.colliding, cap(0.9) - cap(0.3));
    EXPECT_GE(map.colliding + map.undecided, cap(0.9) - cap(0.3));
    EXPECT_NEAR(map.colliding + map.safe + map.undecided, kSphere, 1e-12);
    double largest = 0, smallest = kSphere;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const double area = solid_angle(map.cell(i));
      smallest = std::min(smallest, area);
      if (map.cells[i].label == Certified::undecided) largest = std::max(largest, area);
    }
    // At most one level apart, four that stayed undecided together, sizes on one level within a factor of
    // two.
    EXPECT_LT(largest, 4 * 4 * 2.1 * smallest) << most;
  }
}

TEST(ConeMap, StopsWhenToldAndKeepsItsPromise) {
  for (const int calls : {1, 2, 5}) {
    ConeMapOptions options = at(1e-4);
    int call = 0;
    double share = 0;
    options.progress = [&](double decided) {
      EXPECT_GE(decided, share);
      EXPECT_LE(decided, 1);
      share = decided;
      return ++call < calls;
    };
    const ConeMap map = cone_map(ring({1, 2, 0}, 0.3, 0.9), options);
    EXPECT_EQ(call, calls);
    EXPECT_FALSE(map.complete);
    EXPECT_NEAR((map.colliding + map.safe) / kSphere, share, 1e-12);
    EXPECT_LE(map.colliding, cap(0.9) - cap(0.3));
    EXPECT_GE(map.colliding + map.undecided, cap(0.9) - cap(0.3));
  }
}

TEST(ConeMap, DoesNotDependOnThreads) {
  const auto classifier = ring({1, -1, 0.1}, 0.2, 1.3);
  ConeMapOptions options = at(0.002);
  const ConeMap one = cone_map(classifier, options);
  for (const int threads : {0, 2, 7}) {
    options.threads = threads;
    EXPECT_TRUE(same(cone_map(classifier, options), one)) << threads;
  }
}

TEST(ConeMap, PassesOnWhatAClassifierThrows) {
  struct Throws : DirectionClassifier {
    mutable std::atomic<int> asked = 0;
    Certified classify(const DirectionCell&, const Frontier&, Frontier&) const override {
      if (++asked > 100) throw std::runtime_error("no more");
      return Certified::undecided;
    }
  };
  for (const int threads : {1, 4}) {
    ConeMapOptions options;
    options.threads = threads;
    EXPECT_THROW(cone_map(Throws(), options), std::runtime_error);
  }
}

TEST(ConeMap, HandsFrontiersFromParentsToChildren) {
  // A frontier holds the indices of the points of a cloud that are within the cell.
  struct Cloud : DirectionClassifier {
    std::vector<Vector3d> points;
    mutable std::atomic<int> looked = 0;
    Frontier start() const override {
      Frontier all(points.size());
      for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
      return all;
    }
    Certified classify(const DirectionCell& c, const Frontier& parent, Frontier& own) const override {
      for (const auto i : parent) {
        const Vector3d& d = points[i];
        ++looked;
        if (d.dot(c[0].cross(c[1])) >= 0 && d.dot(c[1].cross(c[2])) >= 0 && d.dot(c[2].cross(c[0])) >= 0)
          own.push_back(i);
      }
      return own.empty() ? Certified::out : Certified::undecided;
    }
  };
  RandomBodies random(2);
  SCOPED_TRACE(random.trace());
  Cloud cloud;
  for (int i = 0; i < 200; ++i) cloud.points.push_back(random.direction());
  const ConeMap map = cone_map(cloud, at(0.003));
  for (const Vector3d& d : cloud.points) EXPECT_EQ(map.cells[cell_at(map, d)].label, Certified::undecided);
  int levels = 0;
  for (double edge = 1.11; edge > 0.003; edge *= 0.5) ++levels;
  EXPECT_LT(cloud.looked, 200 * (20 + 4 * (levels + 2)));
  EXPECT_LE(map.undecided, 200 * 1e-5);
}

TEST(ConeMap, EllipsoidsAgainstTheExactCone) {
  RandomBodies random(3);
  SCOPED_TRACE(random.trace());
  for (int k = 0; k < 60; ++k) {
    const double factor = k % 3 == 0 ? 1 + random.log_uniform(1e-6, 1e-1) : random.uniform(1.05, 6);
    const auto [a, b] = random.scaled_from_touching(0.1, k % 2 ? 2 : 20, factor);
    const ConeMap map = cone_map(EllipsoidClassifier(a, b), at(0.02));
    const TrueCone cone = true_cone(a, b, 512);
    const ConeBounds bounds = cone_bounds(cone, a, b);
    EXPECT_LE(map.colliding, bounds.outer.solid_angle + 1e-11) << k;
    EXPECT_GE(map.colliding + map.undecided, bounds.inner.solid_angle - 1e-11) << k;
    // Nothing is left undecided that is not at the rim, of at most 2 pi for a convex cone.
    EXPECT_LT(map.undecided, 1.2 * 2 * std::numbers::pi * 0.02) << k;
    const ConeOracle oracle(a, b);
    testing::expect_never_contradicted(map, random, 1000, [&](const Vector3d& d) {
      return oracle.membership(d) == Membership::out ? Certified::out : Certified::in;
    });
  }
}

TEST(ConeMap, RefusesBadOptions) {
  const auto classifier = ring({1, 0, 0}, 0.2, 0.3);
  const auto field = [&](auto change) {
    ConeMapOptions options;
    change(options);
    try {
      cone_map(classifier, options);
    } catch (const InputError& e) {
      return e.field();
    }
    return std::string("accepted");
  };
  for (const double bad : {0.0, -1.0, 1e-9, 2.1, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(field([&](auto& o) { o.resolution = bad; }), "resolution") << bad;
  for (const std::uint64_t bad : {std::uint64_t{0}, std::uint64_t{19}, std::uint64_t{1} << 33})
    EXPECT_EQ(field([&](auto& o) { o.most_cells = bad; }), "most_cells") << bad;
  for (const int bad : {-1, 5000}) EXPECT_EQ(field([&](auto& o) { o.threads = bad; }), "threads") << bad;
}

}  // namespace
}  // namespace vericone::cone_map_test
