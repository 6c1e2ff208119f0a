// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/navigator.h>

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "check_numbers.h"
#include "foresight.h"
#include "route.h"

namespace vericone::guidance {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kLookAgain = 0.5;      // s
constexpr double kOfTimeLeft = 0.25;    // before a contact it looks again when this part of it has gone
constexpr int kMostLooks = 8;           // ahead, before it says that all courses hit
constexpr long kMostAhead = 200000;     // distances measured for them
constexpr double kWorthChanging = 0.1;  // rad nearer to what is wanted
constexpr double kUnhurriedTurn = 2;    // rad/s, where no acceleration is too much
constexpr double kHurriedTurn = 32;     // rad/s, there, where that does not help
constexpr double kAtRest = 1e-3;        // m/s: who is slower does not turn
constexpr long kLooksWithAStop = 400;   // it goes on at the next step
constexpr double kBraking = 0.9;        // of what it can, who is to stop at its destination

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

/// By a thousandth: what is foreseen is not quite what is flown, and a course that misses by less hits.
Ellipsoid slightly_larger(const Ellipsoid& body) {
  constexpr double kScale = 1.001;
  return Ellipsoid::trusted(body.center(), kScale * kScale * body.shape(), kScale * body.factor(), true);
}

/// The ball about the bounds, which costs little even of a map.
Ellipsoid ball_about(const Placed& body) {
  const Box bounds = body.body.assembly() ? body.body.assembly()->bounds() : body.body.bounds();
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

/// Its largest semi-axis, a little too much: of every body at every step, so without its other axes.
double longest_axis(const Ellipsoid& body) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver =
      Eigen::SelfAdjointEigenSolver<Matrix3d>().computeDirect(body.shape(), Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues().maxCoeff()) * (1 + 1e-6);
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

Navigator::Body Navigator::body_of(const BodyState& other, bool planar) const {
  const Placed* placed = other.shape.placed();
  const bool as_it_is = placed && rigid(other) && !placed->body.quadric();
  Body body{as_it_is ? ball_about(*placed) : seen(other), other.velocity};
  body.reach =
      planar || !rigid(other) ? reach_of(body.body, body.body.center(), planar) : longest_axis(body.body);
  if (as_it_is) body.itself = *placed;
  if (!as_it_is || !other.velocity.isZero(0)) body.swerves = options_.others_most;
  if (!other.omega.isZero(0)) body.offset = (body.body.center() - other.position).norm();
  if (!rigid(other)) body.body = Ellipsoid::from_axes(body.body.center(), Vector3d::Constant(body.reach));
  return body;
}

/// How far one velocity is from another, in what courses may differ by: radians, or parts of the pace.
double Navigator::beside(const Moment& now, const Vector3d& u, const Vector3d& v) const {
  return options_.longitudinal ? (u - v).norm() / now.pace : angle_between(u, v);
}

/// In a whole number of steps, at the end of which the command changes: so it is flown as it is foreseen.
Navigator::Course Navigator::towards(const Moment& now, const Vector3d& velocity, double most) const {
  Course course;
  course.velocity = velocity;
  course.asked = course.most = most;
  const auto in_steps = [&](double change) {  // m/s
    const double steps = std::ceil(change / (most * now.step) - 1e-6);
    course.turning = std::max(steps, 1.0) * now.step;
    course.most = change / course.turning;
  };
  if (options_.longitudinal) {
    const Vector3d change = velocity - now.velocity;
    course.aside = change.normalized();  // zero stays zero
    if (change.norm() > kAligned * now.pace) in_steps(change.norm());
    if (now.stops) brake_from(now, velocity.isZero(0) ? course.turning : course.turning + now.step, course);
    return course;
  }
  const Vector3d direction = velocity.normalized();
  course.velocity = now.speed * direction;
  course.aside = side_of(now.ahead, direction, now.planar);
  course.angle = angle_between(now.ahead, direction);
  if (!(course.angle > kAligned)) return course;
  in_steps(course.angle * now.speed);
  course.radius = now.speed * now.speed / course.most;
  return course;
}

/// In a whole number of steps too.
void Navigator::brake_from(const Moment& now, double t, Course& course) {
  const double steps = std::ceil(course.velocity.norm() / (course.asked * now.step) - 1e-6);
  course.brakes = std::max(t, course.turning);
  course.braking = std::max(steps, 0.0) * now.step;
}

/// m/s, in a second, of who was at rest.
double Navigator::soon(const Moment& now, double most) { return now.speed + 1 * most; }

/// At a part of the speed that it would have. Nothing where the point lies within the circle that the agent
/// can turn on.
std::optional<Navigator::Course> Navigator::to_destination(const Moment& now, const Destination& destination,
                                                           double part) const {
  const Vector3d to_point = destination.point - now.position, &u = destination.velocity;
  const double distance = to_point.norm(), most = std::min(destination.most, options_.most);
  if (!(distance > 0) && !destination.stay) return std::nullopt;
  if (options_.longitudinal) {
    // At the speed that it has; without one, as fast as it can still stop there.
    const double stopping = std::sqrt(2 * kBraking * most * distance);
    double pace =
        now.cruise > 0 ? std::max(now.cruise, u.norm()) : std::min(soon(now, most), stopping) + u.norm();
    pace = part * std::min(pace, options_.fastest);
    const Vector3d ahead = to_point.normalized();
    // u + closing ahead, as fast as that.
    const double along = u.dot(ahead), root = along * along - u.squaredNorm() + pace * pace;
    double closing = root > 0 ? std::max(0.0, std::sqrt(root) - along) : 0;
    if (destination.stay) closing = std::min({closing, stopping, distance / now.step});
    Course course = towards(now, u + closing * ahead, most);
    if (closing == 0 || now.stops) return course;
    // What is after it counts too: it stops there, or behind it.
    const double arrives = std::max(course.turning, distance / closing);
    if (!destination.stay)
      brake_from(now, arrives, course);
    else if (u.isZero(0))
      brake_from(now, arrives - 0.5 * closing / most, course);
    return course;
  }
  const double radius = now.speed * now.speed / most;
  // Where a point that moves will be met, by who flies straight there; where it is now, of one too fast.
  const double a = now.speed * now.speed - u.squaredNorm(), half = to_point.dot(u),
               root = half * half + a * distance * distance;
  const double meets = a > 0 ? (half + std::sqrt(root)) / a : 0;
  const Vector3d there = to_point + meets * u, aside = side_of(now.ahead, there, now.planar);
  // From the circle's centre the point is at R(angle) (length, -radius).
  const double x = there.dot(now.ahead), y = there.dot(aside) - radius;
  const double square = x * x + y * y - radius * radius;
  if (square < 0) return std::nullopt;
  const double length = std::sqrt(square);
  double angle = std::atan2(y, x) + std::atan2(radius, length);
  if (angle < -1e-9) angle += 2 * kPi;
  angle = std::max(angle, 0.0);
  Course course;
  course.aside = aside;
  course.asked = course.most = most;
  course.velocity = now.speed * (std::cos(angle) * now.ahead + std::sin(angle) * aside);
  course.until = (radius * angle + length) / now.speed;
  if (!(angle > kAligned)) return course;
  course.angle = angle;
  course.radius = radius;
  course.turning = radius * angle / now.speed;
  return course;
}

/// Moves a safe course towards the one that is wanted, as far as it stays safe: the velocities tried are some
/// way apart.
void Navigator::closer(const Moment& now, const Vector3d& wanted, double most, Course& course,
                       Foreseen& foreseen) {
  const Vector3d found = course.velocity;
  const Vector3d aside = side_of(wanted.normalized(), found.normalized(), now.planar);
  const double angle = angle_between(wanted, found);
  const Foreseen all{now.surely - kAlmost, kFar};
  double low = 0, high = 1;
  for (int i = 0; i < 5; ++i) {
    const double part = 0.5 * (low + high);
    const Vector3d velocity =
        options_.longitudinal
            ? Vector3d(wanted + part * (found - wanted))
            : Vector3d(std::cos(part * angle) * wanted.normalized() + std::sin(part * angle) * aside);
    const Course tried = towards(now, velocity, most);
    const Foreseen seen = foresee(now, tried, all);
    if (!seen.better_than(all)) {
      low = part;
      continue;
    }
    high = part;
    course = tried;
    foreseen = seen;
  }
}

/// Where none is safe the best of those tried may be some way from the best there is: steps to all sides,
/// halved where none is better.
bool Navigator::refine(const Moment& now, Course& course, Foreseen& foreseen) {
  const double most = course.asked;
  double width = 0.1;
  bool found = false;
  for (int i = 0; i < 16 && width > 4e-3 && !spent(); ++i) {
    const AxisFrame frame(course.velocity.isZero(0) ? Vector3d(Vector3d::UnitX()) : course.velocity);
    bool better = false;
    for (int k = 0; k < 6 && !better; ++k) {
      const double sign = k % 2 == 0 ? 1 : -1;
      Vector3d step = k < 2 ? frame.e1 : k < 4 ? frame.e2 : frame.axis;
      if (k >= 4 && !options_.longitudinal) break;
      if (now.planar) {
        if (k < 2) step = Vector3d::UnitZ().cross(frame.axis);
        if (k == 2 || k == 3) continue;
      }
      const Course tried = towards(now, course.velocity + sign * width * now.pace * step, most);
      const Foreseen seen = foresee(now, tried, foreseen);
      if (!(better = seen.better_than(foreseen))) continue;
      course = tried;
      foreseen = seen;
      found = true;
    }
    if (found && foreseen.keeps(now.surely)) break;
    if (!better) width *= 0.5;
  }
  return found;
}

/// The velocities that are tried, those nearer to the one that is wanted before others.
void Navigator::spread(const Moment& now, const Vector3d& wanted, double less_than, int finer) {
  candidates_.clear();
  const auto add = [&](const Vector3d& velocity) {
    const double from_wanted = beside(now, wanted, velocity);
    if (from_wanted < less_than)
      candidates_.push_back({from_wanted + 0.25 * beside(now, now.velocity, velocity), velocity});
  };
  const Vector3d axis = !wanted.isZero(0) ? wanted
                        : now.speed > 0   ? now.velocity
                                          : Vector3d(Vector3d::UnitX());
  const auto around = [&](double pace, int in_plane, int rings, int in_ring) {
    if (now.planar) {
      for (int k = 0; k < in_plane; ++k)
        add(pace * (Eigen::AngleAxisd(2 * kPi * k / in_plane, Vector3d::UnitZ()) * axis.normalized()));
      return;
    }
    const AxisFrame frame(axis);
    add(pace * frame.axis);
    add(-pace * frame.axis);
    for (int ring = 1; ring < rings; ++ring)
      for (int k = 0; k < in_ring; ++k) {
        const double tilt = kPi * ring / rings, at = 2 * kPi * (k + 0.5 * (ring % 2)) / in_ring;
        add(pace * (std::cos(tilt) * frame.axis + std::sin(tilt) * frame.across(at)));
      }
  };
  add(now.velocity);
  add(wanted);
  if (options_.longitudinal) {
    add(Vector3d::Zero());
    for (const double part : {0.25, 0.5, 1.0}) around(part * now.pace, finer * 36, finer * 12, finer * 12);
  } else {
    around(now.speed, finer * 72, finer * 24, finer * 16);
  }
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& x, const Candidate& y) { return x.cost < y.cost; });
}

