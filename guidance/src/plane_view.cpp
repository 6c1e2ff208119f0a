// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/requires.h>
#include <vericone/guidance/plane_view.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane_cones.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d lateral(const PlaneView& view, double heading) {
  return -std::sin(heading) * view.line_of_sight + std::cos(heading) * view.across;
}

/// Angular velocity of a body for a unit acceleration along `lateral`; zero where it does not turn with its
/// heading.
Vector3d turning_by_lateral(const BodyState& body, const Vector3d& lateral) {
  const double square = body.velocity.squaredNorm();
  if (body.turning == Turning::none || !(square > 0)) return Vector3d::Zero();
  return body.velocity.cross(lateral) / square;
}

/// Of the axes (u, e): with the line of sight, and about it.
Vector3d plane_turning(const PlaneView& view, const Vector3d& c, const Vector3d& v) {
  return view.line_of_sight.cross(v) / c.norm() + view.state.plane_spin * view.line_of_sight;
}

std::vector<DelimiterRate> in_plane(const ShapeRate& rate) {
  std::vector<DelimiterRate> all;
  for (const SpatialDelimiterRate& d : rate.delimiters)
    all.push_back({d.matrix.topLeftCorner<2, 2>(), d.level});
  return all;
}

double direction_in_plane(const Vector3d& u) { return std::atan2(u.y(), u.x()); }

/// theta_b from the line of sight, in (-pi, pi].
double from_sight(double theta_b, const Vector3d& u) {
  return std::remainder(theta_b - direction_in_plane(u), 2 * std::numbers::pi);
}

bool planar_cone(const PlaneView& view, const BodyState& a, const BodyState& b, bool with_rates,
                 PlaneCone& cone) {
  const auto &shape_a = std::get<CombinedEllipse>(a.shape), &shape_b = std::get<CombinedEllipse>(b.shape);
  const CombinedSector sector = combined_sector(shape_a, shape_b);
  if (sector.sector.relation != Relation::disjoint) return false;
  cone.psi = sector.sector.psi;
  cone.theta_b = from_sight(sector.sector.theta_b, view.line_of_sight);
  if (!with_rates) return true;
  PlanarMotion motion;
  motion.v_a = a.velocity.head<2>();
  motion.v_b = b.velocity.head<2>();
  motion.omega_a = a.omega.z();
  motion.omega_b = b.omega.z();
  motion.shape_rate_a = a.rate.shape.topLeftCorner<2, 2>();
  motion.shape_rate_b = b.rate.shape.topLeftCorner<2, 2>();
  const SectorRates rates =
      combined_sector_rates(sector, shape_a, shape_b, motion, in_plane(a.rate), in_plane(b.rate));
  cone.psi_rate = rates.psi;
  cone.theta_b_rate = rates.theta_b;
  const auto by_command = [&](const Vector3d& turning, double PlanarMotion::*omega, double& psi,
                              double& theta_b) {
    if (turning.isZero(0)) return;
    PlanarMotion unit;
    unit.*omega = turning.z();
    const SectorRates by = combined_sector_rates(sector, shape_a, shape_b, unit);
    psi = by.psi;
    theta_b = by.theta_b;
  };
  by_command(turning_by_lateral(a, view.lateral_a()), &PlanarMotion::omega_a, cone.psi_rate_by_a,
             cone.theta_b_rate_by_a);
  by_command(turning_by_lateral(b, view.lateral_b()), &PlanarMotion::omega_b, cone.psi_rate_by_b,
             cone.theta_b_rate_by_b);
  return true;
}

