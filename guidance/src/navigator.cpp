// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/navigator.h>

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "check_numbers.h"
#include "foresight.h"
#include "route.h"

namespace vericone::guidance {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLookAgain = 0.5;      // s
constexpr double kWorthChanging = 0.1;  // rad nearer to what is wanted
constexpr double kUnhurriedTurn = 2;    // rad/s, where no acceleration is too much
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

/// Its largest semi-axis, a little too much: of every body at every step, so without its other axes. No
/// eigenvalue of F^T F is more than a diagonal entry and what stands beside it (Gershgorin), and next to
/// nothing does where F was made of axes.
double longest_axis(const Ellipsoid& body) {
  const Matrix3d square = body.factor().transpose() * body.factor();
  const double largest = square.diagonal().maxCoeff(),
               beside = std::abs(square(0, 1)) + std::abs(square(0, 2)) + std::abs(square(1, 2));
  if (beside <= 1e-9 * largest) return std::sqrt(largest + beside) * (1 + 1e-6);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver =
      Eigen::SelfAdjointEigenSolver<Matrix3d>().computeDirect(body.shape(), Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues().maxCoeff()) * (1 + 1e-6);
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

Navigator::Body Navigator::body_of(const BodyState& other, bool planar, double swerves) const {
  // A hull too: the ellipsoid about a wall holds much of the room before it.
  const std::optional<Placed> hull =
      other.shape.hull() && rigid(other) ? std::optional(other.shape.as_placed()) : std::nullopt;
  const Placed* placed = hull ? &*hull : other.shape.placed();
  const bool as_it_is = placed && rigid(other) && !placed->body.quadric();
  Body body{as_it_is ? ball_about(*placed) : seen(other), other.velocity};
  body.reach =
      planar || !rigid(other) ? reach_of(body.body, body.body.center(), planar) : longest_axis(body.body);
  if (as_it_is) body.itself = *placed;
  if (!as_it_is || !other.velocity.isZero(0)) body.swerves = swerves;
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
  if (course.angle > kAligned) {
    in_steps(course.angle * now.speed);
    course.radius = now.speed * now.speed / course.most;
  }
  if (now.circles) circle_from(now, course.turning + now.step + now.before, course);
  return course;
}

/// The way that it has turned, or the other; who has not turned, level to the left, or the right.
void Navigator::circle_from(const Moment& now, double t, Course& course) {
  course.circles = t;
  const Vector3d ahead = course.velocity.normalized(), left(-ahead.y(), ahead.x(), 0);
  if (course.angle > kAligned)
    course.inward = std::cos(course.angle) * course.aside - std::sin(course.angle) * now.ahead;
  else
    course.inward = left.norm() > 1e-6 ? Vector3d(left.normalized()) : AxisFrame(ahead).e1;
  course.inward *= now.side;
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
  if (now.circles) return towards(now, course.velocity, most);
  course.until = (radius * angle + length) / now.speed;
  if (!(angle > kAligned)) return course;
  course.angle = angle;
  course.radius = radius;
  course.turning = radius * angle / now.speed;
  return course;
}

namespace {

void require_course(const BodyState& body) {
  require_finite(body.position, "position", " (m)");
  require_finite(body.velocity, "velocity", " (m/s)");
  constexpr double kMost = 1e150;  // squares of what is larger overflow
  for (const auto& [x, field] : {std::pair(body.position, "position"), {body.velocity, "velocity"}})
    if (const double most = x.lpNorm<Eigen::Infinity>(); most > kMost)
      throw InputError(field, to_text(most), "at most 1e150 (m, m/s)");
}

void require_corridor(const Destination& destination, bool longitudinal) {
  const Corridor& corridor = *destination.corridor;
  require_finite(corridor.from, "destination.corridor.from", " (m)");
  if (!(corridor.radius > 0 && corridor.radius < kFar))
    throw InputError("destination.corridor.radius", to_text(corridor.radius), "positive and finite (m)");
  if (!longitudinal)
    throw InputError("destination.corridor", "of an agent that keeps its speed",
                     "left out, or longitudinal: in a corridor courses end at rest");
  if (!destination.velocity.isZero(0))
    throw InputError("destination.corridor", "beside a velocity", "left out: the leg would turn");
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
                              const std::optional<Destination>& destination, double time, double step,
                              std::span<const double> others_most) {
  if (!(step > 0 && step < kFar)) throw InputError("step", to_text(step), "positive and finite (s)");
  if (!std::isfinite(time)) throw InputError("time", to_text(time), "a finite number (s)");
  if (destination) {
    require_finite(destination->point, "destination.point", " (m)");
    require_not_negative(destination->most, "destination.most", " (m/s^2)");
    require_finite(destination->velocity, "destination.velocity", " (m/s)");
    if (destination->corridor) require_corridor(*destination, options_.longitudinal);
  }
  if (!others_most.empty() && others_most.size() != others.size())
    throw InputError("others_most", std::to_string(others_most.size()) + " numbers",
                     "one of each of the " + std::to_string(others.size()) + " others");
  for (std::size_t i = 0; i < others_most.size(); ++i)
    require_not_negative(others_most[i], ("others_most[" + std::to_string(i) + "]").c_str(), " (m/s^2)");
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
  corridor_ = destination ? destination->corridor : std::nullopt;
  if (corridor_) leg_ = destination->point - corridor_->from;
  now.stops = options_.longitudinal && (std::isfinite(options_.range) || corridor_);
  now.slack = 1e-3 * now.reach;
  required_ = options_.required.value_or(now.reach / 20);
  beyond_ = options_.beyond.value_or(now.reach / 10);
  bodies_.clear();
  for (const BodyState& other : others) {
    const double swerves = others_most.empty() ? options_.others_most : others_most[bodies_.size()];
    Body& body = bodies_.emplace_back(body_of(other, now.planar, swerves));
    if (body.swerves > 0 || body.holds(now.position, now.reach)) {
      now.stops |= options_.longitudinal;
      if (!now.stops) body.matters = now.to_turn;
      now.circles = !now.stops && now.speed > 0;
    }
    const double apart = (body.body.center() - now.position).norm() - body.reach - now.reach;
    if (apart < required_ + beyond_)
      body.now = body.near({now.body, Vector3d::Zero()}, {.reach = now.reach}).distance;
  }
  clear_ = clear_ || std::all_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
             return body.now >= required_ + beyond_ || !body.stays();
           });
  now.clear = clear_;
  const auto swerves = [](const Body& body) { return body.swerves > 0; };
  if (!legs_.empty() || std::any_of(bodies_.begin(), bodies_.end(), swerves)) now.circles = false;
  now.surely = required_ + beyond_;
  // Who is between both moves on by courses that keep what is required.
  if ((now.stops || now.circles) && clear_)
    for (const Body& body : bodies_)
      if (body.now < now.surely && body.stays()) now.surely = required_;
  failed_by_ = 0;
  looks_ = 0;
  limit_ = options_.looks > 0                     ? long(options_.looks)
           : (now.stops && clear_) || now.circles ? kLooksWithAStop
                                                  : 0;
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
    std::optional<Course> tried = way(now, destination, part);
    if (!tried) break;
    const Foreseen floor = direct ? chosen.foreseen : Foreseen::nothing();
    Foreseen seen = foresee(now, *tried, floor);
    if (now.circles && !seen.keeps(surely)) {
      const Foreseen other = foresee_towards(now, tried->velocity, tried->asked, seen, *tried, true);
      if (other.better_than(seen)) seen = other;
    }
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
  Course before = towards(now, had ? *held_ : now.velocity, had ? turn_ : now.most);
  Foreseen of_before = foresee_all(now, before, legs_, time);
  if (now.circles && !of_before.keeps(surely)) {
    const Foreseen other = foresee_towards(now, before.velocity, before.asked, of_before, before, true);
    if (other.better_than(of_before)) of_before = other;
  }
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
  const bool in_hand = now.stops || now.circles;
  if (in_hand && !chosen.foreseen.keeps(required_)) {
    // What was judged safe before is not given up for what looks a little better now: by errors of sensors
    // alone something always does.
    const Course stop = this->in_hand(now, time);
    const Foreseen of_stop = foresee(as_held(now), stop, Foreseen::nothing());
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
  const bool any = !decided && (in_hand ? chosen.foreseen.hits() : !options_.longitudinal);
  if (search(now, wanted, bound, any, better.course, better.foreseen)) {
    chosen = {better.course, better.foreseen, false, aims};
    stopping = false;
    legs_.clear();
  }
  if (any && !in_hand && chosen.foreseen.hits() && worse)
    if (look_farther(now, to, time, chosen.course, chosen.foreseen)) chosen.way = false;
  chosen.looked = !spent();
  chosen.stopping = stopping;
  return chosen;
}

/// To the destination, or of who may change its speed back to that of the start.
std::optional<Navigator::Course> Navigator::way(const Moment& now,
                                                const std::optional<Destination>& destination,
                                                double part) const {
  std::optional<Course> course;
  if (destination) course = to_destination(now, *destination, part);
  if (!course && options_.longitudinal)
    course = towards(now, part * *pace_ * held_.value_or(now.ahead).normalized(), now.most);
  return course;
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
    if (corridor_ && out_of_corridor(to, now.reach + more + 2 * now.slack) > 0) return false;
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

/// The rest of what was taken before, with the stop or the circle at its end; without one, that at once.
Navigator::Course Navigator::in_hand(const Moment& now, double time) const {
  if (now.circles) {
    const double left = circles_ - time;
    const bool later = held_ && left > 0.5 * now.step && left < kFar;
    Moment straight = now;
    straight.circles = false;
    Course course =
        towards(straight, later ? *held_ : now.velocity, held_ && circles_ < kFar ? turn_ : now.most);
    if (!later) course.angle = course.turning = course.radius = 0;
    circle_from(now, later ? std::max(left, course.turning) : 0, course);
    if (held_ && circles_ < kFar) course.inward = about_.cross(course.velocity).normalized();
    return course;
  }
  const double left = brakes_ - time;
  if (!held_ || !(left > 0.5 * now.step && left < kFar)) return towards(now, Vector3d::Zero(), now.most);
  Course course = towards(now, *held_, turn_);
  brake_from(now, left, course);
  return course;
}

/// What is taken, with what is proved of it.
Navigator::Choice Navigator::decide(const Moment& now, const std::optional<Destination>& destination,
                                    double time, NavigatorStep& step) {
  Choice chosen = choose(now, destination, time);
  if (options_.longitudinal && !now.stops && !chosen.foreseen.keeps(required_)) {
    Moment careful = now;
    careful.stops = true;
    const Choice stops = choose(careful, destination, time);
    if (stops.foreseen.better_than(chosen.foreseen)) chosen = stops;
  }
  if (chosen.way) legs_.clear();
  prove(now, chosen.course, time, step);
  if (step.proved || !(now.stops || now.circles) || chosen.stopping) return chosen;
  // What is proved is not given up for what is not.
  const Course stop = in_hand(now, time);
  std::swap(legs_, tried_);
  legs_.clear();
  prove(now, stop, time, step);
  if (step.proved)
    chosen = {stop, foresee(as_held(now), stop, Foreseen::nothing()), false, chosen.aims, false, true};
  else
    std::swap(legs_, tried_);
  return chosen;
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
  Moment as = now;
  Choice chosen = decide(as, destination, time, result);
  if (as.circles && !result.proved) {
    as.circles = false;  // there is no room for a circle
    looks_ = 0;
    chosen = decide(as, destination, time, result);
  }
  if (corridor_ && chosen.foreseen.kept < 0) {  // no course stays in it
    corridor_.reset();
    looks_ = 0;
    chosen = decide(as, destination, time, result);
    result.inside = false;
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
  circles_ = time + course.circles;
  about_ = course.velocity.cross(course.inward).normalized();
  stopping_ = stopping;
  result.rest = course.rests();
  result.circles = course.circles;
  if (options_.longitudinal) {
    const double missing = (course.velocity - now.velocity).norm() / now.step;
    result.acceleration = std::min(course.most, missing) * course.aside;
    result.aligned = way && destination && missing <= course.most * (1 + 1e-9);
  } else {
    const double missing = course.angle * now.speed / now.step;
    if (course.angle > kAligned)
      result.acceleration = std::min(course.most, missing) * course.aside;
    else if (course.circles < 0.5 * now.step)
      result.acceleration = course.asked * course.inward;
    result.aligned = way && missing <= course.most * (1 + 1e-9);
  }
  tell(as, course, time, result);
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
