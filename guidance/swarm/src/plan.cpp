// SPDX-License-Identifier: BSD-3-Clause
#include "plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone::swarm {

using Eigen::Vector3d;

namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
constexpr int kHalvings = 4;

std::size_t leg_at(std::span<const PlanLeg> legs, double t) {
  const auto after = std::upper_bound(legs.begin(), legs.end(), t,
                                      [](double at, const PlanLeg& leg) { return at < leg.begin; });
  return after == legs.begin() ? 0 : static_cast<std::size_t>(after - legs.begin() - 1);
}

/// A way, leg by leg, along a normal.
class Walk {
 public:
  Walk(const Way& way, const Vector3d& n, double from)
      : way_(way), n_(n), leg_(leg_at(way.legs, from)), width_(way.width(leg_, n)) {}

  [[nodiscard]] double end(double to) const {
    return leg_ + 1 == way_.legs.size() ? to : way_.legs[leg_ + 1].begin;
  }
  [[nodiscard]] const PlanLeg& leg() const { return way_.legs[leg_]; }
  [[nodiscard]] double width() const { return width_; }
  void go_on() {
    ++leg_;
    if (leg_ <= way_.last) width_ = way_.width(leg_, n_);
  }

 private:
  const Way& way_;
  const Vector3d& n_;
  std::size_t leg_;
  double width_;
};

/// The least of n.c less both widths over [from, to], c the second's place less the first's: a parabola a
/// leg.
double least_along(const Vector3d& n, const Way& first, const Way& second, double from, double to) {
  Walk a(first, n, from), b(second, n, from);
  double least = std::numeric_limits<double>::infinity();
  while (true) {
    const double end_a = a.end(to), end_b = b.end(to), end = std::min({to, end_a, end_b});
    const double s = end - from;
    const double value = n.dot(b.leg().at(from) - a.leg().at(from)) - a.width() - b.width(),
                 slope = n.dot(b.leg().velocity_at(from) - a.leg().velocity_at(from)),
                 bend = 0.5 * n.dot(b.leg().acceleration - a.leg().acceleration);
    least = std::min({least, value, value + s * (slope + s * bend)});
    if (bend > 0 && slope < 0 && -slope < 2 * bend * s)
      least = std::min(least, value - slope * slope / (4 * bend));
    if (end >= to) return least;
    if (end_a <= end) a.go_on();
    if (end_b <= end) b.go_on();
    from = end;
  }
}

Vector3d between_at(const Way& a, const Way& b, double t) {
  return b.legs[leg_at(b.legs, t)].at(t) - a.legs[leg_at(a.legs, t)].at(t);
}

/// Halves what one plane does not prove.
double proved_by_halves(const Way& a, const Way& b, double from, double to, double enough, int halvings,
                        Vector3d& found) {
  // The normal of the time at which they are nearest of a few.
  Vector3d nearest = between_at(a, b, from);
  double when = from;
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    const double t = from + part * (to - from);
    const Vector3d c = between_at(a, b, t);
    if (!(c.squaredNorm() < nearest.squaredNorm())) continue;
    nearest = c;
    when = t;
  }
  const Between between(a.body(leg_at(a.legs, when)), b.body(leg_at(b.legs, when)));
  const Vector3d n = between.normal(nearest);
  if (!(between.gap(n, nearest) > enough)) return kNever;
  found = n;
  const double least = least_along(n, a, b, from, to);
  if (least > enough) return least;
  found.setZero();
  if (halvings <= 0) return kNever;
  Vector3d of_half;
  const double middle = 0.5 * (from + to);
  const double first = proved_by_halves(a, b, from, middle, enough, halvings - 1, of_half);
  if (!(first > enough)) return kNever;
  return std::min(first, proved_by_halves(a, b, middle, to, enough, halvings - 1, of_half));
}

}  // namespace

Plan::Plan(const Vector3d& position, const Vector3d& velocity, const Vector3d& acceleration, double seconds,
           double most) {
  legs_[0] = {0, position, velocity, acceleration};
  double length = 0;
  if (seconds > 0) {
    const Vector3d later = velocity + seconds * acceleration;
    length = 0.5 * seconds * (velocity.norm() + later.norm());  // the speed is convex in time
    add(seconds, Vector3d::Zero());
  }
  PlanLeg& braking = legs_[count_ - 1];
  if (const double speed = braking.velocity.norm(); speed > 0) {
    braking.acceleration = -most / speed * braking.velocity;
    length += 0.5 * speed * speed / most;
    add(speed / most, Vector3d::Zero());
  }
  legs_[count_ - 1].velocity.setZero();
  middle_ = 0.5 * (position + last());
  radius_ = 0.5 * length * (1 + 1e-12);
}

void Plan::add(double seconds, const Vector3d& acceleration) {
  const PlanLeg& before = legs_[count_ - 1];
  const double t = before.begin + seconds;
  legs_[count_++] = {t, before.at(t), before.velocity_at(t), acceleration};
}

double proved_gap(const Way& a, const Way& b, double from, double to, double enough, int halvings,
                  Vector3d* hint) {
  if (hint != nullptr && hint->squaredNorm() > 0)
    if (const double least = least_along(*hint, a, b, from, to); least > enough) return least;
  Vector3d found = Vector3d::Zero();
  const double least = proved_by_halves(a, b, from, to, enough, halvings, found);
  if (hint != nullptr) *hint = found;
  return least;
}

bool apart(const Course& a, const Course& b, Vector3d* hint) {
  const double far = a.bodies->reach + b.bodies->reach + a.plan.radius() + b.plan.radius() + kPadding;
  if ((b.plan.middle() - a.plan.middle()).squaredNorm() > far * far * (1 + 1e-12)) return true;
  return proved_gap(a.way(), b.way(), 0, std::max({a.plan.end(), b.plan.end(), 1e-3}), 4 * kPadding,
                    kHalvings, hint) > 0;
}

}  // namespace vericone::swarm
