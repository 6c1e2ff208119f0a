// SPDX-License-Identifier: BSD-3-Clause
//
// How near courses come to bodies.
#include "foresight.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace vericone::guidance {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d Navigator::Flight::velocity(double t) const {
  if (t > course.circles) {
    const double turned = turns() * (t - course.circles);
    return std::cos(turned) * course.velocity + std::sin(turned) * now.speed * course.inward;
  }
  if (t > course.brakes && !(course.braking > 0)) return Vector3d::Zero();
  if (t > course.brakes) return std::max(0.0, 1 - (t - course.brakes) / course.braking) * course.velocity;
  if (t >= course.turning) return course.velocity;
  if (course.radius > 0) {
    const double turned = course.angle * t / course.turning;
    return now.speed * (std::cos(turned) * now.ahead + std::sin(turned) * course.aside);
  }
  return now.velocity + t * course.most * course.aside;
}

Matrix3d Navigator::Flight::rotation(double t) const {
  if (!now.carried) return Matrix3d::Identity();
  if (t > course.circles) {
    const Vector3d about = course.velocity.cross(course.inward).normalized();
    return Eigen::AngleAxisd(turns() * (t - course.circles), about) * rotation(course.circles);
  }
  if (course.turning == 0) return Matrix3d::Identity();
  t = std::min(t, course.turning);
  if (course.radius > 0) return Eigen::AngleAxisd(course.angle * t / course.turning, axis).toRotationMatrix();
  const Vector3d v = now.velocity + t * course.most * course.aside;
  if (!(v.norm() > 1e-9 * now.speed)) return Matrix3d::Identity();
  return Eigen::Quaterniond::FromTwoVectors(now.ahead, v).toRotationMatrix();
}

Vector3d Navigator::Flight::moved(double t) const {
  const double manoeuvre = std::min(t, course.turning);
  Vector3d x;
  if (course.radius > 0) {
    const double turned = course.angle * manoeuvre / course.turning;
    x = course.radius * (std::sin(turned) * now.ahead + (1 - std::cos(turned)) * course.aside);
  } else {
    x = manoeuvre * (now.velocity + 0.5 * manoeuvre * course.most * course.aside);
  }
  return t > course.turning ? Vector3d(x + beyond(t)) : x;
}

Vector3d Navigator::Flight::beyond(double t) const {
  double seconds = std::min({t, course.brakes, course.circles}) - course.turning;  // at its velocity
  if (t > course.circles) {
    const double turned = turns() * (t - course.circles);
    return seconds * course.velocity + round() / now.speed * std::sin(turned) * course.velocity +
           round() * (1 - std::cos(turned)) * course.inward;
  }
  if (const double part = std::min(t - course.brakes, course.braking); part > 0)
    seconds += part * (1 - 0.5 * part / course.braking);
  return seconds * course.velocity;
}

Vector3d Navigator::Flight::manoeuvring(double t) const {
  return now.position + rotation(t) * (now.body.center() - now.position) + moved(t);
}

Vector3d Navigator::Flight::middle() const {
  return now.position + moved(course.circles) + round() * course.inward;
}

Vector3d Navigator::Flight::center(double t) const {
  if (t > course.circles) return manoeuvring(t);
  return t >= course.turning ? Vector3d(after + beyond(t)) : manoeuvring(t);
}

Ellipsoid Navigator::Flight::body(double t) const {
  if (!now.carried || (course.turning == 0 && !(t > course.circles)))
    return now.body.translated(center(t) - now.body.center());
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
  const double balls = (c - part * sweep.along).norm() - reach - wanted.reach - sweep.widest();
  if (balls >= wanted.enough && square < kFar) return {balls};
  wanted.normal = &normal;
  return itself ? courses::near(sweep, *itself, wanted) : courses::near(sweep, body, wanted);
}

Navigator::Chord::Chord(const Flight& flight, const Body& other, double begin, double end) {
  const Moment& now = flight.now;
  const double middle = 0.5 * (begin + end), span = end - begin;
  const bool brakes = begin >= flight.course.brakes;
  const double acceleration = brakes ? flight.course.velocity.norm() / flight.course.braking
                              : begin >= flight.course.circles ? flight.course.asked
                                                               : flight.course.most;
  beside = bent = acceleration * span * span / 8;
  if (now.carried && !brakes) {
    const auto between = [&](double s, double t) {
      const Vector3d u = flight.velocity(s), v = flight.velocity(t);
      return std::atan2(u.cross(v).norm(), u.dot(v));
    };
    turned = std::max(between(begin, middle), between(middle, end));
    const double offset = (now.body.center() - now.position).norm();
    beside += std::min(2.0, turned) * now.uneven + 0.5 * offset * turned * turned;
  }
  fine = beside <= 5e-4 * now.reach || span <= 0.25 * now.step;
  const Vector3d from = flight.center(begin) - (now.since + begin) * other.velocity;
  sweep = {now.carried ? flight.body(middle) : now.body,
           flight.center(end) - (now.since + end) * other.velocity - from, flight.swerved(other, begin),
           flight.swerved(other, end)};
  sweep.agent = sweep.agent.translated(from - sweep.agent.center());
}

