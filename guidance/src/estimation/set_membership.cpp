// SPDX-License-Identifier: BSD-3-Clause
//
// Rounding: the true set lies within `corners_` moved by `slack_`. Every step computes new corners with an
// error of a few units in the last place of the numbers involved, and adds that to the slack. Nothing has to
// be rounded corner by corner.
#include <vericone/guidance/estimation/filters.h>
#include <vericone/internal/geometry/requires.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone::guidance {
namespace {

using Point = PossibleMotion::Point;

constexpr std::size_t kMostCorners = 24;
constexpr double kUnit =
    std::numeric_limits<double>::epsilon();  // two half-units: covers a rounding and more

double cross(const Point& o, const Point& a, const Point& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

/// The convex hull, counter-clockwise (Andrew's monotone chain). A corner that rounding drops lies within a
/// few units of the hull, which the caller's slack covers.
std::vector<Point> hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Point> chain(2 * points.size());
  std::size_t n = 0;
  for (const Point& p : points) {
    while (n >= 2 && cross(chain[n - 2], chain[n - 1], p) <= 0) --n;
    chain[n++] = p;
  }
  for (std::size_t i = points.size() - 1, first = n + 1; i-- > 0;) {
    while (n >= first && cross(chain[n - 2], chain[n - 1], points[i]) <= 0) --n;
    chain[n++] = points[i];
  }
  chain.resize(n - 1);
  return chain;
}

Point largest(const std::vector<Point>& points) {
  Point most = Point::Zero();
  for (const Point& p : points) most = most.cwiseMax(p.cwiseAbs());
  return most;
}

double up(double x) { return x + kUnit * std::abs(x) + std::numeric_limits<double>::denorm_min(); }
double down(double x) { return -up(-x); }

}  // namespace

PossibleMotion::PossibleMotion(const Bounds& position, const Bounds& velocity)
    : corners_(hull({{position.low, velocity.low},
                     {position.high, velocity.low},
                     {position.high, velocity.high},
                     {position.low, velocity.high}})) {}

void PossibleMotion::advance(double dt, double most) {
  if (!(dt > 0)) return;
  // The shear (p, v) -> (p + dt v, v): positions move with the slack in velocity as well.
  slack_.x() = up(slack_.x() + dt * slack_.y());
  for (Point& corner : corners_) corner.x() += dt * corner.y();
  if (most > 0) {
    // Two segments: (dt/2, 1) s with |s| <= most dt, and (1, 0) s with |s| <= most dt^2 / 4.
    const double dv = up(most * dt), dp = up(0.25 * most * dt * dt);
    std::vector<Point> sum;
    sum.reserve(4 * corners_.size());
    for (const Point& corner : corners_)
      for (const double along : {-1.0, 1.0})
        for (const double aside : {-1.0, 1.0})
          sum.push_back({corner.x() + along * 0.5 * dt * dv + aside * dp, corner.y() + along * dv});
    corners_ = hull(std::move(sum));
  }
  const Point size = largest(corners_);
  slack_.x() = up(slack_.x() + 64 * kUnit * (size.x() + dt * size.y()));
  slack_.y() = up(slack_.y() + 64 * kUnit * size.y());
  if (corners_.size() > kMostCorners) simplify();
}

/// Cuts off what has sign * coordinate > bound.
void PossibleMotion::keep_below(std::vector<Point>& polygon, int axis, double sign, double bound) {
  std::vector<Point> kept;
  kept.reserve(polygon.size() + 2);
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % n];
    const double at_p = sign * p[axis] - bound, at_q = sign * q[axis] - bound;
    if (at_p <= 0) kept.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
      // On the edge between p and q, at the bound: off it by the rounding of one interpolation.
      const double part = std::clamp(at_p / (at_p - at_q), 0.0, 1.0);
      Point cut = p + part * (q - p);
      cut[axis] = sign * bound;
      kept.push_back(cut);
    }
  }
  polygon = std::move(kept);
}

bool PossibleMotion::meet(const Bounds& position, const Bounds& velocity) {
  // Where a point of the polygon, moved by the slack, is within the bounds, the point itself is within the
  // bounds moved by the slack.
  std::vector<Point> polygon = corners_;
  keep_below(polygon, 0, 1, up(position.high + slack_.x()));
  if (!polygon.empty()) keep_below(polygon, 0, -1, up(slack_.x() - position.low));
  if (!polygon.empty()) keep_below(polygon, 1, 1, up(velocity.high + slack_.y()));
  if (!polygon.empty()) keep_below(polygon, 1, -1, up(slack_.y() - velocity.low));
  if (polygon.empty()) return false;
  const Point size = largest(corners_);
  slack_.x() = up(slack_.x() + 64 * kUnit * size.x());
  slack_.y() = up(slack_.y() + 64 * kUnit * size.y());
  corners_ = hull(std::move(polygon));
  if (corners_.size() > kMostCorners) simplify();
  return true;
}

