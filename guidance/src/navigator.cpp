// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/navigator.h>

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "check_numbers.h"
#include "foresight.h"

namespace vericone::guidance {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kLookAgain = 0.5;      // s
constexpr double kWorthChanging = 0.1;  // rad nearer to what is wanted
constexpr double kUnhurriedTurn = 2;    // rad/s, where no acceleration is too much
constexpr double kHurriedTurn = 32;     // rad/s, there, where that does not help

/// In the plane z = 0 an ellipse does what a spatial body does that is symmetric about it; tall, so that no
/// way over it is the shortest one.
Ellipsoid raised(const Ellipse& body) {
  const Eigen::Vector2d axes = body.semi_axes();
  Matrix3d directions = Matrix3d::Identity();
  directions.topLeftCorner<2, 2>() = body.axis_directions();
  if (directions.determinant() < 0) directions.col(1) *= -1;
  return Ellipsoid::from_axes({body.center().x(), body.center().y(), 0}, {axes(0), axes(1), 10 * axes(0)},
                              directions);
}

Ellipsoid seen(const BodyState& body) {
  return body.planar() ? raised(body.shape.containing_ellipse()) : body.shape.containing_ellipsoid();
}

/// The ball about the bounds, which costs little even of a map.
Ellipsoid ball_about(const Placed& body) {
  const Box bounds = body.body.bounds();
  const double radius = bounds.half_widths().norm() * (1 + 1e-12);
  return Ellipsoid::from_axes(body.pose.to_world(bounds.center()),
                              Vector3d::Constant(std::max(radius, std::numeric_limits<double>::min())));
}

bool rigid(const BodyState& body) {
  return body.omega.isZero(0) && body.rate.shape.isZero(0) && body.rate.delimiters.empty();
}

/// Of the farthest point of a body from a point, at most; in the plane the raised height does not count.
double reach_of(const Ellipsoid& body, const Vector3d& about, bool planar) {
  const Vector3d axes = body.semi_axes();
  return (planar ? std::max(axes(1), axes(2)) : axes(0)) + (body.center() - about).norm();
}

double angle_between(const Vector3d& u, const Vector3d& v) { return std::atan2(u.cross(v).norm(), u.dot(v)); }

/// A unit vector across `ahead` on the side of `direction`; left or e1 where that is straight ahead or
/// behind.
Vector3d side_of(const Vector3d& ahead, const Vector3d& direction, bool planar) {
  const Vector3d across = direction - direction.dot(ahead) * ahead;
  if (across.norm() > 1e-12) return across.normalized();
  return planar ? Vector3d(-ahead.y(), ahead.x(), 0) : AxisFrame(ahead).e1;
}

}  // namespace

const char* to_string(NavigatorStatus status) {
  switch (status) {
    case NavigatorStatus::straight:
      return "straight";
    case NavigatorStatus::homing:
      return "homing";
    case NavigatorStatus::avoiding:
      return "avoiding";
    case NavigatorStatus::too_near:
      return "too_near";
    case NavigatorStatus::cannot_avoid:
      return "cannot_avoid";
    case NavigatorStatus::no_course:
      return "no_course";
  }
  return "?";
}

Navigator::Body Navigator::body_of(const BodyState& other, bool planar) {
  if (const Placed* placed = other.shape.placed()) {
    Body body{ball_about(*placed), other.velocity, 0, 0, false};
    body.reach = reach_of(body.body, body.body.center(), planar);
    if (rigid(other)) body.itself = *placed;
    return body;
  }
  Body body{seen(other), other.velocity, 0, 0, false};
  body.reach = reach_of(body.body, body.body.center(), planar);
  if (!rigid(other)) body.body = Ellipsoid::from_axes(body.body.center(), Vector3d::Constant(body.reach));
  return body;
}

Navigator::Course Navigator::towards(const Moment& now, const Vector3d& direction, double most) const {
  Course course;
  course.direction = direction;
  course.aside = side_of(now.ahead, direction, now.planar);
  course.angle = angle_between(now.ahead, direction);
  course.radius = now.speed * now.speed / most;
  return course;
}

