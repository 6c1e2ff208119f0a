// SPDX-License-Identifier: BSD-3-Clause
#include "plane_cones.h"

#include <vericone/cones/cone_geometry.h>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone::guidance {

using Eigen::Vector3d;

Vector3d across_axis(const Vector3d& u, const Vector3d& v) {
  Vector3d rest = v - v.dot(u) * u;
  if (!(rest.norm() > 1e-12 * v.norm())) return AxisFrame(u).e1;
  rest.normalize();
  // Twice: what is left of a vector nearly along u is not perpendicular to it yet.
  return (rest - rest.dot(u) * u).normalized();
}

bool has_sectors(const BodyState& a, const BodyState& b, SectorMethod method) {
  if (a.planar() || b.planar()) return a.planar() && b.planar();
  if (method == SectorMethod::true_cone) return true;
  const auto* agent = std::get_if<CombinedEllipsoid>(&a.shape);
  return agent && (std::holds_alternative<CombinedEllipsoid>(b.shape) ||
                   (agent->is_ellipsoid() && std::holds_alternative<HullBody>(b.shape)));
}

PlaneCones::PlaneCones(const BodyState& a, const BodyState& b, SectorMethod method, EdgeMemory* memory)
    : kind_(kind_of(a, b, method, memory)) {}

PlaneCones::Kind PlaneCones::kind_of(const BodyState& a, const BodyState& b, SectorMethod method,
                                     EdgeMemory* memory) {
  if (a.planar() && b.planar())
    return Planar{std::get<CombinedEllipse>(a.shape), std::get<CombinedEllipse>(b.shape)};
  if (a.planar() || b.planar()) return None{};
  const auto* agent = std::get_if<CombinedEllipsoid>(&a.shape);
  const auto any_two = [&]() -> Kind {
    if (method == SectorMethod::slice) return None{};
    return TruePair{pair_of(a.shape, b.shape), a.position, b.position};
  };
  if (!agent) return any_two();
  if (const auto* hull = std::get_if<HullBody>(&b.shape)) {
    if (!agent->is_ellipsoid()) return any_two();
    if (method == SectorMethod::slice) return HullSlices{agent->ellipsoid(), *hull};
    return TrueHull(agent->ellipsoid(), *hull, b.position);
  }
  const auto* obstacle = std::get_if<CombinedEllipsoid>(&b.shape);
  if (!obstacle) return any_two();
  if (method == SectorMethod::slice) return Slices{*agent, *obstacle};
  if (agent->is_ellipsoid() && obstacle->is_ellipsoid())
    return SectorPlanes(agent->ellipsoid(), obstacle->ellipsoid());
  return TrueCombined(*agent, *obstacle, memory);
}

std::optional<Opening> PlaneCones::on(const Vector3d& u, const Vector3d& e) const {
  struct Ask {
    const Vector3d &u, &e;

    std::optional<Opening> operator()(const None&) const { return std::nullopt; }
    std::optional<Opening> operator()(const Planar& pair) const {
      const Sector sector = combined_sector(pair.a, pair.b).sector;
      if (sector.relation != Relation::disjoint) return std::nullopt;
      return Opening{sector.psi,
                     std::remainder(sector.theta_b - std::atan2(u.y(), u.x()), 2 * std::numbers::pi)};
    }
    std::optional<Opening> operator()(const Slices& pair) const {
      const Sections sections = sections_of(pair.a, pair.b, u, e);
      if (!sections.disjoint()) return std::nullopt;
      return sections.opening();
    }
    std::optional<Opening> operator()(const HullSlices& pair) const {
      return hull_section(pair.agent, pair.hull, u, e);
    }
    std::optional<Opening> operator()(const SectorPlanes& planes) const {
      if (!planes.disjoint()) return std::nullopt;
      const PlaneSector sector = planes.on(e);
      return Opening{sector.psi(), sector.theta_b()};
    }
    std::optional<Opening> operator()(const TrueHull& cone) const { return opening(cone.on(e)); }
    std::optional<Opening> operator()(const TrueCombined& cone) const { return opening(cone.on(e)); }
    std::optional<Opening> operator()(const TruePair& seen) const {
      return opening(seen.pair.sector(seen.from, seen.to, e));
    }

    static std::optional<Opening> opening(const std::optional<PlaneSector>& sector) {
      return sector ? std::optional(Opening{sector->psi(), sector->theta_b()}) : std::nullopt;
    }
  };
  return std::visit(Ask{u, e}, kind_);
}

std::optional<PlaneSector> PlaneCones::true_sector(const Vector3d& e) const {
  if (const auto* hull = std::get_if<TrueHull>(&kind_)) return hull->on(e);
  if (const auto* seen = std::get_if<TruePair>(&kind_)) return seen->pair.sector(seen->from, seen->to, e);
  if (const auto* combined = std::get_if<TrueCombined>(&kind_)) return combined->on(e);
  return std::nullopt;
}

std::optional<double> PlaneCones::opening_slope(const Vector3d& e) const {
  const auto* planes = std::get_if<SectorPlanes>(&kind_);
  if (!planes || !planes->disjoint()) return std::nullopt;
  const PlaneSector sector = planes->on(e);
  const Vector3d &u = sector.line_of_sight, p = u.cross(sector.across);
  // The contact normal stays perpendicular to the edge d, which turns in the plane and with it, by
  // u x d = +-sin p.
  const auto slope = [&](const PlaneSector::Edge& edge, double side) {
    const double cosine = std::cos(edge.angle), sine = std::sin(edge.angle);
    return -sine * edge.normal.dot(p) / edge.normal.dot(cosine * sector.across - side * sine * u);
  };
  return slope(sector.left, 1) + slope(sector.right, -1);
}

double PlaneCones::tolerance() const {
  if (std::holds_alternative<TrueHull>(kind_)) return HullSectors::kEdge;
  if (const auto* seen = std::get_if<TruePair>(&kind_))
    return std::max(1e-9, seen->pair.guarantee().tolerance);
  if (std::holds_alternative<TrueCombined>(kind_)) return TrueCombined::kEdge;
  return 0;
}

bool PlaneCones::smooth() const {
  const auto* slices = std::get_if<Slices>(&kind_);
  return std::holds_alternative<SectorPlanes>(kind_) ||
         (slices && slices->a.is_ellipsoid() && slices->b.is_ellipsoid());
}

}  // namespace vericone::guidance
