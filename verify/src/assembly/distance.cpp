// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/distance.h"

#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace vericone::verify {
namespace {

using Eigen::Vector3d;

struct Least {
  Vector3d v;
  std::vector<Vector3d> support;  // the points that v is a combination of
};

/// The point of least norm of the hull of up to four points plus the multiples of d (d = 0: none): the least
/// over all subsets whose flat has its foot within.
Least least(const std::vector<Vector3d>& points, const Vector3d& d) {
  Least best;
  double squared = INFINITY;
  const int n = static_cast<int>(points.size());
  for (int subset = 1; subset < 1 << n; ++subset)
    for (int ray = 0; ray < (d.isZero(0) ? 1 : 2); ++ray) {
      std::vector<Vector3d> chosen;
      for (int i = 0; i < n; ++i)
        if (subset >> i & 1) chosen.push_back(points[i]);
      const int edges = static_cast<int>(chosen.size()) - 1 + ray;
      if (edges > 3) continue;
      Eigen::MatrixXd e(3, edges);
      for (int i = 0; i + 1 < static_cast<int>(chosen.size()); ++i) e.col(i) = chosen[i + 1] - chosen[0];
      if (ray) e.col(edges - 1) = d;
      Eigen::VectorXd s = Eigen::VectorXd::Zero(edges);
      if (edges > 0) s = least_squares(e, -chosen[0]);
      const double sum = s.head(edges - ray).sum();
      if ((s.array() < 0).any() || sum > 1) continue;
      const Vector3d v = chosen[0] + e * s;
      if (v.squaredNorm() < squared) {
        squared = v.squaredNorm();
        best = {v, chosen};
      }
    }
  return best;
}

}  // namespace

DistanceBounds ellipsoid_distance(const Ellipsoid& agent, std::span<const Vector3d> points,
                                  const Vector3d& w) {
  const Vector3d back = w.isZero(0) ? w : Vector3d(-w.normalized());
  const auto support = [&](const Vector3d& v) {
    Vector3d x = points[0];
    for (const Vector3d& y : points)
      if (v.dot(y) < v.dot(x)) x = y;
    const Vector3d u = agent.factor().transpose() * v;
    return Vector3d(x - agent.center() - agent.factor() * (u / u.norm()));
  };
  Least at = least({Vector3d(points[0] - agent.center())}, back);
  DistanceBounds r{0, at.v.norm()};
  for (int k = 0; k < 300 && at.v.norm() > 0; ++k) {
    const Vector3d y = support(at.v);
    // Only normals that the ray does not run against bound from below.
    const double slope = at.v.dot(back) / at.v.norm();
    if (slope > -1e-12) r.low = std::max(r.low, at.v.dot(y) / at.v.norm());
    r.high = std::min(r.high, at.v.norm());
    if (r.high - r.low < 1e-13 * (r.high + agent.center().norm())) break;
    std::vector<Vector3d> next = at.support;
    next.push_back(y);
    const Least found = least(next, back);
    if (!(found.v.norm() < at.v.norm())) break;
    at = found;
  }
  if (at.v.isZero(0)) r.high = 0;
  return r;
}

}  // namespace vericone::verify