/// Nothing where the point lies within the circle that the agent can turn on.
std::optional<Navigator::Course> Navigator::to_destination(const Moment& now,
                                                           const Destination& destination) const {
  const Vector3d to_point = destination.point - now.position;
  if (!(to_point.norm() > 0)) return std::nullopt;
  const double most = std::min(destination.most, options_.most);
  Course course;
  course.aside = side_of(now.ahead, to_point, now.planar);
  course.radius = now.speed * now.speed / most;
  // From the circle's centre the point is at R(angle) (length, -radius).
  const double x = to_point.dot(now.ahead), y = to_point.dot(course.aside) - course.radius;
  const double square = x * x + y * y - course.radius * course.radius;
  if (square < 0) return std::nullopt;
  const double length = std::sqrt(square);
  double angle = std::atan2(y, x) + std::atan2(course.radius, length);
  if (angle < -1e-9) angle += 2 * kPi;
  course.angle = std::max(angle, 0.0);
  course.direction = std::cos(course.angle) * now.ahead + std::sin(course.angle) * course.aside;
  course.until = (course.radius * course.angle + length) / now.speed;
  return course;
}

/// Moves a safe course towards the one that is wanted, as far as it stays safe: the directions tried are some
/// degrees apart.
void Navigator::closer(const Moment& now, const Vector3d& wanted, double most, Course& course,
                       Foreseen& foreseen) const {
  const Vector3d found = course.direction, aside = side_of(wanted, found, now.planar);
  const double beside = angle_between(wanted, found);
  double low = 0, high = beside;
  for (int i = 0; i < 5; ++i) {
    const double angle = 0.5 * (low + high);
    const Course tried = towards(now, std::cos(angle) * wanted + std::sin(angle) * aside, most);
    const Foreseen seen = foresee(now, tried, beyond_, 0);
    if (!seen.safe) {
      low = angle;
      continue;
    }
    high = angle;
    course = tried;
    foreseen = seen;
  }
}

/// The safe course nearest to `wanted`, less than `less_than` beside it; else, where that is no bound, the
/// one that lacks least. False: none.
bool Navigator::search(const Moment& now, const Vector3d& wanted, double less_than, Course& course,
                       Foreseen& foreseen) {
  candidates_.clear();
  const auto add = [&](const Vector3d& direction) {
    const double beside = angle_between(wanted, direction);
    if (beside < less_than)
      candidates_.push_back({beside + 0.25 * angle_between(now.ahead, direction), direction});
  };
  add(now.ahead);
  if (now.planar) {
    constexpr int kDirections = 72;
    for (int k = 0; k < kDirections; ++k)
      add(Eigen::AngleAxisd(2 * kPi * k / kDirections, Vector3d::UnitZ()) * wanted);
  } else {
    const AxisFrame frame(wanted);
    constexpr int kRings = 24, kAround = 16;
    for (int ring = 1; ring < kRings; ++ring)
      for (int k = 0; k < kAround; ++k) {
        const double tilt = kPi * ring / kRings, around = 2 * kPi * (k + 0.5 * (ring % 2)) / kAround;
        add(std::cos(tilt) * wanted + std::sin(tilt) * frame.across(around));
      }
  }
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& x, const Candidate& y) { return x.cost < y.cost; });
  const bool any = less_than > kPi;
  double best = -kFar;
  double most = std::isfinite(options_.most) ? options_.most : kUnhurriedTurn * now.speed;
  while (true) {
    for (const Candidate& candidate : candidates_) {
      const Course tried = towards(now, candidate.direction, most);
      const Foreseen seen = foresee(now, tried, beyond_, any ? best : 0);
      if (!(seen.lacking > best) || (!any && !seen.safe)) continue;
      best = seen.lacking;
      course = tried;
      foreseen = seen;
      turn_ = most;
      if (seen.safe) {
        closer(now, wanted, most, course, foreseen);
        return true;
      }
    }
    if (!any || std::isfinite(options_.most) || most >= kHurriedTurn * now.speed) break;
    most *= 4;
  }
  return any && best > -kFar;
}

namespace {

void require_course(const BodyState& body) {
  require_finite(body.position, "position", " (m)");
  require_finite(body.velocity, "velocity", " (m/s)");
}

}  // namespace

Navigator::Navigator(const NavigatorOptions& options) : options_(options) {
  if (options.required) require_not_negative(*options.required, "required", " (m)");
  if (options.beyond) require_not_negative(*options.beyond, "beyond", " (m)");
  if (!(options.most > 0)) throw InputError("most", to_text(options.most), "positive (m/s^2)");
}

