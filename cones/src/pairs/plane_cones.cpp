// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/plane_cones.h>

#include <vericone/internal/cones/assembly/assembly_sectors.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "slices/plane_slices.h"

namespace vericone {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCombinedEdge = 1e-7;  // rad

/// How fast the boundary of a body moves outwards at a contact as its shape changes. The normal is the sum of
/// w M y over the surfaces y^T M y <= l touched there, and each counts by w (l' - y^T M' y) / 2.
double shape_speed(const TouchedSurfaces& touched, const Vector3d& y, const Vector3d& outward,
                   const CombinedEllipsoid* body, const BodyRate* rate) {
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
    const DelimiterRate<3>& d = rate->delimiters[i - 1];
    speed += 0.5 * touched.weight[k] * (d.level - y.dot(d.matrix * y));
  }
  // Of the ellipsoid M' = -S^{-1} S' S^{-1}, and what is left of the normal is w S^{-1} y.
  if (of_ellipsoid > 1e-9 * y.norm()) speed += 0.5 / of_ellipsoid * rest.dot(rate->shape * rest);
  return speed;
}

/// From the contacts: only how fast the points in contact move along their normal counts.
OpeningRates contact_rates(const PlaneSector& sector, const CombinedEllipsoid* a, const CombinedEllipsoid* b,
                           const Vector3d& e, const SpatialMotion& motion) {
  const Vector3d v = motion.v_b - motion.v_a;
  const auto speed = [&](const GrazingEdge& edge) {
    const Vector3d& n = edge.normal;
    return n.dot(v + motion.omega_b.cross(edge.on_b) - motion.omega_a.cross(edge.on_a)) -
           shape_speed(edge.touched_a, edge.on_a, n, a, motion.rate_a) -
           shape_speed(edge.touched_b, edge.on_b, -n, b, motion.rate_b);
  };
  const PlaneSectorRates rates =
      sector_rates(sector, speed(sector.left), speed(sector.right), v, motion.plane_spin);
  return {rates.psi(), rates.theta_b() + v.dot(e) / sector.distance};
}

std::vector<DelimiterRate<2>> delimiters_in_plane(const BodyRate* rate) {
  std::vector<DelimiterRate<2>> all;
  if (rate)
    for (const DelimiterRate<3>& d : rate->delimiters)
      all.push_back({d.matrix.topLeftCorner<2, 2>(), d.level});
  return all;
}

OpeningRates planar_rates(const CombinedSector& sector, const CombinedEllipse& a, const CombinedEllipse& b,
                          const SpatialMotion& motion) {
  PlanarMotion planar;
  planar.v_a = motion.v_a.head<2>();
  planar.v_b = motion.v_b.head<2>();
  planar.omega_a = motion.omega_a.z();
  planar.omega_b = motion.omega_b.z();
  if (motion.rate_a) planar.shape_rate_a = motion.rate_a->shape.topLeftCorner<2, 2>();
  if (motion.rate_b) planar.shape_rate_b = motion.rate_b->shape.topLeftCorner<2, 2>();
  const SectorRates rates = combined_sector_rates(sector, a, b, planar, delimiters_in_plane(motion.rate_a),
                                                  delimiters_in_plane(motion.rate_b));
  return {rates.psi, rates.theta_b};
}

OpeningRates ellipsoid_rates(const PlaneSector& sector, const Ellipsoid& a, const Ellipsoid& b,
                             const SpatialMotion& motion) {
  const PlaneSectorRates rates = true_sector_rates(sector, a, b, motion);
  return {rates.psi(), rates.theta_b() + rates.line_of_sight};
}

}  // namespace

bool has_sectors(const WorldBody& a, const WorldBody& b, SectorMethod method) {
  if (a.planar() || b.planar()) return a.planar() && b.planar();
  if (method == SectorMethod::true_cone) return true;
  return a.quadric() && (b.quadric() || (!a.delimited() && b.hull()));
}

PlaneCones::PlaneCones(const WorldBody& a, const WorldBody& b, const Vector3d& from, const Vector3d& to,
                       SectorMethod method, EdgeMemory* memory)
    : a_(a), b_(b), from_(from), to_(to), kind_(kind_of(method, memory)) {}

PlaneCones::Kind PlaneCones::kind_of(SectorMethod method, EdgeMemory* memory) const {
  const bool slice = method == SectorMethod::slice;
  const CombinedEllipsoid *agent = a_.quadric(), *obstacle = b_.quadric();
  if (agent && obstacle) {
    if (slice) return Slices{*agent, *obstacle};
    if (agent->is_ellipsoid() && obstacle->is_ellipsoid())
      return Kind(std::in_place_type<Ellipsoids>, agent->ellipsoid(), obstacle->ellipsoid());
    return Kind(std::in_place_type<TrueCombined>, *agent, *obstacle, memory);
  }
  if (!has_sectors(a_, b_, method)) return None{};
  if (a_.planar()) return Planar{*a_.flat(), *b_.flat()};
  if (const HullBody* hull = b_.hull(); hull && agent && agent->is_ellipsoid()) {
    if (slice) return HullSlices{agent->ellipsoid(), *hull};
    return Kind(std::in_place_type<TrueHull>, agent->ellipsoid(), *hull);
  }
  return pair_of(a_, b_);
}