bool slice_cone(const PlaneView& view, const BodyState& a, const BodyState& b, bool with_rates,
                PlaneCone& cone) {
  const auto &shape_a = std::get<CombinedEllipsoid>(a.shape), &shape_b = std::get<CombinedEllipsoid>(b.shape);
  const Vector3d &u = view.line_of_sight, &e = view.across;
  const Sections sections = sections_of(shape_a, shape_b, u, e);
  if (!sections.disjoint()) return false;
  cone.psi = sections.opening().psi;
  cone.theta_b = sections.opening().theta_b;
  if (!with_rates) return true;
  const Vector3d v = b.velocity - a.velocity, c = shape_b.center() - shape_a.center();
  const Vector3d plane = plane_turning(view, c, v);
  TurningMotion motion{a.omega - plane, b.omega - plane, v.dot(u), &a.rate, &b.rate};
  const OpeningRates rates = section_rates(sections, shape_a, shape_b, u, e, motion);
  cone.psi_rate = rates.psi;
  cone.theta_b_rate = rates.theta_b + v.dot(e) / c.norm();
  const auto by_command = [&](const Vector3d& turning, Vector3d TurningMotion::*omega, double& psi,
                              double& theta_b) {
    if (turning.isZero(0)) return;
    TurningMotion unit;
    unit.*omega = turning;
    const OpeningRates by = section_rates(sections, shape_a, shape_b, u, e, unit);
    psi = by.psi;
    theta_b = by.theta_b;
  };
  by_command(turning_by_lateral(a, view.lateral_a()), &TurningMotion::omega_a, cone.psi_rate_by_a,
             cone.theta_b_rate_by_a);
  by_command(turning_by_lateral(b, view.lateral_b()), &TurningMotion::omega_b, cone.psi_rate_by_b,
             cone.theta_b_rate_by_b);
  return true;
}

bool true_cone(const PlaneView& view, const BodyState& a, const BodyState& b, bool with_rates,
               PlaneCone& cone) {
  const Ellipsoid &shape_a = std::get<CombinedEllipsoid>(a.shape).ellipsoid(),
                  &shape_b = std::get<CombinedEllipsoid>(b.shape).ellipsoid();
  const SectorPlanes planes(shape_a, shape_b);
  if (!planes.disjoint()) return false;
  const PlaneSector sector = planes.on(view.across);
  cone.psi = sector.psi();
  cone.theta_b = sector.theta_b();
  if (!with_rates) return true;
  const PlaneSectorRates rates = true_sector_rates(
      sector, shape_a, shape_b,
      {a.velocity, b.velocity, a.omega, b.omega, a.rate.shape, b.rate.shape, view.state.plane_spin});
  cone.psi_rate = rates.psi();
  cone.theta_b_rate = rates.theta_b() + rates.line_of_sight;
  const auto by_command = [&](const Vector3d& turning, Vector3d SpatialMotion::*omega, double& psi,
                              double& theta_b) {
    if (turning.isZero(0)) return;
    SpatialMotion unit;
    unit.*omega = turning;
    const PlaneSectorRates by = true_sector_rates(sector, shape_a, shape_b, unit);
    psi = by.psi();
    theta_b = by.theta_b();
  };
  by_command(turning_by_lateral(a, view.lateral_a()), &SpatialMotion::omega_a, cone.psi_rate_by_a,
             cone.theta_b_rate_by_a);
  by_command(turning_by_lateral(b, view.lateral_b()), &SpatialMotion::omega_b, cone.psi_rate_by_b,
             cone.theta_b_rate_by_b);
  return true;
}

