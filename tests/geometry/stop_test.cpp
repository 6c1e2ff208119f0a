// SPDX-License-Identifier: BSD-3-Clause
//
// Long work looks whether it was asked to end: asked before it starts, it ends at its first checkpoint.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <vericone/internal/geometry/hierarchy.h>

#include <thread>
#include <vector>

namespace vericone::stop_test {
namespace {

TEST(Stop, EndsThisThreadWhileTheScopeLives) {
  EXPECT_EQ(stop_of_this_thread(), nullptr);
  EXPECT_NO_THROW(checkpoint());
  Stop stop;
  {
    const StopScope scope(&stop);
    EXPECT_NO_THROW(checkpoint());
    stop.request();
    EXPECT_TRUE(stop_requested());
    EXPECT_THROW(checkpoint(), Interrupted);
  }
  EXPECT_FALSE(stop_requested());
  EXPECT_NO_THROW(checkpoint());
}

TEST(Stop, InnermostScopeCounts) {
  Stop outer, inner;
  outer.request();
  const StopScope whole(&outer);
  {
    const StopScope part(&inner);
    EXPECT_FALSE(stop_requested());
    {
      const StopScope unstoppable(nullptr);
      inner.request();
      EXPECT_FALSE(stop_requested());
    }
    EXPECT_TRUE(stop_requested());
  }
  EXPECT_EQ(stop_of_this_thread(), &outer);
  EXPECT_TRUE(stop_requested());
}

TEST(Stop, BelongsToAThreadAndIsPassedOn) {
  Stop stop;
  const StopScope scope(&stop);
  bool alone = true, helping = false;
  std::thread([&] { alone = stop_requested(); }).join();
  std::thread asking([&] { stop.request(); });
  asking.join();
  std::thread([&, mine = stop_of_this_thread()] {
    const StopScope same(mine);
    helping = stop_requested();
  }).join();
  EXPECT_FALSE(alone);
  EXPECT_TRUE(helping);
}

TEST(Stop, EndsMinimumVolumeEllipsoids) {
  const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Random(3, 100);
  Stop stop;
  const StopScope scope(&stop);
  EXPECT_NO_THROW(static_cast<void>(min_volume_ellipsoid<3>(points)));
  stop.request();
  EXPECT_THROW(static_cast<void>(min_volume_ellipsoid<3>(points)), Interrupted);
}

TEST(Stop, EndsTreesOfManyPieces) {
  std::vector<Box> boxes(10000);
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].low = boxes[i].high = {double(i), 0, 0};
  Stop stop;
  const StopScope scope(&stop);
  const std::size_t nodes = Hierarchy(boxes).nodes().size();
  EXPECT_GT(nodes, 2000);
  stop.request();
  EXPECT_THROW(Hierarchy{boxes}, Interrupted);
}

}  // namespace
}  // namespace vericone::stop_test
