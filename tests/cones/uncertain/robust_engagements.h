// SPDX-License-Identifier: BSD-3-Clause
//
// Random engagements with bounded errors, and errors drawn from their sets, many of them from the rims.
#pragma once

#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/uncertain/robust.h>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace vericone::testing {

struct RobustEngagement {
  Ellipsoid a, b;
  Eigen::Vector3d v_a, v_b;
  RelativeErrors errors;
};

class RobustDice {
 public:
  explicit RobustDice(std::uint64_t seed) : engine_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Eigen::Vector3d normal() { return {gauss_(engine_), gauss_(engine_), gauss_(engine_)}; }
  Eigen::Vector3d direction() { return normal().normalized(); }
  Eigen::Matrix3d rotation() {
    return Eigen::Quaterniond(gauss_(engine_), gauss_(engine_), gauss_(engine_), gauss_(engine_))
        .normalized()
        .toRotationMatrix();
  }
  Eigen::Vector3d axes(double low, double high) {
    return {between(low, high), between(low, high), between(low, high)};
  }

  Ellipsoid body(const Eigen::Vector3d& center) {
    return Ellipsoid::from_axes(center, axes(0.3, 3), rotation());
  }

  /// A ball, an ellipsoid, a box, a zonotope of five, or a sum, of about this size.
  ErrorSet set(double size, int kind) {
    switch (kind % 5) {
      case 0:
        return ErrorSet::ball(size * between(0, 1));
      case 1:
        return ErrorSet::ellipsoid(size * axes(0.05, 1), rotation());
      case 2:
        return ErrorSet::box(size * axes(0, 1));
      case 3: {
        std::array<Eigen::Vector3d, 5> generators;
        for (Eigen::Vector3d& g : generators) g = 0.4 * size * normal();
        return ErrorSet::zonotope(generators);
      }
      default:
        return set(0.5 * size, 2) + set(0.5 * size, 1) + set(0.3 * size, 0);
    }
  }

  /// Aimed at the obstacle, more or less, or anywhere; errors from a hundredth of the bodies to their size.
  RobustEngagement engagement(int kind) {
    RobustEngagement e;
    e.a = body(5 * normal());
    const Eigen::Vector3d c = between(4, 40) * direction();
    e.b = body(e.a.center() + c);
    const Eigen::Vector3d aim = c + between(0, 6) * direction();
    const Eigen::Vector3d w = between(1, 20) * (between(0, 1) < 0.15 ? direction() : aim.normalized());
    e.v_b = 5 * normal();
    e.v_a = e.v_b + w;
    e.errors.position = set(std::pow(10, between(-2, 0.3)), kind);
    e.errors.velocity = set(w.norm() * std::pow(10, between(-3, -0.5)), kind);
    if (between(0, 1) < 0.5) e.errors.horizon = between(0.3, 2) * c.norm() / w.norm();
    return e;
  }

  /// Half of them reach the rim of every summand; by a last rounding they stay in it.
  Eigen::Vector3d error(const ErrorSet& set) {
    constexpr double kInside = 1 - 1e-12;
    const bool rim = between(0, 1) < 0.5;
    const auto in_ball = [&] {
      return Eigen::Vector3d(kInside * (rim ? 1 : std::cbrt(between(0, 1))) * direction());
    };
    Eigen::Vector3d e = set.radius() > 0 ? Eigen::Vector3d(set.radius() * in_ball())
                                         : Eigen::Vector3d(Eigen::Vector3d::Zero());
    for (const Eigen::Matrix3d& f : set.factors()) e += f * in_ball();
    for (const Eigen::Vector3d& g : set.segments()) {
      const double s = between(-1, 1);
      e += kInside * (rim ? (s < 0 ? -1 : 1) : s) * g;
    }
    return e;
  }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> gauss_;
};

/// What the exact predicates say of one error; nothing where the horizon is nearer to the contact than its
/// time is rounded.
inline std::optional<bool> collides(const RobustEngagement& e, const RelativeError& error) {
  const Ellipsoid b = e.b.translated(error.position);
  const ConeOracle oracle(e.a, b);
  const Eigen::Vector3d v_a = e.v_a + error.velocity;
  if (!may_collide(oracle.verdict(v_a, e.v_b))) return false;
  if (!std::isfinite(e.errors.horizon)) return true;
  const double time = time_to_contact(oracle, v_a, e.v_b).value_or(0);
  if (std::abs(time - e.errors.horizon) < 1e-9 * e.errors.horizon) return std::nullopt;
  return time < e.errors.horizon;
}

}  // namespace vericone::testing
