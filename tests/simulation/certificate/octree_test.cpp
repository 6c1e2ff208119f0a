// SPDX-License-Identifier: BSD-3-Clause
//
// What stands for many pieces in certificates of runs: octrees, whose text is read here apart, and boxes that
// hold runs of pieces. tests/cli/run_certificate_test.py has them read by the checker.
#include "certificate/octree.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "certificate/planes.h"
#include "certificate/solid.h"
#include "certificate/tube.h"
#include "simulation/moving_pairs.h"
#include "simulation/random.h"

namespace vericone::simulation::certificate_test {
namespace {

using namespace certified;
using Eigen::Vector3d;
using Place = std::tuple<int, int, int>;

/// The smallest cells of a tree, its text read as the format's page has it.
class Cells {
 public:
  explicit Cells(const Octree& octree) : octree_(octree) { node({0, 0, 0}, 1 << octree.depth); }
  std::set<Place> places;
  std::vector<std::pair<Place, int>> whole;  // in their order, with their edge
  [[nodiscard]] bool at_end() const { return at_ == octree_.tree.size(); }

 private:
  void node(const Place& low, int edge) {
    const std::string block = octree_.tree.substr(at_, 8);
    at_ += 8;
    for (int bits = 0; bits < 8; ++bits) {
      const auto [x, y, z] = low;
      const Place eighth{x + edge * (bits & 1), y + edge * (bits >> 1 & 1), z + edge * (bits >> 2)};
      const char what = block.at(static_cast<std::size_t>(bits));
      if (what == '+') node(eighth, edge / 2);
      if (what == '#') fill(eighth, edge);
    }
  }
  void fill(const Place& low, int edge) {
    whole.emplace_back(low, edge);
    const auto [x, y, z] = low;
    for (int i = 0; i < edge; ++i)
      for (int j = 0; j < edge; ++j)
        for (int k = 0; k < edge; ++k) EXPECT_TRUE(places.insert({x + i, y + j, z + k}).second);
  }

  const Octree& octree_;
  std::size_t at_ = 0;
};

int whole_number(Random& random, int low, int high) {
  return static_cast<int>(std::floor(random.uniform(low, high + 1 - 1e-9)));
}

TEST(Octree, IsTheBoxesThatItIsOf) {
  Random random(71);
  for (int run = 0; run < 60; ++run) {
    const double edge = run % 2 == 0 ? 0.1 : 0.25;
    const Vector3d shift = run % 3 == 0 ? Vector3d(0.0371, -5.2, 1e3) : Vector3d(Vector3d::Zero());
    std::vector<Box> boxes{{shift, shift + Vector3d::Constant(edge)}};
    std::set<Place> expected{{0, 0, 0}};
    for (int k = 0; k < 40; ++k) {
      const int x = whole_number(random, -20, 20), y = whole_number(random, -9, 9),
                z = whole_number(random, -9, 9);
      const int a = whole_number(random, 1, 4), b = whole_number(random, 1, 4),
                c = whole_number(random, 1, 3);
      boxes.push_back({shift + edge * Vector3d(x, y, z), shift + edge * Vector3d(x + a, y + b, z + c)});
      for (int i = 0; i < a; ++i)
        for (int j = 0; j < b; ++j)
          for (int l = 0; l < c; ++l) expected.insert({x + i, y + j, z + l});
    }
    const auto octree = octree_of(boxes);
    ASSERT_TRUE(octree) << run;
    EXPECT_NEAR(octree->cell, edge, 1e-12);
    EXPECT_LT(octree->rounding, 1e-11);
    const Cells cells(*octree);
    EXPECT_TRUE(cells.at_end());
    ASSERT_EQ(cells.whole.size(), octree->boxes.size());
    const Vector3d first = (octree->low - shift) / octree->cell;
    std::set<Place> found;
    for (const auto& [x, y, z] : cells.places)
      found.insert({x + static_cast<int>(std::lround(first.x())),
                    y + static_cast<int>(std::lround(first.y())),
                    z + static_cast<int>(std::lround(first.z()))});
    EXPECT_EQ(found, expected);
    for (std::size_t k = 0; k < cells.whole.size(); ++k) {
      const auto [x, y, z] = cells.whole[k].first;
      const Vector3d low = octree->low + octree->cell * Vector3d(x, y, z);
      EXPECT_LT((octree->boxes[k].low - low).norm(), 1e-9);
      EXPECT_LT((octree->boxes[k].high - low).maxCoeff(), octree->cell * cells.whole[k].second + 1e-9);
    }
  }
}

TEST(Octree, IsNoneOfOtherBoxes) {
  const Box one{{0, 0, 0}, {1, 1, 1}};
  EXPECT_FALSE(octree_of({one}));
  EXPECT_FALSE(octree_of({one, {{2, 0, 0}, {3.4, 1, 1}}}));          // no whole cells
  EXPECT_FALSE(octree_of({one, {{2.3, 0, 0}, {3.3, 1, 1}}}));        // between cells
  EXPECT_FALSE(octree_of({one, {{2, 0, 0}, {2, 1, 1}}}));            // flat
  EXPECT_FALSE(octree_of({one, {{1e12, 0, 0}, {1e12 + 1, 1, 1}}}));  // far away
}

/// A tunnel of small boxes, along x.
Assembly tunnel(double shift) {
  std::vector<Box> boxes;
  for (int x = -20; x < 20; ++x)
    for (int y = -5; y < 5; ++y)
      for (int z = -5; z < 5; ++z)
        if (std::max({y, -1 - y, z, -1 - z}) == 4) {
          const Vector3d low(0.5 * x, 0.5 * y + shift * (x % 3), 0.5 * z);
          boxes.push_back({low, low + Vector3d::Constant(0.5)});
        }
  return Assembly::boxes(boxes);
}

TEST(RunCertificate, BoxesStandForManyPieces) {
  const Track a = straight(ball(1), {-12, 0.1, -0.2}, {3, 0, 0}, 8);
  for (const double shift : {0.0, 1e-3}) {
    const ShapeInTime walls = RigidShape{WorldBody(Placed(vericone::Body(tunnel(shift))))};
    const Track b = straight(walls, {0, 0, 0}, {0, 0, 0}, 8);
    const Solid of_a = in_own_frame(a.shape(), 0, 8).solid, of_b = in_own_frame(b.shape(), 0, 8).solid;
    EXPECT_EQ(of_b.kind, shift == 0 ? Solid::Kind::octree : Solid::Kind::boxes);
    EXPECT_EQ(of_b.size(), of_b.boxes.size());
    const TubeQuestion question{0, 8, 1e-4, 12, true, 1e-8};
    const auto tube_a = tube(a, question), tube_b = tube(b, question);
    std::string reason;
    const auto proof = proof_of_pair({of_a, of_b, *tube_a, *tube_b, 0.7, 0, 8}, reason);
    ASSERT_TRUE(proof) << reason;  // the walls are 0.8 m from the ball
    EXPECT_NE(proof->find("\"cover\""), std::string::npos);
    EXPECT_LT(proof->size(), 100'000U);
    EXPECT_FALSE(proof_of_pair({of_a, of_b, *tube_a, *tube_b, 0.9, 0, 8}, reason));
  }
}

}  // namespace
}  // namespace vericone::simulation::certificate_test
