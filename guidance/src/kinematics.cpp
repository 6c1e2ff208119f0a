// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/guidance/kinematics.h>
#include <vericone/internal/geometry/lengths.h>
#include <vericone/internal/geometry/requires.h>
#include <vericone/internal/guidance/directions.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone::guidance {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using std::numbers::pi;

double heading_of(const Vector2d& v) { return v.isZero(0) ? 0 : std::atan2(v.y(), v.x()); }

Vector2d unit(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// The axes of (6.10) at a direction: along it, and those in which azimuth and elevation grow.
struct Axes {
  Vector3d along, azimuth, elevation;
  double cosine;  // of the elevation
  bool vertical;  // the elevation rounds to a right angle: the cosine is rounding
};

Axes axes_at(double azimuth, double elevation) {
  const double ca = std::cos(azimuth), sa = std::sin(azimuth);
  const double ce = std::cos(elevation), se = std::sin(elevation);
  const bool vertical = std::abs(ce) <= std::numeric_limits<double>::epsilon();
  return {{ce * ca, ce * sa, se}, {-sa, ca, 0}, {-se * ca, -se * sa, ce}, ce, vertical};
}

struct HeadingRates {
  Direction heading;
  double speed = 0;
};

HeadingRates heading_rates(const Direction& heading, double speed, const Vector3d& acceleration) {
  const Axes axes = axes_at(heading.azimuth, heading.elevation);
  HeadingRates rates;
  rates.speed = acceleration.dot(axes.along);
  if (!(speed > 0)) return rates;
  if (!axes.vertical) rates.heading.azimuth = acceleration.dot(axes.azimuth) / (speed * axes.cosine);
  rates.heading.elevation = acceleration.dot(axes.elevation) / speed;
  return rates;
}

Direction heading_of(const Vector3d& v, const Direction* previous) {
  Direction heading = direction_of(v, previous ? *previous : Direction{});
  if (previous) heading.azimuth = unwrapped(heading.azimuth, previous->azimuth);
  return heading;
}

}  // namespace

double unwrapped(double angle, double near) {
  return angle - 2 * pi * std::nearbyint((angle - near) / (2 * pi));
}

PlanarRates planar_rates(const PlanarState& s, const PlanarInputs& in) {
  VERICONE_REQUIRES(s.r > 0, "state.r", "no positive number", "positive (m)");
  const double sine_a = std::sin(s.alpha - s.theta), cosine_a = std::cos(s.alpha - s.theta);
  const double sine_b = std::sin(s.beta - s.theta), cosine_b = std::cos(s.beta - s.theta);
  PlanarRates rates;
  rates.r = s.v_r;
  rates.theta = s.v_theta / s.r;
  // A frame (u, e, u x e) that turns with the line of sight has u' = (V_theta e + V_n u x e) / r and
  // e' = -(V_theta / r) u + spin (u x e): hence the terms of a projection.
  rates.v_theta = -s.v_theta * s.v_r / s.r + s.plane_spin * s.v_normal  // (5.8), (5.13), (5.15)
                  - cosine_a * in.lateral_a - sine_a * in.longitudinal_a + cosine_b * in.lateral_b +
                  sine_b * in.longitudinal_b;
  rates.v_r = (s.v_theta * s.v_theta + s.v_normal * s.v_normal) / s.r  // (5.8), (5.13), (5.15)
              + sine_a * in.lateral_a - cosine_a * in.longitudinal_a - sine_b * in.lateral_b +
              cosine_b * in.longitudinal_b;
  rates.alpha = s.speed_a > 0 ? in.lateral_a / s.speed_a : 0;
  rates.beta = s.speed_b > 0 ? in.lateral_b / s.speed_b : 0;
  rates.speed_a = in.longitudinal_a;
  rates.speed_b = in.longitudinal_b;
  return rates;
}

PlanarState planar_state(const Cartesian<2>& motion) {
  const Vector2d c = motion.p_b - motion.p_a, v = motion.v_b - motion.v_a;
  if (c.isZero(0))
    throw InputError("obstacle.center", "[" + to_text(motion.p_b.x()) + ", " + to_text(motion.p_b.y()) + "]",
                     "different from the agent's centre");
  PlanarState s;
  s.r = detail::length(c);
  const Vector2d u = c / s.r;
  s.theta = std::atan2(c.y(), c.x());
  s.v_r = v.dot(u);
  s.v_theta = u.x() * v.y() - u.y() * v.x();
  s.alpha = heading_of(motion.v_a);
  s.beta = heading_of(motion.v_b);
  s.speed_a = motion.v_a.norm();
  s.speed_b = motion.v_b.norm();
  return s;
}