/// The first safe course, less than `less_than` beside the wanted one; else, where `any` will do, the best
/// that is better than the one given. False: there is none, or there was no time to find it: the next search
/// goes on from there.
bool Navigator::search(const Moment& now, const Vector3d& wanted, double less_than, bool any, Course& course,
                       Foreseen& foreseen) {
  spread(now, wanted, less_than, 1);
  if (!any) foreseen = {now.surely - kAlmost, kFar};
  bool found = false;
  double most = now.most;
  while (true) {
    const std::size_t count = candidates_.size(), first = count > 0 ? resume_ % count : 0;
    resume_ = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Candidate& candidate = candidates_[(first + i) % count];
      if (spent()) {
        resume_ = first + i;
        return found;
      }
      const Course tried = towards(now, candidate.velocity, most);
      const Foreseen seen = foresee(now, tried, foreseen);
      if (!seen.better_than(foreseen) || (!any && !seen.keeps(now.surely))) continue;
      course = tried;
      foreseen = seen;
      found = true;
      if (seen.keeps(now.surely)) {
        closer(now, wanted, most, course, foreseen);
        return true;
      }
    }
    if (!any || std::isfinite(options_.most) || most >= kHurriedTurn * now.pace) break;
    most *= 4;
  }
  if (any && refine(now, course, foreseen)) found = true;
  // Before it says that all hit: between those tried too. In a map, which is not judged to its end, and of
  // what is to come, that is not worth what it costs.
  if (!any || !foreseen.hits() || now.since > 0 ||
      std::any_of(bodies_.begin(), bodies_.end(), [](const Body& b) { return b.itself.has_value(); }))
    return found;
  spread(now, wanted, less_than, 2);
  for (const Candidate& candidate : candidates_) {
    const Course tried = towards(now, candidate.velocity, now.most);
    const Foreseen seen = foresee(now, tried, foreseen);
    if (!seen.better_than(foreseen)) continue;
    course = tried;
    foreseen = seen;
    found = true;
  }
  if (refine(now, course, foreseen)) found = true;
  return found;
}

