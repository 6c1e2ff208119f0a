// SPDX-License-Identifier: BSD-3-Clause
//
// The engagements every benchmark is run on: the same for the library and for its peers.
#pragma once

#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace vericone::benchmarks {

struct Placed {
  Eigen::Vector3d semi_axes;
  Eigen::Matrix3d rotation;
  Eigen::Vector3d center;

  Ellipsoid body() const { return Ellipsoid::from_axes(center, semi_axes, rotation); }
};

struct Engagement {
  Placed placed_a, placed_b;
  Ellipsoid a, b;
  Eigen::Vector3d w;       // velocity of A relative to B, unit
  Eigen::Vector3d across;  // spans the plane of planar questions together with the line of centres
  SpatialMotion motion;    // for rates
  bool aimed;              // w was aimed near the cone's boundary, else anywhere

  /// Distance that A travels along w before it has certainly passed B.
  double horizon() const {
    return (b.center() - a.center()).norm() + placed_a.semi_axes.maxCoeff() + placed_b.semi_axes.maxCoeff();
  }
};

/// Numbers that are the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  double uniform(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform(0x1p-60, 1)));
    return radius * std::cos(uniform(0, 2 * std::numbers::pi));
  }

  Eigen::Vector3d direction() {
    const double x = normal(), y = normal(), z = normal();
    return Eigen::Vector3d(x, y, z).normalized();
  }

  Eigen::Matrix3d rotation() {
    const double w = normal(), x = normal(), y = normal(), z = normal();
    return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  }

 private:
  std::mt19937_64 engine_;
};

/// Semi-axes uniform in 1..10, any attitude, centres at 1.5 to 3 times rho_A(d) + rho_B(d) along a random d.
/// Every second velocity is aimed within `aim` radians of the cone's boundary, inside and outside alike; the
/// others point anywhere.
inline std::vector<Engagement> engagements(int count, double aim = 0.2, std::uint64_t seed = 1) {
  Dice dice(seed);
  const auto semi_axes = [&] {
    const double x = dice.uniform(1, 10), y = dice.uniform(1, 10), z = dice.uniform(1, 10);
    return Eigen::Vector3d(x, y, z);
  };
  std::vector<Engagement> all;
  all.reserve(count);
  for (int i = 0; i < count; ++i) {
    Engagement e;
    e.placed_a = {semi_axes(), dice.rotation(), dice.uniform(-20, 20) * dice.direction()};
    e.placed_b = {semi_axes(), dice.rotation(), Eigen::Vector3d::Zero()};
    e.a = e.placed_a.body();
    const Eigen::Vector3d d = dice.direction();
    const double width = e.a.radius(d) + e.placed_b.body().radius(d);
    e.placed_b.center = e.placed_a.center + dice.uniform(1.5, 3) * width * d;
    e.b = e.placed_b.body();
    e.across = dice.direction();
    e.motion.v_a = dice.direction();
    e.motion.v_b = dice.direction();
    e.motion.omega_a = dice.direction();
    e.motion.omega_b = dice.direction();
    e.aimed = i % 2 == 0;
    e.w = dice.direction();
    if (e.aimed) {
      const TrueCone cone = true_cone(e.a, e.b, 16);
      const BoundarySample& s = cone.boundary[static_cast<std::size_t>(dice.uniform(0, 16))];
      const double turn = aim * dice.uniform(-1, 1);
      e.w = (std::cos(turn) * s.direction + std::sin(turn) * s.normal).normalized();
    }
    all.push_back(e);
  }
  return all;
}

/// Two ellipses: the same recipe in the plane.
struct PlanarEngagement {
  Ellipse a, b;
  PlanarMotion motion;
};

inline std::vector<PlanarEngagement> planar_engagements(int count, std::uint64_t seed = 1) {
  Dice dice(seed);
  std::vector<PlanarEngagement> all;
  all.reserve(count);
  const auto body = [&](const Eigen::Vector2d& center) {
    const double x = dice.uniform(1, 10), y = dice.uniform(1, 10);
    return Ellipse::from_axes(center, {x, y}, rotation_2d(dice.uniform(0, 2 * std::numbers::pi)));
  };
  const auto velocity = [&] {
    const double x = dice.normal(), y = dice.normal();
    return Eigen::Vector2d(x, y);
  };
  for (int i = 0; i < count; ++i) {
    PlanarEngagement e;
    e.a = body(velocity());
    e.b = body(e.a.center());
    const Eigen::Vector2d d = velocity().normalized();
    e.b = e.b.translated(dice.uniform(1.5, 3) * (e.a.radius(d) + e.b.radius(d)) * d);
    e.motion.v_a = velocity();
    e.motion.v_b = velocity();
    e.motion.omega_a = dice.normal();
    e.motion.omega_b = dice.normal();
    all.push_back(e);
  }
  return all;
}

/// Ellipsoids with common axes and velocities that graze exactly, all numbers small integers: the image under
/// a diagonal map of two spheres of radii summing to leg1 m, centres hyp m apart, and w = (leg2, leg1, 0) of
/// a Pythagorean triple, axes permuted; seven of eight velocities are then moved by up to 8 units in the last
/// place.
inline std::vector<Engagement> tangent_engagements(int count, std::uint64_t seed = 2) {
  Dice dice(seed);
  const auto whole = [&dice](int lo, int hi) {
    return static_cast<int>(std::floor(dice.uniform(lo, hi + 1)));
  };
  constexpr int kTriples[][3] = {{3, 4, 5},   {5, 12, 13},  {8, 15, 17},
                                 {7, 24, 25}, {20, 21, 29}, {12, 35, 37}};
  std::vector<Engagement> all;
  all.reserve(count);
  for (int i = 0; i < count; ++i) {
    const auto& triple = kTriples[whole(0, 5)];
    const bool swap = whole(0, 1) == 1;
    const int leg1 = triple[swap ? 1 : 0], leg2 = triple[swap ? 0 : 1], m = whole(1, 3);
    const int radius = whole(1, leg1 * m - 1), x = whole(0, 2), y = (x + whole(1, 2)) % 3;
    const Eigen::Vector3d map(whole(1, 9), whole(1, 9), whole(1, 9));
    Eigen::Vector3d c = Eigen::Vector3d::Zero(), w = Eigen::Vector3d::Zero();
    c(x) = triple[2] * m;
    w(x) = leg2;
    w(y) = whole(0, 1) == 1 ? leg1 : -leg1;
    Engagement e;
    e.placed_a = {map * radius, Eigen::Matrix3d::Identity(),
                  Eigen::Vector3d(whole(-9, 9), whole(-9, 9), whole(-9, 9))};
    e.placed_b = {map * (leg1 * m - radius), Eigen::Matrix3d::Identity(),
                  e.placed_a.center + map.cwiseProduct(c)};
    e.a = e.placed_a.body();
    e.b = e.placed_b.body();
    e.w = map.cwiseProduct(w);
    e.w *= std::ldexp(1.0, -std::ilogb(e.w.norm()));  // exact; FCL's motion goes far enough
    const int ulps = i % 8 == 0 ? 0 : whole(-8, 8);
    for (int k = 0; k < std::abs(ulps); ++k) e.w(y) = std::nextafter(e.w(y), ulps < 0 ? -1e9 : 1e9);
    e.across = Eigen::Vector3d::Unit(y);
    e.aimed = true;
    all.push_back(e);
  }
  return all;
}

}  // namespace vericone::benchmarks