Cartesian<2> cartesian(const PlanarState& s, const Vector2d& p_a) {
  return {p_a, s.speed_a * unit(s.alpha), p_a + s.r * unit(s.theta), s.speed_b * unit(s.beta)};
}

Direction direction_of(const Vector3d& v, const Direction& otherwise) {
  Direction direction = otherwise;
  const double level = std::hypot(v.x(), v.y());
  // Zeros may have a sign, which atan2 would turn into half a turn: + 0 makes them positive.
  if (level > 0) direction.azimuth = std::atan2(v.y() + 0.0, v.x() + 0.0);
  if (level > 0 || v.z() != 0) direction.elevation = std::atan2(v.z(), level);
  return direction;
}

Vector3d unit_vector(const Direction& direction) {
  return axes_at(direction.azimuth, direction.elevation).along;
}

DirectedAcceleration directed(const Vector3d& acceleration) {
  return {detail::length(acceleration), direction_of(acceleration)};
}

SpatialRates spatial_rates(const SpatialState& s, const DirectedAcceleration& a,
                           const DirectedAcceleration& b) {
  const Axes axes = axes_at(s.theta, s.phi);
  const Vector3d a_a = a.magnitude * unit_vector(a.direction), a_b = b.magnitude * unit_vector(b.direction);
  const Vector3d relative = a_b - a_a;
  SpatialRates rates;
  rates.r = s.v_r;
  rates.phi = s.v_phi / s.r;
  rates.v_r = (s.v_theta * s.v_theta + s.v_phi * s.v_phi) / s.r + relative.dot(axes.along);
  rates.at_pole = axes.vertical;
  if (!rates.at_pole) {  // (6.10); its V_phi row as corrected, -V_phi V_r for the printed -V_theta V_r
    const double tangent = std::tan(s.phi);
    rates.theta = s.v_theta / (s.r * axes.cosine);
    rates.v_theta = (-s.v_theta * s.v_r + s.v_theta * s.v_phi * tangent) / s.r + relative.dot(axes.azimuth);
    rates.v_phi = (-s.v_phi * s.v_r - s.v_theta * s.v_theta * tangent) / s.r + relative.dot(axes.elevation);
  }
  const HeadingRates of_a = heading_rates(s.heading_a, s.speed_a, a_a),
                     of_b = heading_rates(s.heading_b, s.speed_b, a_b);
  rates.heading_a = of_a.heading;
  rates.heading_b = of_b.heading;
  rates.speed_a = of_a.speed;
  rates.speed_b = of_b.speed;
  return rates;
}

SpatialState spatial_state(const Cartesian<3>& motion, const SpatialState* previous) {
  const Vector3d c = motion.p_b - motion.p_a, v = motion.v_b - motion.v_a;
  if (c.isZero(0))
    throw InputError(
        "obstacle.center",
        "[" + to_text(motion.p_b.x()) + ", " + to_text(motion.p_b.y()) + ", " + to_text(motion.p_b.z()) + "]",
        "different from the agent's centre");
  SpatialState s;
  s.r = detail::length(c);
  const Direction before = previous ? Direction{previous->theta, previous->phi} : Direction{};
  const Direction sight = heading_of(c, previous ? &before : nullptr);
  s.theta = sight.azimuth;
  s.phi = sight.elevation;
  // V_r along the vector itself: near a pole the angles keep fewer digits of it.
  const Axes axes = axes_at(s.theta, s.phi);
  s.v_r = v.dot(c) / s.r;
  s.v_theta = v.dot(axes.azimuth);
  s.v_phi = v.dot(axes.elevation);
  s.heading_a = heading_of(motion.v_a, previous ? &previous->heading_a : nullptr);
  s.heading_b = heading_of(motion.v_b, previous ? &previous->heading_b : nullptr);
  s.speed_a = motion.v_a.norm();
  s.speed_b = motion.v_b.norm();
  return s;
}

Cartesian<3> cartesian(const SpatialState& s, const Vector3d& p_a) {
  return {p_a, s.speed_a * unit_vector(s.heading_a), p_a + s.r * unit_vector({s.theta, s.phi}),
          s.speed_b * unit_vector(s.heading_b)};
}

}  // namespace vericone::guidance
