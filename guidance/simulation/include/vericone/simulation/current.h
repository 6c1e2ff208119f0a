// SPDX-License-Identifier: BSD-3-Clause
//
// Water that moves: what a vehicle swims in, or air, which it flies in.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>

namespace vericone::simulation {

/// Horizontal, in proportion to the height above a level.
struct Shear {
  Eigen::Vector2d rate = Eigen::Vector2d::Zero();  // 1/s: of the velocity's x and y, per metre of height
  double level = 0;                                // z where it adds nothing, m
};

/// The same everywhere, smooth in time, never faster than `most`: sines whose amplitudes sum to it.
struct Gusts {
  double most = 0;          // m/s
  double shortest = 2;      // s, the shortest period
  double longest = 20;      // s, the longest
  std::uint64_t seed = 1;   // of directions, periods and phases
  bool horizontal = false;  // without a vertical part
};

/// Velocity of the water at a place and time: uniform, sheared, gusty. World z is up. Cost: 0.14 us with
/// gusts.
class Current {
 public:
  Current() = default;
  /// Throws InputError naming "uniform", "shear.rate", "shear.level", "gusts.most", "gusts.shortest" or
  /// "gusts.longest".
  explicit Current(const Eigen::Vector3d& uniform, const Shear& shear = {}, const Gusts& gusts = {});

  /// This water, and all of it moving uniformly besides, m/s.
  [[nodiscard]] Current carried(const Eigen::Vector3d& by) const;

  [[nodiscard]] Eigen::Vector3d velocity(double z, double t) const;
  /// Of a particle that stays at its height: what the gusts do, m/s^2.
  [[nodiscard]] Eigen::Vector3d acceleration(double t) const;
  /// By height, 1/s.
  [[nodiscard]] Eigen::Vector3d gradient() const { return {shear_.rate.x(), shear_.rate.y(), 0}; }
  /// Whether any of it ever moves.
  [[nodiscard]] bool moves() const { return gusts_ > 0 || !uniform_.isZero(0) || !shear_.rate.isZero(0); }
  /// The shortest period of its gusts, s; infinite without any.
  [[nodiscard]] double shortest() const { return shortest_; }
  /// No water is faster between two heights, m/s.
  [[nodiscard]] double most(double bottom, double top) const;

 private:
  struct Wave {
    Eigen::Vector3d amplitude = Eigen::Vector3d::Zero();  // m/s
    double rate = 0, phase = 0;                           // rad/s, rad
  };

  Eigen::Vector3d uniform_ = Eigen::Vector3d::Zero();
  Shear shear_;
  double gusts_ = 0;                                           // m/s
  double shortest_ = std::numeric_limits<double>::infinity();  // s
  std::array<Wave, 8> waves_;
};

}  // namespace vericone::simulation
