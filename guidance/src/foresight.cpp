// SPDX-License-Identifier: BSD-3-Clause
//
// How near courses come to bodies.
#include "foresight.h"

#include <Eigen/Geometry>
#include <cmath>

namespace vericone::guidance {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d Navigator::Flight::velocity(double t) const {
  if (course.radius > 0) {
    const double turned = course.angle * t / course.turning;
    return now.speed * (std::cos(turned) * now.ahead + std::sin(turned) * course.aside);
  }
  return now.velocity + t * course.most * course.aside;
}

Matrix3d Navigator::Flight::rotation(double t) const {
  if (!now.carried || course.turning == 0) return Matrix3d::Identity();
  if (course.radius > 0) return Eigen::AngleAxisd(course.angle * t / course.turning, axis).toRotationMatrix();
  const Vector3d v = velocity(t);
  if (!(v.norm() > 1e-9 * now.speed)) return Matrix3d::Identity();
  return Eigen::Quaterniond::FromTwoVectors(now.ahead, v).toRotationMatrix();
}

Vector3d Navigator::Flight::moved(double t) const {
  if (!(course.radius > 0)) return t * (now.velocity + 0.5 * t * course.most * course.aside);
  const double turned = course.angle * t / course.turning;
  return course.radius * (std::sin(turned) * now.ahead + (1 - std::cos(turned)) * course.aside);
}

Vector3d Navigator::Flight::center(double t) const {
  return now.position + rotation(t) * (now.body.center() - now.position) + moved(t);
}

Ellipsoid Navigator::Flight::body(double t) const {
  if (!now.carried || course.turning == 0) return now.body.translated(center(t) - now.body.center());
  const Matrix3d factor = rotation(t) * now.body.factor();
  return Ellipsoid::trusted(center(t), factor * factor.transpose(), factor, true);
}

bool Navigator::Body::holds(const Vector3d& point, double margin) const {
  if (!itself) return false;
  Box bounds = itself->body.assembly() ? itself->body.assembly()->bounds() : itself->body.bounds();
  bounds.low.array() -= margin;
  bounds.high.array() += margin;
  return bounds.contains(itself->pose.to_body(point));
}

Near Navigator::Body::near(const Sweep& sweep, Wanted wanted) const {
  // The balls first.
  const Vector3d c = body.center() - sweep.agent.center();
  const double square = sweep.along.squaredNorm();
  const double part = square > 0 ? std::clamp(c.dot(sweep.along) / square, 0.0, 1.0) : 0;
  const double balls = (c - part * sweep.along).norm() - reach - wanted.reach;
  if (balls >= wanted.enough) return {balls};
  wanted.normal = &normal;
  return itself ? courses::near(sweep, *itself, wanted) : courses::near(sweep, body, wanted);
}

/// A part of the manoeuvre: its chord, and how far from the chord the body may be, which turns meanwhile.
struct Navigator::Chord {
  Sweep sweep;
  double beside;  // m
  bool fine;      // no shorter one is looked at

