// SPDX-License-Identifier: BSD-3-Clause
//
// Combined quadrics for tests: typical ones and random ones.
#pragma once

#include <vericone/geometry/combined.h>
#include <cmath>
#include <vector>

#include "support/random.h"

namespace vericone::testing {

inline CombinedEllipsoid biconcave() {
  return {Ellipsoid::from_axes({0, 0, 0}, {2, 3, 3}), {hyperboloid(2, {0.7, 1.2, 1.2})}};
}

inline CombinedEllipsoid waisted() {
  return {Ellipsoid::from_axes({0, 0, 0}, {4, 2, 2}), {hyperboloid(1, {1.5, 0.8, 0.8})}};
}

/// A delimiter that cuts the ellipsoid: random hyperboloids of the unit ball, mapped with it.
inline Delimiter<3> random_delimiter(Random& random, const Ellipsoid& e) {
  const int sheets = random.integer(1, 2);
  Eigen::Vector3d axes(random.uniform(0.2, 1.5), random.uniform(0.2, 1.5), random.uniform(0.2, 1.5));
  (sheets == 2 ? axes(0) : axes(1)) = random.uniform(0.2, 0.95);
  const Eigen::Matrix3d inverse = e.factor().inverse();
  const Eigen::Matrix3d m =
      inverse.transpose() * hyperboloid(sheets, axes, random.rotation<3>()).matrix * inverse;
  return {0.5 * (m + m.transpose()), 1};
}

inline CombinedEllipsoid random_star(Random& random, int delimiters) {
  const Ellipsoid e = Ellipsoid::from_axes(
      random.vector<3>(), {random.uniform(0.5, 3), random.uniform(0.5, 3), random.uniform(0.5, 3)},
      random.rotation<3>());
  std::vector<Delimiter<3>> all;
  for (int i = 0; i < delimiters; ++i) all.push_back(random_delimiter(random, e));
  return {e, all};
}

inline CombinedEllipse random_planar_star(Random& random, int delimiters) {
  const Ellipse e = Ellipse::from_axes(random.vector<2>(), {random.uniform(0.5, 3), random.uniform(0.5, 3)},
                                       random.rotation<2>());
  const Eigen::Matrix2d inverse = e.factor().inverse();
  std::vector<Delimiter<2>> all;
  for (int i = 0; i < delimiters; ++i) {
    const Eigen::Matrix2d m =
        inverse.transpose() *
        hyperbola({random.uniform(0.2, 0.95), random.uniform(0.2, 1.5)}, random.uniform(-3.2, 3.2)).matrix *
        inverse;
    all.push_back({0.5 * (m + m.transpose()), 1});
  }
  return {e, all};
}

}  // namespace vericone::testing
