// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <random>

namespace vericone::simulation {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Eigen::Vector3d vector(double size) {
    const double x = uniform(-size, size), y = uniform(-size, size), z = uniform(-size, size);
    return {x, y, z};
  }
  Eigen::Vector3d flat_vector(double size) {
    const double x = uniform(-size, size), y = uniform(-size, size);
    return {x, y, 0};
  }
  Eigen::Matrix3d rotation() {
    const double angle = uniform(-3, 3);
    return Eigen::AngleAxisd(angle, Eigen::Vector3d(vector(1) + Eigen::Vector3d(0, 0, 1e-3)).normalized())
        .toRotationMatrix();
  }
  Eigen::Matrix3d rotation_about_z() {
    return Eigen::AngleAxisd(uniform(-3, 3), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }

 private:
  std::mt19937 engine_;
};

}  // namespace vericone::simulation
