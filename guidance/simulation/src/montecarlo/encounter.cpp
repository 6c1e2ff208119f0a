// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/cone_geometry.h>
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/internal/simulation/montecarlo/flight.h>
#include <vericone/simulation/montecarlo/campaign.h>
#include <cmath>
#include <numbers>

namespace vericone::montecarlo {
namespace {

using Eigen::Vector3d;
using engagements::Random;

constexpr double kSlowest = 5, kFastest = 15;  // m/s
constexpr double kLeastClosing = 3;            // m/s, of the relative velocity
/// Squared offset of the aim, uniform up to this, in parts of the squared extent of both bodies across.
constexpr double kFarthestAim = 1.85;

simulation::Body body(const char* name, const Ellipsoid& ellipsoid, const Vector3d& velocity) {
  simulation::Body result;
  result.name = name;
  const Eigen::Matrix3d& factor = ellipsoid.factor();
  const Vector3d axes = factor.colwise().norm();
  result.shape = simulation::RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), axes))};
  result.start = {ellipsoid.center(), velocity, factor * axes.cwiseInverse().asDiagonal()};
  result.orientation = simulation::Orientation::heading;
  return result;
}

/// Where the agent aims, seen from it: beside the obstacle's centre.
Vector3d aim(const Ellipsoid& a, const Ellipsoid& b, Random& random) {
  const Vector3d c = b.center() - a.center();
  const AxisFrame frame(c);
  const double azimuth = random.uniform(0, 2 * std::numbers::pi);
  const Vector3d aside = frame.across(azimuth);
  const double extent = a.radius(aside) + b.radius(aside);
  return c + extent * std::sqrt(random.uniform(0, kFarthestAim)) * aside;
}

}  // namespace

double Encounter::scale() const {
  return (obstacle.start.position - agent.start.position).norm() / relative_velocity().norm();
}

Encounter random_encounter(std::uint64_t seed, std::uint64_t index) {
  const auto [a, b] = engagements::random_engagement(seed, index);
  Random random(~seed, index);  // not the numbers that made the bodies
  const Vector3d along = aim(a, b, random).normalized();
  const double speed_a = random.uniform(kSlowest, kFastest), speed_b = random.uniform(kSlowest, kFastest);
  // v_A = v_B + s along with the speed wanted; an obstacle that is too fast for it is drawn again.
  for (;;) {
    const Vector3d v_b = speed_b * random.direction();
    const double across = v_b.dot(along);
    const double root = across * across + speed_a * speed_a - speed_b * speed_b;
    if (!(root >= 0)) continue;
    const double s = -across + std::sqrt(root);
    if (!(s >= kLeastClosing)) continue;
    return {body("agent", a, v_b + s * along), body("obstacle", b, v_b)};
  }
}

}  // namespace vericone::montecarlo
