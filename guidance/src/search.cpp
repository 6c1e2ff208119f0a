// SPDX-License-Identifier: BSD-3-Clause
//
// The courses that are tried: all velocities, outwards from the one that is wanted.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "foresight.h"

namespace vericone::guidance {

using Eigen::Vector3d;

namespace {

constexpr double kOfTimeLeft = 0.25;  // before a contact it looks again when this part of it has gone
constexpr int kMostLooks = 8;         // ahead, before it says that all courses hit
constexpr long kMostAhead = 200000;   // distances measured for them
constexpr double kHurriedTurn = 32;   // rad/s, where no acceleration is too much and less does not help

}  // namespace

/// Of the course to a velocity; of those that end on a circle the best one, of more where there is time
/// (`patient`).
Navigator::Foreseen Navigator::foresee_towards(const Moment& now, const Vector3d& velocity, double most,
                                               const Foreseen& floor, Course& course, bool patient) {
  course = towards(now, velocity, most);
  Foreseen best = foresee(now, course, floor);
  if (!now.circles) return best;
  // Through a door, say, it goes straight on for a while first.
  const double across = 2 * now.speed / most;  // s, as long as a circle is wide
  for (int later = 0; later < (patient ? 3 : 1); ++later)
    for (const double side : {1.0, -1.0}) {
      if (best.keeps(now.surely)) return best;
      if (later == 0 && side > 0) continue;  // that was the first
      Moment at = now;
      at.side = side;
      at.before = std::ceil(later * across / now.step) * now.step;
      const Course other = towards(at, velocity, most);
      const Foreseen seen = foresee(at, other, best);
      if (!seen.better_than(best)) continue;
      course = other;
      best = seen;
    }
  return best;
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
    Course tried;
    const Foreseen seen = foresee_towards(now, velocity, most, all, tried);
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
      Course tried;
      const Foreseen seen =
          foresee_towards(now, course.velocity + sign * width * now.pace * step, most, foreseen, tried);
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
      Course tried;
      const Foreseen seen = foresee_towards(now, candidate.velocity, most, foreseen, tried);
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

}  // namespace vericone::guidance
