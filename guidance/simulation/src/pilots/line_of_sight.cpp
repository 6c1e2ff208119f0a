// SPDX-License-Identifier: BSD-3-Clause
#include "pilots/line_of_sight.h"

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/pair.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "tracks/level_frame.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;
using guidance::BodyState;

/// About a body, m.
struct Ball {
  Vector3d center;
  double radius;
};

Ball ball_about(const Track& track, const BodyState& body) {
  if (!body.shape.placed() && !body.shape.hull()) return {body.position, reach(track.shape())};
  const Placed placed = body.shape.as_placed();
  const Box bounds = placed.body.bounds();
  return {placed.pose.to_world(bounds.center()), bounds.half_widths().norm() * (1 + 1e-12)};
}

/// Stands for a point, which has no inside: m.
constexpr double kPoint = 1e-6;

WorldBody point_at(const Vector3d& at, bool planar) {
  if (planar) return CombinedEllipse(Ellipse::from_axes(at.head<2>(), Eigen::Vector2d::Constant(kPoint)));
  return CombinedEllipsoid(Ellipsoid::from_axes(at, Vector3d::Constant(kPoint)));
}

bool within_range(double range, const Vector3d& eye, const Ball& ball, const WorldBody& body) {
  const double away = (ball.center - eye).norm();
  if (away + ball.radius <= range) return true;
  return away - ball.radius <= range &&
         pair_of(point_at(eye, body.planar()), body).distance() + kPoint <= range;
}

bool in_view(double view, const Vector3d& eye, const Vector3d& ahead, const Ball& ball) {
  const Vector3d to = ball.center - eye;
  const double away = to.norm();
  if (!(away > ball.radius)) return true;
  const double off = std::atan2(ahead.cross(to).norm(), ahead.dot(to));
  return off - std::asin(ball.radius / away) <= view;
}

/// Points of a body that are looked for, slightly within it.
std::vector<Vector3d> looked_for(const Vector3d& eye, const Ball& ball, const WorldBody& body) {
  constexpr double kWithin = 0.99;
  const Vector3d to = ball.center - eye;
  std::vector<Vector3d> points{ball.center};
  if (to.isZero(0)) return points;
  const auto farthest = [&](const Vector3d& n) -> Vector3d {
    if (body.planar()) {
      const Ellipse around = body.containing_ellipse();
      const Eigen::Vector2d at = around.support_point(n.head<2>());
      return {at.x(), at.y(), 0};
    }
    if (const auto point = body.support_point(n)) return *point;
    const Placed placed = body.as_placed();
    return ball.center + (placed.support(n) - n.dot(ball.center)) * n;
  };
  const auto look = [&](const Vector3d& n) {
    for (const double side : {1.0, -1.0})
      points.push_back(ball.center + kWithin * (farthest(side * n) - ball.center));
  };
  if (body.planar()) {
    look(Vector3d(-to.y(), to.x(), 0).normalized());
  } else {
    const AxisFrame frame(to);
    look(frame.e1);
    look(frame.e2);
  }
  return points;
}

double from_segment(const Vector3d& point, const Vector3d& begin, const Vector3d& end) {
  const Vector3d along = end - begin;
  const double length = along.squaredNorm();
  const double part = length > 0 ? std::clamp((point - begin).dot(along) / length, 0.0, 1.0) : 0;
  return (begin + part * along - point).norm();
}

bool hidden(const Vector3d& eye, std::vector<Vector3d> points, const Instant& now, std::size_t agent,
            std::size_t body) {
  for (std::size_t k = 0; k < now.bodies.size(); ++k) {
    if (k == agent || k == body || !now.there(k)) continue;
    const WorldBody& other = now.bodies[k].shape;
    const Ball around = ball_about(now.tracks[k], now.bodies[k]);
    std::optional<Pair> pair;
    std::erase_if(points, [&](const Vector3d& point) {
      if (from_segment(around.center, eye, point) > around.radius + kPoint) return false;
      if (!pair) pair = pair_of(point_at(eye, other.planar()), other);
      return pair->verdict(point - eye, Vector3d::Zero(), Horizon{0, 1}) == Verdict::in;
    });
    if (points.empty()) return true;
  }
  return false;
}

}  // namespace

bool sees_in_part(const Sensor& sensor) {
  return std::isfinite(sensor.range) || std::isfinite(sensor.view) || sensor.occluded;
}

bool in_sight(const Sensor& sensor, const Instant& now, std::size_t agent, std::size_t body) {
  const BodyState &a = now.bodies[agent], &b = now.bodies[body];
  const Ball ball = ball_about(now.tracks[body], b);
  if (!within_range(sensor.range, a.position, ball, b.shape)) return false;
  if (b.shape.placed() && b.velocity.isZero(0) && b.omega.isZero(0)) return true;
  if (std::isfinite(sensor.view)) {
    const bool moves = a.velocity.norm() > kRestSpeed;
    const Vector3d ahead = moves ? a.velocity : now.tracks[agent].motion(now.t).rotation.col(0);
    if (!in_view(sensor.view, a.position, ahead, ball)) return false;
  }
  return !sensor.occluded || !hidden(a.position, looked_for(a.position, ball, b.shape), now, agent, body);
}

}  // namespace vericone::simulation