/// From the contacts at the edges: true sectors of all but two ellipsoids.
void contact_cone_rates(const PlaneSector& sector, const PlaneView& view, const BodyState& a,
                        const BodyState& b, PlaneCone& cone) {
  const Vector3d v = b.velocity - a.velocity;
  const TurningMotion motion{a.omega, b.omega, 0, &a.rate, &b.rate};
  const OpeningRates rates = contact_rates(sector, a, b, v, view.state.plane_spin, motion);
  cone.psi_rate = rates.psi;
  cone.theta_b_rate = rates.theta_b + v.dot(view.across) / sector.distance;
  const auto by_command = [&](const Vector3d& by, Vector3d TurningMotion::*omega, double& psi,
                              double& theta_b) {
    if (by.isZero(0)) return;
    TurningMotion unit;
    unit.*omega = by;
    const OpeningRates one = contact_rates(sector, a, b, Vector3d::Zero(), 0, unit);
    psi = one.psi;
    theta_b = one.theta_b;
  };
  by_command(turning_by_lateral(a, view.lateral_a()), &TurningMotion::omega_a, cone.psi_rate_by_a,
             cone.theta_b_rate_by_a);
  by_command(turning_by_lateral(b, view.lateral_b()), &TurningMotion::omega_b, cone.psi_rate_by_b,
             cone.theta_b_rate_by_b);
}

/// Inverse of the time in which the engagement changes by its own size, 1/s.
double rate_scale(const BodyState& a, const BodyState& b) {
  const double r = (b.position - a.position).norm();
  double scale = (b.velocity - a.velocity).norm() / r + a.omega.norm() + b.omega.norm();
  for (const BodyState* body : {&a, &b})
    if (const auto* shape = std::get_if<CombinedEllipsoid>(&body->shape))
      scale += body->rate.shape.norm() / shape->ellipsoid().shape().norm();
  return scale > 0 ? scale : 1;
}

/// The body turned by the rotation vector `turn` about its centre.
BodyState turned(const BodyState& body, const Vector3d& turn) {
  BodyState still = body;
  still.velocity.setZero();
  still.omega = turn;
  still.rate = {};
  return advanced(still, 1);
}

/// Central differences with the plane carried along: e is turned with the line of sight, which describes a
/// great circle, and about it by plane_spin. Nothing is written where a sector is missing.
bool difference(const PlaneView& view, const BodyState& a, const BodyState& b, SectorMethod method,
                double tolerance, PlaneCone& cone) {
  // The error of the edges over h and that of the difference, h^2, are made alike.
  const double part = std::max(1e-4, std::cbrt(tolerance)), h = part / rate_scale(a, b);
  const auto later = [&](double dt) -> std::optional<Opening> {
    const BodyState next_a = advanced(a, dt), next_b = advanced(b, dt);
    const Vector3d u = (next_b.position - next_a.position).normalized();
    // Turned as the line of sight turns, which takes little of a circle.
    const Vector3d carried =
        view.across - view.across.dot(u) / (1 + view.line_of_sight.dot(u)) * (view.line_of_sight + u);
    const double spin = view.state.plane_spin * dt;
    return PlaneCones(next_a, next_b, method)
        .on(u, across_axis(u, std::cos(spin) * carried + std::sin(spin) * u.cross(carried)));
  };
  const auto before = later(-h), after = later(h);
  if (!before || !after) return false;
  cone.psi_rate = (after->psi - before->psi) / (2 * h);
  cone.theta_b_rate = std::remainder(after->theta_b - before->theta_b, 2 * std::numbers::pi) / (2 * h) +
                      view.state.v_theta / view.state.r;
  // By the turning that a unit command of one body causes.
  const auto by_command = [&](const Vector3d& turning, bool of_a, double& psi_rate, double& theta_b_rate) {
    if (turning.isZero(0)) return true;
    const double size = turning.norm();
    const auto by_turn = [&](double angle) {
      const Vector3d turn = angle / size * turning;
      return PlaneCones(of_a ? turned(a, turn) : a, of_a ? b : turned(b, turn), method)
          .on(view.line_of_sight, view.across);
    };
    const auto back = by_turn(-part), ahead = by_turn(part);
    if (!back || !ahead) return false;
    psi_rate = size * (ahead->psi - back->psi) / (2 * part);
    theta_b_rate = size * std::remainder(ahead->theta_b - back->theta_b, 2 * std::numbers::pi) / (2 * part);
    return true;
  };
  return by_command(turning_by_lateral(a, view.lateral_a()), true, cone.psi_rate_by_a,
                    cone.theta_b_rate_by_a) &&
         by_command(turning_by_lateral(b, view.lateral_b()), false, cone.psi_rate_by_b,
                    cone.theta_b_rate_by_b);
}

}  // namespace