/// The polygon of sixteen supporting lines around it, their directions even where the set is as wide as it is
/// high: at most a fiftieth wider.
void PossibleMotion::simplify() {
  constexpr int kLines = 16;
  const Bounds p = position(), v = velocity();
  const Point middle(p.middle(), v.middle()),
      size(std::max(0.5 * (p.high - p.low), 1e-300), std::max(0.5 * (v.high - v.low), 1e-300));
  std::array<double, kLines> reach{};
  std::array<Point, kLines> normal;
  for (std::size_t i = 0; i < kLines; ++i) {
    const double angle = 2 * std::numbers::pi * double(i) / kLines;
    normal[i] = {std::cos(angle), std::sin(angle)};
    reach[i] = -std::numeric_limits<double>::infinity();
    for (const Point& corner : corners_)
      reach[i] = std::max(reach[i], normal[i].dot((corner - middle).cwiseQuotient(size)));
  }
  std::vector<Point> around;
  for (std::size_t i = 0; i < kLines; ++i) {
    const std::size_t j = (i + 1) % kLines;
    const double det = normal[i].x() * normal[j].y() - normal[i].y() * normal[j].x();
    const Point scaled((reach[i] * normal[j].y() - reach[j] * normal[i].y()) / det,
                       (normal[i].x() * reach[j] - normal[j].x() * reach[i]) / det);
    around.push_back(middle + scaled.cwiseProduct(size));
  }
  const Point most = largest(around);
  slack_.x() = up(slack_.x() + 128 * kUnit * most.x());
  slack_.y() = up(slack_.y() + 128 * kUnit * most.y());
  corners_ = hull(std::move(around));
}

Bounds PossibleMotion::position() const { return position_after(0); }

Bounds PossibleMotion::velocity() const {
  Bounds bounds{corners_.front().y(), corners_.front().y()};
  for (const Point& corner : corners_) {
    bounds.low = std::min(bounds.low, corner.y());
    bounds.high = std::max(bounds.high, corner.y());
  }
  return {down(bounds.low - slack_.y()), up(bounds.high + slack_.y())};
}

Bounds PossibleMotion::position_after(double t) const {
  Bounds bounds{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Point& corner : corners_) {
    const double ahead = corner.x() + t * corner.y(),
                 rounding = t > 0 ? 2 * kUnit * (std::abs(corner.x()) + t * std::abs(corner.y())) : 0;
    bounds.low = std::min(bounds.low, ahead - rounding);
    bounds.high = std::max(bounds.high, ahead + rounding);
  }
  const double slack = up(slack_.x() + t * slack_.y());
  return {down(bounds.low - slack), up(bounds.high + slack)};
}

bool PossibleMotion::contains(double position, double velocity) const {
  // The pair, moved by the slack, meets the polygon: no edge has all four corners of that box outside.
  const auto within = [](const Bounds& b, double x) { return b.low <= x && x <= b.high; };
  if (!within(this->position(), position) || !within(this->velocity(), velocity)) return false;
  const Point at(position, velocity);
  const std::size_t n = corners_.size();
  for (std::size_t i = 0; n > 1 && i < n; ++i) {
    const Point &p = corners_[i], &q = corners_[(i + 1) % n];
    const Point outward(q.y() - p.y(), p.x() - q.x());
    const double beyond = outward.dot(at - p), allowed = outward.cwiseAbs().dot(slack_);
    const double rounding = 8 * kUnit * outward.cwiseAbs().dot(at.cwiseAbs() + p.cwiseAbs());
    if (beyond > allowed + rounding) return false;
  }
  return true;
}

bool SetMembershipFilter::step(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
                               const Eigen::Vector3d& position_error, const Eigen::Vector3d& velocity_error,
                               double time) {
  const auto around = [](double x, double error) { return Bounds{down(x - error), up(x + error)}; };
  const auto measured = [&](int i) {
    return PossibleMotion(around(position[i], position_error[i]), around(velocity[i], velocity_error[i]));
  };
  if (!axes_) {
    axes_ = std::array<PossibleMotion, 3>{measured(0), measured(1), measured(2)};
    time_ = time;
    return true;
  }
  const double dt = time - time_;
  time_ = time;
  std::array<PossibleMotion, 3> next = *axes_;
  bool possible = true;
  for (int i = 0; i < 3 && possible; ++i) {
    PossibleMotion& axis = next[std::size_t(i)];
    axis.advance(up(dt), most_);
    possible = axis.meet(around(position[i], position_error[i]), around(velocity[i], velocity_error[i]));
  }
  if (possible)
    axes_ = std::move(next);
  else
    axes_ = std::array<PossibleMotion, 3>{measured(0), measured(1), measured(2)};
  return possible;
}

namespace {
template <typename Of>
Eigen::Vector3d each_axis(Of of) {
  return {of(0), of(1), of(2)};
}
/// Half the width about the middle as it is rounded.
double radius(const Bounds& b) { return up(std::max(up(b.high - b.middle()), up(b.middle() - b.low))); }
}  // namespace

Eigen::Vector3d SetMembershipFilter::position() const {
  VERICONE_REQUIRES(started(), "filter", "no measurement", "one that has met a measurement");
  return each_axis([&](int i) { return axis(i).position().middle(); });
}
Eigen::Vector3d SetMembershipFilter::velocity() const {
  VERICONE_REQUIRES(started(), "filter", "no measurement", "one that has met a measurement");
  return each_axis([&](int i) { return axis(i).velocity().middle(); });
}
Eigen::Vector3d SetMembershipFilter::position_radius() const {
  VERICONE_REQUIRES(started(), "filter", "no measurement", "one that has met a measurement");
  return each_axis([&](int i) { return radius(axis(i).position()); });
}
Eigen::Vector3d SetMembershipFilter::velocity_radius() const {
  VERICONE_REQUIRES(started(), "filter", "no measurement", "one that has met a measurement");
  return each_axis([&](int i) { return radius(axis(i).velocity()); });
}

}  // namespace vericone::guidance
