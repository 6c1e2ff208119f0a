// SPDX-License-Identifier: BSD-3-Clause
//
// Random instances of the robust law, and its linear matrix inequalities written down once more, from the
// source.
#pragma once

#include <vericone/guidance/robust_law.h>
#include <Eigen/Core>
#include <cmath>
#include <random>
#include <vector>

namespace vericone::guidance {

struct RobustInstance {
  double z, low, high;
  RobustModel model;
  RobustOptions options;
};

/// As chapter 7 might set them: a few m/s^2 left, lambda of some 1/100 per m, steps of 10 ms.
inline RobustInstance random_instance(std::mt19937_64& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto power = [&](double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  };
  RobustInstance x{};
  x.z = -power(1e-3, 0.3);
  const double most = between(5, 40), inner = between(-most, most);
  x.low = -most - inner, x.high = most - inner;
  x.model.gain = power(0.3, 6);
  const double nu = between(0.5, 2);
  x.model.a_low = -nu, x.model.a_high = nu;
  x.model.b_high = power(0.005, 0.2);
  x.model.sign_b = between(-1, 1) < 0 ? -1 : 1;
  x.model.dt = power(0.005, 0.05);
  x.options.mu = power(1e-3, 10);
  x.options.state_weight = power(0.1, 10);
  x.options.input_weight = power(1e-7, 1e-3);
  x.options.polytope = Polytope::printed;
  x.options.attenuation = Attenuation::printed;
  return x;
}

/// (7.17)'s two corners: [A, B, D].
inline std::vector<Eigen::Vector3d> printed_corners(const RobustModel& m) {
  std::vector<Eigen::Vector3d> all;
  for (const double a : {m.a_low, m.a_high}) {
    const double x = m.gain * a * m.dt, d = x == 0 ? m.dt : (1 - std::exp(-x)) / (m.gain * a);
    all.emplace_back(std::exp(-x), m.sign_b * m.b_high * d, d);
  }
  return all;
}

/// The left-hand sides of (7.22) and (7.23) at a corner.
inline Eigen::Matrix4d decay_lmi(const Eigen::Vector3d& c, double q, double y, double gamma,
                                 const RobustOptions& o) {
  const double next = c(0) * q + c(1) * y, sq = std::sqrt(o.state_weight) * q,
               sr = std::sqrt(o.input_weight) * y;
  Eigen::Matrix4d m;
  m << q, next, sq, sr, next, q, 0, 0, sq, 0, gamma, 0, sr, 0, 0, gamma;
  return m;
}
inline Eigen::Matrix4d attenuation_lmi(const Eigen::Vector3d& c, double q, double y, double gamma,
                                       double mu) {
  const double next = c(0) * q + c(1) * y;
  Eigen::Matrix4d m;
  m << q, 0, next, q, 0, gamma * mu, gamma * c(2), 0, next, gamma * c(2), q, 0, q, 0, 0, gamma;
  return m;
}

}  // namespace vericone::guidance