Vector3d PlaneView::lateral_a() const { return lateral(*this, state.alpha); }
Vector3d PlaneView::lateral_b() const { return lateral(*this, state.beta); }

PlaneView plane_states(const BodyState& a, const BodyState& b, const Vector3d& across, double plane_spin) {
  VERICONE_REQUIRES(a.position != b.position);
  VERICONE_REQUIRES((a.planar() && b.planar()) || !(b.position - a.position).cross(across).isZero(0));
  const Vector3d c = b.position - a.position, v = b.velocity - a.velocity;
  PlaneView view;
  view.line_of_sight = c.normalized();
  const Vector3d& u = view.line_of_sight;
  view.across = a.planar() && b.planar() ? Vector3d(-u.y(), u.x(), 0) : across_axis(u, across);
  const Vector3d& e = view.across;
  PlanarState& state = view.state;
  state.r = c.norm();
  state.v_r = v.dot(u);
  state.v_theta = v.dot(e);
  state.v_normal = v.dot(view.normal());
  state.plane_spin = plane_spin;
  const Vector2d along_a(a.velocity.dot(u), a.velocity.dot(e)), along_b(b.velocity.dot(u), b.velocity.dot(e));
  state.alpha = std::atan2(along_a.y(), along_a.x());
  state.beta = std::atan2(along_b.y(), along_b.x());
  state.speed_a = along_a.norm();
  state.speed_b = along_b.norm();
  return view;
}

bool fill_cone(PlaneView& view, const BodyState& a, const BodyState& b, SectorMethod method, RateMethod rates,
               EdgeMemory* memory) {
  PlaneCone cone;
  const bool analytic = rates == RateMethod::analytic;
  const auto* spatial_a = std::get_if<CombinedEllipsoid>(&a.shape);
  const auto* spatial_b = std::get_if<CombinedEllipsoid>(&b.shape);
  bool closed_form = true, found = false;
  double tolerance = 0;
  if (a.planar() && b.planar()) {
    found = planar_cone(view, a, b, analytic, cone);
  } else if (spatial_a && spatial_b && method == SectorMethod::slice) {
    found = slice_cone(view, a, b, analytic, cone);
  } else if (spatial_a && spatial_b && spatial_a->is_ellipsoid() && spatial_b->is_ellipsoid()) {
    found = true_cone(view, a, b, analytic, cone);
  } else {
    closed_form = false;
    const PlaneCones cones(a, b, method, memory);
    tolerance = cones.tolerance();
    if (const auto sector = cones.true_sector(view.across)) {
      cone.psi = sector->psi();
      cone.theta_b = sector->theta_b();
      found = true;
      closed_form = sector->has_contacts();
      if (closed_form && analytic) contact_cone_rates(*sector, view, a, b, cone);
    } else if (const auto opening = cones.on(view.line_of_sight, view.across)) {
      cone.psi = opening->psi;
      cone.theta_b = opening->theta_b;
      found = true;
    }
  }
  if (!found) return false;
  if (rates == RateMethod::differenced || (analytic && !closed_form))
    if (!difference(view, a, b, method, tolerance, cone)) return false;
  view.cone = cone;
  return true;
}

std::optional<PlaneView> plane_view(const BodyState& a, const BodyState& b, const Vector3d& across,
                                    SectorMethod method, RateMethod rates, double plane_spin,
                                    EdgeMemory* memory) {
  if (a.position == b.position) return std::nullopt;
  PlaneView view = plane_states(a, b, across, plane_spin);
  if (!fill_cone(view, a, b, method, rates, memory)) return std::nullopt;
  return view;
}

}  // namespace vericone::guidance
