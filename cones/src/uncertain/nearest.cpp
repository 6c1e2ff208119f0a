// SPDX-License-Identifier: BSD-3-Clause
#include "uncertain/nearest.h"

#include <Eigen/Geometry>

namespace vericone::robust {
namespace {

using Corner = Nearest::Corner;

/// The point of a simplex nearest to 0; keeps the corners that it is made of, with their weights.
class Simplex {
 public:
  Simplex(std::array<Corner, 4>& corners, int& count) : corner_(corners), count_(count) {}

  /// False where 0 is inside.
  bool reduce(Vector3d& y) {
    if (count_ == 4) {
      if (holds_zero()) return false;
      // The nearest of its faces.
      const std::array<Corner, 4> all = corner_;
      std::array<Corner, 4> best = all;
      int best_count = 0;
      double least = std::numeric_limits<double>::infinity();
      for (int skip = 0; skip < 4; ++skip) {
        for (int i = 0, k = 0; i < 4; ++i)
          if (i != skip) corner_[k++] = all[i];
        count_ = 3;
        const Vector3d z = triangle();
        if (z.squaredNorm() < least) least = z.squaredNorm(), best = corner_, best_count = count_, y = z;
      }
      corner_ = best;
      count_ = best_count;
      return true;
    }
    if (count_ == 3)
      y = triangle();
    else if (count_ == 2)
      y = segment();
    else
      y = keep_one(0);
    return true;
  }

 private:
  const Vector3d& x(int i) const { return corner_[i].x; }

  Vector3d keep_one(int i) {
    corner_[0] = corner_[i];
    corner_[0].weight = 1;
    count_ = 1;
    return x(0);
  }
  Vector3d keep_two(int i, int j, double at) {
    const Corner p = corner_[i], q = corner_[j];
    corner_[0] = p, corner_[1] = q;
    corner_[0].weight = 1 - at, corner_[1].weight = at;
    count_ = 2;
    return p.x + at * (q.x - p.x);
  }

  Vector3d segment() {
    const Vector3d d = x(1) - x(0);
    const double along = -x(0).dot(d), length = d.squaredNorm();
    if (!(along > 0)) return keep_one(0);
    if (along >= length) return keep_one(1);
    return keep_two(0, 1, along / length);
  }

  /// By the regions of its corners, edges and inside.
  Vector3d triangle() {
    const Vector3d ab = x(1) - x(0), ac = x(2) - x(0);
    const double d1 = -ab.dot(x(0)), d2 = -ac.dot(x(0));
    if (d1 <= 0 && d2 <= 0) return keep_one(0);
    const double d3 = -ab.dot(x(1)), d4 = -ac.dot(x(1));
    if (d3 >= 0 && d4 <= d3) return keep_one(1);
    const double d5 = -ab.dot(x(2)), d6 = -ac.dot(x(2));
    if (d6 >= 0 && d5 <= d6) return keep_one(2);
    const double of_c = d1 * d4 - d3 * d2;
    if (of_c <= 0 && d1 >= 0 && d3 <= 0) return keep_two(0, 1, d1 / (d1 - d3));
    const double of_b = d5 * d2 - d1 * d6;
    if (of_b <= 0 && d2 >= 0 && d6 <= 0) return keep_two(0, 2, d2 / (d2 - d6));
    const double of_a = d3 * d6 - d5 * d4;
    if (of_a <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return keep_two(1, 2, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double sum = of_a + of_b + of_c;
    corner_[0].weight = of_a / sum, corner_[1].weight = of_b / sum, corner_[2].weight = of_c / sum;
    // Along the normal, which keeps more digits than the sum.
    const Vector3d n = ab.cross(ac);
    return n * (n.dot(x(0)) / n.squaredNorm());
  }

  /// By the edges from one corner, which keep their digits where the simplex is small and far away.
  bool holds_zero() {
    const Vector3d e1 = x(1) - x(0), e2 = x(2) - x(0), e3 = x(3) - x(0);
    const double all = det(e1, e2, e3);
    if (all == 0) return false;
    const auto shares = [&](const Vector3d& to) {
      return Vector3d(Vector3d(det(to, e2, e3), det(e1, to, e3), det(e1, e2, to)) / all);
    };
    Vector3d w = shares(-x(0));
    w += shares(-(x(0) + w(0) * e1 + w(1) * e2 + w(2) * e3));
    const double first = 1 - w.sum();
    if (!(first > 0 && w.minCoeff() > 0)) return false;
    corner_[0].weight = first;
    for (int i = 0; i < 3; ++i) corner_[std::size_t(i + 1)].weight = w(i);
    return true;
  }
  static double det(const Vector3d& p, const Vector3d& q, const Vector3d& r) { return p.dot(q.cross(r)); }

  std::array<Corner, 4>& corner_;
  int& count_;
};

/// A horizon after which nothing more can happen where errors leave the relative motion its direction, so
/// that D is bounded. Where they do not, a long one.
double bounded_horizon(const Engagement& e) {
  const double speed = e.w.norm(), most = speed + e.velocity.reach();
  if (!(most > 0)) return 0;
  const double least = speed > 0 ? speed - e.velocity.support(e.w / speed) : 0;
  const double far = e.c.norm() + e.reach() + e.position.reach();
  return std::min(e.horizon, 4 * far / std::max(least, 0.05 * most));
}

/// Without an end nothing may approach along n: n is tilted away from w as far as needed.
bool proves(const Engagement& e, const Vector3d& n, double span, Vector3d& proved) {
  proved = n;
  if (span < e.horizon) {
    const double closing = n.dot(e.w) + e.velocity.support(n), size = e.w.norm() + e.velocity.reach();
    const double slack = 1e-15 * size;
    if (closing > -slack) {
      const double speed = e.w.norm();
      if (!(speed > 0)) return size == 0 && e.separates_all(n);
      const Vector3d along = e.w / speed;
      const double effect = speed - e.velocity.support(along);
      if (!(effect > 0)) return false;
      proved -= along * ((closing + 2 * slack) / effect);
    }
  }
  return e.separates_all(proved);
}

}  // namespace

Nearest nearest(const Engagement& e, const Vector3d& start) {
  Nearest result;
  result.span = bounded_horizon(e);
  const auto corner = [&](const Vector3d& n) {
    Corner k;
    k.n = n;
    k.x = e.c - e.farthest(n) - e.position.support_point(n);
    const Vector3d fastest = e.w + e.velocity.support_point(n);
    k.late = n.dot(fastest) > 0;
    if (k.late) k.x -= result.span * fastest;
    return k;
  };
  Simplex simplex(result.corners, result.count);
  Vector3d n = start.normalized(), y = n;
  double best = 0;
  for (int i = 0; i < 100; ++i) {
    const Corner next = corner(n);
    const double gap = n.dot(next.x);
    if (gap > best) {
      best = gap;
      if (proves(e, n, result.span, result.normal)) {
        result.nearness = Nearness::apart;
        return result;
      }
    }
    // No nearer than the last: rounding.
    for (int k = 0; k < result.count; ++k)
      if (result.corners[k].x == next.x) return result;
    result.corners[result.count++] = next;
    if (!simplex.reduce(y)) {
      result.nearness = Nearness::meet;
      return result;
    }
    const double length = y.norm();
    if (!(length > 1e-14 * (e.c.norm() + e.reach()))) {
      // On a face, an edge or a corner of the simplex.
      result.nearness = Nearness::meet;
      return result;
    }
    if (gap > 0 && length - gap < 1e-13 * length) return result;
    n = y / length;
  }
  return result;
}

}  // namespace vericone::robust
