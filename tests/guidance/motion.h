// SPDX-License-Identifier: BSD-3-Clause
//
// Point masses and bodies on exact curved paths in Cartesian coordinates, for finite differences: no formula
// of the library's kinematics is used. Random states for laws.
#pragma once

#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "cones/ellipsoids/richardson.h"

namespace vericone::testing {

/// A point mass with constant acceleration in fixed axes: its path is exact, and its first derivatives at t =
/// 0 are those of any motion that begins with this acceleration.
template <int D>
struct Path {
  using Vector = Eigen::Matrix<double, D, 1>;
  Vector p = Vector::Zero(), v = Vector::Zero(), a = Vector::Zero();

  Vector position(double t) const { return p + t * v + (0.5 * t * t) * a; }
  Vector velocity(double t) const { return v + t * a; }
};

inline Eigen::Vector2d at_angle(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// The angle from x to y, in (-pi, pi].
inline double angle_between(const Eigen::Vector2d& x, const Eigen::Vector2d& y) {
  return std::atan2(x.x() * y.y() - x.y() * y.x(), x.dot(y));
}

/// The least rotation that takes the direction of x to that of y.
inline Eigen::Matrix3d least_rotation(const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  const Eigen::Vector3d axis = x.cross(y);
  const double sine = axis.norm(), cosine = x.dot(y);
  if (sine == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(std::atan2(sine, cosine), axis / sine).toRotationMatrix();
}

/// Errors over all states of a test, for its verdict and for the tables of docs/explanation/guidance.md.
class Errors {
 public:
  void add(double error) { values_.push_back(error); }
  double worst() const { return *std::max_element(values_.begin(), values_.end()); }
  double median() const {
    std::vector<double> sorted = values_;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2), sorted.end());
    return sorted[sorted.size() / 2];
  }
  std::size_t count() const { return values_.size(); }

 private:
  std::vector<double> values_;
};

}  // namespace vericone::testing
