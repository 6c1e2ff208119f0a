// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/clearance.h>

#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "answers/interval_vector.h"
#include "ellipsoids/enclosed_pair.h"

namespace vericone {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Normals that are exactly perpendicular to w: L^T z with the projection that needs no division,
/// L x = (w_k x_i - w_i x_k, w_k x_j - w_j x_k).
class NormalsAcross {
 public:
  explicit NormalsAcross(const Vector3d& w) {
    w.cwiseAbs().maxCoeff(&k_);
    i_ = (k_ + 1) % 3;
    j_ = (k_ + 2) % 3;
    w_ = w * std::ldexp(1.0, -std::ilogb(std::abs(w(k_))));
  }

  IntervalVector3 normal(const Interval& x, const Interval& y) const {
    IntervalVector3 n;
    n[i_] = Interval(w_(k_)) * x;
    n[j_] = Interval(w_(k_)) * y;
    n[k_] = -(Interval(w_(i_)) * x + Interval(w_(j_)) * y);
    return n;
  }
  /// The z of a normal about perpendicular to w.
  Vector2d coordinates(const Vector3d& n) const { return Vector2d(n(i_), n(j_)) / w_(k_); }
  IntervalVector3 velocity() const { return {w_(0), w_(1), w_(2)}; }

 private:
  int i_, j_, k_;
  Vector3d w_;
};

/// c minus the supporting points of n: the vector between a point of A and a point of B.
IntervalVector3 between_supports(const EnclosedPair<3>& pair, const IntervalVector3& n) {
  const IntervalVector3 at_a = pair.a.support(n).point(), at_b = pair.b.support(n).point();
  IntervalVector3 q;
  for (int r = 0; r < 3; ++r) q[r] = pair.c[r] - at_a[r] - at_b[r];
  return q;
}

/// Lengths of the pair's unit in metres; infinite where the range of doubles ends.
Interval in_metres(const EnclosedPair<3>& pair, const Interval& x) { return scaled_down(x, -pair.exponent); }

bool in_range(const EnclosedPair<3>& pair) { return pair.usable && std::abs(pair.exponent) < 465; }

/// Whether g(n) <= bound |n| for all n = L^T z with z on one side of the square max |z_i| = 1, side 0..3, its
/// free coordinate in [lo, hi]. Mean value form; halves what it cannot decide. `budget`: boxes left.
bool below_everywhere(const EnclosedPair<3>& pair, const NormalsAcross& across, double bound, int side,
                      double lo, double hi, int& budget) {
  if (--budget < 0) return false;
  const double middle = 0.5 * (lo + hi);
  const auto at = [&](const Interval& t) {
    const double fixed = side < 2 ? 1 : -1;
    return side % 2 == 0 ? across.normal(fixed, t) : across.normal(t, fixed);
  };
  const IntervalVector3 along = side % 2 == 0 ? across.normal(0.0, 1.0) : across.normal(1.0, 0.0);
  const Interval range = Interval::between(lo, hi);
  const IntervalVector3 n = at(range), n0 = at(middle);
  // h(t) = n.c - rho_A - rho_B - bound |n|
  const Interval value = pair.gap(n0) - Interval(bound) * norm(n0);
  const auto a = pair.a.support(n), b = pair.b.support(n);
  const Interval length = norm(n);
  if (a.rho.positive() && b.rho.positive() && length.positive()) {
    const Interval slope = dot(along, pair.c) - dot(along, a.shape_times_n) / a.rho -
                           dot(along, b.shape_times_n) / b.rho - Interval(bound) * (dot(along, n) / length);
    const Interval whole = value + slope * (range - Interval(middle));
    if (whole.hi() <= 0) return true;
  }
  if (value.positive() || hi - lo < 1e-13) return false;
  return below_everywhere(pair, across, bound, side, lo, middle, budget) &&
         below_everywhere(pair, across, bound, side, middle, hi, budget);
}

}  // namespace

Interval enclose_clearance(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w) {
  const Clearance near = clearance(a, b, w);  // refuses bad velocities
  const EnclosedPair<3> pair(a, b);
  if (!in_range(pair)) return {0, kInfinity};
  const NormalsAcross across(w);
  const Vector2d z = across.coordinates(near.normal);
  const IntervalVector3 n = across.normal(z.x(), z.y());
  const Interval lower = pair.gap(n) / norm(n);
  if (lower.positive()) {
    // The two supporting points, projected along w, are points of the two shadows.
    const IntervalVector3 v = across.velocity();
    const Interval upper = norm(cross(between_supports(pair, n), v)) / norm(v);
    return in_metres(pair, Interval::between(lower.lo(), std::max(lower.hi(), upper.hi())));
  }
  for (int bits = 40; bits >= 0; bits -= 4) {
    const double bound = lower.hi() + std::ldexp(1.0, -bits);
    int budget = 2000;
    bool proved = true;
    for (int side = 0; side < 4 && proved; ++side)
      proved = below_everywhere(pair, across, bound, side, -1, 1, budget);
    if (proved) return in_metres(pair, Interval::between(lower.lo(), bound));
  }
  return in_metres(pair, Interval::between(lower.lo(), 2));  // |c| <= sqrt(3) bounds every gap
}

Interval enclose_separation(const Ellipsoid& a, const Ellipsoid& b) {
  if (relation<3>(a, b) != Relation::disjoint) return 0.0;
  const Vector3d normal = separation(a, b).normal;
  const EnclosedPair<3> pair(a, b);
  if (!in_range(pair)) return {0, kInfinity};
  const IntervalVector3 n{normal.x(), normal.y(), normal.z()};
  const Interval lower = pair.gap(n) / norm(n);
  return in_metres(pair, Interval::between(std::max(0.0, lower.lo()),
                                           std::max(lower.hi(), norm(between_supports(pair, n)).hi())));
}

std::optional<PlaneSectorEnclosure> enclose_plane_sector(const Ellipsoid& a, const Ellipsoid& b,
                                                         const Vector3d& across) {
  const PlaneSector sector = true_sector(a, b, across);
  const ConeOracle oracle(a, b);
  // u and e as boxes around the true ones: c / |c|, and what is left of `across` without its part along c.
  IntervalVector3 u, e, towards{across.x(), across.y(), across.z()};
  for (int r = 0; r < 3; ++r) u[r] = Interval(b.center()(r)) - Interval(a.center()(r));
  const Interval distance = norm(u);
  for (Interval& x : u) x = x / distance;
  const Interval part = dot(towards, u);
  for (int r = 0; r < 3; ++r) e[r] = towards[r] - part * u[r];
  const Interval rest = norm(e);
  for (Interval& x : e) x = x / rest;
  const auto enclose = [&](double angle, double side) -> std::optional<Interval> {
    const auto membership = [&](double phi) {
      const Interval c = rounded_by_library(std::cos(phi)), s = rounded_by_library(side * std::sin(phi));
      IntervalVector3 w;
      for (int r = 0; r < 3; ++r) w[r] = c * u[r] + s * e[r];
      return oracle.interval_membership(w);
    };
    for (int bits = 50; bits > 3; --bits) {
      const double step = std::ldexp(1.0, -bits);
      // The line of sight is inside, so the ray turns outwards exactly once in the half-plane.
      if (membership(angle - step) == Membership::in && membership(angle + step) == Membership::out)
        return Interval::between(angle - step, angle + step);
    }
    return std::nullopt;
  };
  const auto left = enclose(sector.left.angle, 1), right = enclose(sector.right.angle, -1);
  if (!left || !right) return std::nullopt;
  return PlaneSectorEnclosure{*left, *right};
}

}  // namespace vericone