NavigatorStep Navigator::step(const BodyState& agent, std::span<const BodyState> others,
                              const std::optional<Destination>& destination, double time, double step) {
  if (!(step > 0 && step < kFar)) throw InputError("step", to_text(step), "positive and finite (s)");
  if (!std::isfinite(time)) throw InputError("time", to_text(time), "a finite number (s)");
  if (destination) {
    require_finite(destination->point, "destination.point", " (m)");
    require_not_negative(destination->most, "destination.most", " (m/s^2)");
  }
  try {
    require_course(agent);
  } catch (const InputError& e) {
    throw e.within("agent");
  }
  for (std::size_t i = 0; i < others.size(); ++i) {
    try {
      require_course(others[i]);
    } catch (const InputError& e) {
      throw e.within("others[" + std::to_string(i) + "]");
    }
    if (others[i].planar() != agent.planar())
      throw InputError("others[" + std::to_string(i) + "]",
                       agent.planar() ? "a body in space" : "a planar body",
                       agent.planar() ? "planar, as the agent is" : "a body in space, as the agent is");
  }
  NavigatorStep result;
  Moment now;
  now.position = agent.position;
  now.velocity = agent.velocity;
  now.speed = agent.velocity.norm();
  now.step = step;
  if (!(now.speed > 0)) {
    result.status = NavigatorStatus::no_course;
    return result;
  }
  now.ahead = agent.velocity / now.speed;
  now.planar = agent.planar();
  now.body = seen(agent);
  now.reach = reach_of(now.body, now.position, now.planar);
  const Vector3d axes = now.body.semi_axes();
  now.carried =
      agent.turning == Turning::with_heading && (now.planar ? axes(1) : axes(0)) > axes(2) * (1 + 1e-12);
  required_ = options_.required.value_or(now.reach / 20);
  beyond_ = options_.beyond.value_or(now.reach / 10);
  bodies_.clear();
  for (const BodyState& other : others) {
    Body body = body_of(other, now.planar);
    body.required = required_;
    if (destination && body.holds(now.position, now.reach + required_ + beyond_))
      body.until = (destination->point - now.position).norm() / now.speed;
    // Who is nearer than required already may stay so, but not come much nearer.
    const double apart = (body.body.center() - now.position).norm() - body.reach - now.reach;
    if (apart < required_ + beyond_) {
      const double distance = body.distance(now.body, 0);
      body.near = distance < required_ + beyond_;
      body.required = std::min(required_, 0.8 * distance);
    }
    bodies_.push_back(body);
  }

  Course course;
  Foreseen foreseen;
  bool decided = false, way = false;
  const std::optional<Course> direct = destination ? to_destination(now, *destination) : std::nullopt;
  if (direct) {
    course = *direct;
    foreseen = foresee(now, course, held_is_way_ ? 0 : beyond_, -kFar);
    way = decided = foreseen.safe;
  }
  const Vector3d wanted =
      direct ? Vector3d((destination->point - now.position).normalized()) : held_.value_or(now.ahead);
  if (!decided) {
    const bool had = held_.has_value() && !held_is_way_;
    const double most = had                            ? turn_
                        : std::isfinite(options_.most) ? options_.most
                                                       : kUnhurriedTurn * now.speed;
    const Vector3d direction = had ? *held_ : now.ahead;
    course = towards(now, direction, most);
    turn_ = most;
    foreseen = foresee(now, course, had ? 0 : beyond_, -kFar);
    decided = foreseen.safe;
    if (!decided || (direct && time >= next_look_)) {
      Course better;
      Foreseen of_better;
      const double bound = decided ? angle_between(wanted, direction) - kWorthChanging : 4;
      const double before = turn_;
      if (search(now, wanted, bound, better, of_better)) {
        course = better;
        foreseen = of_better;
      } else {
        turn_ = before;
      }
      next_look_ = time + kLookAgain;
    }
  }
  held_ = course.direction;
  held_is_way_ = way;

  const double most = way ? std::min(destination->most, options_.most) : turn_;
  const double missing = course.angle * now.speed / step;
  if (course.angle > kAligned) result.acceleration = std::min(most, missing) * course.aside;
  result.aligned = way && missing <= most;
  result.least = foreseen.least;
  result.nearest = foreseen.nearest;
  if (foreseen.safe || foreseen.lacking >= -beyond_) {
    const bool straight_on = course.angle <= kAligned && !direct;
    result.status = way           ? NavigatorStatus::homing
                    : straight_on ? NavigatorStatus::straight
                                  : NavigatorStatus::avoiding;
  } else {
    result.status = foreseen.least > 0 ? NavigatorStatus::too_near : NavigatorStatus::cannot_avoid;
  }
  return result;
}

}  // namespace vericone::guidance
