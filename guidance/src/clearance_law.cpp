// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/laws.h>
#include <vericone/internal/guidance/laws.h>
#include <vericone/internal/guidance/plane_view.h>

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/pair.h>
#include <vericone/cones/uncertain/robust.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include <vericone/guidance/plane_view.h>

#include "check_numbers.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// What the law needs of m(w): the value, the normal and when its supporting points pass.
struct Passing {
  double m = 0, time = 0;
  Vector3d normal = Vector3d::Zero();
  bool ahead = false;  // the passage, or the collision, is still to come
};

Passing spatial_passing(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w) {
  const Clearance c = clearance(a, b, w);
  Passing miss{c.distance, c.time, c.normal, c.time > 0};
  // The supporting points of a line that hits may lie behind although the hit lies ahead: the cone knows.
  if (c.distance < 0) {
    const ConeOracle oracle(a, b);
    if (oracle.relation() == Relation::disjoint)
      miss.ahead = oracle.triage_membership(w).value_or(Membership::in) != Membership::out;
    else
      miss.ahead = w.dot(b.center() - a.center()) > 0;
  }
  return miss;
}

/// In the plane two normals are perpendicular to w.
Passing planar_passing(const Ellipse& a, const Ellipse& b, const Vector2d& w) {
  const Vector2d c = b.center() - a.center(), along = w.normalized();
  Passing best;
  for (const double side : {1.0, -1.0}) {
    const Vector2d n(-side * along.y(), side * along.x());
    const double m = n.dot(c) - a.radius(n) - b.radius(n);
    if (side < 0 && !(m > best.m)) continue;
    const Vector2d apart = b.support_point(-n) - a.support_point(n);
    best = {m, apart.dot(w) / w.squaredNorm(), Vector3d(n.x(), n.y(), 0), true};
  }
  best.ahead = best.m < 0 ? c.dot(w) > 0 : best.time > 0;
  return best;
}

Eigen::Matrix3d raised(const Eigen::Matrix2d& m) {
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  result.topLeftCorner<2, 2>() = m;
  return result;
}

/// One body along a normal: S n / rho, the gradient of its radius.
struct Side {
  Vector3d reach;
  double radius;
};

struct View {
  Passing miss;
  Side a, b;
};

Side side_of(const Eigen::Matrix3d& factor, const Vector3d& n) {
  const Vector3d u = factor.transpose() * n;
  const double rho = u.norm();
  return {factor * u / rho, rho};
}

/// Placed bodies, and hulls that fly. Other hulls are seen as ellipsoids around them.
bool as_they_are(const BodyState& a, const BodyState& b) {
  return a.shape.placed() || b.shape.placed() || a.shape.hull();
}

Side side_about(const Vector3d& reach) { return {reach, std::max(reach.norm(), 1e-300)}; }

/// Meshes, clouds, maps and unions as they are. m is the distance of the point of one from the point
/// of the other that come nearest, so m' is that of these two points moving with their bodies. Where the
/// bodies will meet, m is how deep ellipsoids around them do, and the points are those of the ellipsoids.
View view_of_pair(const BodyState& a, const BodyState& b) {
  const Miss found = pair_of(a.shape, b.shape).miss(a.velocity, b.velocity);
  const Vector3d& n = found.normal;
  const bool meet = !(found.most > 0);
  View view;
  view.miss = {found.distance, found.time, n, meet || found.time > 0};
  if (n.isZero(0)) {
    view.a = view.b = side_about(Vector3d::Zero());
    return view;
  }
  const Vector3d w = a.velocity - b.velocity;
  std::optional<Vector3d> on_a, on_b;
  if (meet) {
    on_a = a.shape.containing_ellipsoid().support_point(n);
    on_b = b.shape.containing_ellipsoid().support_point(-n);
  } else {
    on_a = a.shape.support_point(n);
    on_b = b.shape.support_point(-n);
    // Of a body with many points that are as far along n the one that comes nearest, seen from the other.
    const Vector3d passed = view.miss.time * w + view.miss.m * n;
    if (on_a)
      on_b = *on_a + passed;
    else if (on_b)
      on_a = *on_b - passed;
  }
  view.a = side_about(on_a ? Vector3d(*on_a - a.position) : Vector3d::Zero());
  view.b = side_about(on_b ? Vector3d(b.position - *on_b) : Vector3d::Zero());
  return view;
}

View view_of(const BodyState& a, const BodyState& b) {
  if (as_they_are(a, b)) return view_of_pair(a, b);
  const Vector3d w = a.velocity - b.velocity;
  View view;
  if (a.planar()) {
    const Ellipse body_a = a.shape.containing_ellipse(), body_b = b.shape.containing_ellipse();
    view.miss = planar_passing(body_a, body_b, w.head<2>());
    view.a = side_of(raised(body_a.factor()), view.miss.normal);
    view.b = side_of(raised(body_b.factor()), view.miss.normal);
  } else {
    const Ellipsoid body_a = a.shape.containing_ellipsoid(), body_b = b.shape.containing_ellipsoid();
    view.miss = spatial_passing(body_a, body_b, w);
    view.a = side_of(body_a.factor(), view.miss.normal);
    view.b = side_of(body_b.factor(), view.miss.normal);
  }
  return view;
}

