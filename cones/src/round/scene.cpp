// SPDX-License-Identifier: BSD-3-Clause
#include "round/scene.h"

#include <vericone/internal/geometry/double_double.h>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// At most how far the ellipsoid of a shape matrix is from that of its factor, in the unit of lengths: their
/// squared radii along n differ by n^T (F F^T - S) n, and one of the radii is at least that of the factor.
double off_shape(const Matrix3d& factor, const Matrix3d& shape) {
  const double rounding = 16 * kUnitRoundoff * (factor.squaredNorm() + shape.norm());
  const double difference = (factor * factor.transpose() - shape).norm() + rounding;
  const Vector3d radii = Eigen::JacobiSVD<Matrix3d>(factor).singularValues();
  const double least = radii(2) - 16 * kUnitRoundoff * radii(0);
  return (least > 0 ? std::min(difference / least, std::sqrt(difference)) : std::sqrt(difference)) *
         (1 + 0x1p-40);
}

}  // namespace

RoundBody round_body(const Convex& body, const Vector3d& at, const Vector3d& reference) {
  RoundBody result;
  std::vector<bool> taken(body.pieces().size());
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (taken[i]) continue;
    const Convex::Piece& first = body.pieces()[i];
    RoundBody::Group group{first.factor, first.rank, static_cast<std::uint32_t>(result.center.size()), 0};
    for (std::size_t j = i; j < taken.size(); ++j) {
      const Convex::Piece& piece = body.pieces()[j];
      if (taken[j] || piece.rank != first.rank || piece.factor != first.factor || piece.shape != first.shape)
        continue;
      taken[j] = true;
      Vector3d x;
      for (int k = 0; k < 3; ++k) x(k) = sum_of_three(piece.center(k), at(k), -reference(k));
      result.center.push_back(x);
      result.reach = std::max(result.reach, x.cwiseAbs().sum() + 2 * first.factor.norm());
    }
    group.end = static_cast<std::uint32_t>(result.center.size());
    if (first.shape) result.off = std::max(result.off, off_shape(first.factor, *first.shape));
    result.groups.push_back(group);
  }
  return result;
}

namespace {

void scale_by(int exponent, RoundBody& body) {
  const double scale = std::ldexp(1.0, exponent);
  for (Vector3d& x : body.center) x *= scale;
  for (RoundBody::Group& group : body.groups) group.factor *= scale;
  body.reach *= scale;
  body.off *= scale;
}

double largest_factor(const RoundBody& body) {
  double most = 0;
  for (const RoundBody::Group& group : body.groups) most = std::max(most, group.factor.norm());
  return most;
}

/// Level discs of one radius and axis. Those of a body that is turned about its axis are rounded, by less
/// than a scene's slack.
struct Stack {
  Vector2d axis;
  double radius, low, high;
};
std::optional<Stack> stack(const RoundBody& body) {
  if (body.groups.size() != 1 || body.groups.front().rank != 2) return std::nullopt;
  const Matrix3d& f = body.groups.front().factor;
  const double radius = std::hypot(f(0, 0), f(1, 0)), rounding = 0x1p-50 * radius;
  const bool is_level = f(2, 0) == 0 && f(2, 1) == 0,
             is_round = std::abs(std::hypot(f(0, 1), f(1, 1)) - radius) <= rounding &&
                        std::abs(f(0, 0) * f(0, 1) + f(1, 0) * f(1, 1)) <= rounding * radius;
  if (!is_level || !is_round) return std::nullopt;
  const Vector3d& first = body.center.front();
  Stack result{first.head<2>(), radius, first.z(), first.z()};
  for (const Vector3d& x : body.center) {
    if (x.head<2>() != result.axis) return std::nullopt;
    result.low = std::min(result.low, x.z());
    result.high = std::max(result.high, x.z());
  }
  return result;
}

std::optional<UprightDifference> upright_difference(const RoundBody& agent, const RoundBody& obstacle) {
  const auto a = stack(agent), b = stack(obstacle);
  if (!a || !b) return std::nullopt;
  const double low = b->low - a->high, high = b->high - a->low;
  const Vector2d between = b->axis - a->axis;
  return UprightDifference{
      {between.x(), between.y(), 0.5 * (low + high)}, a->radius + b->radius, 0.5 * (high - low)};
}

Vector3d mean_center(const RoundBody& body) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& x : body.center) sum += x;
  return sum / static_cast<double>(body.center.size());
}

Interval enclosed_center(double centred) {
  return {centred, kUnitRoundoff * std::abs(centred) * Interval::kInflate + Interval::kTiny};
}

