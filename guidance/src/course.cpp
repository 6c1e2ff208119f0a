// SPDX-License-Identifier: BSD-3-Clause
//
// Whether two bodies will meet if neither does anything: what laws ask before they say anything.
#include <vericone/cones/combined/cone.h>
#include <vericone/cones/hulls/hull_oracle.h>
#include <vericone/guidance/guide.h>

namespace vericone::guidance {
namespace {

using Eigen::Vector3d;

/// The relative velocity against the sector on the plane that holds it.
std::optional<bool> by_sector(const BodyState& a, const BodyState& b, SectorMethod method, double cease) {
  PlaneOptions of_motion;
  of_motion.choice = PlaneChoice::of_motion;
  const auto across = choose_plane(a, b, method, of_motion);
  if (!across) return std::nullopt;
  const auto view = plane_view(a, b, *across, method, RateMethod::none);
  if (!view) return std::nullopt;
  const ConeRates rates = cone_rates(view->state, view->cone);
  return rates.y < cease && rates.v_r_hat < 0;
}

std::optional<bool> exactly(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& v_a,
                            const Vector3d& v_b) {
  const ConeOracle oracle(a, b);
  if (oracle.relation() != Relation::disjoint) return std::nullopt;
  return oracle.membership(v_a, v_b) != Membership::out;
}

std::optional<bool> exactly(const BodyState& a, const BodyState& b) {
  const auto& agent = std::get<CombinedEllipsoid>(a.shape);
  if (const auto* hull = std::get_if<HullBody>(&b.shape)) {
    const HullOracle oracle(agent.ellipsoid(), *hull);
    if (oracle.relation() != Relation::disjoint) return std::nullopt;
    return oracle.membership(a.velocity, b.velocity) != Membership::out;
  }
  const auto& obstacle = std::get<CombinedEllipsoid>(b.shape);
  if (agent.is_ellipsoid() && obstacle.is_ellipsoid())
    return exactly(agent.ellipsoid(), obstacle.ellipsoid(), a.velocity, b.velocity);
  const CombinedOracle oracle(agent, obstacle);
  if (oracle.relation() != Relation::disjoint) return std::nullopt;
  return oracle.membership(a.velocity - b.velocity) != Certified::out;
}

}  // namespace

std::optional<bool> on_collision_course(const BodyState& a, const BodyState& b, SectorMethod method,
                                        double cease) {
  const bool hull_agent = std::holds_alternative<HullBody>(a.shape);
  if (a.planar() || hull_agent || method == SectorMethod::slice || cease > 0)
    return by_sector(a, b, method, cease);
  const std::optional<bool> course = exactly(a, b);
  // Below 0 the law is to let go before the cone is left.
  return course && *course && cease < 0 ? by_sector(a, b, method, cease) : course;
}

}  // namespace vericone::guidance
