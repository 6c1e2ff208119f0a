// SPDX-License-Identifier: BSD-3-Clause
//
// True sectors of bodies without a closed form, from certified answers about single directions.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane_cones.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector3d;

}  // namespace

ExactHull::ExactHull(const Ellipsoid& agent, const HullBody& hull)
    : oracle_(agent, Assembly::polyhedra({hull})), disjoint_(oracle_.relation() == Relation::disjoint) {}

std::optional<Opening> ExactHull::on(const Vector3d& u, const Vector3d& e) const {
  if (!disjoint_) return std::nullopt;
  const ExtremeDirection left = oracle_.extreme(u, e, kEdge), right = oracle_.extreme(u, -e, kEdge);
  if (!left.any && !right.any) return std::nullopt;
  const auto middle = [](const ExtremeDirection& d) { return 0.5 * (d.low + d.high); };
  double to_left = middle(left), to_right = middle(right);
  // The line of sight ends at the reference point, which need not be in the hull: the cone may lie on one
  // side of it, and its near edge is the far one seen from behind.
  if (!right.any) to_right = middle(oracle_.extreme(-u, e, kEdge)) - std::numbers::pi;
  if (!left.any) to_left = middle(oracle_.extreme(-u, -e, kEdge)) - std::numbers::pi;
  return Opening{to_left + to_right, 0.5 * (to_left - to_right)};
}

TrueCombined::TrueCombined(const CombinedEllipsoid& a, const CombinedEllipsoid& b)
    : oracle_(a, b, kEdge), disjoint_(oracle_.relation() == Relation::disjoint) {}

std::optional<Opening> TrueCombined::on(const Vector3d& u, const Vector3d& e) const {
  if (!disjoint_) return std::nullopt;
  // Each half-plane from the line of centres holds one interval of the cone, which begins there.
  const auto edge = [&](const Vector3d& side) {
    double in = 0, out = std::numbers::pi;
    while (out - in > kEdge) {
      const double t = 0.5 * (in + out);
      const Certified answer = oracle_.membership(std::cos(t) * u + std::sin(t) * side);
      (answer == Certified::out ? out : in) = t;
    }
    return out;
  };
  const double to_left = edge(e), to_right = edge(-e);
  return Opening{to_left + to_right, 0.5 * (to_left - to_right)};
}

}  // namespace vericone::guidance
