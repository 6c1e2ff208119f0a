// SPDX-License-Identifier: BSD-3-Clause
//
// Whether two bodies will meet if neither does anything: what laws ask before they say anything.
#include <vericone/cones/combined/cone.h>
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

/// By the true cone. Ellipsoids and dented bodies are asked without a Pair, which would prepare more.
std::optional<bool> truly(const BodyState& a, const BodyState& b) {
  const auto* agent = std::get_if<CombinedEllipsoid>(&a.shape);
  const auto* obstacle = std::get_if<CombinedEllipsoid>(&b.shape);
  if (agent && obstacle && agent->is_ellipsoid() && obstacle->is_ellipsoid()) {
    const ConeOracle oracle(agent->ellipsoid(), obstacle->ellipsoid());
    if (oracle.relation() != Relation::disjoint) return std::nullopt;
    return oracle.membership(a.velocity, b.velocity) != Membership::out;
  }
  if (agent && obstacle) {
    const CombinedOracle oracle(*agent, *obstacle);
    if (oracle.relation() != Relation::disjoint) return std::nullopt;
    return oracle.verdict(a.velocity, b.velocity) != Verdict::out;
  }
  const Pair pair = pair_of(a.shape, b.shape);
  if (pair.relation() != Relation::disjoint) return std::nullopt;
  return pair.verdict(a.velocity, b.velocity) != Verdict::out;
}

}  // namespace

std::optional<bool> on_collision_course(const BodyState& a, const BodyState& b, SectorMethod method,
                                        double cease) {
  if (!has_sectors(a, b, method)) return truly(a, b);
  if (a.planar() || method == SectorMethod::slice || cease > 0) return by_sector(a, b, method, cease);
  const std::optional<bool> course = truly(a, b);
  // Below 0 the law is to let go before the cone is left.
  return course && *course && cease < 0 ? by_sector(a, b, method, cease) : course;
}

}  // namespace vericone::guidance
