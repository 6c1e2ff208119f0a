// SPDX-License-Identifier: BSD-3-Clause
//
// True sectors of bodies without a closed form: contacts by Newton's method or a search, asked of the
// certified oracles.
#include <vericone/cones/assembly/assembly_oracle.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "plane_cones.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vector3d turned_by(double angle, const Vector3d& u, const Vector3d& side) {
  return std::cos(angle) * u + std::sin(angle) * side;
}

/// How fast the boundary of a body moves outwards at a contact as its shape changes. The normal is the sum of
/// w M y over the surfaces y^T M y <= l touched there, and each counts by w (l' - y^T M' y) / 2.
double shape_speed(const TouchedSurfaces& touched, const Vector3d& y, const Vector3d& outward,
                   const Shape& shape, const ShapeRate* rate) {
  const auto* body = std::get_if<CombinedEllipsoid>(&shape);
  if (!rate || !body) return 0;
  double speed = 0, of_ellipsoid = 0;
  Vector3d rest = outward;
  for (int k = 0; k < touched.count; ++k) {
    const std::size_t i = touched.surface[k];
    if (i == 0) {
      of_ellipsoid = touched.weight[k];
      continue;
    }
    rest -= touched.weight[k] * (body->delimiters()[i - 1].matrix * y);
    if (i > rate->delimiters.size()) continue;
    const SpatialDelimiterRate& d = rate->delimiters[i - 1];
    speed += 0.5 * touched.weight[k] * (d.level - y.dot(d.matrix * y));
  }
  // Of the ellipsoid M' = -S^{-1} S' S^{-1}, and what is left of the normal is w S^{-1} y.
  if (of_ellipsoid > 1e-9 * y.norm()) speed += 0.5 / of_ellipsoid * rest.dot(rate->shape * rest);
  return speed;
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

OpeningRates contact_rates(const TrueEdges& edges, const BodyState& a, const BodyState& b, const Vector3d& u,
                           const Vector3d& e, const Vector3d& velocity, const Vector3d& plane_turning,
                           const TurningMotion& motion) {
  const Vector3d c = b.position - a.position;
  // n.d = 0 and n.k = 0 for k = c + b - a along d. That k stays on the boundary moves it along n by g_t, as
  // the points in contact move; the rest is the turning of d, of its own and with the plane.
  const auto edge_rate = [&](const CombinedEdge& edge, double side) {
    const double cosine = std::cos(edge.angle), sine = side * std::sin(edge.angle);
    const Vector3d d = cosine * u + sine * e, turned = -sine * u + cosine * e;
    const Vector3d& n = edge.normal;
    const double way = (c + edge.on_b - edge.on_a).dot(d);
    const double moved = n.dot(velocity + motion.omega_b.cross(edge.on_b) - motion.omega_a.cross(edge.on_a)) -
                         shape_speed(edge.touched_a, edge.on_a, n, a.shape, motion.rate_a) -
                         shape_speed(edge.touched_b, edge.on_b, -n, b.shape, motion.rate_b);
    return side * (moved / way - n.dot(plane_turning.cross(d))) / n.dot(turned);
  };
  const double left = edge_rate(edges.left, 1), right = edge_rate(edges.right, -1);
  return {left + right, 0.5 * (left - right)};
}

TrueHull::TrueHull(const Ellipsoid& agent, const HullBody& hull, const Vector3d& position)
    : agent_(agent),
      hull_(hull),
      oracle_(agent, hull),
      position_(position),
      inverse_(agent.factor().inverse()) {}

std::optional<CombinedEdge> TrueHull::edge(const Vector3d& u, const Vector3d& side) const {
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
  CombinedEdge edge;
  edge.on_a = agent_.factor() * n;
  edge.on_b = agent_.center() + agent_.factor() * y - position_;
  edge.normal = (inverse_.transpose() * n).normalized();
  edge.touched_a.count = 1;
  edge.touched_a.weight[0] = (agent_.factor().transpose() * edge.normal).norm();
  // The edge is where its normal says, whatever part of its face is touched.
  edge.angle = std::atan2(edge.normal.dot(u), -edge.normal.dot(side));
  return edge;
}

std::optional<TrueEdges> TrueHull::on(const Vector3d& u, const Vector3d& e) const {
  if (oracle_.relation() != Relation::disjoint) return std::nullopt;
  // The line of sight ends at the reference point, which need not be in the hull.
  if (oracle_.normal_certified() && oracle_.membership(u) == Membership::in) {
    const auto left = edge(u, e), right = edge(u, -e);
    const auto certain = [&](const std::optional<CombinedEdge>& found, const Vector3d& side) {
      return found && found->angle > kEdge && found->angle < std::numbers::pi - kEdge &&
             oracle_.membership(turned_by(found->angle - kEdge, u, side)) != Membership::out &&
             oracle_.membership(turned_by(found->angle + kEdge, u, side)) == Membership::out;
    };
    if (certain(left, e) && certain(right, -e)) return TrueEdges{*left, *right};
  }
  return by_assembly(u, e);
}

std::optional<TrueEdges> TrueHull::by_assembly(const Vector3d& u, const Vector3d& e) const {
  const AssemblyOracle oracle(agent_, Assembly::polyhedra({hull_}));
  if (oracle.relation() != Relation::disjoint) return std::nullopt;
  const ExtremeDirection left = oracle.extreme(u, e, kEdge), right = oracle.extreme(u, -e, kEdge);
  if (!left.any && !right.any) return std::nullopt;
  const auto middle = [](const ExtremeDirection& d) { return 0.5 * (d.low + d.high); };
  TrueEdges edges;
  edges.left.angle = middle(left);
  edges.right.angle = middle(right);
  // The cone may lie on one side of the line of sight, and its near edge is the far one seen from behind.
  if (!right.any) edges.right.angle = middle(oracle.extreme(-u, e, kEdge)) - std::numbers::pi;
  if (!left.any) edges.left.angle = middle(oracle.extreme(-u, -e, kEdge)) - std::numbers::pi;
  return edges;
}

TrueCombined::TrueCombined(const CombinedEllipsoid& a, const CombinedEllipsoid& b, EdgeMemory* memory)
    : oracle_(a, b, kEdge), disjoint_(oracle_.relation() == Relation::disjoint), memory_(memory) {}

CombinedEdge TrueCombined::edge(const Vector3d& u, const Vector3d& side,
                                std::optional<CombinedEdge>& before) const {
  const EdgeBracket bracket = oracle_.edge(u, side, kEdge, before ? &*before : nullptr);
  if (bracket.edge) return *(before = bracket.edge);
  before.reset();
  CombinedEdge edge;
  edge.angle = bracket.out;
  return edge;
}

std::optional<TrueEdges> TrueCombined::on(const Vector3d& u, const Vector3d& e) const {
  if (!disjoint_) return std::nullopt;
  EdgeMemory& before = memory_ ? *memory_ : own_;
  const CombinedEdge left = edge(u, e, before.left), right = edge(u, -e, before.right);
  return TrueEdges{left, right};
}

}  // namespace vericone::guidance