double Navigator::Chord::nearest(const Body& other) const {
  const double square = sweep.along.squaredNorm();
  const Vector3d c = other.body.center() - sweep.agent.center();
  return square > 0 ? std::clamp(c.dot(sweep.along) / square, 0.0, 1.0) : 0;
}

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
  const double wider = flight.swerved(other, t);
  return other
             .near({body.translated(there - body.center()), Vector3d::Zero(), wider, wider},
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

/// From `begin`, after the manoeuvre, until `end`, at a velocity that it keeps.
void Navigator::see_straight(const Flight& flight, const Body& other, double begin, double end,
                             Meeting meeting, Approach& seen) const {
  ++looks_;
  const Moment& now = flight.now;
  const Vector3d velocity = flight.velocity(begin), w = velocity - other.velocity;
  const double speed = w.norm(), reach = other.reach + now.reach;
  const Vector3d start = flight.center(begin);
  const Vector3d there = (now.since + begin) * other.velocity, c = other.body.center() + there - start;
  // Who swerves does so until the agent rests, or as long as it matters; then it keeps its velocity.
  const bool swerves = other.swerves > 0 && begin < flight.course.rests();
  if (!swerves && !(speed > 1e-9 * (now.speed + velocity.norm() + other.velocity.norm()))) end = begin;
  // Once past it, and the reach of both, they move apart.
  if (!swerves) end = std::min(end, begin + (std::max(0.0, c.dot(w)) / speed + reach) / speed);
  if (!(end > begin)) end = begin;
  const double wider_from = swerves ? flight.swerved(other, begin) : 0,
               wider_to = swerves ? flight.swerved(other, end) : 0;
  const Vector3d along = (end - begin) * w;
  const double square = along.squaredNorm();
  const double part = square > 0 ? std::clamp(c.dot(along) / square, 0.0, 1.0) : 0;
  if ((c - part * along).norm() - reach - wider_to >= seen.least) return;
  const Ellipsoid agent = flight.body(begin);
  const Near found =
      other.near({agent.translated(start - there - agent.center()), along, wider_from, wider_to},
                 {seen.least, seen.hopeless, meeting, now.reach});
  if (found.distance >= seen.least) return;
  seen.least = found.distance;
  if (found.distance > 0) return;
  seen.hit = begin + found.part * (end - begin);
  seen.depth = found.depth;
}

/// From `begin`, after the manoeuvre, to where it rests, past a body at rest: one way, however it brakes.
void Navigator::see_stop(const Flight& flight, const Body& other, double begin, double end, Meeting meeting,
                         Approach& seen) const {
  ++looks_;
  const Vector3d from = flight.center(begin), along = flight.center(end) - from;
  const Ellipsoid agent = flight.body(begin);
  const Near found = other.near({agent.translated(from - agent.center()), along},
                                {seen.least, seen.hopeless, meeting, flight.now.reach});
  if (found.distance >= seen.least) return;
  seen.least = found.distance;
  if (found.distance > 0) return;
  // When it has gone so far.
  double low = begin, high = end;
  for (int i = 0; i < 40; ++i) {
    const double t = 0.5 * (low + high);
    ((flight.center(t) - from).norm() < found.part * along.norm() ? low : high) = t;
  }
  seen.hit = low;
  seen.depth = found.depth;
}

/// The manoeuvre or the braking.
void Navigator::see_curved(const Flight& flight, const Body& other, double begin, double end, Meeting meeting,
                           Approach& seen) const {
  if (seen.hopeless > 0 && fails(flight, other, begin, end, seen.hopeless))
    seen.least = std::min(seen.least, seen.hopeless);
  else
    see_turn(flight, other, begin, end, meeting, seen);
}

/// Until when the circle that a course ends on is to be looked at: once round among bodies at rest; else
/// until the other has left what is `enough` metres about the circle, for ever. Infinite: that takes too
/// long.
double Navigator::round_until(const Flight& flight, const Body& other, double enough) {
  constexpr double kMostRounds = 20;
  const Moment& now = flight.now;
  const double begin = flight.course.circles, once = 2 * std::numbers::pi / flight.turns() * (1 + 1e-9);
  if (other.stays()) return begin + once;
  if (other.swerves > 0) return kFar;
  const Vector3d& u = other.velocity;
  const Vector3d c = other.body.center() + (now.since + begin) * u - flight.middle();
  const double reach =
      flight.round() + now.reach + (now.body.center() - now.position).norm() + other.reach + 2 * other.offset;
  const double wide = (enough < kFar ? enough + reach : c.norm() + reach) * (1 + 1e-9);
  const double square = u.squaredNorm(), half = c.dot(u);
  if (!(square > 0)) return begin + once;
  const double root = half * half - square * (c.squaredNorm() - wide * wide);
  if (root < 0) return begin;
  const double seconds = (std::sqrt(root) - half) / std::sqrt(square) / std::sqrt(square);
  if (seconds > kMostRounds * once) return kFar;
  return begin + std::max(0.0, seconds) * (1 + 1e-9);
}

/// On the circle that it ends on, for ever; what takes too long to look at counts as a hit.
void Navigator::see_circle(const Flight& flight, const Body& other, double end, Meeting meeting,
                           Approach& seen) const {
  const double begin = flight.course.circles;
  const double until = std::min(end, round_until(flight, other, seen.least));
  if (until == kFar) {
    seen.least = 0;
    seen.hit = begin;
    return;
  }
  const double quarter = 0.5 * std::numbers::pi / flight.turns();
  for (double from = begin; from < until && !seen.done(); from += quarter)
    see_curved(flight, other, from, std::min(until, from + quarter), meeting, seen);
}

/// Of the course from `begin` on; `enough` metres are as good as more, `hopeless` metres as bad as less.
Navigator::Approach Navigator::see(const Flight& flight, const Body& other, double begin, double enough,
                                   double hopeless, Meeting meeting) const {
  Approach seen;
  seen.least = enough;
  seen.hopeless = hopeless;
  const Course& course = flight.course;
  const double matters = flight.now.circles ? kFar : other.matters - flight.now.since;
  const double end = std::max(begin, std::min(course.until, matters));
  using Look = void (Navigator::*)(const Flight&, const Body&, double, double, Meeting, Approach&) const;
  const auto part = [&](double from, double to, Look look) {
    from = std::max(from, begin);
    to = std::min(to, end);
    if (!(from <= to) || (seen.done() && meeting == Meeting::whether)) return;
    Approach of_part;
    of_part.least = seen.hit < kFar ? enough : seen.least;
    of_part.hopeless = hopeless;
    (this->*look)(flight, other, from, to, meeting, of_part);
    if (of_part.hit < kFar)
      seen = of_part;
    else
      seen.least = std::min(seen.least, of_part.least);
  };
  // The later parts first: what is no good is so there mostly.
  const bool still = other.stays();
  if (course.circles < kFar) {
    part(course.turning, course.circles, &Navigator::see_straight);
    if (end > course.circles && !(seen.done() && meeting == Meeting::whether)) {
      Approach round;
      round.least = seen.hit < kFar ? enough : seen.least;
      round.hopeless = hopeless;
      see_circle(flight, other, end, meeting, round);
      seen.least = std::min(seen.least, round.least);
      if (round.hit < seen.hit) seen = round;
    }
  } else if (course.brakes == kFar) {
    part(course.turning, kFar, &Navigator::see_straight);
  } else if (still) {
    part(course.turning, std::max(course.rests(), begin), &Navigator::see_stop);
  } else {
    part(course.rests(), kFar, &Navigator::see_straight);
    if (course.braking > 0) part(course.brakes, course.rests(), &Navigator::see_curved);
    part(course.turning, course.brakes, &Navigator::see_straight);
  }
  if (begin < course.turning) part(0, course.turning, &Navigator::see_curved);
  return seen;
}

/// Whether they meet before `until`.
bool Navigator::meets(const Flight& flight, const Body& other, double until) const {
  const Course& course = flight.course;
  const double matters = flight.now.circles ? kFar : other.matters - flight.now.since;
  const double end = std::min({until, course.until, matters});
  const auto straight = [&](double from, double to) {
    Approach seen;
    seen.least = 1e-300;
    to = std::min(to, end);
    if (to > from) see_straight(flight, other, from, to, Meeting::whether, seen);
    return seen.hit < kFar;
  };
  const auto curved = [&](double from, double to) {
    to = std::min(to, end);
    return to > from && fails(flight, other, from, to, 0);
  };
  if (course.circles < kFar) {
    if (straight(course.turning, course.circles) || curved(0, course.turning)) return true;
    Approach seen;
    seen.least = 1e-300;
    if (end > course.circles) see_circle(flight, other, end, Meeting::whether, seen);
    return seen.hit < kFar;
  }
  return straight(course.turning, course.brakes) || curved(0, course.turning) ||
         (course.brakes < kFar && (curved(course.brakes, course.rests()) || straight(course.rests(), kFar)));
}

/// Whether it rests within what the agent sees. Where it stops at once it does so wherever that is.
bool Navigator::in_sight(const Flight& flight) const {
  if (options_.range == kFar || flight.course.brakes == kFar || flight.course.velocity.isZero(0)) return true;
  return flight.moved(flight.course.rests()).norm() + flight.now.reach + required_ <= options_.range;
}

/// m: how far a ball about a point is out of the corridor; negative within.
double Navigator::out_of_corridor(const Vector3d& position, double reach) const {
  const Vector3d c = position - corridor_->from;
  const double square = leg_.squaredNorm();
  const double part = square > 0 ? std::clamp(c.dot(leg_) / square, 0.0, 1.0) : 0;
  return (c - part * leg_).norm() + reach - corridor_->radius;
}

/// The same of a course, at most, until it rests: a corridor is convex, so that the ends of what is straight
/// are enough, and of a manoeuvre those of its chords, less what is beside them.
double Navigator::out_of_corridor(const Flight& flight) const {
  const Course& course = flight.course;
  const Moment& now = flight.now;
  if (course.brakes == kFar && !course.velocity.isZero(0)) return kFar;
  const double reach = now.reach * (1 + 1e-12);
  double most =
      course.brakes < kFar ? out_of_corridor(now.position + flight.moved(course.rests()), reach) : -kFar;
  const double sagitta = course.most * course.turning * course.turning / 8;
  const int chords = std::clamp(int(std::ceil(std::sqrt(sagitta / (1e-4 * now.reach)))), 1, 100);
  for (int i = 0; i <= chords; ++i)
    most = std::max(most, out_of_corridor(now.position + flight.moved(course.turning * i / chords), reach));
  const double sizes = now.position.norm() + corridor_->from.norm() + leg_.norm() + reach +
                       (course.turning + course.rests()) * (now.speed + course.velocity.norm());
  return most + sagitta / (chords * chords) + 0x1p-44 * (course.brakes < kFar ? sizes : now.position.norm());
}

/// What the course keeps of required and beyond. Gives up where it cannot be better than `floor`.
Navigator::Foreseen Navigator::foresee(const Moment& now, const Course& course, const Foreseen& floor) {
  const Flight flight(now, course);
  const Meeting meeting = floor.kept > 0 ? Meeting::whether : Meeting::when;
  if (!in_sight(flight)) return Foreseen::nothing();
  if (corridor_ &&
      out_of_corridor(flight) > std::max(-now.slack, out_of_corridor(now.position, now.reach) + now.slack))
    return Foreseen::nothing();
  const Outline outline(flight);
  Foreseen result;
  result.kept = required_ + beyond_;
  for (std::size_t n = 0; n < bodies_.size(); ++n) {
    // First the one that the course before failed by.
    const std::size_t i = n == 0 ? failed_by_ : n <= failed_by_ ? n - 1 : n;
    const Body& other = bodies_[i];
    if (result.better_than(floor) && outline.is_far(flight, other, result.kept)) continue;
    if (floor.hits() && floor.hit > now.since && meets(flight, other, floor.hit - now.since)) {
      failed_by_ = i;
      return {0, 0};
    }
    // Who is nearer than it should be may stay so for a while, but not come much nearer. Not who can stop,
    // and once was as far as it should be from a body at rest: in a narrow place what errors of sensors make
    // too near on one side would let it come too near on the other.
    const bool late = (now.stops || now.circles) && now.clear && other.stays();
    const bool near = other.now < result.kept && other.now > 0 && !late;
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
  Moment then = now;
  then.position = now.position + flight.moved(t);
  then.velocity = flight.velocity(t);
  then.speed = then.velocity.norm();
  if (then.speed > 0) then.ahead = then.velocity / then.speed;
  then.body = flight.body(t);
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
    const Outline outline(flight);
    double hit = kFar, depth = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (outline.is_far(flight, bodies_[i], least)) continue;
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
