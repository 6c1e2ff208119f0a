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

const PlanLeg* leg_at(std::span<const PlanLeg> legs, double t) {
  const auto after = std::upper_bound(legs.begin(), legs.end(), t,
                                      [](double at, const PlanLeg& leg) { return at < leg.begin; });
  return &*(after == legs.begin() ? after : after - 1);
}

/// The least of n.c over [from, to], c the second's place less the first's: a parabola a leg.
double least_along(const Vector3d& n, const PairOfWays& ways, double from, double to) {
  const PlanLeg *a = leg_at(ways.first, from), *b = leg_at(ways.second, from);
  const PlanLeg* const last_a = ways.first.data() + ways.first.size() - 1;
  const PlanLeg* const last_b = ways.second.data() + ways.second.size() - 1;
  double least = std::numeric_limits<double>::infinity();
  while (true) {
    const double end_a = a == last_a ? to : (a + 1)->begin, end_b = b == last_b ? to : (b + 1)->begin;
    const double end = std::min({to, end_a, end_b});
    const double s = end - from;
    const double value = n.dot(b->at(from) - a->at(from)),
                 slope = n.dot(b->velocity_at(from) - a->velocity_at(from)),
                 bend = 0.5 * n.dot(b->acceleration - a->acceleration);
    least = std::min({least, value, value + s * (slope + s * bend)});
    if (bend > 0 && slope < 0 && -slope < 2 * bend * s)
      least = std::min(least, value - slope * slope / (4 * bend));
    if (end >= to) return least;
    if (end_a <= end) ++a;
    if (end_b <= end) ++b;
    from = end;
  }
}

Vector3d between_at(const PairOfWays& ways, double t) {
  return leg_at(ways.second, t)->at(t) - leg_at(ways.first, t)->at(t);
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

double proved_gap(const Between& between, const PairOfWays& ways, double from, double to, double enough,
                  int halvings) {
  // The normal of the time at which they are nearest of a few.
  Vector3d nearest = between_at(ways, from);
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    const Vector3d c = between_at(ways, from + part * (to - from));
    if (c.squaredNorm() < nearest.squaredNorm()) nearest = c;
  }
  const Vector3d n = between.normal(nearest);
  const double here = between.gap(n, nearest);
  if (!(here > enough)) return kNever;
  const double least = least_along(n, ways, from, to) - (n.dot(nearest) - here);
  if (least > enough) return least;
  if (halvings <= 0) return kNever;
  const double middle = 0.5 * (from + to);
  const double first = proved_gap(between, ways, from, middle, enough, halvings - 1);
  if (!(first > enough)) return kNever;
  return std::min(first, proved_gap(between, ways, middle, to, enough, halvings - 1));
}

bool apart(const Prepared& a, const Plan& of_a, const Prepared& b, const Plan& of_b) {
  const double far = a.reach + b.reach + of_a.radius() + of_b.radius() + kPadding;
  if ((of_b.middle() - of_a.middle()).squaredNorm() > far * far * (1 + 1e-12)) return true;
  const PairOfWays ways{of_a.legs(), of_b.legs()};
  return proved_gap(Between(a, b), ways, 0, std::max({of_a.end(), of_b.end(), 1e-3}), 4 * kPadding,
                    kHalvings) > 0;
}

}  // namespace vericone::swarm
