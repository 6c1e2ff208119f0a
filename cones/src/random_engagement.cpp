// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/internal/geometry/mixed.h>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

namespace vericone::engagements {

Random::Random(std::uint64_t seed, std::uint64_t index)
    : state_(seed * 0x9e3779b97f4a7c15 + 0x2545f4914f6cdd1d) {
  state_ ^= next() + index;
  next();
}

std::uint64_t Random::next() {
  const std::uint64_t z = detail::mixed(state_);
  state_ += 0x9e3779b97f4a7c15;
  return z;
}

void Random::fill(std::uint64_t seed, std::uint64_t first, std::uint64_t number, std::span<double> u) {
  constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15;
  // Without its index, and without the step that the constructor ends with.
  const std::uint64_t mask = seed * kStep + 0x2545f4914f6cdd1d + kStep, begin = detail::mixed(mask - kStep);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const std::uint64_t state = (mask ^ (begin + first + i)) + (number + 1) * kStep;
    u[i] = (static_cast<double>(detail::mixed(state) >> 12) + 0.5) * 0x1p-52;
  }
}

double Random::uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

Eigen::Vector3d Random::direction() {
  const double z = uniform(-1, 1), azimuth = uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

Eigen::Matrix3d Random::rotation() {
  const double u = uniform(), v = uniform(0, 2 * std::numbers::pi), w = uniform(0, 2 * std::numbers::pi);
  const double p = std::sqrt(1 - u), q = std::sqrt(u);
  return Eigen::Quaterniond(p * std::sin(v), p * std::cos(v), q * std::sin(w), q * std::cos(w))
      .normalized()
      .toRotationMatrix();
}

namespace {

Eigen::Vector3d semi_axes(Random& random, double low, double high) {
  const double a = random.uniform(low, high), b = random.uniform(low, high), c = random.uniform(low, high);
  return {a, b, c};
}

struct Drawn {
  Ellipsoid a, b;
  Eigen::Vector3d axes_b;
  Eigen::Matrix3d rotation_b;
};

Drawn draw(Random& random, const Distribution& from) {
  const auto [low, high] = from.semi_axes;
  const Eigen::Vector3d axes_a = semi_axes(random, low, high), axes_b = semi_axes(random, low, high);
  const Eigen::Matrix3d rotation_a = random.rotation(), rotation_b = random.rotation();
  const Eigen::Vector3d d = random.direction();
  const Ellipsoid a = Ellipsoid::from_axes(Eigen::Vector3d::Zero(), axes_a, rotation_a);
  const Ellipsoid b = Ellipsoid::from_axes(Eigen::Vector3d::Zero(), axes_b, rotation_b);
  const double distance =
      from.distance ? random.uniform(from.distance->low, from.distance->high)
                    : (a.radius(d) + b.radius(d)) * random.uniform(from.spacing.low, from.spacing.high);
  return {a, b.translated(distance * d), axes_b, rotation_b};
}

std::vector<Delimiter<3>> random_delimiters(ObstacleKind kind, const Drawn& drawn, Random& random) {
  constexpr double kLeast = 0.3, kMost = 0.8;
  std::vector<Delimiter<3>> delimiters;
  const int count = kind == ObstacleKind::star ? 3 : 1;
  for (int i = 0; i < count; ++i) {
    const double u = random.uniform(kLeast, kMost), v = random.uniform(kLeast, 1);
    const Eigen::Matrix3d turn = kind == ObstacleKind::star ? random.rotation() : drawn.rotation_b;
    Eigen::Vector3d axes = drawn.axes_b;
    if (kind == ObstacleKind::star)
      for (int k = 0; k < 3; ++k) axes(k) = 1 / CombinedEllipsoid(drawn.b).gauge(turn.col(k));
    if (kind == ObstacleKind::biconvex) {
      delimiters.push_back(hyperboloid(1, axes.cwiseProduct(Eigen::Vector3d(v, u, u)), turn));
    } else {
      delimiters.push_back(hyperboloid(2, axes.cwiseProduct(Eigen::Vector3d(u, v, v)), turn));
    }
  }
  return delimiters;
}

}  // namespace

std::pair<Ellipsoid, Ellipsoid> random_engagement(std::uint64_t seed, std::uint64_t index,
                                                  const Distribution& from) {
  Random random(seed, index);
  const Drawn drawn = draw(random, from);
  return {drawn.a, drawn.b};
}

std::pair<Ellipsoid, CombinedEllipsoid> random_combined_engagement(ObstacleKind kind, std::uint64_t seed,
                                                                   std::uint64_t index,
                                                                   const Distribution& from) {
  Random random(seed, index);
  const Drawn drawn = draw(random, from);
  if (kind == ObstacleKind::ellipsoid) return {drawn.a, drawn.b};
  return {drawn.a, CombinedEllipsoid(drawn.b, random_delimiters(kind, drawn, random))};
}

Ellipsoid random_agent(const Ellipsoid& obstacle, std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  const double mean = obstacle.semi_axes().mean();
  const Eigen::Vector3d axes = semi_axes(random, 0.2 * mean, mean);
  const Ellipsoid agent = Ellipsoid::from_axes(Eigen::Vector3d::Zero(), axes, random.rotation());
  const Eigen::Vector3d d = random.direction();
  const double distance = (agent.radius(d) + obstacle.radius(d)) * random.uniform(1.5, 3);
  return agent.translated(obstacle.center() - distance * d);
}

}  // namespace vericone::engagements
