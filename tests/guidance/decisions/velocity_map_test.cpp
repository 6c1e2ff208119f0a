// SPDX-License-Identifier: BSD-3-Clause
//
// Maps of velocities: what each cell claims against exact verdicts of single velocities, of the bodies as
// they are, not of their parts; shares against shares of samples; windows and gaps as regions.
#include <vericone/guidance/velocity_map.h>

#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <array>
#include <cmath>
#include <iostream>
#include <vector>

#include "guidance/decisions/balls.h"
#include "guidance/decisions/round_pieces.h"
#include "support/campaign.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector3d;
using testing::any_body;
using testing::any_pose;
using testing::campaign_size;
using testing::RandomBodies;

/// An agent and others, with the pairs that single velocities are asked of.
struct Crowd {
  Placed agent{Body()};
  std::vector<Intruder> others;
  VelocityMapOptions options;
  mutable std::vector<Pair> pairs = {};

  VelocityMap map() const {
    for (std::size_t i = pairs.size(); i < others.size(); ++i) pairs.emplace_back(agent, others[i].body);
    return velocity_map(agent, others, options);
  }
  Verdict verdict(std::size_t i, const Vector3d& v, double until) const {
    return pairs[i].verdict(v + options.wind, others[i].velocity, {0, until});
  }
  bool meets(std::size_t i, const Vector3d& v, double until) const {
    const Verdict found = verdict(i, v, until);
    return found == Verdict::in || found == Verdict::overlapping;
  }
  bool meets_any(const Vector3d& v, double until) const {
    for (std::size_t i = 0; i < others.size(); ++i)
      if (meets(i, v, until)) return true;
    return false;
  }
  Vector3d any_velocity(RandomBodies& random, const Vector3d& low, const Vector3d& high) const {
    Vector3d v;
    for (int i = 0; i < 3; ++i) v(i) = low(i) + random.uniform() * (high(i) - low(i));
    return v;
  }
};

bool holds(const VelocityCell& cell, const Vector3d& v) {
  return (cell.low.array() <= v.array()).all() && (v.array() <= cell.high.array()).all();
}

/// Of a velocity in a cell; what is only touched is no contradiction to either.
void expect_as_claimed(const Crowd& crowd, const VelocityCell& cell, const Vector3d& v) {
  if (cell.label == Certified::undecided) return;
  if (cell.label == Certified::out) {
    ASSERT_FALSE(crowd.meets_any(v, crowd.options.until)) << v.transpose();
    return;
  }
  ASSERT_LT(cell.obstacle, crowd.others.size());
  ASSERT_LE(cell.earliest, cell.latest);
  ASSERT_LE(cell.latest, crowd.options.until);
  const Verdict met = crowd.verdict(cell.obstacle, v, std::max(cell.latest * (1 + 1e-9), 1e-300));
  ASSERT_TRUE(met != Verdict::out) << v.transpose();
  if (cell.earliest > 0) {
    ASSERT_FALSE(crowd.meets_any(v, cell.earliest * (1 - 1e-9))) << v.transpose();
  }
  if (!cell.first) return;
  for (std::size_t i = 0; i < crowd.others.size(); ++i)
    ASSERT_TRUE(i == cell.obstacle || !crowd.meets(i, v, cell.latest * (1 - 1e-9))) << v.transpose();
}