/// The velocity that it would like best who is on a course to `held`.
Vector3d Navigator::wanted(const Way& way, const Moment& at, const Vector3d& held) const {
  if (!way.course) return held;
  return options_.longitudinal ? way.course->velocity : Vector3d(*way.point - at.position);
}

/// Where all courses hit: flies on in thought by the one that hits last, looks again on the way as it will,
/// and follows what it finds. False: nothing was found that is better.
bool Navigator::look_farther(const Moment& now, const Way& way, double time, Course& course,
                             Foreseen& foreseen) {
  tried_.clear();
  const long looks = looks_;
  Moment at = now;
  Course of_leg = towards(now, course.velocity, course.asked);
  Foreseen found = foreseen;
  double contact = found.hit;
  // What keeps next to nothing is soon lost again.
  for (int look = 0;
       look < kMostLooks && looks_ - looks < kMostAhead && !spent() && found.kept < 0.02 * now.reach;
       ++look) {
    at = later(at, of_leg, look_again(now, contact - at.since));
    if (!(at.since < contact)) break;
    of_leg = towards(at, of_leg.velocity, of_leg.asked);
    Course better = of_leg;
    if (!search(at, wanted(way, at, of_leg.velocity), kFar, true, better, found)) continue;
    of_leg = better;
    tried_.push_back({time + at.since, better.velocity, better.asked});
    if (found.hits()) contact = found.hit;
  }
  if (tried_.empty()) return false;
  course = towards(now, course.velocity, course.asked);
  found = foresee_all(now, course, tried_, time);
  if (!found.better_than(foreseen)) return false;
  foreseen = found;
  std::swap(legs_, tried_);
  return true;
}

