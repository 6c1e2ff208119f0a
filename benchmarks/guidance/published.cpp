// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/guidance/published.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace vericone::published {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

Vector2d turned(const Vector2d& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// The point of half-planes and a disc of velocities nearest to the wanted one, one half-plane after the
/// other: where a new one is violated, the answer is on its edge. Nothing where they leave nothing.
std::optional<Vector2d> nearest_allowed(std::span<const HalfPlane> all, const Vector2d& wanted,
                                        double fastest) {
  Vector2d v = wanted.norm() > fastest ? Vector2d(wanted * (fastest / wanted.norm())) : wanted;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const HalfPlane& edge = all[i];
    if (edge.normal.dot(v - edge.point) >= 0) continue;
    const Vector2d along(-edge.normal.y(), edge.normal.x());
    // point + s along, within the disc and the half-planes before this one.
    const double middle = -edge.point.dot(along), away = edge.normal.dot(edge.point);
    const double half = std::sqrt(std::max(0.0, fastest * fastest - away * away));
    if (std::abs(away) > fastest) return std::nullopt;
    double low = middle - half, high = middle + half;
    for (std::size_t k = 0; k < i; ++k) {
      const double slope = all[k].normal.dot(along), room = all[k].normal.dot(edge.point - all[k].point);
      if (std::abs(slope) < 1e-12) {
        if (room < 0) return std::nullopt;
        continue;
      }
      (slope > 0 ? low : high) = slope > 0 ? std::max(low, -room / slope) : std::min(high, -room / slope);
    }
    if (low > high) return std::nullopt;
    v = edge.point + std::clamp((wanted - edge.point).dot(along), low, high) * along;
  }
  return v;
}

}  // namespace

double time_to_touch(const Disc& agent, const Vector2d& v, const Disc& other) {
  const Vector2d c = other.position - agent.position, w = v - other.velocity;
  const double radius = agent.radius + other.radius, square = w.squaredNorm(), along = c.dot(w);
  const double apart = c.squaredNorm() - radius * radius;
  if (apart <= 0) return 0;
  const double root = along * along - square * apart;
  if (along <= 0 || root < 0) return kInfinity;
  return apart / (along + std::sqrt(root));
}

HalfPlane orca_half_plane(const Disc& agent, const Disc& other, double until, double share) {
  // The velocities that touch: a cone with its tip cut off by the disc about c / until.
  const Vector2d c = other.position - agent.position, w = agent.velocity - other.velocity;
  const double radius = agent.radius + other.radius, distance = c.norm();
  const Vector2d from_disc = w - c / until;
  Vector2d normal, change;  // outwards, and what brings w to the nearest point of the boundary
  const double towards = from_disc.dot(c);
  if (distance <= radius || (towards < 0 && towards * towards > radius * radius * from_disc.squaredNorm())) {
    normal = from_disc.normalized();
    change = (radius / until - from_disc.norm()) * normal;
  } else {
    // The leg on the side of w.
    const double side = cross(c, from_disc) > 0 ? 1 : -1;
    const Vector2d leg = turned(c / distance, side * std::asin(radius / distance));
    normal = side * Vector2d(-leg.y(), leg.x());
    change = -w.dot(normal) * normal;
  }
  return {agent.velocity + share * change, normal};
}

std::optional<Vector2d> orca(const Decision& decision, Vector2d* least_violation) {
  std::vector<HalfPlane> all;
  for (const Disc& other : decision.others)
    all.push_back(orca_half_plane(decision.agent, other, decision.until, 1));
  const auto found = nearest_allowed(all, decision.wanted, decision.fastest);
  if (found || !least_violation) return found;
  // The least by which all have to be moved out so that something is left.
  double low = 0, high = 4 * decision.fastest + 1;
  for (const HalfPlane& one : all) high = std::max(high, 2 * one.point.norm());
  for (int i = 0; i < 60; ++i) {
    const double moved = 0.5 * (low + high);
    std::vector<HalfPlane> wider = all;
    for (HalfPlane& one : wider) one.point -= moved * one.normal;
    const auto v = nearest_allowed(wider, decision.wanted, decision.fastest);
    (v ? high : low) = moved;
    if (v) *least_violation = *v;
  }
  return std::nullopt;
}

std::optional<Vector2d> dynamic_window(const Decision& decision, bool moving) {
  constexpr int kSpeeds = 20, kTurns = 90;
  constexpr double kHeading = 0.8, kDistance = 0.1, kSpeed = 0.1, kBraking = 2;  // the last m/s^2
  const double wanted = decision.wanted.norm();
  const Vector2d ahead = decision.wanted / wanted;
  double best = -kInfinity;
  std::optional<Vector2d> chosen;
  for (int i = 1; i <= kSpeeds; ++i)
    for (int k = -kTurns; k <= kTurns; ++k) {
      const double speed = wanted * i / kSpeeds, turn = std::numbers::pi / 180 * k;
      const Vector2d v = speed * turned(ahead, turn);
      double time = decision.until;
      for (Disc other : decision.others) {
        if (!moving) other.velocity.setZero();
        time = std::min(time, time_to_touch(decision.agent, v, other));
      }
      const double distance = time * speed;
      if (speed > std::sqrt(2 * kBraking * distance)) continue;  // could not stop before it
      const double value = kHeading * (1 - std::abs(turn) / std::numbers::pi) +
                           kDistance * time / decision.until + kSpeed * speed / wanted;
      if (value > best) {
        best = value;
        chosen = v;
      }
    }
  return chosen;
}

std::optional<Vector2d> heading_grid(const Decision& decision, double step_degrees) {
  const int half = static_cast<int>(180 / step_degrees);
  for (int k = 0; k <= half; ++k)
    for (const int side : {1, -1}) {
      const Vector2d v = turned(decision.wanted, side * k * step_degrees * std::numbers::pi / 180);
      const bool conflict = std::any_of(
          decision.others.begin(), decision.others.end(),
          [&](const Disc& other) { return time_to_touch(decision.agent, v, other) <= decision.until; });
      if (!conflict) return v;
    }
  return std::nullopt;
}

}  // namespace vericone::published