TEST(VelocityMaps, ClaimWhatSingleVelocitiesDo) {
  RandomBodies random(3851);
  SCOPED_TRACE(random.trace());
  using enum BodyKind;
  int firsts = 0, colliding = 0, safe = 0, decided = 0, undecided = 0;
  for (int i = 0; i < campaign_size(14, 1400); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Crowd crowd;
    crowd.agent = Placed(i % 3 == 0   ? any_body(random, hull)
                         : i % 5 == 1 ? any_body(random, convex)
                                      : Body(Ellipsoid::from_axes({0, 0, 0}, {0.5, 0.8, 0.3})));
    const int count = i % 7 == 6 ? 60 : 1 + i % 6;
    while (static_cast<int>(crowd.others.size()) < count) {
      // Kinds mixed in one world.
      const BodyKind kind = std::array{
          ellipsoid, hull, mesh, cloud, boxes, combined, pieces, convex}[std::size_t(random.integer(0, 7))];
      const bool round = kind == pieces && random.coin();
      const Placed body(round ? round_pieces(random) : any_body(random, kind),
                        any_pose(random, random.uniform(5, count > 6 ? 40 : 15)));
      if (Pair(crowd.agent, body).relation() == Relation::disjoint)
        crowd.others.push_back({body, random.uniform(0, 2) * random.direction()});
    }
    crowd.options.until = random.uniform(4, 15);
    const Vector3d half(random.uniform(0.5, 2), random.uniform(0.5, 2), random.uniform(0.5, 2));
    const Vector3d middle = crowd.others[0].body.pose.position / 4 + crowd.others[0].velocity;
    crowd.options.low = middle - half;
    crowd.options.high = middle + half;
    if (i % 2 == 0) crowd.options.high.z() = crowd.options.low.z() = middle.z();
    crowd.options.resolution = i % 2 == 0 ? 0.05 : 0.3;
    if (i % 3 == 1) crowd.options.time = 0.5;
    if (i % 5 == 4) crowd.options.wind = 0.5 * random.direction();
    const VelocityMap map = crowd.map();
    ASSERT_TRUE(map.complete);
    ASSERT_NEAR(map.colliding + map.safe + map.undecided, 1, 1e-12);
    for (int k = 0; k < 300; ++k) {
      const Vector3d v = crowd.any_velocity(random, crowd.options.low, crowd.options.high);
      int held = 0;
      for (const VelocityCell& cell : map.cells)
        if (holds(cell, v)) {
          ++held;
          expect_as_claimed(crowd, cell, v);
          ++(cell.label == Certified::in ? colliding : cell.label == Certified::out ? safe : undecided);
          firsts += cell.first;
        }
      ASSERT_GE(held, 1) << v.transpose();
    }
    // Corners, where a claim is closest to being wrong.
    for (int k = 0; k < 200; ++k) {
      const auto& cell = map.cells[std::size_t(random.integer(0, static_cast<int>(map.cells.size()) - 1))];
      Vector3d v;
      for (int axis = 0; axis < 3; ++axis) v(axis) = random.coin() ? cell.low(axis) : cell.high(axis);
      expect_as_claimed(crowd, cell, v);
      decided += cell.label != Certified::undecided;
    }
  }
  std::cout << "[ velocities ] " << colliding << " colliding, " << firsts << " of them by whom first; "
            << safe << " safe, " << undecided << " undecided; " << decided << " corners\n";
  EXPECT_GT(colliding, 300);
  EXPECT_GT(firsts, colliding / 4);
  EXPECT_GT(safe, 300);
  EXPECT_LT(undecided, (colliding + safe) / 2);
}

TEST(VelocityMaps, OfADiscIsItsTruncatedCone) {
  // In the plane through its centre: of the directions, that within asin(r / c) of it; of those, what arrives
  // in time. The set of all is scaled by the speed, so its area is that of the cone less that of the cap.
  Crowd crowd;
  crowd.agent = ball(Vector3d::Zero(), 1);
  crowd.others = {{ball({10, 0, 0}, 1), Vector3d::Zero()}};
  crowd.options.until = 5;
  crowd.options.low = {-1, -4, 0};
  crowd.options.high = {6, 4, 0};
  // v_x up to 6 within the box; the boundary nearest to the origin is |T v - c| = 2, seen from 0.
  const double angle = std::asin(0.2);
  double area = 0;
  constexpr int kStrips = 200'000;
  for (int k = 0; k < kStrips; ++k) {
    const double theta = angle * (2 * (k + 0.5) / kStrips - 1);
    const double near = (10 * std::cos(theta) - std::sqrt(4 - std::pow(10 * std::sin(theta), 2))) / 5;
    const double far = 6 / std::cos(theta);
    area += 0.5 * (far * far - near * near) * 2 * angle / kStrips;
  }
  const double expected = area / (7 * 8);
  double before = 1;
  for (const double resolution : {0.4, 0.2, 0.1, 0.05, 0.025}) {
    crowd.options.resolution = resolution;
    const VelocityMap map = crowd.map();
    EXPECT_LE(map.colliding, expected + 1e-9);
    EXPECT_GE(map.colliding + map.undecided, expected - 1e-9);
    EXPECT_LT(map.undecided, 0.62 * before);  // a line of cells, half as wide each time
    before = map.undecided;
    for (const VelocityCell& cell : map.cells)
      if (cell.label == Certified::undecided) {
        ASSERT_LE((cell.high - cell.low).maxCoeff(), resolution);
      }
  }
  EXPECT_LT(before, 0.02);
}

TEST(VelocityMaps, ShowsTheWindowAsARegionOfItsOwn) {
  // A wall with a window; velocities that all arrive, and none past its rim.
  std::vector<Box> boxes;
  for (int i = -10; i < 10; ++i)
    for (int j = -10; j < 10; ++j)
      if (i < 1 || i > 4 || j < -2 || j > 1)
        boxes.push_back({{5, 0.5 * i, 0.5 * j}, {5.2, 0.5 * i + 0.5, 0.5 * j + 0.5}});
  Crowd crowd;
  crowd.agent = Placed(Ellipsoid::from_axes({0, 0, 0}, {0.3, 0.2, 0.2}));
  crowd.others = {{Placed(Body(Assembly::boxes(boxes))), Vector3d::Zero()}};
  crowd.options.until = 20;
  crowd.options.low = {2, -1.5, -1.5};
  crowd.options.high = {2, 1.5, 1.5};
  crowd.options.resolution = 0.05;
  const VelocityMap map = crowd.map();
  EXPECT_EQ(map.safe_regions, 1);
  int through = 0;
  for (const VelocityCell& cell : map.cells)
    if (cell.label == Certified::out) {
      ++through;
      const Vector3d middle = 0.5 * (cell.low + cell.high) / 2 * 5;  // where it crosses the wall
      EXPECT_TRUE(middle.y() > 0.5 && middle.y() < 2.5 && middle.z() > -1 && middle.z() < 1);
    }
  EXPECT_GT(through, 10);
  EXPECT_GT(map.colliding, 0.5);
  // With a pole in it: two ways, apart.
  crowd.options.resolution = 0.025;
  crowd.others.push_back(
      {Placed(Ellipsoid::from_axes({0, 0, 0}, {0.2, 0.1, 9}), Pose{{4, 1.2, 0}}), {0, 0, 0}});
  EXPECT_EQ(crowd.map().safe_regions, 2);
}

