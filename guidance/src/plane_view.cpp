// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/plane_view.h>
#include <vericone/internal/geometry/requires.h>
#include <vericone/internal/guidance/plane_view.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "across_axis.h"

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

/// Inverse of the time in which the engagement changes by its own size, 1/s.
double rate_scale(const BodyState& a, const BodyState& b) {
  const double r = (b.position - a.position).norm();
  double scale = (b.velocity - a.velocity).norm() / r + a.omega.norm() + b.omega.norm();
  for (const BodyState* body : {&a, &b})
    if (const CombinedEllipsoid* quadric = body->shape.quadric())
      scale += body->rate.shape.norm() / quadric->ellipsoid().shape().norm();
  return scale > 0 ? scale : 1;
}

PlaneCones cones_of(const BodyState& a, const BodyState& b, SectorMethod method,
                    EdgeMemory* memory = nullptr) {
  return {a.shape, b.shape, a.position, b.position, method, memory};
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
  const auto later = [&](double dt) -> std::optional<PlaneOpening> {
    const BodyState next_a = advanced(a, dt), next_b = advanced(b, dt);
    const Vector3d u = (next_b.position - next_a.position).normalized();
    // Turned as the line of sight turns, which takes little of a circle.
    const Vector3d carried =
        view.across - view.across.dot(u) / (1 + view.line_of_sight.dot(u)) * (view.line_of_sight + u);
    const double spin = view.state.plane_spin * dt;
    return cones_of(next_a, next_b, method)
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
      const BodyState now_a = of_a ? turned(a, turn) : a, now_b = of_a ? b : turned(b, turn);
      return cones_of(now_a, now_b, method).on(view.line_of_sight, view.across);
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

enum class Found { nothing, opening, rates };

Found opening_alone(const PlaneCones& cones, const PlaneView& view, PlaneCone& cone) {
  const auto opening = cones.on(view.line_of_sight, view.across);
  if (!opening) return Found::nothing;
  cone.psi = opening->psi;
  cone.theta_b = opening->theta_b;
  return Found::opening;
}

/// Rates of the bodies' own motion, and by the turning that a unit command of one body causes.
Found opening_and_rates(const PlaneCones& cones, const PlaneView& view, const BodyState& a,
                        const BodyState& b, PlaneCone& cone) {
  std::array<PlaneCones::Moving, 3> moving;
  moving[0].motion = {a.velocity, b.velocity, a.omega, b.omega, &a.rate, &b.rate, view.state.plane_spin};
  std::size_t motions = 1, by_a = 0, by_b = 0;
  if (const Vector3d turning = turning_by_lateral(a, view.lateral_a()); !turning.isZero(0))
    moving[by_a = motions++].motion.omega_a = turning;
  if (const Vector3d turning = turning_by_lateral(b, view.lateral_b()); !turning.isZero(0))
    moving[by_b = motions++].motion.omega_b = turning;
  const auto opening = cones.on(view.line_of_sight, view.across, std::span(moving.data(), motions));
  if (!opening) return Found::nothing;
  cone.psi = opening->psi;
  cone.theta_b = opening->theta_b;
  if (!moving[0].rates) return Found::opening;
  const auto write = [&](std::size_t of, double& psi, double& theta_b) {
    psi = moving[of].rates->psi;
    theta_b = moving[of].rates->theta_b;
  };
  write(0, cone.psi_rate, cone.theta_b_rate);
  if (by_a) write(by_a, cone.psi_rate_by_a, cone.theta_b_rate_by_a);
  if (by_b) write(by_b, cone.psi_rate_by_b, cone.theta_b_rate_by_b);
  return Found::rates;
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
  const PlaneCones cones = cones_of(a, b, method, memory);
  PlaneCone cone;
  const Found found = rates == RateMethod::analytic ? opening_and_rates(cones, view, a, b, cone)
                                                    : opening_alone(cones, view, cone);
  if (found == Found::nothing) return false;
  if (rates != RateMethod::none && found != Found::rates &&
      !difference(view, a, b, method, cones.tolerance(), cone))
    return false;
  view.cone = cone;
  return true;
}

std::optional<PlaneView> plane_view(const BodyState& a, const BodyState& b, const Vector3d& across,
                                    SectorMethod method, RateMethod rates, double plane_spin,
                                    EdgeMemory* memory) {
  VERICONE_REQUIRES(across.allFinite() && (a.position == b.position || (a.planar() && b.planar()) ||
                                           !(b.position - a.position).cross(across).isZero(0)),
                    "across", "bodies in one place, or a direction along their line",
                    "across the line between bodies apart");
  if (a.position == b.position) return std::nullopt;
  PlaneView view = plane_states(a, b, across, plane_spin);
  if (!fill_cone(view, a, b, method, rates, memory)) return std::nullopt;
  return view;
}

}  // namespace vericone::guidance
