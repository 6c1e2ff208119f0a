// SPDX-License-Identifier: BSD-3-Clause
#include "motion/look.h"

#include <vericone/cones/pair.h>
#include <vericone/geometry/world_body.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace vericone::motion {
namespace {

using Eigen::Vector3d;

/// Boxes of the search for a common point of two delimited bodies are refined to this part of them.
constexpr double kInflatedTolerance = 1e-8;
constexpr int kInflations = 12;

/// Of two combined quadrics a Pair has the distance of ellipsoids around them, which overlap where one body
/// is before the other's dent. Another bound: one of the two, widened by a distance, does not meet the other.
double by_inflation(const Placed& a, const Placed& b, double most) {
  const CombinedEllipsoid in_a = in_world(*a.body.quadric(), a.pose),
                          in_b = in_world(*b.body.quadric(), b.pose);
  const bool widen_b = in_b.is_ellipsoid() || !in_a.is_ellipsoid();
  const WorldBody fixed = widen_b ? in_a : in_b, wide = widen_b ? in_b : in_a;
  const auto apart = [&](double distance) {
    return relation_of(fixed, wide.inflated(distance), kInflatedTolerance) == Relation::disjoint;
  };
  if (!(most > 0) || !std::isfinite(most)) return 0;
  double proved = 0, failed = most;
  for (int i = 0; i < kInflations && proved < 0.9 * failed; ++i) {
    const double middle = proved > 0 ? 0.5 * (proved + failed) : 0.25 * failed;
    (apart(middle) ? proved : failed) = middle;
  }
  return proved;
}

struct Nearness {
  double least = std::numeric_limits<double>::infinity(), most = least;
  Vector3d normal = Vector3d::Zero();
};

void take_nearer(Nearness& nearest, const Placed& a, const Placed& b) {
  const Pair pair(a, b);
  const Miss miss = pair.miss(Vector3d::Zero(), Vector3d::Zero());
  double least = miss.least;
  const bool quadrics = a.body.quadric() && b.body.quadric() && !pair.guarantee().exact;
  if (quadrics && least < 0.5 * miss.most && pair.relation() == Relation::disjoint)
    least = std::max(least, by_inflation(a, b, miss.most));
  if (miss.most < nearest.most || nearest.normal.isZero(0)) nearest.normal = miss.normal;
  nearest.least = std::min(nearest.least, least);
  nearest.most = std::min(nearest.most, miss.most);
}

double sway(const Path& path, double dt) {
  const double half = 0.5 * path.rate() * dt;
  return 2 * path.reach() * (half < 0.5 * std::numbers::pi ? half : 1);
}

/// h(n + s n x spin) of a body about its center, one of whose points at s is h(n)'s at most, but for
/// |spin|^2 reach s^2 / 2.
double tilted_support(const Placed& about, const Path& path, const Vector3d& n, double s) {
  return about.support(path.rate() == 0 ? n : Vector3d(n + s * n.cross(path.spin())));
}

}  // namespace

Look::Look(const Path& a, const Path& b, double t, const Look* before)
    : path_a_(a), path_b_(b), t_(t), a_(a.about_center(t)), b_(b.about_center(t)) {
  Nearness nearest;
  const auto all_b = b.parts(t);
  for (const Placed& one : a.parts(t))
    for (const Placed& other : all_b) take_nearer(nearest, one, other);
  least_ = nearest.least;
  most_ = nearest.most;
  const Course of_a = a.course(t), of_b = b.course(t);
  between_ = of_b.center - of_a.center;
  velocity_ = of_b.velocity - of_a.velocity;
  acceleration_ = of_b.acceleration - of_a.acceleration;
  normal_ = nearest.normal.isZero(0) ? between_ : nearest.normal;
  if (const double length = normal_.stableNorm(); length > 0 && std::isfinite(length))
    normal_ /= length;
  else
    normal_.setZero();
  // A Pair's bound is 0 before its search is sure of the last digits; a plane has all of them. It may have
  // stood still, or turned with a body.
  double widest = by_plane(normal_, 0, 0);
  if (before)
    for (const Vector3d& turned : {Vector3d::Zero().eval(), a.spin(), b.spin()}) {
      const Vector3d n = turn((t - before->t_) * turned) * before->normal_;
      const double gap = by_plane(n, 0, 0);
      if (gap > widest) {
        other_ = normal_;
        normal_ = n;
        widest = gap;
      } else if (other_.isZero(0)) {
        other_ = n;
      }
    }
  least_ = std::max(least_, widest - 4 * rounding(t));
}

double Look::closing() const {
  return velocity_.norm() + path_a_.rate() * path_a_.reach() + path_b_.rate() * path_b_.reach();
}

// Pair takes one body into the frame of the other.
double Look::rounding(double t) const { return 2 * (path_a_.rounding(t) + path_b_.rounding(t)); }

double Look::by_plane(const Vector3d& n, double back, double ahead) const {
  if (n.isZero(0)) return 0;
  const double s = std::max(back, ahead);
  // Over a quarter of a turn a plane tells nothing, and the normals below would be long.
  if (!(std::max(path_a_.rate(), path_b_.rate()) * s < 1)) return 0;
  // Concave in time but for the acceleration: least at an end.
  const auto gap = [&](double at) {
    return n.dot(between_ + at * velocity_) - tilted_support(a_, path_a_, n, at) -
           tilted_support(b_, path_b_, -n, at);
  };
  const double bend = std::max(0.0, -n.dot(acceleration_)) +
                      path_a_.rate() * path_a_.rate() * path_a_.reach() +
                      path_b_.rate() * path_b_.rate() * path_b_.reach();
  const double at_once = back > 0 && ahead > 0 ? std::numeric_limits<double>::infinity() : gap(0);
  const double before = back > 0 ? gap(-back) : at_once, after = ahead > 0 ? gap(ahead) : at_once;
  return std::min({at_once, before, after}) - 0.5 * bend * s * s * (1 + 1e-12);
}

double Look::bound(double back, double ahead) const {
  const double s = std::max(back, ahead);
  const double rounding = this->rounding(t_ + ahead);
  const double way = (velocity_.norm() * s + 0.5 * acceleration_.stableNorm() * s * s) * (1 + 1e-12);
  const double by_distance = least_ - way - sway(path_a_, s) - sway(path_b_, s);
  const double by_balls = between_.norm() - way - path_a_.reach() - path_b_.reach();
  const double best = std::max(by_distance, by_balls) - rounding;
  if (!std::isfinite(best)) return 0;
  return std::max(best,
                  std::max(by_plane(normal_, back, ahead), by_plane(other_, back, ahead)) - 4 * rounding);
}

}  // namespace vericone::motion
