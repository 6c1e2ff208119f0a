// SPDX-License-Identifier: BSD-3-Clause
#include "hulls/certificates.h"
#include "answers/elementary.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone {
namespace {

Interval entry(const HullScene& scene, int r, int c) {
  return scene.enclosed_shape[HullScene::kPacked[r][c]];
}

Interval enclosed(double centred) {
  return {centred, kUnitRoundoff * std::abs(centred) * Interval::kInflate + Interval::kTiny};
}

Interval enclosed_height(const CentredPoints& points, std::size_t i, const Eigen::Vector3d& n) {
  return Interval(n.x()) * enclosed(points.x[i]) + Interval(n.y()) * enclosed(points.y[i]) +
         Interval(n.z()) * enclosed(points.z[i]);
}

Interval determinant(const std::array<Interval, 3>& x, const std::array<Interval, 3>& y,
                     const std::array<Interval, 3>& z) {
  return x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) +
         x[2] * (y[0] * z[1] - y[1] * z[0]);
}

/// How far values of `near` may be from those of n, over the points of one body or of both.
double turned(const HullScene& scene, const Eigen::Vector3d& near, const Eigen::Vector3d& n) {
  // The difference of two close doubles is off by one rounding at most.
  return kRoundUp * (n - near).cwiseAbs().dot(scene.reach) + 0x1p-1000;
}

}  // namespace

double radius_above(const HullScene& scene, const Eigen::Vector3d& n) noexcept {
  if (!scene.ellipsoid) return 0;
  const Eigen::Vector3d m = n.cwiseAbs();
  double square = 0;
  if (scene.ellipsoid->defined_by_factor()) {
    // Each entry of F^T n: three products, two sums.
    for (int j = 0; j < 3; ++j) {
      const double above = std::abs(scene.factor.col(j).dot(n)) +
                           4 * kUnitRoundoff * scene.factor.col(j).cwiseAbs().dot(m) + 1e-280;
      square += above * above;
    }
  } else {
    const Eigen::Matrix3d& s = scene.shape;
    square = std::max(0.0, n.dot(s * n)) + 10 * kUnitRoundoff * m.dot(s.cwiseAbs() * m) + 1e-280;
  }
  return std::sqrt(square) * kRoundUp;
}

bool triage_ahead_of(const HullScene& scene, const Eigen::Vector3d& near, const HullSupport& support,
                     const Eigen::Vector3d& n) noexcept {
  const double slack = support_slack(scene, near) + turned(scene, near, n), radius = radius_above(scene, n);
  return support.value() > (slack + radius) * kRoundUp;
}

bool interval_ahead_of(const HullScene& scene, const Eigen::Vector3d& near, const HullSupport& support,
                       const Eigen::Vector3d& n) noexcept {
  if (triage_ahead_of(scene, near, support, n)) return true;
  Interval square = 0;
  if (scene.ellipsoid) {
    if (scene.ellipsoid->defined_by_factor()) {
      for (int j = 0; j < 3; ++j) {
        Interval c = 0;
        for (int k = 0; k < 3; ++k) c = c + Interval(scene.factor(k, j), Interval::kTiny) * Interval(n(k));
        square = square + c * c;
      }
    } else {
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) square = square + Interval(n(r)) * Interval(n(c)) * entry(scene, r, c);
    }
  }
  // A point whose value under `near` exceeds the least by more than this is not the least under n.
  const double beyond = 2 * kRoundUp * (support_slack(scene, near) + turned(scene, near, n));
  // A lower bound of the least of sign * n.x.
  const auto least = [&](const CentredPoints& points, double sign, double least_near) {
    double low = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (sign * (near.x() * points.x[i] + near.y() * points.y[i] + near.z() * points.z[i]) >
          least_near + beyond)
        continue;
      const Interval height = Interval(sign) * enclosed_height(points, i, n);
      if (!height.finite()) return Interval(-std::numeric_limits<double>::infinity());
      low = std::min(low, height.lo());
    }
    return Interval(low);
  };
  const Interval gap = least(scene.centred_obstacle, 1, support.obstacle_value) +
                       least(scene.centred_agent, -1, -support.agent_value) - sqrt(square);
  return gap.finite() && gap.positive();
}

int triage_side(const Eigen::Vector3d& n, const Eigen::Vector3d& w) noexcept {
  // w: 1, products: 1, sums: 2, the bound itself.
  const double side = n.dot(w), bound = 8 * kUnitRoundoff * n.cwiseAbs().dot(w.cwiseAbs()) + 1e-290;
  return static_cast<int>(side > bound) - static_cast<int>(side < -bound);
}

int interval_side(const Eigen::Vector3d& n, const std::array<Interval, 3>& w) noexcept {
  const Interval side = Interval(n.x()) * w[0] + Interval(n.y()) * w[1] + Interval(n.z()) * w[2];
  return static_cast<int>(side.positive()) - static_cast<int>(side.negative());
}

std::array<Interval, 3> enclosed_difference(const HullScene& scene, HullPair pair) noexcept {
  const auto &b = scene.centred_obstacle, &a = scene.centred_agent;
  return {enclosed(b.x[pair.obstacle]) - enclosed(a.x[pair.agent]),
          enclosed(b.y[pair.obstacle]) - enclosed(a.y[pair.agent]),
          enclosed(b.z[pair.obstacle]) - enclosed(a.z[pair.agent])};
}

bool interval_inside(const HullScene& scene, const HullPair* pairs, const double* weights,
                     int count) noexcept {
  std::array<Interval, 3> x{0, 0, 0};
  Interval sigma = 0;
  for (int t = 0; t < count; ++t) {
    const auto d = enclosed_difference(scene, pairs[t]);
    for (int k = 0; k < 3; ++k) x[k] = x[k] + Interval(weights[t]) * d[k];
    sigma = sigma + Interval(weights[t]);
  }
  // x^T adj(S) x < sigma^2 det S.
  Interval cofactor[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int r0 = (i + 1) % 3, r1 = (i + 2) % 3, c0 = (j + 1) % 3, c1 = (j + 2) % 3;
      cofactor[i][j] =
          entry(scene, r0, c0) * entry(scene, r1, c1) - entry(scene, r0, c1) * entry(scene, r1, c0);
    }
  const Interval det = entry(scene, 0, 0) * cofactor[0][0] + entry(scene, 0, 1) * cofactor[0][1] +
                       entry(scene, 0, 2) * cofactor[0][2];
  Interval form = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) form = form + x[i] * x[j] * cofactor[i][j];
  return (sigma * sigma * det - form).positive();
}

bool interval_surrounds(const HullScene& scene, const HullPair* pairs) noexcept {
  std::array<Interval, 3> p[4];
  for (int t = 0; t < 4; ++t) p[t] = enclosed_difference(scene, pairs[t]);
  const Interval w[4] = {determinant(p[1], p[2], p[3]), -determinant(p[0], p[2], p[3]),
                         determinant(p[0], p[1], p[3]), -determinant(p[0], p[1], p[2])};
  return std::all_of(w, w + 4, [](const Interval& x) { return x.positive(); }) ||
         std::all_of(w, w + 4, [](const Interval& x) { return x.negative(); });
}

}  // namespace vericone