  Chord(const Flight& flight, const Body& other, double begin, double end) {
    const Moment& now = flight.now;
    const double middle = 0.5 * (begin + end), span = end - begin;
    beside = flight.course.most * span * span / 8;
    if (now.carried) {
      const auto between = [&](double s, double t) {
        const Vector3d u = flight.velocity(s), v = flight.velocity(t);
        return std::atan2(u.cross(v).norm(), u.dot(v));
      };
      const double turned = std::max(between(begin, middle), between(middle, end));
      const double offset = (now.body.center() - now.position).norm();
      beside += std::min(2.0, turned) * now.uneven + 0.5 * offset * turned * turned;
    }
    fine = beside <= 5e-4 * now.reach || span <= 0.25 * now.step;
    const Vector3d from = flight.center(begin) - (now.since + begin) * other.velocity;
    sweep = {now.carried ? flight.body(middle) : now.body,
             flight.center(end) - (now.since + end) * other.velocity - from};
    sweep.agent = sweep.agent.translated(from - sweep.agent.center());
  }
  /// The part of it where the centres are nearest.
  [[nodiscard]] double nearest(const Body& other) const {
    const double square = sweep.along.squaredNorm();
    const Vector3d c = other.body.center() - sweep.agent.center();
    return square > 0 ? std::clamp(c.dot(sweep.along) / square, 0.0, 1.0) : 0;
  }
};

/// Whether, from `begin` to `end` of the manoeuvre, it comes as near as `hopeless`. Most courses that are
/// tried are left here.
bool Navigator::fails(const Flight& flight, const Body& other, double begin, double end,
                      double hopeless) const {
  ++looks_;
  const Chord chord(flight, other, begin, end);
  const double middle = 0.5 * (begin + end);
  if (chord.fine || chord.beside <= 0.25 * flight.now.reach) {
    const double enough = hopeless + chord.beside;
    const double found = other
                             .near(chord.sweep, {enough, std::max(0.0, hopeless - chord.beside),
                                                 Meeting::whether, flight.now.reach, chord.fine ? 1e-3 : 0.5})
                             .distance;
    if (found >= enough) return false;
    if (chord.fine) return found <= hopeless;
    if (found + chord.beside <= hopeless) return true;
    // As near as this it is mostly so at the nearest instant too, and nothing else need be looked at.
    if (found <= hopeless && fails_at(flight, other, begin + chord.nearest(other) * (end - begin), hopeless))
      return true;
  }
  return fails(flight, other, begin, middle, hopeless) || fails(flight, other, middle, end, hopeless);
}

/// At `t` of the manoeuvre.
bool Navigator::fails_at(const Flight& flight, const Body& other, double t, double hopeless) const {
  const Vector3d there = flight.center(t) - (flight.now.since + t) * other.velocity;
  const Ellipsoid body = flight.now.carried ? flight.body(t) : flight.now.body;
  return other
             .near({body.translated(there - body.center()), Vector3d::Zero()},
                   {hopeless + kAlmost, hopeless, Meeting::whether, flight.now.reach})
             .distance <= hopeless;
}

/// From `begin` to `end` of the manoeuvre: on the chord first, and where what is beside it may matter on its
/// halves, in the order of time.
void Navigator::see_turn(const Flight& flight, const Body& other, double begin, double end, Meeting meeting,
                         Approach& seen) const {
  ++looks_;
  const Chord chord(flight, other, begin, end);
  const double middle = 0.5 * (begin + end), beside = chord.beside;
  const double enough = seen.least + (chord.fine ? 0 : beside);
  const Near found = chord.fine ? other.near(chord.sweep, {enough, seen.hopeless, meeting, flight.now.reach})
                                : other.near(chord.sweep, {enough, std::max(0.0, seen.hopeless - beside),
                                                           Meeting::whether, flight.now.reach});
  if (found.distance >= enough) return;
  if (!chord.fine && beside > 0.01 * found.distance) {
    if (found.distance + beside <= seen.hopeless) {
      seen.least = found.distance + beside;
      return;
    }
    see_turn(flight, other, begin, middle, meeting, seen);
    if (!seen.done()) see_turn(flight, other, middle, end, meeting, seen);
    return;
  }
  seen.least = std::min(seen.least, found.distance);
  if (found.distance > 0) return;
  seen.hit = begin + found.part * (end - begin);
  seen.depth = found.depth;
}

/// From `begin`, after the manoeuvre, until `end`.
void Navigator::see_straight(const Flight& flight, const Body& other, double begin, double end,
                             Meeting meeting, Approach& seen) const {
  const Moment& now = flight.now;
  const double turning = flight.course.turning;
  const Vector3d w = flight.course.velocity - other.velocity;
  const double speed = w.norm(), reach = other.reach + now.reach;
  const Vector3d start = flight.center(turning) + (begin - turning) * flight.course.velocity;
  const Vector3d there = (now.since + begin) * other.velocity, c = other.body.center() + there - start;
  if (!(speed > 1e-9 * (now.speed + flight.course.velocity.norm() + other.velocity.norm()))) end = begin;
  // Once past it, and the reach of both, they move apart.
  end = std::min(end, begin + (std::max(0.0, c.dot(w)) / speed + reach) / speed);
  if (!(end > begin)) end = begin;
  const Vector3d along = (end - begin) * w;
  const double part = end > begin ? std::clamp(c.dot(along) / along.squaredNorm(), 0.0, 1.0) : 0;
  if ((c - part * along).norm() - reach >= seen.least) return;
  const Ellipsoid agent = flight.body(turning);
  const Near found = other.near({agent.translated(start - there - agent.center()), along},
                                {seen.least, seen.hopeless, meeting, now.reach});
  if (found.distance >= seen.least) return;
  seen.least = found.distance;
  if (found.distance > 0) return;
  seen.hit = begin + found.part * (end - begin);
  seen.depth = found.depth;
}

/// Of the course from `begin` on; `enough` metres are as good as more, `hopeless` metres as bad as less.
Navigator::Approach Navigator::see(const Flight& flight, const Body& other, double begin, double enough,
                                   double hopeless, Meeting meeting) const {
  Approach seen;
  seen.least = enough;
  seen.hopeless = hopeless;
  const double turning = flight.course.turning,
               end = std::max(begin, std::min(flight.course.until, other.matters - flight.now.since));
  // The straight part first: what is no good is so there mostly.
  if (end >= turning) see_straight(flight, other, std::max(begin, turning), end, meeting, seen);
  if (!(begin < turning) || (seen.done() && meeting == Meeting::whether)) return seen;
  if (hopeless > 0 && fails(flight, other, begin, std::min(turning, end), hopeless)) {
    seen.least = hopeless;
    return seen;
  }
  Approach turn;
  turn.least = enough;
  turn.hopeless = hopeless;
  see_turn(flight, other, begin, std::min(turning, end), meeting, turn);
  if (turn.hit < kFar) return turn;
  seen.least = std::min(seen.least, turn.least);
  return seen;
}

/// Whether they meet before `until`.
bool Navigator::meets(const Flight& flight, const Body& other, double until) const {
  const double end = std::min({until, flight.course.until, other.matters - flight.now.since}),
               turning = flight.course.turning;
  Approach straight;
  straight.least = 1e-300;
  if (end > turning) see_straight(flight, other, turning, end, Meeting::whether, straight);
  return straight.hit < kFar || (turning > 0 && fails(flight, other, 0, std::min(turning, end), 0));
}

/// What the course keeps of required and beyond. Gives up where it cannot be better than `floor`.
Navigator::Foreseen Navigator::foresee(const Moment& now, const Course& course, const Foreseen& floor) {
  const Flight flight(now, course);
  const Meeting meeting = floor.kept > 0 ? Meeting::whether : Meeting::when;
  Foreseen result;
  result.kept = required_ + beyond_;
  for (std::size_t n = 0; n < bodies_.size(); ++n) {
    // First the one that the course before failed by.
    const std::size_t i = n == 0 ? failed_by_ : n <= failed_by_ ? n - 1 : n;
    const Body& other = bodies_[i];
    if (floor.hits() && floor.hit > now.since && meets(flight, other, floor.hit - now.since)) {
      failed_by_ = i;
      return {0, 0};
    }
    // Who is nearer than it should be may stay so for a while, but not come much nearer.
    const bool near = other.now < result.kept && other.now > 0;
    const double enough = near ? std::min(result.kept, 0.8 * other.now) : result.kept;
    Approach seen =
        see(flight, other, 0, std::max(enough, 1e-300), std::min(floor.kept, enough - kAlmost), meeting);
    if (near && seen.least >= enough)
      seen = see(flight, other, std::clamp(0.5 * now.to_turn - now.since, 0.0, course.until), result.kept,
                 floor.kept, meeting);
    result.hit = std::min(result.hit, now.since + seen.hit);
    result.kept = result.hits() ? 0 : std::min(result.kept, seen.least);
    if (!result.better_than(floor)) {
      failed_by_ = i;
      return result;
    }
  }
  return result;
}

/// When it has flown the course for `t` seconds.
Navigator::Moment Navigator::later(const Moment& now, const Course& course, double t) {
  const Flight flight(now, course);
  const double turned = std::min(t, course.turning);
  const Vector3d straight = (t - turned) * course.velocity;
  Moment then = now;
  then.position = now.position + flight.moved(turned) + straight;
  then.velocity = t < course.turning ? flight.velocity(t) : course.velocity;
  then.speed = then.velocity.norm();
  if (then.speed > 0) then.ahead = then.velocity / then.speed;
  then.body = flight.body(turned).translated(straight);
  then.carried = now.carried && then.speed > 0;
  then.since = now.since + t;
  return then;
}

/// Of the course and those that follow it.
Navigator::Foreseen Navigator::foresee_all(const Moment& now, Course course, const std::vector<Leg>& legs,
                                           double time) {
  if (legs.empty()) return foresee(now, course, Foreseen::nothing());
  Foreseen all;
  Moment at = now;
  for (std::size_t i = 0;; ++i) {
    if (i < legs.size()) course.until = legs[i].begin - time - at.since;
    const Foreseen part = foresee(at, course, Foreseen::nothing());
    if (part.hits()) return part;
    all.kept = std::min(all.kept, part.kept);
    if (i == legs.size()) return all;
    at = later(at, course, course.until);
    course = towards(at, legs[i].velocity, legs[i].most);
  }
}

/// Of the course that is flown, how near it comes to what it comes nearest to, whatever is required.
void Navigator::tell(const Moment& now, Course course, double time, NavigatorStep& step) const {
  double least = kFar;
  Moment at = now;
  for (std::size_t leg = 0;; ++leg) {
    if (leg < legs_.size()) course.until = legs_[leg].begin - time - at.since;
    const Flight flight(at, course);
    double hit = kFar, depth = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Approach seen = see(flight, bodies_[i], 0, std::max(least, 1e-300), 0, Meeting::depth);
      if (seen.hit < hit) {
        hit = seen.hit;
        depth = seen.depth;
      } else if (hit < kFar || !(seen.least < least)) {
        continue;
      }
      least = seen.least;
      step.nearest = i;
    }
    step.least = hit < kFar ? -depth : least;
    if (hit < kFar || leg == legs_.size()) return;
    at = later(at, course, course.until);
    course = towards(at, legs_[leg].velocity, legs_[leg].most);
  }
}

}  // namespace vericone::guidance
