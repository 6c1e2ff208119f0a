// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/swarm/swarm.h>
#include <algorithm>
#include <cmath>
#include <vector>

namespace vericone::swarm {
namespace {

using Eigen::Vector3d;
using engagements::Random;

double violation(const std::vector<VelocityHalfSpace>& planes, const Vector3d& v) {
  double most = 0;
  for (const VelocityHalfSpace& plane : planes) most = std::max(most, plane.offset - plane.normal.dot(v));
  return most;
}

/// Both problems are convex: what cannot be bettered nearby, at any scale, is best.
TEST(NearestVelocity, CannotBeBettered) {
  int kept = 0, left = 0;
  for (std::uint64_t k = 0; k < 3000; ++k) {
    Random random(431, k);
    const double fastest = random.uniform(0.5, 3), tight = k % 2 ? -0.2 : 0.4;
    std::vector<VelocityHalfSpace> planes(1 + static_cast<std::size_t>(random.uniform(0, 30)));
    for (VelocityHalfSpace& plane : planes) plane = {random.direction(), fastest * random.uniform(-1, tight)};
    const Vector3d wished = random.uniform(0, 1.3 * fastest) * random.direction();
    const VelocityFound found = nearest_velocity(planes, fastest, wished);
    ASSERT_LE(found.velocity.norm(), fastest * (1 + 1e-12));
    const double broken = violation(planes, found.velocity);
    ASSERT_NEAR(found.violation, broken, 1e-10) << k;
    (broken > 1e-9 ? left : kept) += 1;
    for (int draw = 0; draw < 600; ++draw) {
      const double size = fastest * std::pow(10, random.uniform(-5, 0));
      Vector3d other = found.velocity + size * random.direction();
      if (other.norm() > fastest) other *= fastest / other.norm();
      if (broken > 1e-9) {
        ASSERT_GE(violation(planes, other), broken - 1e-9) << k;
      } else if (violation(planes, other) == 0) {
        ASSERT_GE((other - wished).norm(), (found.velocity - wished).norm() - 1e-9) << k;
      }
    }
  }
  EXPECT_GT(kept, 500);
  EXPECT_GT(left, 500);
}

TEST(NearestVelocity, OfOppositePlanesIsAmidThem) {
  // x >= 1 and x <= -0.5: a quarter, where both are left by 0.75.
  const VelocityFound found =
      nearest_velocity({{Vector3d::UnitX(), 1}, {-Vector3d::UnitX(), 0.5}}, 2, Vector3d::Zero());
  EXPECT_NEAR(found.velocity.x(), 0.25, 1e-12);
  EXPECT_NEAR(found.violation, 0.75, 1e-12);
}

}  // namespace
}  // namespace vericone::swarm