/// Seconds from one look to the next before a contact in `left` seconds.
double Navigator::look_again(const Moment& now, double left) {
  return std::max(1.0, std::floor(kOfTimeLeft * left / now.step + 1e-6)) * now.step;
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
  require_not_negative(options.others_most, "others_most", " (m/s^2)");
  if (!(options.most > 0)) throw InputError("most", to_text(options.most), "positive (m/s^2)");
  if (!(options.fastest > 0)) throw InputError("fastest", to_text(options.fastest), "positive (m/s)");
  if (!(options.range > 0)) throw InputError("range", to_text(options.range), "positive (m)");
}

NavigatorStep Navigator::step(const BodyState& agent, std::span<const BodyState> others,
                              const std::optional<Destination>& destination, double time, double step) {
  if (!(step > 0 && step < kFar)) throw InputError("step", to_text(step), "positive and finite (s)");
  if (!std::isfinite(time)) throw InputError("time", to_text(time), "a finite number (s)");
  if (destination) {
    require_finite(destination->point, "destination.point", " (m)");
    require_not_negative(destination->most, "destination.most", " (m/s^2)");
    require_finite(destination->velocity, "destination.velocity", " (m/s)");
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
  Moment now;
  now.position = agent.position;
  now.velocity = agent.velocity;
  now.speed = agent.velocity.norm();
  now.step = step;
  now.ahead = now.speed > 0 ? Vector3d(agent.velocity / now.speed) : Vector3d(Vector3d::Zero());
  now.planar = agent.planar();
  now.body = slightly_larger(seen(agent));
  now.reach = reach_of(now.body, now.position, now.planar);
  const Vector3d axes = now.body.semi_axes();
  now.uneven = (now.planar ? axes(1) : axes(0)) - axes(2);
  now.carried = agent.turning == Turning::with_heading && now.speed > kAtRest && now.uneven > 1e-12 * axes(2);
  if (!pace_) pace_ = now.speed;
  now.cruise = options_.fastest < kFar ? options_.fastest : *pace_;
  now.pace = std::max(now.speed, now.cruise);
  if (options_.longitudinal) {
    for (const BodyState& other : others) now.pace = std::max(now.pace, other.velocity.norm());
    if (destination && !(now.cruise > 0))
      now.pace = std::max(now.pace, soon(now, std::min(destination->most, options_.most)));
    if (!(now.pace > 0)) now.pace = now.reach;  // nothing moves: any speed will do
    now.pace = std::min(now.pace, options_.fastest);
  }
  now.most = std::isfinite(options_.most) ? options_.most : kUnhurriedTurn * now.pace;
  now.to_turn = kLookAgain + (options_.longitudinal ? 1 : kPi) * now.speed / now.most;
  now.stops = options_.longitudinal && std::isfinite(options_.range);
  required_ = options_.required.value_or(now.reach / 20);
  beyond_ = options_.beyond.value_or(now.reach / 10);
  bodies_.clear();
  for (const BodyState& other : others) {
    Body& body = bodies_.emplace_back(body_of(other, now.planar));
    if (body.swerves > 0 || body.holds(now.position, now.reach)) {
      now.stops |= options_.longitudinal;
      if (!now.stops) body.matters = now.to_turn;
    }
    const double apart = (body.body.center() - now.position).norm() - body.reach - now.reach;
    if (apart < required_ + beyond_)
      body.now = body.near({now.body, Vector3d::Zero()}, {.reach = now.reach}).distance;
  }
  clear_ = clear_ || std::all_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
             return body.now >= required_ + beyond_ || !body.stays();
           });
  now.clear = clear_;
  now.surely = required_ + beyond_;
  // Who is between both moves on by courses that keep what is required.
  if (now.stops && clear_)
    for (const Body& body : bodies_)
      if (body.now < now.surely && body.stays()) now.surely = required_;
  failed_by_ = 0;
  looks_ = 0;
  limit_ = options_.looks > 0 ? long(options_.looks) : now.stops && clear_ ? kLooksWithAStop : 0;
  if (destination && now.stops) return fly(now, on_the_way(now, *destination, time), time);
  return fly(now, destination, time);
}