/// n.x of a centre, and |F^T n| of its group.
Interval enclosed_height(const Vector3d& center, const std::array<Interval, 3>& n) {
  return n[0] * enclosed_center(center.x()) + n[1] * enclosed_center(center.y()) +
         n[2] * enclosed_center(center.z());
}
Interval enclosed_radius(const Matrix3d& factor, int rank, const std::array<Interval, 3>& n) {
  Interval sum = 0;
  for (int j = 0; j < rank; ++j) {
    Interval back = 0;
    for (int k = 0; k < 3; ++k) back = back + Interval(factor(k, j), Interval::kTiny) * n[k];
    sum = sum + square(back);
  }
  return sqrt(sum);
}

/// At least the largest n.x over the body.
double enclosed_most(const RoundBody& body, const std::array<Interval, 3>& n) {
  double most = -std::numeric_limits<double>::infinity();
  for (const RoundBody::Group& group : body.groups) {
    const Interval own = group.rank > 0 ? enclosed_radius(group.factor, group.rank, n) : Interval(0);
    for (std::uint32_t i = group.first; i < group.end; ++i) {
      const Interval value = enclosed_height(body.center[i], n) + own;
      if (!value.finite()) return std::numeric_limits<double>::infinity();
      most = std::max(most, value.hi());
    }
  }
  return most;
}

}  // namespace

RoundScene::RoundScene(Convex agent_body, const Vector3d& a_at, Convex obstacle_body, const Vector3d& b_at)
    : given_agent(std::move(agent_body)),
      given_obstacle(std::move(obstacle_body)),
      agent_at(a_at),
      obstacle_at(b_at) {
  reference = given_agent.pieces().front().center + agent_at;
  agent = round_body(given_agent, agent_at, reference);
  obstacle = round_body(given_obstacle, obstacle_at, reference);
  margin = given_agent.margin() + given_obstacle.margin();
  const double largest = agent.reach + obstacle.reach + 4 * margin;
  usable = largest > 0x1p-400 && largest < 0x1p400;
  if (!usable) return;
  exponent = std::ilogb(largest) + 1;
  scale_by(-exponent, agent);
  scale_by(-exponent, obstacle);
  margin = std::ldexp(margin, -exponent);
  obstacle_margin = std::ldexp(given_obstacle.margin(), -exponent);
  middle_obstacle = mean_center(obstacle);
  middle = middle_obstacle - mean_center(agent);
  size = (agent.reach + obstacle.reach + 2 * margin) * (1 + 0x1p-40);
  // Centres are rounded once, three products and five sums of them in a value; the sums of the middle have as
  // many terms as there are. All else is of the size of the pieces themselves.
  const double terms = 16 + static_cast<double>(agent.center.size() + obstacle.center.size());
  const double of_pieces = 64 * (largest_factor(agent) + largest_factor(obstacle) + margin);
  slack =
      ((terms * size + of_pieces) * kUnitRoundoff + 2 * (agent.off + obstacle.off)) * (1 + 0x1p-40) + 1e-250;
  if (margin == 0) upright = upright_difference(agent, obstacle);
}

double RoundScene::enclosed_least(const std::array<Interval, 3>& n) const noexcept {
  const std::array<Interval, 3> back{-n[0], -n[1], -n[2]};
  const Interval length = sqrt(square(n[0]) + square(n[1]) + square(n[2]));
  const Interval beside = length * Interval(margin * (1 + 4 * kUnitRoundoff) + agent.off + obstacle.off);
  const Interval most = Interval(enclosed_most(agent, n)) + Interval(enclosed_most(obstacle, back)) + beside;
  return most.finite() ? -most.hi() : -std::numeric_limits<double>::infinity();
}

std::array<Interval, 3> RoundScene::enclosed_point(const Vector3d& n) const noexcept {
  const RoundSupport support = least(n);
  std::array<Interval, 3> x{0, 0, 0};
  const auto add = [&](const RoundBody& body, const RoundBody::Farthest& farthest, double sign) {
    const Vector3d v = RoundBody::direction(farthest);
    const RoundBody::Group& group = body.groups[farthest.group];
    for (int k = 0; k < 3; ++k) {
      Interval own = enclosed_center(body.center[farthest.at](k));
      for (int j = 0; j < group.rank; ++j)
        own = own + Interval(group.factor(k, j), Interval::kTiny) * Interval(v(j));
      x[k] = x[k] + Interval(sign) * own + Interval(0, body.off);
    }
  };
  add(obstacle, support.obstacle, 1);
  add(agent, support.agent, -1);
  if (margin > 0) {
    const Vector3d v = n * ((1 - 0x1p-49) / n.norm());
    for (int k = 0; k < 3; ++k) x[k] = x[k] - Interval(margin * (1 - 4 * kUnitRoundoff)) * Interval(v(k));
  }
  return x;
}

std::array<Interval, 3> RoundScene::enclosed_middle() const noexcept {
  std::array<Interval, 3> x;
  for (int k = 0; k < 3; ++k) x[k] = Interval(middle(k), slack);
  return x;
}

}  // namespace vericone