Ellipsoid in_space(const BodyState& body, double height) {
  return body.planar()
             ? vericone::raised(CombinedEllipse(body.shape.containing_ellipse()), height).ellipsoid()
             : body.shape.containing_ellipsoid();
}

/// The worst of the errors; nothing where they may be as large as the relative velocity.
std::optional<View> view_with_errors(const BodyState& a, const BodyState& b,
                                     const ClearanceOptions& options) {
  const bool planar = a.planar();
  const double height = planar ? std::max(a.shape.containing_ellipse().semi_axes().maxCoeff(),
                                          b.shape.containing_ellipse().semi_axes().maxCoeff())
                               : 0;
  const Ellipsoid body_a = in_space(a, height), body_b = in_space(b, height);
  const Vector3d w = a.velocity - b.velocity;
  const auto found = robust_clearance(body_a, body_b, w, options.position_error, options.velocity_error);
  if (!found) return std::nullopt;
  Vector3d n = found->normal;
  if (planar) n = Vector3d(n.x(), n.y(), 0).normalized();
  const bool ahead = found->time > 0 || (found->distance < 0 && w.dot(body_b.center() - body_a.center()) > 0);
  return View{
      {found->distance, found->time, n, ahead}, side_of(body_a.factor(), n), side_of(body_b.factor(), n)};
}

/// rho' of a body that turns with omega and changes its shape: n.S'n / (2 rho), S' = [omega x] S - S [omega
/// x] + extra.
double radius_rate(const Side& side, const Vector3d& n, const Vector3d& omega, const Eigen::Matrix3d& extra) {
  return side.reach.dot(n.cross(omega)) + 0.5 * n.dot(extra * n) / side.radius;
}

}  // namespace

void check(const ClearanceOptions& options) {
  require_positive(options.gain, "gain", " (1/s)");
  require_not_negative(options.required, "required", " (m)");
  require_not_negative(options.beyond, "beyond", " (m)");
  if (!(options.most > 0)) throw InputError("most", to_text(options.most), "positive (m/s^2)");
}

ClearanceCommand clearance_law(const BodyState& a, const BodyState& b, const ClearanceOptions& options,
                               const Vector3d& acceleration_b) {
  ClearanceCommand command;
  const Vector3d w = a.velocity - b.velocity;
  if (!(w.squaredNorm() > 0)) {
    command.status = LawStatus::no_relative_velocity;
    return command;
  }
  const bool known = options.position_error.none() && options.velocity_error.none();
  const std::optional<View> seen = known ? view_of(a, b) : view_with_errors(a, b, options);
  if (!seen) {
    command.status = LawStatus::no_relative_velocity;
    return command;
  }
  const View& view = *seen;
  const Vector3d& n = view.miss.normal;
  command.m = view.miss.m;
  command.time_to_closest = view.miss.time;

  const Vector3d omega_b = angular_velocity(b, acceleration_b);
  command.drift = view.miss.time * n.dot(acceleration_b) - radius_rate(view.a, n, a.omega, a.rate.shape) -
                  radius_rate(view.b, n, omega_b, b.rate.shape);
  command.by_acceleration = -view.miss.time * n;
  const double speed = a.velocity.norm();
  // omega = v x a / |v|^2: reach.(n x omega) = a.((reach x n) x v) / |v|^2.
  if (a.turning == Turning::with_heading && speed > 0)
    command.by_acceleration -= view.a.reach.cross(n).cross(a.velocity) / (speed * speed);

  if (!view.miss.ahead) {
    command.status = LawStatus::receding;
    return command;
  }
  if (command.m >= options.required && !options.hold) return command;

  Vector3d effect = command.by_acceleration;
  const Vector3d ahead = speed > 0 ? Vector3d(a.velocity / speed) : Vector3d::Zero();
  if (!options.longitudinal) effect -= effect.dot(ahead) * ahead;
  const double aim = options.required + options.beyond;
  const double wanted = -options.gain * (command.m - aim) - command.drift;
  const double reach = std::abs(view.miss.time) + view.a.radius / std::max(speed, 1e-300);
  if (effect.norm() <= 1e-9 * reach) {
    command.status = LawStatus::ineffective;
    Vector3d aside = -n + n.dot(ahead) * ahead;
    if (!(aside.norm() > 1e-6))
      aside = a.planar() ? Vector3d(-ahead.y(), ahead.x(), 0) : AxisFrame(a.velocity).e1;
    if (std::isfinite(options.most)) command.acceleration = options.most * aside.normalized();
    command.demanded = options.most;
    return command;
  }
  command.acceleration = effect * (wanted / effect.squaredNorm());
  command.demanded = command.acceleration.norm();
  command.status = LawStatus::steering;
  if (command.demanded > options.most) {
    command.acceleration *= options.most / command.demanded;
    command.status = LawStatus::saturated;
  }
  return command;
}

double law_clearance(const BodyState& a, const BodyState& b) {
  if (a.velocity == b.velocity) return std::numeric_limits<double>::infinity();
  return view_of(a, b).miss.m;
}

}  // namespace vericone::guidance
