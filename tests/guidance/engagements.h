// SPDX-License-Identifier: BSD-3-Clause
//
// Random engagements and how they go on, written without the library's own propagation.
#pragma once

#include <vericone/guidance/plane_view.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "cones/ellipsoids/richardson.h"
#include "support/random_combined.h"

namespace vericone::testing {

inline Eigen::Matrix3d turn(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix()
                   : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
}

/// A body that is moved, turned and changed along smooth functions of time: constant acceleration, constant
/// omega, a heading that takes the body with it, semi-axes and delimiters that change linearly.
struct MovingBody {
  guidance::BodyState now;
  Eigen::Vector3d semi_axes, axes_rate = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation;
  std::vector<Delimiter<3>> own_delimiters, delimiter_rates;  // in the body's axes
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();

  guidance::BodyState at(double t) const {
    guidance::BodyState s = now;
    s.position = now.position + t * now.velocity + 0.5 * t * t * acceleration;
    s.velocity = now.velocity + t * acceleration;
    Eigen::Matrix3d r = turn(t * now.omega) * rotation;
    if (now.turning == guidance::Turning::with_heading)
      r = Eigen::Quaterniond::FromTwoVectors(now.velocity, s.velocity).toRotationMatrix() * r;
    const Ellipsoid e = Ellipsoid::from_axes(s.position, semi_axes + t * axes_rate, r);
    std::vector<Delimiter<3>> delimiters;
    for (std::size_t i = 0; i < own_delimiters.size(); ++i) {
      Eigen::Matrix3d m = own_delimiters[i].matrix;
      double level = own_delimiters[i].level;
      if (i < delimiter_rates.size()) {
        m += t * delimiter_rates[i].matrix;
        level += t * delimiter_rates[i].level;
      }
      m = r * m * r.transpose();
      delimiters.push_back({0.5 * (m + m.transpose()), level});
    }
    s.shape = CombinedEllipsoid::trusted(e, std::move(delimiters));
    return s;
  }

  /// The state now, with the rates of the shape.
  guidance::BodyState state() const {
    guidance::BodyState s = at(0);
    const Eigen::Vector3d d = 2 * semi_axes.cwiseProduct(axes_rate);
    s.rate.shape = rotation * d.asDiagonal() * rotation.transpose();
    for (const Delimiter<3>& rate : delimiter_rates)
      s.rate.delimiters.push_back({rotation * rate.matrix * rotation.transpose(), rate.level});
    return s;
  }
};

/// `e` carried along the straight relative motion c0 + t v: the line of sight stays in the plane of c0 and v,
/// so the part of e in it turns as the line of sight does and the rest stays. Then spun about it.
inline Eigen::Vector3d carried_axis(const Eigen::Vector3d& c0, const Eigen::Vector3d& v, double t,
                                    const Eigen::Vector3d& e, double spin) {
  const Eigen::Vector3d u0 = c0.normalized(), u = (c0 + t * v).normalized(), m = c0.cross(v).normalized();
  const Eigen::Vector3d carried = e.dot(m) * m + e.dot(m.cross(u0)) * m.cross(u);
  return turn(t * spin * u) * carried;
}

/// Semi-axes 1 to 3, velocities of some m/s, every kind of turning and change.
inline MovingBody moving_body(RandomBodies& random, const Eigen::Vector3d& position) {
  MovingBody m;
  m.now.position = position;
  m.now.velocity = random.uniform(1, 10) * random.direction();
  m.now.omega = random.in_box(1);
  m.semi_axes = {random.uniform(1, 3), random.uniform(1, 3), random.uniform(1, 3)};
  m.axes_rate = random.in_box(0.3);
  m.rotation = random.rotation();
  return m;
}

/// Two ellipsoids `factor` times as far apart as when they touch on their line of centres.
inline std::pair<MovingBody, MovingBody> moving_pair(RandomBodies& random, double low, double high) {
  MovingBody a = moving_body(random, random.in_box(5)), b = moving_body(random, a.now.position);
  const Eigen::Vector3d d = random.direction();
  const Ellipsoid at_a = a.at(0).shape.quadric()->ellipsoid(), at_b = b.at(0).shape.quadric()->ellipsoid();
  const double touching = 1 / std::sqrt(ContactFrame<3>(at_a, at_b.translated(d)).contact);
  b.now.position += random.uniform(low, high) * touching * d;
  return {a, b};
}

/// One or two dents on the body's axes that leave 0.3 to 0.8 of it.
inline void dent(RandomBodies& random, MovingBody& m) {
  const int count = random.integer(1, 2);
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d d = -(m.semi_axes * random.uniform(0.3, 1)).cwiseAbs2().cwiseInverse();
    const int axis = i + random.integer(0, 1);
    d(axis) = 1 / std::pow(m.semi_axes(axis) * random.uniform(0.3, 0.8), 2);
    m.own_delimiters.push_back({Eigen::Matrix3d(d.asDiagonal()), 1});
    const Eigen::Vector3d change(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1),
                                 random.uniform(-0.1, 0.1));
    m.delimiter_rates.push_back({Eigen::Matrix3d(change.asDiagonal()), random.uniform(-0.1, 0.1)});
  }
}

/// f'(0); nothing where differences over steps twice as long say another one, as where f has a kink nearby.
template <typename Function>
std::optional<double> settled_derivative(const Function& f, double h, double tolerance) {
  const double once = richardson_derivative(f, h), again = richardson_derivative(f, 2 * h);
  if (!(std::abs(once - again) < tolerance)) return std::nullopt;
  return once;
}

}  // namespace vericone::testing