/// The way to the destination, or of who may change its speed back to that of the start, that is safe; else
/// what is flown now; else what a search finds.
Navigator::Choice Navigator::choose(const Moment& now, const std::optional<Destination>& destination,
                                    double time) {
  const double surely = now.surely;
  Choice chosen;
  bool decided = false;
  std::optional<Course> direct;
  for (double part = 1; part > 0.2 && !decided; part *= 0.5) {
    std::optional<Course> tried;
    if (destination) tried = to_destination(now, *destination, part);
    if (!tried && options_.longitudinal)
      tried = towards(now, part * *pace_ * held_.value_or(now.ahead).normalized(), now.most);
    if (!tried) break;
    const Foreseen seen = foresee(now, *tried, direct ? chosen.foreseen : Foreseen::nothing());
    if (!direct || seen.better_than(chosen.foreseen)) {
      chosen = {*tried, seen};
      chosen.way = decided = seen.keeps(held_is_way_ ? required_ : surely);
    }
    if (!direct) direct = tried;
    if (!now.stops) break;  // slower is no safer
  }
  const bool aims = direct.has_value();
  const Way to{direct ? &*direct : nullptr, destination ? &destination->point : nullptr};
  const Vector3d wanted = this->wanted(to, now, held_.value_or(now.velocity));
  if (decided) return chosen;
  const bool had = held_.has_value() && !held_is_way_;
  const Course before = towards(now, had ? *held_ : now.velocity, had ? turn_ : now.most);
  const Foreseen of_before = foresee_all(now, before, legs_, time);
  decided = of_before.keeps(had ? required_ : surely);
  // Who keeps something gives it up for what is worth it only.
  const auto worth = [&](Foreseen in_hand) {
    if (in_hand.kept > 0) in_hand.kept += 0.01 * surely;
    return in_hand;
  };
  chosen.way = direct && !decided &&
               (held_is_way_ ? !of_before.better_than(worth(chosen.foreseen))
                             : chosen.foreseen.better_than(worth(of_before)));
  if (!chosen.way) chosen = {before, of_before};
  chosen.aims = aims;
  bool stopping = false;
  if (now.stops && !chosen.foreseen.keeps(required_)) {
    // What was judged safe before is not given up for what looks a little better now: by errors of sensors
    // alone something always does.
    const Course stop = in_hand(now, time);
    const Foreseen of_stop = foresee(now, stop, Foreseen::nothing());
    if ((stopping = !of_stop.hits() || of_stop.better_than(chosen.foreseen)))
      chosen = {stop, of_stop, false, aims};
  }
  const bool due = time > next_look_ - 0.5 * now.step || (stopping && !stopping_),
             worse = chosen.foreseen.kept < 0.95 * kept_ || time + chosen.foreseen.hit < hit_ - now.step;
  // Who touches already hits on every course.
  if (!(chosen.foreseen.hit > 0) || !(decided ? direct && due : due || worse)) {
    chosen.stopping = stopping;
    return chosen;
  }
  Choice better = chosen;
  better.foreseen = decided ? chosen.foreseen : worth(chosen.foreseen);
  const double bound = decided ? beside(now, wanted, chosen.course.velocity) - kWorthChanging : kFar;
  // Who can stop need not take what is not safe.
  const bool any = !decided && (now.stops ? chosen.foreseen.hits() : !options_.longitudinal);
  if (search(now, wanted, bound, any, better.course, better.foreseen)) {
    chosen = {better.course, better.foreseen, false, aims};
    stopping = false;
    legs_.clear();
  }
  if (any && !now.stops && chosen.foreseen.hits() && worse)
    if (look_farther(now, to, time, chosen.course, chosen.foreseen)) chosen.way = false;
  chosen.looked = !spent();
  chosen.stopping = stopping;
  return chosen;
}

