// SPDX-License-Identifier: BSD-3-Clause
//
// Products of vectors in the plane.
#pragma once

#include <Eigen/Core>

namespace vericone::guidance {

inline double cross(const Eigen::Vector2d& x, const Eigen::Vector2d& y) {
  return x.x() * y.y() - x.y() * y.x();
}
/// A quarter turn: cross(p, a) = left(p).dot(a).
inline Eigen::Vector2d left(const Eigen::Vector2d& p) { return {-p.y(), p.x()}; }

}  // namespace vericone::guidance
