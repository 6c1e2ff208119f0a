// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/vehicles/fish_water.h>
#include <vericone/vehicles/fish.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone::vehicles {
namespace {

using Eigen::Vector3d;

constexpr double kUp = 1 + 1e-12;

/// The least a of an ellipsoid (a, b, c) that contains tail and trunk; infinite where none does.
double least_length(const FishParameters& fish, double b, double c) {
  const double none = std::numeric_limits<double>::infinity();
  // The tail's corners, (hinge + C cos, C sin, L/2) for angles up to the most: its other points are between
  // them and the hinge, and the ellipsoid is convex.
  const double angle = most_tail_angle(fish);
  double most = 0;
  constexpr int kAngles = 64;
  for (int i = 0; i <= kAngles; ++i) {
    // Chords of the arc, pushed out: the polygon contains the arc.
    const double at = angle * i / kAngles, out = 1 / std::cos(angle / kAngles / 2);
    const double x = fish.hinge + fish.tail_chord * out * std::cos(at),
                 y = fish.tail_chord * out * std::sin(at), z = 0.5 * fish.tail_span;
    const double left = 1 - y * y / (b * b) - z * z / (c * c);
    if (!(left > 0)) return none;
    most = std::max(most, x / std::sqrt(left));
  }
  // The trunk, an ellipsoid about (ahead, 0, 0): a point of it is ahead + a_1 t along, and across at most
  // sqrt(1 - t^2) times the larger of its other axes in parts of b and c.
  const Trunk trunk = trunk_of(fish);
  const double across = std::max(trunk.semi_axes.y() / b, trunk.semi_axes.z() / c);
  if (!(across < 1)) return none;
  for (const double end : {1.0, -1.0}) {
    // (ahead + end a_1 t)^2 / a^2 + across^2 (1 - t^2) <= 1 for all t in [0, 1]: as a tangent shows, if
    // a^2 >= a_1^2 / across^2 never worse than at the end; otherwise the most is found on the way.
    for (int i = 0; i <= kAngles; ++i) {
      const double t = std::sin(0.5 * std::numbers::pi * i / kAngles);
      const double next = std::sin(0.5 * std::numbers::pi * std::min(kAngles, i + 1) / kAngles);
      // Between two values of t: the larger x with the larger share across.
      const double x = std::max(std::abs(trunk.ahead + end * trunk.semi_axes.x() * next),
                                std::abs(trunk.ahead + end * trunk.semi_axes.x() * t));
      most = std::max(most, x / std::sqrt(1 - across * across * (1 - t * t)));
    }
  }
  return most * kUp;
}

}  // namespace

double most_tail_angle(const FishParameters& fish) { return fish.most_amplitude + fish.most_bias; }

Trunk trunk_of(const FishParameters& fish) {
  using std::numbers::pi;
  const double half = 0.5 * (fish.length - fish.tail_chord), high = fish.area_y / (pi * half);
  return {half - fish.hinge, {half, fish.area_x / (pi * high), high}};
}

Vector3d ellipsoid_of(const FishParameters& fish) {
  Vector3d best = Vector3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  const Trunk trunk = trunk_of(fish);
  const double widest = std::max(fish.tail_chord, trunk.semi_axes.y()),
               highest = std::max(0.5 * fish.tail_span, trunk.semi_axes.z());
  // Any of these contains it; the one of the least volume is taken, to a few parts in a hundred.
  for (double b = widest * 0.8; b < 3 * widest; b *= 1.02)
    for (double c = highest; c < 3 * highest; c *= 1.02) {
      const double a = least_length(fish, b, c);
      if (!(a * b * c < least)) continue;
      least = a * b * c;
      best = {a, b, c};
    }
  return best;
}

double sphere_of(const FishParameters& fish) {
  const double tail = std::hypot(fish.hinge + fish.tail_chord, 0.5 * fish.tail_span);
  const Trunk trunk = trunk_of(fish);
  // No point of the trunk is farther than its centre and its longest axis together.
  return std::max(tail, std::abs(trunk.ahead) + trunk.semi_axes.maxCoeff()) * kUp;
}

}  // namespace vericone::vehicles
