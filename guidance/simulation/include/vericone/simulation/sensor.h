// SPDX-License-Identifier: BSD-3-Clause
//
// What an agent measures of the bodies it minds, and how it filters that. The bodies themselves move, and are
// proved, as they truly are.
#pragma once

#include <vericone/guidance/kinematics.h>
#include <vericone/guidance/robust_law.h>
#include <cstdint>

namespace vericone::simulation {

/// What errors are made of position and velocity, at every command. Shape and attitude are known.
enum class Noise : std::uint8_t {
  /// (7.2): of r, V_r and V_theta parts of the true value, of theta, theta_b and psi angles, each times m. Of
  /// the avoidance law; it acts on the plane that the law looks at.
  engagement,
  /// (7.27): along each axis of the world a part of the true relative position and velocity there, times m.
  /// So
  /// it depends on the axes, and vanishes where a component is 0.
  per_axis,
  isotropic,  // along each axis metres and metres a second, times m
  bounded,    // uniform in balls of these radii, m and m/s: nothing is ever beyond them
};
[[nodiscard]] const char* to_string(Noise noise);

struct Sensor {
  Noise noise = Noise::isotropic;
  guidance::EngagementParts engagement;  // of Noise::engagement
  double position = 0, velocity = 0;     // parts, or m and m/s: of the others
  double deviation = 1;                  // standard deviation of m; the source has 1/3
  /// One m for all channels of a measurement, the literal reading of m(t); otherwise each has its own, as the
  /// source's variances assume.
  bool shared = false;

  /// All errors times a number.
  [[nodiscard]] Sensor times(double factor) const;
};

/// What the law is given of a measured body.
enum class Estimator : std::uint8_t {
  none,
  state,  // ConstantVelocityFilter, told how large the errors usually are
  /// SetMembershipFilter, told their bounds: for Noise::bounded. The middle of what is possible.
  set_membership,
};
[[nodiscard]] const char* to_string(Estimator estimator);

/// Numbers that depend on what they are for alone: the same for every law, number of threads and order.
struct Draw {
  std::uint64_t seed = 0, trial = 0;
  std::uint64_t pair = 0;  // which agent sees which body
  std::uint64_t step = 0;  // number of the command

  /// Uniform in (0, 1), and standard normal, dimensionless, of a channel.
  [[nodiscard]] double uniform(std::uint64_t channel) const;
  [[nodiscard]] double normal(std::uint64_t channel) const;
};

/// Position and velocity of a body as measured, and their standard deviations along each axis (m, m/s). Of
/// Noise::engagement they are the true ones.
struct Measurement {
  Eigen::Vector3d position, velocity;
  Eigen::Vector3d position_deviation = Eigen::Vector3d::Zero(), velocity_deviation = Eigen::Vector3d::Zero();
};

/// Of B by A, which knows itself. Planar bodies stay in their plane.
[[nodiscard]] Measurement measure(const Sensor& sensor, const guidance::BodyState& a,
                                  const guidance::BodyState& b, const Draw& draw);

/// Throws InputError naming "noise", "position", "velocity", "deviation", "r", "theta", ...
void check(const Sensor& sensor);

}  // namespace vericone::simulation
