// SPDX-License-Identifier: BSD-3-Clause
//
// The search in floating point for the point of a hull nearest to the origin (Gilbert, Johnson and Keerthi).
// Nothing here is relied on: it proposes certificates, and others prove them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "hulls/scene.h"

namespace vericone {

/// At most D + 1 pairs, their images, and the nearest point of their hull.
template <int D>
struct HullSimplex {
  using Vector = Eigen::Matrix<double, D, 1>;
  int count = 0;
  std::array<HullPair, D + 1> pair;
  std::array<Vector, D + 1> z;
  std::array<double, D + 1> weight{};  // of the nearest point; all positive
  Vector nearest = Vector::Zero();
  Vector normal = Vector::Zero();  // direction from the origin to it, accurate also where it is near 0
  bool surrounds = false;          // D + 1 points with the origin inside

  void add(HullPair p, const Vector& image) {
    pair[count] = p;
    z[count++] = image;
  }

  /// Finds the nearest point among all faces and drops the points off its face.
  void reduce() {
    double best = std::numeric_limits<double>::infinity();
    unsigned best_mask = 0;
    std::array<double, D + 1> best_weight{};
    Vector best_nearest = Vector::Zero(), best_normal = Vector::Zero();
    for (unsigned mask = 1; mask < (1U << count); ++mask) {
      std::array<double, D + 1> w{};
      Vector n;
      Vector y;
      if (!face(mask, w, y, n)) continue;
      const double length = y.squaredNorm();
      if (!(length < best)) continue;
      best = length;
      best_mask = mask;
      best_weight = w;
      best_nearest = y;
      best_normal = n;
    }
    int kept = 0;
    for (int i = 0; i < count; ++i)
      if (best_mask >> i & 1) {
        pair[kept] = pair[i];
        z[kept] = z[i];
        weight[kept++] = best_weight[i];
      }
    count = kept;
    nearest = best_nearest;
    normal = best_normal;
    surrounds = count == D + 1;
  }

 private:
  static double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  }

  /// The point of the face's plane nearest to the origin, if it is inside the face.
  bool face(unsigned mask, std::array<double, D + 1>& w, Vector& y, Vector& n) const {
    int m = 0;
    std::array<int, D + 1> id{};
    for (int i = 0; i < count; ++i)
      if (mask >> i & 1) id[m++] = i;
    if (m == 1) {
      w[id[0]] = 1;
      y = n = z[id[0]];
      return true;
    }
    const Vector &a = z[id[0]], &b = z[id[1]];
    if (m == 2) {
      const Vector e = b - a;
      const double wa = b.dot(e), wb = -a.dot(e), sum = e.squaredNorm();
      if (!(wa > 0 && wb > 0 && sum > 0)) return false;
      w[id[0]] = wa / sum;
      w[id[1]] = wb / sum;
      y = n = a + w[id[1]] * e;
      if constexpr (D == 2) {
        n = Vector(-e.y(), e.x());
        const double height = n.dot(a);
        if (height < 0) n = -n;
        // Along the edge's normal the distance is height / |e|, free of the cancellation in a + t e.
        y = n * (std::abs(height) / sum);
      }
      return true;
    }
    const Vector& c = z[id[2]];
    if constexpr (D == 2) {
      const double wa = cross(b, c), wb = cross(c, a), wc = cross(a, b), sum = wa + wb + wc;
      const bool inside = (wa > 0 && wb > 0 && wc > 0) || (wa < 0 && wb < 0 && wc < 0);
      if (!inside) return false;
      w = {wa / sum, wb / sum, wc / sum};
      y = n = Vector::Zero();
      return true;
    } else {
      if (m == 3) {
        n = (b - a).cross(c - a);
        const double sum = n.squaredNorm();
        if (!(sum > 0)) return false;
        const double wa = n.dot(b.cross(c)), wb = n.dot(c.cross(a)), wc = n.dot(a.cross(b));
        if (!(wa > 0 && wb > 0 && wc > 0)) return false;
        w[id[0]] = wa / sum;
        w[id[1]] = wb / sum;
        w[id[2]] = wc / sum;
        const double height = n.dot(a);
        if (height < 0) n = -n;
        y = n * (std::abs(height) / sum);
        return true;
      }
      const Vector& d = z[id[3]];
      const double wa = b.dot(c.cross(d)), wb = -a.dot(c.cross(d)), wc = a.dot(b.cross(d)),
                   wd = -a.dot(b.cross(c)), sum = wa + wb + wc + wd;
      const bool inside = (wa > 0 && wb > 0 && wc > 0 && wd > 0) || (wa < 0 && wb < 0 && wc < 0 && wd < 0);
      if (!inside) return false;
      w = {wa / sum, wb / sum, wc / sum, wd / sum};
      y = n = Vector::Zero();
      return true;
    }
  }
};

/// Runs the search for the points G x, x in K's hull of points; the ellipsoid is the ball of radius
/// scene.radius() in these coordinates. `at_point(simplex)` is called with every nearest point,
/// `at_plane(simplex, normal, support)` with every plane tried (`normal` in space, largest entry 1); a true
/// return ends the search. The simplex is left where it ended.
template <int D, typename AtPoint, typename AtPlane>
void search_hull(const HullScene& scene, const Eigen::Matrix<double, D, 3>& g, HullSimplex<D>& simplex,
                 const AtPoint& at_point, const AtPlane& at_plane) noexcept {
  constexpr int kMostSteps = 60;
  simplex.count = 0;
  simplex.add(scene.start, g * scene.difference(scene.start));
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMostSteps; ++step) {
    simplex.reduce();
    const double length = simplex.nearest.squaredNorm();
    if (!(length < last)) return;  // no progress, or not a number
    last = length;
    if (at_point(simplex) || simplex.surrounds) return;
    Eigen::Vector3d n = g.transpose() * simplex.normal;
    const double largest = n.cwiseAbs().maxCoeff();
    if (!(largest > 1e-250 && largest < 1e250)) return;
    n /= largest;
    const HullSupport support = least_support(scene, n);
    if (at_plane(simplex, n, support)) return;
    const Eigen::Matrix<double, D, 1> image = g * scene.difference(support.pair);
    // No point is nearer along the normal than the face: converged.
    const double gain = simplex.normal.dot(simplex.z[0] - image);
    if (!(gain > 1e-15 * simplex.normal.norm() * simplex.z[0].norm())) return;
    simplex.add(support.pair, image);
  }
}

/// Two rows orthogonal to w, orthonormal where the ellipsoid is the unit ball.
inline Eigen::Matrix<double, 2, 3> shadow_plane(const HullScene& scene, const Eigen::Vector3d& w) {
  const Eigen::Vector3d axis = (scene.to_ball * w).normalized();
  const Eigen::Vector3d p = axis.unitOrthogonal(), q = axis.cross(p);
  Eigen::Matrix<double, 2, 3> g;
  g.row(0) = p.transpose() * scene.to_ball;
  g.row(1) = q.transpose() * scene.to_ball;
  return g;
}

/// Where a search in doubles of the shadow along w ends: the points of K nearest to the line of w, or around
/// it. `w`: largest entry 1.
inline std::vector<HullPair> around_line(const HullScene& scene, const Eigen::Vector3d& w) {
  if (!scene.usable) return {};
  HullSimplex<2> simplex;
  search_hull<2>(
      scene, shadow_plane(scene, w), simplex, [](const auto&) { return false; },
      [](const auto&, const auto&, const auto&) { return false; });
  return {simplex.pair.begin(), simplex.pair.begin() + simplex.count};
}

}  // namespace vericone
