// SPDX-License-Identifier: BSD-3-Clause
//
// What is proved of the course that is flown: on pieces of it, which cover it, a plane between the agent and
// a body, with all that rounding may take.
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "foresight.h"

namespace vericone::guidance {

using Eigen::Vector3d;

namespace {

constexpr double kBeside = 2e-3;       // of a distance: what is beside a chord may take so much of it
constexpr double kAsGoodAsEver = 1e6;  // s: for who hardly moves as seen from another

}  // namespace

/// The command of a step is held for all of it. So what is left to change in less than a step is changed in
/// one, and what is too little to be commanded is not changed.
Navigator::Course Navigator::as_flown(const Moment& now, Course course) const {
  if (options_.longitudinal) {
    const double change = (course.velocity - now.velocity).norm();
    if (course.turning > 0 || change == 0) return course;
    course.most = std::min(course.most, change / now.step);
    course.velocity = now.velocity + now.step * course.most * course.aside;
    course.turning = now.step;
    course.brakes = std::max(course.brakes, now.step);
  } else if (!(course.angle > kAligned)) {
    course.velocity = now.velocity;
    course.turning = course.angle = course.radius = 0;
    if (course.circles < kFar)  // across that velocity
      course.inward = (course.inward - course.inward.dot(now.ahead) * now.ahead).normalized();
  } else if (course.turning < now.step) {
    course.turning = now.step;
    course.most = course.angle * now.speed / now.step;
    course.radius = now.speed * now.step / course.angle;
    course.circles = std::max(course.circles, now.step);
  }
  return course;
}

/// Metres surely kept from the other on a piece, at most `enough`.
double Navigator::surely(const Body& other, const Sweep& sweep, double reach, double enough) const {
  const double more = 2 * other.offset;  // where it turns, its middle may go about what it turns about
  const Vector3d c = other.body.center() - sweep.agent.center();
  const double square = sweep.along.squaredNorm();
  const double part = square > 0 ? std::clamp(c.dot(sweep.along) / square, 0.0, 1.0) : 0;
  const double rounded = 0x1p-45 * (c.norm() + sweep.along.norm());
  const double balls = (c - part * sweep.along).norm() - (other.reach + reach) * kAbove - sweep.widest();
  if (balls - rounded - more >= enough) return enough;
  Vector3d normal = other.normal;
  const double kept = other.itself ? courses::surely_apart(sweep, *other.itself, enough + more)
                                   : courses::surely_apart(sweep, other.body, enough + more, normal);
  return std::min(enough, kept - more);
}

/// What rounding may take of places at `t` of a course, metres.
double Navigator::Flight::rounding(const Body& other, double t) const {
  const double speeds =
      now.speed + course.velocity.norm() + other.velocity.norm() + course.most * course.turning;
  return 0x1p-44 * (now.position.norm() + now.reach + other.body.center().norm() + (now.since + t) * speeds);
}

/// On the manoeuvre or the braking.
double Navigator::surely_curved(const Flight& flight, const Body& other, double begin, double end,
                                double enough) const {
  const Moment& now = flight.now;
  const Chord chord(flight, other, begin, end);
  // Turned by an angle it is nowhere wider by more than that of `uneven`, and never by more than that. Its
  // middle, if that is beside what turns, goes on an arc; unevenly where it is no circle that it flies on.
  const double turned = std::min(chord.turned, 1.0), offset = (now.body.center() - now.position).norm();
  const double off_arc = flight.course.radius > 0 ? 0.5 * chord.turned * chord.turned : 2 * chord.turned;
  const double beside =
      (chord.bent + turned * now.uneven + off_arc * offset) * kAbove + flight.rounding(other, end);
  const double found = surely(other, chord.sweep, now.reach, enough + beside);
  if (found - beside >= enough) return enough;
  if (beside <= kBeside * found || end - begin < 1e-3 * now.step) return found - beside;
  const double middle = 0.5 * (begin + end);
  const double first = surely_curved(flight, other, begin, middle, enough);
  return first < 0 ? first : surely_curved(flight, other, middle, end, first);
}

/// From `begin` to `end` at a velocity that it keeps; without end until they are past each other, and from
/// then on by the balls about both.
double Navigator::surely_straight(const Flight& flight, const Body& other, double begin, double end,
                                  double enough) const {
  const Moment& now = flight.now;
  const bool rests = begin >= flight.course.rests();
  const Vector3d u = other.velocity, w = rests ? Vector3d(-u) : Vector3d(flight.velocity(begin) - u);
  const Vector3d start = flight.center(begin), there = (now.since + begin) * u;
  const Ellipsoid agent = flight.body(begin);
  const double speed = w.norm(), reach = (other.reach + now.reach) * kAbove;
  Sweep sweep{agent.translated(start - there - agent.center()), Vector3d::Zero()};
  double until = end;
  if (end == kFar) {
    const Vector3d c = other.body.center() + there - start;
    until = begin;
    if (speed > 0) {
      until += (std::max(0.0, c.dot(w)) / speed + reach + enough + 4 * other.offset) / speed * kAbove;
      const Vector3d then = c - (until - begin) * w;
      const double rounded = flight.rounding(other, until) + 0x1p-44 * (c.norm() + then.norm());
      enough = std::min(enough, then.norm() - reach - 2 * other.offset - rounded);
      if (!(then.dot(w) < 0)) return -kFar;
      if (enough < 0) return enough;
    }
  } else if (other.swerves > 0) {
    sweep.wider_from = flight.swerved(other, begin);
    sweep.wider_to = flight.swerved(other, end);
  }
  sweep.along = (until - begin) * w;
  const double rounded = flight.rounding(other, until);
  return surely(other, sweep, now.reach, enough + rounded) - rounded;
}

/// On the circle that it ends on, for ever.
double Navigator::surely_round(const Flight& flight, const Body& other, double enough) const {
  const double begin = flight.course.circles, until = round_until(flight, other, enough);
  if (until == kFar) return -kFar;
  const double quarter = 0.5 * std::numbers::pi / flight.turns();
  double kept = enough;
  for (double from = begin; from < until && kept >= 0; from += quarter)
    kept = surely_curved(flight, other, from, std::min(until, from + quarter), kept);
  return kept;
}

/// On the whole course, as far as it counts.
double Navigator::surely_all(const Flight& flight, const Body& other, double end, double enough) const {
  const Course& course = flight.course;
  double kept = enough;
  using Look = double (Navigator::*)(const Flight&, const Body&, double, double, double) const;
  const auto part = [&](double from, double to, Look look) {
    to = std::min(to, end);
    if (kept >= 0 && from <= to) kept = (this->*look)(flight, other, from, to, kept);
  };
  if (course.circles < kFar) {
    part(course.turning, course.circles, &Navigator::surely_straight);
    if (kept >= 0 && course.circles <= end) kept = surely_round(flight, other, kept);
  } else if (course.brakes == kFar) {
    part(course.turning, kFar, &Navigator::surely_straight);
  } else {
    if (other.swerves == 0) part(course.rests(), kFar, &Navigator::surely_straight);
    if (other.stays()) {
      // One way, however it brakes.
      const double to = std::min(course.rests(), end);
      const Vector3d from = flight.center(course.turning);
      const Ellipsoid agent = flight.body(course.turning);
      const double rounded = flight.rounding(other, to);
      if (kept >= 0 && course.turning <= to)
        kept = surely(other, {agent.translated(from - agent.center()), flight.center(to) - from},
                      flight.now.reach, kept + rounded) -
               rounded;
    } else {
      if (course.braking > 0) part(course.brakes, course.rests(), &Navigator::surely_curved);
      part(course.turning, course.brakes, &Navigator::surely_straight);
    }
  }
  if (course.turning > 0) part(0, course.turning, &Navigator::surely_curved);
  return kept;
}

/// Of the course and those that follow it, into `step`.
void Navigator::prove(const Moment& now, Course course, double time, NavigatorStep& step) const {
  step.proved.reset();
  step.until = kFar;
  step.inside = !corridor_;
  double kept = required_;
  Moment at = now;
  for (std::size_t leg = 0;; ++leg) {
    const bool last = leg == legs_.size();
    if (!last) course.until = legs_[leg].begin - time - at.since;
    course = as_flown(at, course);
    const Flight flight(at, course);
    const Outline outline(flight);
    for (const Body& other : bodies_) {
      const double matters = at.circles ? kFar : std::max(0.0, other.matters - at.since);
      double end = std::min(course.until, matters);
      if (other.swerves > 0) end = std::min(end, course.rests());
      // Of two that go on together the least difference counts some time.
      const Vector3d w = course.velocity - other.velocity;
      if (course.brakes == kFar && course.circles == kFar && !w.isZero(0) &&
          w.norm() < 1e-9 * (course.velocity.norm() + other.velocity.norm()))
        end = std::min(end, kAsGoodAsEver);
      if (!outline.is_far(flight, other, kept)) kept = surely_all(flight, other, end, kept);
      if (!(kept >= 0)) return;
      if (last) step.until = std::min(step.until, at.since + end);
    }
    if (last) step.inside = !corridor_ || (leg == 0 && out_of_corridor(flight) <= 0);
    if (last) break;
    at = later(at, course, course.until);
    course = towards(at, legs_[leg].velocity, legs_[leg].most);
  }
  step.proved = kept;
}

void Navigator::fly_on(const Moment& now, const Course& course, double time) {
  flown_ = as_flown(now, course);
  from_ = now.position;
  at_ = now.velocity;
  time_ = time;
  step_ = now.step;
}

PlannedMotion Navigator::planned(double seconds) const {
  if (!(seconds >= 0 && seconds < kFar))
    throw InputError("seconds", to_text(seconds), "a finite number, 0 or more (s)");
  Moment at;
  at.position = from_;
  at.velocity = at_;
  at.speed = at_.norm();
  at.ahead = at.speed > 0 ? Vector3d(at_ / at.speed) : Vector3d(Vector3d::Zero());
  at.step = step_;
  at.carried = false;
  at.body = Ellipsoid::from_axes(from_, Vector3d::Ones());
  Course course = flown_;
  for (const Leg& leg : legs_) {
    const double begins = leg.begin - time_ - at.since;
    if (seconds - at.since < begins) break;
    at = later(at, course, begins);
    course = as_flown(at, towards(at, leg.velocity, leg.most));
  }
  const Flight flight(at, course);
  const double t = seconds - at.since;
  return {at.position + flight.moved(t), flight.velocity(t)};
}

}  // namespace vericone::guidance