PlaneCones::TrueCombined::TrueCombined(const CombinedEllipsoid& a, const CombinedEllipsoid& b,
                                       EdgeMemory* of_before)
    : oracle(a, b, kCombinedEdge), memory(of_before) {}

struct PlaneCones::Ask {
  const PlaneCones& cones;
  const Vector3d &u, &e;
  std::span<Moving> moving;

  template <typename Rates>
  void fill(const Rates& rates) const {
    for (Moving& one : moving) one.rates = rates(one.motion);
  }

  std::optional<PlaneOpening> operator()(const None&) const { return std::nullopt; }
  std::optional<PlaneOpening> operator()(const Planar& pair) const {
    const CombinedSector sector = combined_sector(pair.a, pair.b);
    if (sector.sector.relation != Relation::disjoint) return std::nullopt;
    fill([&](const SpatialMotion& motion) { return planar_rates(sector, pair.a, pair.b, motion); });
    return PlaneOpening{sector.sector.psi, std::remainder(sector.sector.theta_b - std::atan2(u.y(), u.x()),
                                                          2 * std::numbers::pi)};
  }
  std::optional<PlaneOpening> operator()(const Slices& pair) const {
    const Sections sections = sections_of(pair.a, pair.b, u, e);
    if (!sections.disjoint()) return std::nullopt;
    fill([&](const SpatialMotion& motion) {
      const SectorRates rates = section_rates(sections, pair.a, pair.b, u, e, motion);
      return OpeningRates{rates.psi, rates.theta_b};
    });
    return PlaneOpening{sections.sector.sector.psi, sections.sector.sector.theta_b};
  }
  std::optional<PlaneOpening> operator()(const HullSlices& pair) const {
    const auto sector = hull_section(pair.agent, pair.hull, u, e);
    return sector ? std::optional(PlaneOpening{sector->psi, sector->theta_b}) : std::nullopt;
  }
  std::optional<PlaneOpening> operator()(const Ellipsoids& pair) const {
    if (!pair.planes.disjoint()) return std::nullopt;
    const PlaneSector sector = pair.planes.on(e);
    fill([&](const SpatialMotion& motion) { return ellipsoid_rates(sector, pair.a, pair.b, motion); });
    return PlaneOpening{sector.psi(), sector.theta_b()};
  }
  std::optional<PlaneOpening> operator()(const TrueHull& pair) const {
    if (const auto sector = HullSectors(pair.agent, pair.hull, pair.oracle).on(cones.to_, e))
      return by_contacts(sector);
    return by_contacts(assembly_sector(AssemblyOracle(pair.agent, Assembly::polyhedra({pair.hull})),
                                       pair.agent.center(), cones.to_, e));
  }
  std::optional<PlaneOpening> operator()(const TrueCombined& pair) const {
    return by_contacts(
        combined_sector_on(pair.oracle, e, kCombinedEdge, pair.memory ? pair.memory : &pair.own));
  }
  std::optional<PlaneOpening> operator()(const Pair& pair) const {
    return by_contacts(pair.sector(cones.from_, cones.to_, e));
  }

  std::optional<PlaneOpening> by_contacts(const std::optional<PlaneSector>& sector) const {
    if (!sector) return std::nullopt;
    if (sector->has_contacts())
      fill([&](const SpatialMotion& motion) {
        return contact_rates(*sector, cones.a_.quadric(), cones.b_.quadric(), e, motion);
      });
    return PlaneOpening{sector->psi(), sector->theta_b()};
  }
};

std::optional<PlaneOpening> PlaneCones::on(const Vector3d& u, const Vector3d& e,
                                           std::span<Moving> moving) const {
  return std::visit(Ask{*this, u, e, moving}, kind_);
}

std::optional<double> PlaneCones::opening_slope(const Vector3d& e) const {
  const auto* pair = std::get_if<Ellipsoids>(&kind_);
  if (!pair || !pair->planes.disjoint()) return std::nullopt;
  const PlaneSector sector = pair->planes.on(e);
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
  if (std::holds_alternative<TrueCombined>(kind_)) return kCombinedEdge;
  if (const auto* pair = std::get_if<Pair>(&kind_)) return std::max(1e-9, pair->guarantee().tolerance);
  return 0;
}

bool PlaneCones::smooth() const {
  const auto* slices = std::get_if<Slices>(&kind_);
  return std::holds_alternative<Ellipsoids>(kind_) ||
         (slices && slices->a.is_ellipsoid() && slices->b.is_ellipsoid());
}

}  // namespace vericone
