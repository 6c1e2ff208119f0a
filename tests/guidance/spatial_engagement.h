// SPDX-License-Identifier: BSD-3-Clause
//
// Two ellipsoids on Cartesian paths and a plane through their line of sight that is carried along; y on it
// from scratch at any time, and what the laws read of it at t = 0.
#pragma once

#include <vericone/guidance/laws.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>

#include "guidance/motion.h"

namespace vericone::testing {

struct SpatialBody {
  Ellipsoid at_start;  // its centre is not read
  Path<3> path;
  bool with_heading = false;                         // turns with its velocity, beyond `omega`
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();   // rad/s
  Eigen::Matrix3d growth = Eigen::Matrix3d::Zero();  // of the shape matrix before turning, m^2/s

  Ellipsoid at(double t) const {
    const double speed = omega.norm();
    Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
    if (speed > 0) r = Eigen::AngleAxisd(speed * t, omega / speed).toRotationMatrix();
    // The velocity stays in one plane, so turning with it without roll is turning about that plane's normal.
    if (with_heading) r = r * least_rotation(path.v, path.velocity(t));
    const Eigen::Matrix3d s = r * (at_start.shape() + t * growth) * r.transpose();
    return Ellipsoid::from_shape(path.position(t), 0.5 * (s + s.transpose()));
  }
};

struct SpatialEngagement {
  SpatialBody a, b;
  Eigen::Vector3d across = Eigen::Vector3d::Zero();  // unit, at t = 0
  double plane_spin = 0;                             // rad/s
  double theta = 0;  // of the line of sight on the plane against an axis of no importance

  Eigen::Vector3d sight(double t) const { return (b.path.position(t) - a.path.position(t)).normalized(); }
  Eigen::Vector3d relative(double t) const { return b.path.velocity(t) - a.path.velocity(t); }
  /// The plane's second axis: turned with the line of sight without spinning, then spun about it.
  Eigen::Vector3d axis(double t) const {
    return Eigen::AngleAxisd(plane_spin * t, sight(t)) * (least_rotation(sight(0), sight(t)) * across);
  }

  /// y by its meaning: the angle on the plane between the relative velocity's projection and the bisector.
  double y(double t) const {
    const Eigen::Vector3d u = sight(t), e = axis(t), v = relative(t);
    const PlaneSector sector = true_sector(a.at(t), b.at(t), e);
    const double lambda = std::atan2(v.dot(e), v.dot(u)) - sector.theta_b();
    return std::pow(std::sin(lambda), 2) - std::pow(std::sin(sector.psi() / 2), 2);
  }

  guidance::PlanarState state() const {
    const Eigen::Vector3d u = sight(0), v = relative(0);
    const auto projected = [&](const Eigen::Vector3d& w) { return Eigen::Vector2d(w.dot(u), w.dot(across)); };
    const Eigen::Vector2d v_a = projected(a.path.v), v_b = projected(b.path.v);
    guidance::PlanarState s;
    s.r = (b.path.p - a.path.p).norm();
    s.theta = theta;
    s.v_r = v.dot(u);
    s.v_theta = v.dot(across);
    s.alpha = theta + std::atan2(v_a.y(), v_a.x());
    s.beta = theta + std::atan2(v_b.y(), v_b.x());
    s.speed_a = v_a.norm();
    s.speed_b = v_b.norm();
    s.v_normal = v.dot(u.cross(across));
    s.plane_spin = plane_spin;
    return s;
  }

  /// On the plane, perpendicular to the whole velocity.
  Eigen::Vector3d left(const SpatialBody& body) const {
    const Eigen::Vector3d u = sight(0);
    return (body.path.v.dot(u) * across - body.path.v.dot(across) * u).normalized();
  }

  guidance::PlaneCone cone() const {
    const Ellipsoid body_a = a.at(0), body_b = b.at(0);
    const PlaneSector sector = true_sector(body_a, body_b, across);
    const auto rates = [&](double lateral_a, double lateral_b) {
      const auto omega = [&](const SpatialBody& body, double lateral) -> Eigen::Vector3d {
        if (!body.with_heading) return body.omega;
        return body.omega + body.path.v.cross(lateral * left(body)) / body.path.v.squaredNorm();
      };
      const BodyRate rate_a{a.growth, {}}, rate_b{b.growth, {}};
      const SpatialMotion motion{a.path.v, b.path.v, omega(a, lateral_a), omega(b, lateral_b),
                                 &rate_a,  &rate_b,  plane_spin};
      return true_sector_rates(sector, body_a, body_b, motion);
    };
    const PlaneSectorRates now = rates(0, 0), by_a = rates(1, 0), by_b = rates(0, 1);
    return {sector.psi(),
            theta + sector.theta_b(),
            now.psi(),
            now.theta_b() + now.line_of_sight,
            by_a.psi() - now.psi(),
            by_a.theta_b() - now.theta_b(),
            by_b.psi() - now.psi(),
            by_b.theta_b() - now.theta_b()};
  }

  void apply(double lateral_a, double lateral_b) {
    const Eigen::Vector3d left_a = left(a), left_b = left(b);
    a.path.a = lateral_a * left_a;
    b.path.a = lateral_b * left_b;
  }

  double time_scale() const {
    const PlaneSector sector = true_sector(a.at(0), b.at(0), across);
    const double contact = std::min(sector.left.contact.norm(), sector.right.contact.norm());
    const double v = relative(0).norm(), a_a = a.path.a.norm(), a_b = b.path.a.norm();
    const double projected = std::hypot(relative(0).dot(sight(0)), relative(0).dot(across));
    return std::min({contact / v, projected / (a_a + a_b), a.path.v.norm() / a_a, b.path.v.norm() / a_b,
                     std::sqrt(contact / (a_a + a_b)),
                     1 / (1 + a.omega.norm() + b.omega.norm() + std::abs(plane_spin))});
  }
  double y_rate() const {
    return richardson_derivative([&](double t) { return y(t); }, 0.02 * time_scale());
  }
};

/// Ellipsoids with semi-axes 1 to 6 m, 1.3 to 4 times as far apart as when they touch, speeds 2 to 40 m/s; on
/// a random plane the projection of the relative velocity lies at `part` of psi / 2 from the bisector, part
/// uniform in [-reach, reach], and it has a component off the plane of up to its own size.
inline SpatialEngagement random_spatial_engagement(RandomBodies& random, double reach) {
  const auto [body_a, body_b] = random.scaled_from_touching(1, 6, random.uniform(1.3, 4));
  SpatialEngagement e;
  e.a.at_start = body_a;
  e.b.at_start = body_b;
  e.a.path.p = body_a.center();
  e.b.path.p = body_b.center();
  const PlaneSector sector = true_sector(body_a, body_b, random.direction());
  e.across = sector.across;
  e.plane_spin = random.uniform(-1, 1);
  e.theta = random.uniform(-10, 10);
  const double angle = sector.theta_b() + random.uniform(-reach, reach) * sector.psi() / 2;
  const Eigen::Vector3d &u = sector.line_of_sight, n = u.cross(e.across);
  e.a.path.v = random.uniform(2, 40) * random.direction();
  e.b.path.v = e.a.path.v - random.uniform(2, 40) * (std::cos(angle) * u + std::sin(angle) * e.across +
                                                     random.uniform(-1, 1) * n);
  for (SpatialBody* body : {&e.a, &e.b}) {
    body->with_heading = random.coin();
    body->omega = random.in_box(0.6);
    body->growth = random.uniform(-0.2, 0.2) * body->at_start.shape();
  }
  return e;
}

}  // namespace vericone::testing
