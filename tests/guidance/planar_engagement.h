// SPDX-License-Identifier: BSD-3-Clause
//
// Two planar bodies on Cartesian paths, y from scratch at any time, and what the laws read of them at t = 0.
#pragma once

#include <vericone/cones/planar/sector.h>
#include <vericone/guidance/laws.h>

#include <limits>
#include <numbers>

#include "guidance/motion.h"

namespace vericone::testing {

struct PlanarBody {
  Ellipse at_start;  // its centre is not read
  Path<2> path;
  bool with_heading = false;                         // turns with its velocity, else with `omega`
  double omega = 0;                                  // rad/s
  Eigen::Matrix2d growth = Eigen::Matrix2d::Zero();  // of the shape matrix, in the body's own axes, m^2/s

  Ellipse at(double t) const {
    const double angle = with_heading ? angle_between(path.v, path.velocity(t)) : omega * t;
    const Eigen::Matrix2d r = rotation_2d(angle), s = r * (at_start.shape() + t * growth) * r.transpose();
    return Ellipse::from_shape(path.position(t), 0.5 * (s + s.transpose()));
  }
  double speed() const { return path.v.norm(); }
  Eigen::Vector2d along() const { return path.v.normalized(); }
  Eigen::Vector2d left() const { return {-along().y(), along().x()}; }
};

struct PlanarEngagement {
  PlanarBody a, b;

  Eigen::Vector2d relative(double t) const { return b.path.velocity(t) - a.path.velocity(t); }

  /// y by its meaning: the angle between the relative velocity and the bisector of the bodies' sector.
  double y(double t) const {
    const Sector sector = sector_by_support(a.at(t), b.at(t));
    const double lambda = angle_between(at_angle(sector.theta_b), relative(t));
    return std::pow(std::sin(lambda), 2) - std::pow(std::sin(sector.psi / 2), 2);
  }

  guidance::PlanarState state() const {
    return guidance::planar_state({a.path.p, a.path.v, b.path.p, b.path.v});
  }

  /// With the rates of cones/sector.h, and what accelerations add by turning bodies by linearity.
  guidance::PlaneCone cone() const {
    const Ellipse body_a = a.at(0), body_b = b.at(0);
    const Sector sector = sector_by_support(body_a, body_b);
    PlanarMotion motion{a.path.v, b.path.v, a.with_heading ? 0 : a.omega, b.with_heading ? 0 : b.omega,
                        a.growth, b.growth};
    const auto rates = [&](double more_a, double more_b) {
      PlanarMotion turned = motion;
      turned.omega_a += more_a;
      turned.omega_b += more_b;
      return sector_rates(sector, body_a, body_b, turned);
    };
    const SectorRates now = rates(0, 0);
    guidance::PlaneCone cone{sector.psi, sector.theta_b, now.psi, now.theta_b};
    if (a.with_heading) {
      const SectorRates turned = rates(1 / a.speed(), 0);
      cone.psi_rate_by_a = turned.psi - now.psi;
      cone.theta_b_rate_by_a = turned.theta_b - now.theta_b;
    }
    if (b.with_heading) {
      const SectorRates turned = rates(0, 1 / b.speed());
      cone.psi_rate_by_b = turned.psi - now.psi;
      cone.theta_b_rate_by_b = turned.theta_b - now.theta_b;
    }
    return cone;
  }

  void apply(double lateral_a, double lateral_b, double longitudinal_a = 0, double longitudinal_b = 0) {
    a.path.a = lateral_a * a.left() + longitudinal_a * a.along();
    b.path.a = lateral_b * b.left() + longitudinal_b * b.along();
  }

  /// In which nothing changes much: differences take a small part of it.
  double time_scale() const {
    const Sector sector = sector_by_support(a.at(0), b.at(0));
    const double tangent = std::min((sector.left.point_on_b - sector.left.point_on_a).norm(),
                                    (sector.right.point_on_b - sector.right.point_on_a).norm());
    const double v = relative(0).norm(), a_a = a.path.a.norm(), a_b = b.path.a.norm();
    return std::min({tangent / v, v / (a_a + a_b), a.speed() / a_a, b.speed() / a_b,
                     std::sqrt(tangent / (a_a + a_b)), 1 / (1 + std::abs(a.omega) + std::abs(b.omega))});
  }
  double y_rate() const {
    return richardson_derivative([&](double t) { return y(t); }, 0.02 * time_scale());
  }
  double speed_squared_rate() const {
    return richardson_derivative([&](double t) { return relative(t).squaredNorm(); }, 0.02 * time_scale());
  }
};

/// Bodies with semi-axes 1 to 6 m, 1.2 to 4 times as far apart as when they touch, speeds 2 to 40 m/s. The
/// relative velocity lies at `part` of psi / 2 from the bisector, part uniform in [-reach, reach]: within 1
/// it collides.
inline PlanarEngagement random_planar_engagement(RandomBodies& random, double reach) {
  const auto [body_a, body_b] = random.planar_scaled_from_touching(1, 6, random.uniform(1.2, 4));
  PlanarEngagement e;
  e.a.at_start = body_a;
  e.b.at_start = body_b;
  e.a.path.p = body_a.center();
  e.b.path.p = body_b.center();
  const Sector sector = sector_by_support(body_a, body_b);
  const double angle = sector.theta_b + random.uniform(-reach, reach) * sector.psi / 2;
  e.a.path.v = random.uniform(2, 40) * random.direction_2d();
  e.b.path.v = e.a.path.v - random.uniform(2, 40) * at_angle(angle);
  e.a.with_heading = random.coin();
  e.b.with_heading = random.coin();
  for (PlanarBody* body : {&e.a, &e.b}) {
    if (!body->with_heading) body->omega = random.uniform(-1, 1);
    body->growth = random.uniform(-0.2, 0.2) * body->at_start.shape();
  }
  return e;
}

}  // namespace vericone::testing
