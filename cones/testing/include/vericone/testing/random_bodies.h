// SPDX-License-Identifier: BSD-3-Clause
//
// Random bodies that are the same on every platform for a seed: no std distributions.
#pragma once

#include <vericone/geometry/body.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>

namespace vericone::testing {

/// x moved by `count` representable numbers.
[[nodiscard]] inline double moved_by_ulps(double x, int count) {
  const double target = std::copysign(std::numeric_limits<double>::infinity(), count);
  for (int i = 0; i < std::abs(count); ++i) x = std::nextafter(x, target);
  return x;
}

/// The environment variable VERICONE_SEED replaces the seed that a test names.
class RandomBodies {
 public:
  explicit RandomBodies(std::uint64_t seed) : seed_(replaced(seed)), engine_(seed_) {}

  /// For SCOPED_TRACE, so that a failure tells how to repeat it.
  [[nodiscard]] std::string trace() const { return "VERICONE_SEED=" + std::to_string(seed_); }

  /// In [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  /// Both ends included.
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool coin() { return (engine_() >> 63) != 0; }

  Eigen::Vector2d direction_2d() {
    const double angle = uniform(-std::numbers::pi, std::numbers::pi);
    return {std::cos(angle), std::sin(angle)};
  }
  Eigen::Vector3d direction() {
    const double z = uniform(-1, 1), r = std::sqrt(1 - z * z);
    const Eigen::Vector2d e = direction_2d();
    return {r * e.x(), r * e.y(), z};
  }
  Eigen::Vector3d in_box(double half) {
    return {uniform(-half, half), uniform(-half, half), uniform(-half, half)};
  }
  /// Uniform over all rotations (Shoemake 1992).
  Eigen::Matrix3d rotation() {
    const double u = uniform();
    const Eigen::Vector2d p = std::sqrt(1 - u) * direction_2d(), q = std::sqrt(u) * direction_2d();
    return rotation_3d(Eigen::Vector4d(p.x(), p.y(), q.x(), q.y()));
  }
  Eigen::Vector3d ulps(const Eigen::Vector3d& v, int most) {
    Eigen::Vector3d r;
    for (int i = 0; i < 3; ++i) r(i) = moved_by_ulps(v(i), integer(-most, most));
    return r;
  }

  /// Semi-axes between `low` and `high`, evenly in their logarithm when the range is wide.
  double semi_axis(double low, double high) {
    return high > 20 * low ? log_uniform(low, high) : uniform(low, high);
  }
  Ellipsoid ellipsoid(const Eigen::Vector3d& center, double low, double high) {
    const double x = semi_axis(low, high), y = semi_axis(low, high), z = semi_axis(low, high);
    return Ellipsoid::from_axes(center, {x, y, z}, rotation());
  }
  Ellipse ellipse(const Eigen::Vector2d& center, double low, double high) {
    const double x = semi_axis(low, high), y = semi_axis(low, high);
    return Ellipse::from_axes(center, {x, y}, rotation_2d(uniform(-std::numbers::pi, std::numbers::pi)));
  }

  using Pair = std::pair<Ellipsoid, Ellipsoid>;
  using PlanarPair = std::pair<Ellipse, Ellipse>;

  /// The line of centres separates the bodies: they are `factor` times rho_A(d) + rho_B(d) apart along it.
  Pair separated_along_centers(double low, double high, double factor) {
    const Ellipsoid a = ellipsoid(in_box(5), low, high), b = ellipsoid({0, 0, 0}, low, high);
    const Eigen::Vector3d d = direction();
    return {a, b.translated(a.center() + factor * (a.radius(d) + b.radius(d)) * d)};
  }

  /// The bodies are `factor` times as far apart as when they touch on this line of centres, which need not
  /// separate them.
  Pair scaled_from_touching(double low, double high, double factor) {
    const Ellipsoid a = ellipsoid(in_box(5), low, high), b = ellipsoid({0, 0, 0}, low, high);
    const Eigen::Vector3d d = direction();
    const double touching = 1 / std::sqrt(ContactFrame<3>(a, b.translated(a.center() + d)).contact);
    return {a, b.translated(a.center() + factor * touching * d)};
  }
  PlanarPair planar_scaled_from_touching(double low, double high, double factor) {
    const Ellipse a = ellipse({uniform(-5, 5), uniform(-5, 5)}, low, high), b = ellipse({0, 0}, low, high);
    const Eigen::Vector2d d = direction_2d();
    const double touching = 1 / std::sqrt(ContactFrame<2>(a, b.translated(a.center() + d)).contact);
    return {a, b.translated(a.center() + factor * touching * d)};
  }

 private:
  [[nodiscard]] static std::uint64_t replaced(std::uint64_t seed) {
    const char* given = std::getenv("VERICONE_SEED");
    return given ? std::strtoull(given, nullptr, 10) : seed;
  }

  std::uint64_t seed_;
  std::mt19937_64 engine_;
};

// Random bodies of every kind, the same on every platform for a seed.

/// About the origin, between 1 and 4 m large: ellipsoids; one to three hyperboloids that cut one; hulls of 6
/// to 12 points; 7 triangles, 9 balls, 6 boxes; unions of two quadrics, or of four hulls.
Body any_body(RandomBodies& random, BodyKind kind);

/// Any rotation; `distance` metres from the origin in any direction.
Pose any_pose(RandomBodies& random, double distance);

}  // namespace vericone::testing
