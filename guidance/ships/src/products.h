// SPDX-License-Identifier: BSD-3-Clause
//
// Products of vectors of the plane, to one and a half roundings of themselves.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace vericone::ships {

/// a b - c d (Kahan).
inline double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d, error = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + error;
}

inline double dot(const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
  return difference_of_products(p.x(), q.x(), -p.y(), q.y());
}

inline double cross(const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
  return difference_of_products(p.x(), q.y(), p.y(), q.x());
}

}  // namespace vericone::ships
