// SPDX-License-Identifier: BSD-3-Clause
//
// Whether a course is safe.
#include "foresight.h"

#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/pair.h>
#include <Eigen/Geometry>
#include <cmath>

namespace vericone::guidance {
namespace {

/// Looks at a turn; one that takes more is not safe, as far as anyone can say in time.
constexpr int kMostLooks = 100'000;

}  // namespace

using Eigen::Matrix3d;
using Eigen::Vector3d;

Navigator::Flight::Flight(const Moment& at, const Course& on)
    : now(at),
      course(on),
      turning(on.angle > kAligned ? on.radius * on.angle / at.speed : 0),
      rate(turning > 0 ? on.angle / turning : 0),
      axis(at.ahead.cross(on.aside)) {}

Vector3d Navigator::Flight::moved(double t) const {
  const double turned = rate * t, r = course.radius;
  if (turning > 0) return r * (std::sin(turned) * now.ahead + (1 - std::cos(turned)) * course.aside);
  return now.speed * t * now.ahead;
}

Ellipsoid Navigator::Flight::body_at(double t) const {
  if (!now.carried || turning == 0) return now.body.translated(moved(t));
  const Matrix3d rotation = Eigen::AngleAxisd(rate * t, axis).toRotationMatrix();
  const Vector3d center = now.position + rotation * (now.body.center() - now.position) + moved(t);
  Matrix3d directions = rotation * now.body.axis_directions();
  if (directions.determinant() < 0) directions.col(2) *= -1;
  return Ellipsoid::from_axes(center, now.body.semi_axes(), directions);
}

Placed Navigator::Body::at(double t) const {
  Placed there = *itself;
  there.pose.position += velocity * t;
  return there;
}

double Navigator::Body::distance(const Ellipsoid& agent, double t) const {
  if (!itself) return separation(agent, body.translated(velocity * t)).distance;
  return Pair(vericone::Body(agent), at(t)).miss(Vector3d::Zero(), Vector3d::Zero()).least;
}

bool Navigator::Body::holds(const Vector3d& point, double margin) const {
  if (!itself) return false;
  Box bounds = itself->body.bounds();
  bounds.low.array() -= margin;
  bounds.high.array() += margin;
  return bounds.contains(itself->pose.to_body(point));
}

/// The straight part past a body that is judged as it is: by how much it is missed for ever; if that is too
/// little, by distances as long as it matters.
void Navigator::see_passing(const Flight& flight, const Ellipsoid& after_turn, const Body& other,
                            std::size_t i, double required, Foreseen& result) {
  const Miss pass =
      Pair(vericone::Body(after_turn), other.at(flight.turning)).miss(flight.straight(), other.velocity);
  const double end = std::min(flight.course.until - flight.turning, other.until);
  if (pass.least >= required || !(end < kFar)) {
    result.see(pass.most > 0 ? pass.least : -pass.depth, required, i);
    return;
  }
  const double closing = (flight.straight() - other.velocity).norm(), least_step = 0.25 * flight.now.step;
  for (double t = 0;;) {
    const double d = other.distance(after_turn.translated(flight.straight() * t), flight.turning + t);
    result.see(d, required, i);
    if (d < required || !(t < end)) return;
    t = std::min(end, t + std::max(least_step, (d - required) / closing));
  }
}

/// Whether the course keeps `extra` more than required from every body. Ends early where it lacks more than
/// `floor`.
Navigator::Foreseen Navigator::foresee(const Moment& now, const Course& course, double extra,
                                       double floor) const {
  Foreseen result;
  const Flight flight(now, course);
  const double turning = flight.turning, rate = flight.rate;
  std::optional<Ellipsoid> after_turn;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& other = bodies_[i];
    const double required = other.required + (other.near ? 0 : extra);
    const auto apart = [&](double t) {  // metres; a lower bound where that is enough
      const Vector3d shift = other.velocity * t,
                     c = other.body.center() + shift - now.position - flight.moved(t);
      const double balls = c.norm() - other.reach - now.reach;
      if (balls > required) return balls;
      return other.distance(flight.body_at(t), t);
    };
    // The turn. Between two looks nothing moves farther than this.
    const double closing = now.speed + other.velocity.norm() + (now.carried ? rate * now.reach : 0);
    const double least_step = 0.25 * now.step, end = std::min(turning, course.until);
    int looks = 0;
    for (double t = 0; end > 0;) {
      if (++looks > kMostLooks) {
        result.see(-kFar, required, i);
        break;
      }
      const double d = apart(t);
      result.see(d, required, i);
      if (d < required && t > 0) break;
      if (t >= end) break;
      t = std::min(end, t + std::max(least_step, (d - required) / closing));
    }
    if (!(result.lacking >= floor)) break;
    if (course.until <= turning) continue;
    // Straight on.
    const Vector3d w = now.speed * course.direction - other.velocity;
    const Vector3d shift = other.velocity * turning;
    if (!(w.norm() > 1e-9 * (now.speed + other.velocity.norm()))) {
      result.see(apart(turning), required, i);
      continue;
    }
    const Vector3d c = other.body.center() + shift - now.position - flight.moved(turning);
    const double along = c.dot(w) / w.norm(), across = (c - along / w.norm() * w).norm();
    const double reach = other.reach + now.reach;
    if (across - reach > required || (along < 0 && c.norm() - reach > required)) continue;  // of the balls
    if (!after_turn) after_turn = flight.body_at(turning);
    if (other.itself) {
      see_passing(flight, *after_turn, other, i, required, result);
      if (!(result.lacking >= floor)) break;
      continue;
    }
    const Ellipsoid there = other.body.translated(shift);
    const Clearance pass = clearance(*after_turn, there, w);
    if (pass.distance >= required) {
      if (pass.time > 0) result.see(pass.distance, required, i);
      continue;
    }
    const Separation gap = separation(*after_turn, there);
    if (gap.distance > 0 && gap.normal.dot(w) <= 0) {  // moving apart
      result.see(gap.distance, required, i);
      continue;
    }
    if (pass.distance >= 0 && pass.time <= 0) continue;
    const double left = course.until - turning;
    if (along / w.norm() > left && (pass.distance < 0 || pass.time > left)) {
      // Not met before the course ends: then nearest at its end.
      const double d = separation(after_turn->translated(now.speed * left * course.direction),
                                  there.translated(other.velocity * left))
                           .distance;
      result.see(d, required, i);
    } else {
      result.see(pass.distance, required, i);
    }
    if (!(result.lacking >= floor)) break;
  }
  result.safe = result.lacking >= 0;
  return result;
}

}  // namespace vericone::guidance