/// Where a wall is before it, what it goes to on its way round.
Destination Navigator::on_the_way(const Moment& now, const Destination& destination, double time) {
  if (!route_)
    route_ = std::make_shared<courses::Route>();
  else if (route_.use_count() > 1)
    route_ = std::make_shared<courses::Route>(*route_);
  const double keep = required_ + beyond_;
  const Ellipsoid ball = Ellipsoid::from_axes(now.position, Vector3d::Constant(now.reach));
  const auto clear = [&](const Vector3d& from, const Vector3d& to, double more) {
    return std::none_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
      if (!body.stays()) return false;
      const Sweep sweep{ball.translated(from - now.position), to - from};
      const double enough = std::min(keep, 0.8 * body.now) + more;  // who is nearer may be so for a while
      return body.near(sweep, {enough, enough - kAlmost, Meeting::whether, now.reach}).distance < enough;
    });
  };
  const Vector3d point =
      route_->towards(destination.point, now.position, now.reach + keep, now.planar, time, clear);
  if (point == destination.point) return destination;
  return {.point = point, .most = destination.most, .stay = true};
}

/// The rest of what was taken before, with the stop at its end; without one, a stop at once.
Navigator::Course Navigator::in_hand(const Moment& now, double time) const {
  const double left = brakes_ - time;
  if (!held_ || !(left > 0.5 * now.step && left < kFar)) return towards(now, Vector3d::Zero(), now.most);
  Course course = towards(now, *held_, turn_);
  brake_from(now, left, course);
  return course;
}

