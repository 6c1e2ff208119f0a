// SPDX-License-Identifier: BSD-3-Clause
//
// What a navigator thinks in: courses, and what will happen on them.
#pragma once

#include <vericone/cones/cone_geometry.h>
#include <vericone/guidance/navigator.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "near.h"

namespace vericone::guidance {

using courses::Meeting, courses::Near, courses::Sweep, courses::Wanted;

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kFar = std::numeric_limits<double>::infinity();
inline constexpr double kAligned = 1e-6;     // rad
inline constexpr double kAlmost = 1e-9;      // m, what rounding may take
inline constexpr double kAbove = 1 + 1e-12;  // of a bound that was rounded to nearest

struct Navigator::Moment {
  Eigen::Vector3d position, velocity, ahead;
  double speed, step;
  Ellipsoid body;
  double reach;          // of the agent about its position
  double uneven;         // m, of its longest less its shortest semi-axis: what its turning changes, at most
  double cruise;         // m/s, at which it goes to its destination
  double pace;           // m/s: of velocities that are tried
  double most;           // m/s^2
  double surely = 0;     // m, that a course must keep when it is taken
  double to_turn = 0;    // s: within bodies that hold it no course matters for longer
  double since = 0;      // s, of a moment to come: from the command
  bool stops = false;    // courses end at rest
  bool circles = false;  // or, of who keeps its speed, on a circle
  double side = 1;       // of the circles: 1 as it turned before, else -1
  double before = 0;     // s, straight on before them, beside the command of a step
  double slack = 0;      // m: so much a course that is new must stay off the wall of a corridor
  bool clear = false;    // what is required of bodies at rest was kept once
  bool planar, carried;
};

[[nodiscard]] inline double angle_between(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// A unit vector across `ahead` on the side of `direction`; left or e1 where that is straight ahead or
/// behind.
[[nodiscard]] inline Eigen::Vector3d side_of(const Eigen::Vector3d& ahead, const Eigen::Vector3d& direction,
                                             bool planar) {
  const Eigen::Vector3d across = direction - direction.dot(ahead) * ahead;
  if (across.norm() > 1e-12) return across.normalized();
  return planar ? Eigen::Vector3d(-ahead.y(), ahead.x(), 0) : AxisFrame(ahead).e1;
}

/// For a course that is held already.
[[nodiscard]] inline auto as_held(auto now) {
  now.slack = 0;
  return now;
}

/// What courses are compared by: the larger the better. A course that hits keeps nothing.
struct Navigator::Foreseen {
  double kept = kFar;  // m, of the whole course, as far as it counts; 0 where it hits
  double hit = kFar;   // s from the command, the first contact
  [[nodiscard]] bool hits() const { return hit < kFar; }
  [[nodiscard]] bool keeps(double metres) const { return !hits() && kept >= metres - kAlmost; }
  [[nodiscard]] bool better_than(const Foreseen& other) const {
    return kept != other.kept ? kept > other.kept : hit > other.hit;
  }
  [[nodiscard]] static Foreseen nothing() { return {-1, 0}; }  // worse than any
};

/// What is taken at a step.
struct Navigator::Choice {
  Course course;
  Foreseen foreseen;
  bool way = false;       // to the destination, or back to its speed
  bool aims = false;      // there is such a way
  bool looked = false;    // all others were tried
  bool stopping = false;  // the stop that was in hand: nothing better is known
};

/// A course as the agent flies it.
struct Navigator::Flight {
  const Moment& now;
  const Course& course;
  Eigen::Vector3d axis;   // of a turn
  Eigen::Vector3d after;  // m, the centre of its body after the manoeuvre

  Flight(const Moment& at, const Course& on)
      : now(at), course(on), axis(at.ahead.cross(on.aside)), after(manoeuvring(on.turning)) {}
  [[nodiscard]] Eigen::Vector3d velocity(double t) const;
  [[nodiscard]] Eigen::Vector3d moved(double t) const;
  /// Of the circle that it ends on: metres, and rad/s.
  [[nodiscard]] double round() const { return now.speed * now.speed / course.asked; }
  [[nodiscard]] double turns() const { return course.asked / now.speed; }
  [[nodiscard]] Eigen::Vector3d middle() const;            // of it
  [[nodiscard]] Eigen::Matrix3d rotation(double t) const;  // of its body, since now
  [[nodiscard]] Eigen::Vector3d center(double t) const;    // of its body
  [[nodiscard]] Ellipsoid body(double t) const;
  /// m: so far another body may be from where its velocity takes it.
  [[nodiscard]] double swerved(const Body& other, double t) const {
    return 0.5 * other.swerves * (now.since + t) * (now.since + t) * (1 + 1e-12);
  }
  [[nodiscard]] double rounding(const Body& other, double t) const;

 private:
  [[nodiscard]] Eigen::Vector3d manoeuvring(double t) const;  // its centre, t <= turning
  [[nodiscard]] Eigen::Vector3d beyond(double t) const;       // how far it is after the manoeuvre
};

/// A part of the manoeuvre, or of the braking: its chord, and how far from the chord the body may be, which
/// turns meanwhile.
struct Navigator::Chord {
  Sweep sweep;
  double beside;      // m
  double bent;        // m, of it what is not by turning
  double turned = 0;  // rad, of its body from the middle to either end
  bool fine;          // no shorter one is looked at

  Chord(const Flight& flight, const Body& other, double begin, double end);
  /// The part of it where the centres are nearest.
  [[nodiscard]] double nearest(const Body& other) const;
};

/// How near a course comes to one body.
struct Navigator::Approach {
  double least = kFar;  // m; 0 where it hits; before that what is as good as more
  double hopeless = 0;  // m: the course is no good that comes as near as this
  double hit = kFar;    // s from its moment
  double depth = 0;     // m
  [[nodiscard]] bool done() const { return hit < kFar || least <= hopeless; }
};

/// The corners of a course, between which it is nearly straight, and then straight for ever: enough to tell
/// that most bodies are far from it.
class Outline {
 public:
  template <typename Flight>
  explicit Outline(const Flight& flight) : since_(flight.now.since), reach_(flight.now.reach) {
    const auto& course = flight.course;
    const double offset = (flight.now.body.center() - flight.now.position).norm();
    const auto corner = [&](double t, double most, double off_arc) {
      const double span = t - corners_[count_ - 1].t;
      corners_[count_++] = {flight.center(t), t, (most * span * span / 8 + off_arc) * kAbove};
    };
    corners_[count_++] = {flight.center(0), 0, 0};
    if (course.turning > 0) corner(course.turning, course.most, 2 * offset);
    if (course.circles < kFar) {
      corner(course.circles, 0, 0);
      // Whoever circles is somewhere about its middle.
      about_ = 2 * flight.round() * kAbove + 2 * offset;
    } else if (course.brakes < kFar) {
      corner(course.brakes, 0, 0);
      if (course.braking > 0) corner(course.rests(), course.velocity.norm() / course.braking, 0);
    } else {
      velocity_ = course.velocity;
    }
  }

  /// Whether it surely keeps `enough` metres from a body. Who swerves does so until the last corner only, so
  /// nothing is known beyond.
  template <typename Flight, typename Body>
  [[nodiscard]] bool is_far(const Flight& flight, const Body& other, double enough) const {
    if (other.swerves > 0 && flight.course.brakes == kFar) return false;
    enough += (other.reach + reach_) * kAbove + 2 * other.offset;
    const auto seen = [&](const Corner& corner) {
      return Eigen::Vector3d(other.body.center() + (since_ + corner.t) * other.velocity - corner.center);
    };
    Eigen::Vector3d c = seen(corners_[0]);
    for (int i = 1; i < count_; ++i) {
      const Corner& end = corners_[i];
      const Eigen::Vector3d next = seen(end), along = next - c;
      const double square = along.squaredNorm();
      if (!(square < kFar)) return false;  // the part would be 0
      const double part = square > 0 ? std::clamp(-c.dot(along) / square, 0.0, 1.0) : 0;
      const double more = end.beside + flight.swerved(other, end.t) + flight.rounding(other, end.t);
      if (!((c + part * along).norm() >= enough + more)) return false;
      c = next;
    }
    enough += about_;
    const Eigen::Vector3d w = velocity_ - other.velocity;
    const double square = w.squaredNorm(), last = corners_[count_ - 1].t;
    if (!(c.squaredNorm() < kFar && square < kFar)) return false;
    const double nearest = square > 0 ? std::max(0.0, c.dot(w) / square) : 0;
    return (c - nearest * w).norm() >= enough + 4 * flight.rounding(other, last + nearest);
  }

 private:
  struct Corner {
    Eigen::Vector3d center;
    double t, beside;  // s; m, from the straight line that leads here
  };
  std::array<Corner, 4> corners_;
  int count_ = 0;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // m/s, after the last
  double since_, reach_, about_ = 0;
};

}  // namespace vericone::guidance
