// SPDX-License-Identifier: BSD-3-Clause
#include "combined/source/pole_polar.h"

#include <cmath>
#include <numbers>

namespace vericone {

std::optional<std::array<PolarTangent, 2>> tangents_by_polar(const Eigen::Matrix3d& dual,
                                                             const Eigen::Vector2d& from) {
  const double a = dual(0, 0), b = dual(1, 1), c = dual(0, 1), d = dual(0, 2), e = dual(1, 2), f = dual(2, 2);
  const double u = from.x(), v = from.y();
  // (5.6)
  const double k2 = (b - a) + 2 * (d * u - e * v) + f * (v * v - u * u);
  const double k0 = a - 2 * d * u + f * u * u;
  const double k1 = -2 * (c - (d * v + e * u) + f * u * v);
  const double sine = (2 * k0 + k2) / std::hypot(k1, k2);
  if (!(std::abs(sine) <= 1)) return std::nullopt;
  std::array<PolarTangent, 2> both;
  for (int i = 0; i < 2; ++i) {
    const double sign = i == 0 ? 1 : -1;
    const double gamma = 0.5 * (std::atan2(k1, k2) + sign * (std::asin(sine) + std::numbers::pi / 2));
    const double cg = std::cos(gamma), sg = std::sin(gamma);
    // (5.7): q = C_1 t, homogeneous.
    const Eigen::Vector3d q((c - d * v) * cg + (d * u - a) * sg, (b - e * v) * cg + (e * u - c) * sg,
                            (e - f * v) * cg + (f * u - d) * sg);
    both[i] = {gamma, Eigen::Vector3d(-sg, cg, u * sg - v * cg), q.head<2>() / q(2)};
  }
  return both;
}

}  // namespace vericone