NavigatorStep Navigator::fly(const Moment& now, const std::optional<Destination>& destination, double time) {
  NavigatorStep result;
  if (!(now.speed > 0) && !options_.longitudinal) {
    const Course course;
    tell(now, course, time, result);
    prove(now, course, time, result);
    fly_on(now, course, time);
    const Foreseen stays = foresee(now, course, Foreseen::nothing());
    result.status = stays.hits() ? NavigatorStatus::cannot_avoid : NavigatorStatus::no_course;
    return result;
  }
  while (!legs_.empty() && legs_.front().begin < time + 0.5 * now.step) {
    held_ = legs_.front().velocity;
    turn_ = legs_.front().most;
    legs_.erase(legs_.begin());
  }
  Choice chosen = choose(now, destination, time);
  if (options_.longitudinal && !now.stops && !chosen.foreseen.keeps(required_)) {
    Moment careful = now;
    careful.stops = true;
    const Choice stops = choose(careful, destination, time);
    if (stops.foreseen.better_than(chosen.foreseen)) chosen = stops;
  }
  if (chosen.way) legs_.clear();
  prove(now, chosen.course, time, result);
  if (!result.proved && now.stops && !chosen.stopping) {
    // What is proved is not given up for what is not.
    const Course stop = in_hand(now, time);
    std::swap(legs_, tried_);
    legs_.clear();
    prove(now, stop, time, result);
    if (result.proved)
      chosen = {stop, foresee(now, stop, Foreseen::nothing()), false, chosen.aims, false, true};
    else
      std::swap(legs_, tried_);
  }
  const auto& [course, foreseen, way, aims, looked, stopping] = chosen;
  fly_on(now, course, time);
  if (looked) next_look_ = time + (foreseen.hits() ? look_again(now, foreseen.hit) : kLookAgain);
  kept_ = foreseen.kept;
  hit_ = time + foreseen.hit;
  held_ = course.velocity;
  held_is_way_ = way;
  turn_ = course.asked;
  brakes_ = time + course.brakes;
  stopping_ = stopping;
  result.rest = course.rests();
  if (options_.longitudinal) {
    const double missing = (course.velocity - now.velocity).norm() / now.step;
    result.acceleration = std::min(course.most, missing) * course.aside;
    result.aligned = way && destination && missing <= course.most * (1 + 1e-9);
  } else {
    const double missing = course.angle * now.speed / now.step;
    if (course.angle > kAligned) result.acceleration = std::min(course.most, missing) * course.aside;
    result.aligned = way && missing <= course.most * (1 + 1e-9);
  }
  tell(now, course, time, result);
  using enum NavigatorStatus;
  if (foreseen.hits()) {
    result.status = cannot_avoid;
  } else if (!foreseen.keeps(required_) || !result.proved) {
    result.status = too_near;
  } else {
    const bool straight_on = way || (result.acceleration.isZero(0) && !aims);
    result.status = way && destination ? homing : straight_on ? straight : avoiding;
  }
  return result;
}

}  // namespace vericone::guidance
