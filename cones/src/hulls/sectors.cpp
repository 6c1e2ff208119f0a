// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/hulls/hull_sectors.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vector3d turned_by(double angle, const Vector3d& u, const Vector3d& side) {
  return std::cos(angle) * u + std::sin(angle) * side;
}

/// The plane through the line of centres that turns farthest towards `side` and has all balls about the
/// points beyond it: n = u + tau side + s p with n.y >= |n| for all of them, the largest tau. tau(s) is
/// concave; its largest value is where one ball's own is or where two meet.
class FarthestPlane {
 public:
  struct Bound {
    double tau = -kInfinity, slope = 0;
    int point = -1;  // none: no tau for this s
  };

  FarthestPlane(const std::vector<Vector3d>& points, const Eigen::Matrix3d& map, const Vector3d& origin,
                const Vector3d& u, const Vector3d& side, const Vector3d& p)
      : points_(points),
        origin_(origin),
        to_u_(map.transpose() * u),
        to_side_(map.transpose() * side),
        to_p_(map.transpose() * p) {}

  Bound at(double s) const {
    Bound least;
    least.tau = kInfinity;
    for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
      const Vector3d x = points_[i] - origin_;
      const double a = to_u_.dot(x) + s * to_p_.dot(x), b = to_side_.dot(x), q = 1 + s * s,
                   square = a * a - q * (1 - b * b);
      if (!(square >= 0)) {
        if (b >= 1) continue;
        return {};
      }
      const double root = std::sqrt(square);
      double tau;
      if (b >= 1) continue;  // no bound from above
      if (a * b > 0 && std::abs(b) < 1) {
        tau = (a * b + root) / (1 - b * b);
      } else {
        tau = (a * a - q) / (root - a * b);
      }
      if (!(a + tau * b >= 0)) return {};
      if (tau < least.tau) {
        const double rho = std::sqrt(q + tau * tau);
        least = {tau, -(to_p_.dot(x) - s / rho) / (b - tau / rho), i};
      }
    }
    return least;
  }

  /// From an s with a bound: the bounds on both sides of the largest tau, next to each other.
  bool search(double s, Bound& low, Bound& high, double& at_s) const {
    Bound here = at(s);
    if (here.point < 0) return false;
    double lo = s, hi = s;
    low = high = here;
    double step = 0.25;
    while (low.slope < 0) {
      if (!widen(lo, low, hi, high, -step)) return false;
      step *= 2;
      if (step > 1e6) return false;
    }
    step = 0.25;
    while (high.slope >= 0) {
      if (!widen(hi, high, lo, low, step)) return false;
      step *= 2;
      if (step > 1e6) return false;
    }
    for (int k = 0; k < 100 && hi - lo > 1e-15 * (1 + std::abs(lo)); ++k) {
      // Where the tangents meet, or where the slope would vanish; now and then the middle.
      double next = low.point == high.point
                        ? lo + (hi - lo) * low.slope / (low.slope - high.slope)
                        : lo + (high.tau - low.tau - high.slope * (hi - lo)) / (low.slope - high.slope);
      if (k % 3 == 2 || !(next > lo && next < hi)) next = 0.5 * (lo + hi);
      if (!(next > lo && next < hi)) break;
      const Bound middle = at(next);
      if (middle.point < 0) return false;
      if (middle.slope >= 0) {
        lo = next;
        low = middle;
      } else {
        hi = next;
        high = middle;
      }
    }
    at_s = low.tau >= high.tau ? lo : hi;
    return true;
  }

 private:
  /// Moves the end `x` by `step`, or as far as there is a bound; the other end follows where it was passed.
  bool widen(double& x, Bound& bound, double& other, Bound& other_bound, double step) const {
    for (int k = 0; k < 60; ++k, step *= 0.5) {
      const Bound next = at(x + step);
      if (next.point < 0) continue;
      other = x;
      other_bound = bound;
      x += step;
      bound = next;
      return true;
    }
    return false;
  }

  const std::vector<Vector3d>& points_;
  const Vector3d& origin_;
  Vector3d to_u_, to_side_, to_p_;
};

}  // namespace

HullSectors::HullSectors(const Ellipsoid& agent, const HullBody& hull, const HullOracle& oracle)
    : agent_(agent), hull_(hull), oracle_(oracle), inverse_(agent.factor().inverse()) {}

std::optional<GrazingEdge> HullSectors::edge(const Vector3d& reference, const Vector3d& u,
                                             const Vector3d& side) const {
  // Where the agent is the unit ball. The angle there is another one; the plane through both axes is the
  // same.
  const Vector3d first = (inverse_ * u).normalized();
  const Vector3d image = inverse_ * side, across = (image - image.dot(first) * first).normalized(),
                 p = first.cross(across);
  const Vector3d normal = agent_.factor().transpose() * oracle_.separating_normal();
  if (!(normal.dot(first) > 0)) return std::nullopt;
  const FarthestPlane planes(hull_.points(), inverse_, agent_.center(), first, -across, p);
  FarthestPlane::Bound low, high;
  double s = 0;
  if (!planes.search(normal.dot(p) / normal.dot(first), low, high, s)) return std::nullopt;
  const double tau = std::max(low.tau, high.tau);
  const Vector3d n = (first - tau * across + s * p).normalized();
  const auto corner = [&](int i) -> Vector3d { return inverse_ * (hull_.points()[i] - agent_.center()); };
  Vector3d y = corner(low.point);
  if (high.point != low.point) {
    const Vector3d z = corner(high.point);
    const double along = p.dot(z - y);
    if (along != 0) y += std::clamp(p.dot(n - y) / along, 0.0, 1.0) * (z - y);
  }
  GrazingEdge edge;
  edge.on_a = agent_.factor() * n;
  edge.on_b = agent_.center() + agent_.factor() * y - reference;
  edge.normal = (inverse_.transpose() * n).normalized();
  edge.touched_a.count = 1;
  edge.touched_a.weight[0] = (agent_.factor().transpose() * edge.normal).norm();
  // The edge is where its normal says, whatever part of its face is touched.
  edge.angle = std::atan2(edge.normal.dot(u), -edge.normal.dot(side));
  return edge;
}

std::optional<PlaneSector> HullSectors::on(const Vector3d& reference, const Vector3d& e) const {
  if (oracle_.relation() != Relation::disjoint || !oracle_.normal_certified()) return std::nullopt;
  const Vector3d c = reference - agent_.center(), u = c.normalized();
  // The line of sight ends at the reference point, which need not be in the hull.
  if (oracle_.membership(u) != Membership::in) return std::nullopt;
  PlaneSector sector;
  sector.line_of_sight = u;
  sector.across = e;
  sector.distance = c.norm();
  const auto put = [&](PlaneSector::Edge& place, const Vector3d& side) {
    auto found = edge(reference, u, side);
    if (!found || !(found->angle > kEdge && found->angle < std::numbers::pi - kEdge) ||
        oracle_.membership(turned_by(found->angle - kEdge, u, side)) == Membership::out ||
        oracle_.membership(turned_by(found->angle + kEdge, u, side)) != Membership::out)
      return false;
    found->error = kEdge;
    found->contact = c + found->on_b - found->on_a;
    place = *found;
    return true;
  };
  if (!put(sector.left, e) || !put(sector.right, -e)) return std::nullopt;
  return sector;
}

}  // namespace vericone
