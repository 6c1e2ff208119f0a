// SPDX-License-Identifier: BSD-3-Clause
//
// Random planar combined quadrics.
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/LU>

namespace vericone::testing {

enum class PlanarKind { ellipse, dented, pinched, one_hyperbola, star, waist };
inline constexpr int kPlanarKinds = 6;

/// Semi-axes of the ellipse 1 to 6; a dented conic's before the factor sqrt(1 + k).
inline CombinedEllipse random_combined(RandomBodies& random, PlanarKind kind, const Eigen::Vector2d& center) {
  using Eigen::Vector2d;
  const auto axes = [&](double low, double high) {
    const double first = random.uniform(low, high);
    return Vector2d(first, random.uniform(low, high));
  };
  const auto angle = [&] { return random.uniform(-std::numbers::pi, std::numbers::pi); };
  const Vector2d outer = axes(1, 6);
  const Ellipse ellipse = Ellipse::from_axes(center, outer, rotation_2d(angle()));
  if (kind == PlanarKind::ellipse) return ellipse;
  if (kind == PlanarKind::dented || kind == PlanarKind::pinched) {
    const double k = kind == PlanarKind::pinched ? 1 : random.uniform();
    return dented_conic(center, outer.x(), outer.y(), k, angle());
  }
  for (;;) {
    std::vector<Delimiter<2>> delimiters;
    const int count = kind == PlanarKind::one_hyperbola ? 1 : random.integer(1, 3);
    for (int i = 0; i < count; ++i) {
      const Vector2d semi = axes(0.3, 5);
      delimiters.push_back(hyperbola(semi, angle()));
    }
    if (kind == PlanarKind::waist) {  // as a section of a one-sheeted hyperboloid may be
      const Vector2d semi = axes(1, 6);
      const Ellipse e = Ellipse::from_axes(Vector2d::Zero(), semi, rotation_2d(angle()));
      const Eigen::Matrix2d m = e.shape().inverse();
      delimiters[0] = {0.5 * (m + m.transpose()), 1};
    }
    try {
      return {ellipse, delimiters};
    } catch (const InputError&) {  // one of them misses the ellipse
    }
  }
}

inline CombinedEllipse random_combined(RandomBodies& random, const Eigen::Vector2d& center) {
  return random_combined(random, static_cast<PlanarKind>(random.integer(0, kPlanarKinds - 1)), center);
}

}  // namespace vericone::testing