TEST(VelocityMaps, SayWhenAndWhoWithinTheTimeAskedFor) {
  Crowd crowd;
  crowd.agent = ball(Vector3d::Zero(), 0.5);
  crowd.others = {{ball({10, 0, 0}, 1), {-1, 0, 0}}, {ball({8, 3, 0}, 2), {0, -1, 0}}};
  crowd.options = {.low = {0, -2, 0}, .high = {5, 2, 0}, .resolution = 0.01, .until = 10, .time = 0.2};
  const VelocityMap map = crowd.map();
  std::array<int, 2> by{};
  double wide = 0, all = 0;
  for (const VelocityCell& cell : map.cells) {
    if (cell.label != Certified::in) continue;
    const double size = (cell.high - cell.low).head<2>().prod();
    all += size;
    if (cell.latest - cell.earliest > 0.2) wide += size;
    if (cell.first) ++by[cell.obstacle];
  }
  EXPECT_GT(by[0], 50);
  EXPECT_GT(by[1], 50);
  EXPECT_LT(wide, 0.05 * all);
}

TEST(VelocityMaps, KeepAMargin) {
  // That of a ball is a larger ball.
  RandomBodies random(3852);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < campaign_size(3, 100); ++i) {
    Crowd crowd, larger;
    crowd.agent = larger.agent = Placed(Ellipsoid::from_axes({0, 0, 0}, {0.5, 0.8, 0.3}));
    const Vector3d at = random.uniform(6, 12) * random.direction();
    crowd.others = {{ball(at, 1), Vector3d::Zero()}};
    larger.others = {{ball(at, 1.4), Vector3d::Zero()}};
    crowd.options = {
        .low = at / 6 - Vector3d(1, 1, 0), .high = at / 6 + Vector3d(1, 1, 0), .resolution = 0.1, .until = 9};
    larger.options = crowd.options;
    crowd.options.margin = 0.4;
    static_cast<void>(larger.map());
    const VelocityMap map = crowd.map();
    EXPECT_LT(map.undecided, 0.3);
    for (int k = 0; k < 500; ++k) {
      const Vector3d v = crowd.any_velocity(random, crowd.options.low, crowd.options.high);
      for (const VelocityCell& cell : map.cells)
        if (holds(cell, v)) {
          if (cell.label == Certified::out) {
            ASSERT_FALSE(larger.meets(0, v, 9));
          } else if (cell.label == Certified::in) {
            ASSERT_TRUE(larger.meets(0, v, 9));
          }
        }
    }
  }
}

TEST(VelocityMaps, StopsAtSoManyCellsAndRefusesWhatIsNone) {
  Crowd crowd;
  crowd.agent = ball(Vector3d::Zero(), 1);
  crowd.others = {{ball({10, 0, 0}, 1), Vector3d::Zero()}};
  crowd.options.resolution = 1e-3;
  crowd.options.low = {0, -1, -1};
  crowd.options.high = {4, 1, 1};
  crowd.options.most_cells = 100;
  const VelocityMap map = crowd.map();
  EXPECT_FALSE(map.complete);
  EXPECT_LE(map.asked, 100);
  EXPECT_GT(map.undecided, 0);
  const auto refused = [](auto&& set) {
    Crowd one;
    set(one.options);
    try {
      static_cast<void>(one.map());
    } catch (const InputError& error) {
      return error.field();
    }
    return std::string("nothing");
  };
  EXPECT_EQ(refused([](VelocityMapOptions& o) { o.low.x() = NAN; }), "low[0]");
  EXPECT_EQ(refused([](VelocityMapOptions& o) { o.high.y() = -2; }), "high[1]");
  EXPECT_EQ(refused([](VelocityMapOptions& o) { o.resolution = 0; }), "resolution");
  EXPECT_EQ(refused([](VelocityMapOptions& o) { o.until = INFINITY; }), "until");
  EXPECT_EQ(refused([](VelocityMapOptions& o) { o.margin = -1; }), "margin");
  EXPECT_EQ(refused([](VelocityMapOptions& o) { o.time = 0; }), "time");
  EXPECT_EQ(refused([](VelocityMapOptions& o) { o.most_cells = 0; }), "most_cells");
  EXPECT_EQ(refused([](VelocityMapOptions&) {}), "nothing");
}

}  // namespace
}  // namespace vericone::guidance
