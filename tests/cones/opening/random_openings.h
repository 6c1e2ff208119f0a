// SPDX-License-Identifier: BSD-3-Clause
//
// Random openings of every outline, and their rims point by point.
#pragma once

#include <vericone/cones/opening/opening.h>
#include <vericone/testing/random_bodies.h>
#include <cmath>
#include <numbers>
#include <vector>

namespace vericone::testing {

/// Star-shaped about the origin: radii between `least` and 1, so concave as a rule.
inline Opening random_polygon(RandomBodies& random, int vertices, double least) {
  std::vector<Eigen::Vector2d> p;
  for (int i = 0; i < vertices; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(0, 0.5)) / vertices;
    p.push_back(random.uniform(least, 1) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return Opening::polygon(std::move(p));
}

/// Of reach one, about: kind 0 a circle, 1 an ellipse, 2 a polygon.
inline Opening random_opening(RandomBodies& random, int kind) {
  if (kind == 0) return Opening::circle(random.uniform(0.5, 1));
  if (kind == 1) return Opening::ellipse({random.uniform(0.2, 1), random.uniform(0.2, 1)});
  return random_polygon(random, random.integer(3, 20), random.coin() ? 0.9 : 0.3);
}

inline PlacedOpening random_placed(RandomBodies& random, int kind, const Eigen::Vector3d& center) {
  return {random_opening(random, kind), center, random.rotation().leftCols<2>()};
}

/// A point of the rim for t in [0, 1], in the world.
inline Eigen::Vector3d rim_point(const PlacedOpening& placed, double t) {
  const Opening& opening = placed.opening;
  t -= std::floor(t);
  if (!opening.polygonal()) {
    const double angle = 2 * std::numbers::pi * t;
    return placed.at({opening.semi_axes().x() * std::cos(angle), opening.semi_axes().y() * std::sin(angle)});
  }
  const auto& p = opening.vertices();
  const double place = t * double(p.size());
  const auto i = std::min(static_cast<std::size_t>(place), p.size() - 1);
  return placed.at(p[i] + (place - double(i)) * (p[(i + 1) % p.size()] - p[i]));
}

/// The t with the least f(t) by samples, every one of them that may lead to it refined; f is periodic.
template <typename F>
double least_over_rim(const F& f, int samples, double* where = nullptr) {
  std::vector<double> value(static_cast<std::size_t>(samples));
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < samples; ++i) least = std::min(least, value[i] = f(double(i) / samples));
  double refined = least, at = 0;
  for (int i = 0; i < samples; ++i) {
    const double before = value[(i + samples - 1) % samples], after = value[(i + 1) % samples];
    if (value[i] > before || value[i] > after) continue;
    double best = double(i) / samples, best_value = value[i];
    for (double step = 0.5 / samples; step > 1e-13; step *= 0.5)
      for (const double t : {best - step, best + step})
        if (const double v = f(t); v < best_value) {
          best_value = v;
          best = t;
        }
    if (best_value <= refined) {
      refined = best_value;
      at = best;
    }
  }
  if (where) *where = at;
  return refined;
}

}  // namespace vericone::testing
