// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/frame.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/double_double.h>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vericone::assembly {
namespace {

/// Points that are looked through one by one; more are sought in a hierarchy.
constexpr std::size_t kFew = 48;

}  // namespace

Frame::Frame(const Ellipsoid& agent, const Place& place) {
  // Through numbers of ordinary size, which leave room for squares and determinants.
  const double unit = std::exp2(-std::ilogb(agent.factor().cwiseAbs().maxCoeff()));
  const Eigen::Matrix3d factor = agent.factor() * unit, shape = (agent.shape() * unit) * unit;
  const Eigen::Matrix3d inverse = factor.inverse();
  to_frame_ = inverse * unit;
  norm_ = inverse.norm() * unit * (1 + 16 * kUlp);
  // G S G^T = 1 + D; the squared length of a point of E's surface along n is nᵀ(1 + D)n.
  Eigen::Matrix3d deviation;
  double rounding;
  if (agent.defined_by_factor()) {
    const Eigen::Matrix3d product = inverse * factor;
    deviation = product * product.transpose() - Eigen::Matrix3d::Identity();
    rounding = 32 * kUlp * inverse.norm() * factor.norm();
  } else {
    deviation = inverse * shape * inverse.transpose() - Eigen::Matrix3d::Identity();
    rounding = 32 * kUlp * inverse.squaredNorm() * shape.norm();
  }
  const double off = deviation.norm() + rounding;
  if (!(off < 0.01))
    throw InputError("agent",
                     "semi-axes " + to_text(agent.semi_axes()(0)) + " to " + to_text(agent.semi_axes()(2)),
                     agent.defined_by_factor() ? "a body whose matrix can be inverted (axis ratio below 1e12)"
                                               : "a body whose shape can be inverted (axis ratio below 1e6; "
                                                 "thinner ones from semi_axes)");
  round_ = true;
  is_space_ = false;
  from_frame_ = agent.factor();
  outer_ = ball_ = std::sqrt(1 + off) * (1 + 4 * kUlp);
  inner_ = std::sqrt(1 - off) * (1 - 4 * kUlp);
  for (int k = 0; k < 3; ++k)
    reach_(k) = std::sqrt(agent.shape()(k, k)) * (1 + 8 * kUlp) + off * std::sqrt(agent.shape()(k, k));
  set_origin(agent.center(), place);
}

void Frame::set_origin(const Eigen::Vector3d& x, const Place& place) {
  origin_ = x;
  if (place.agent.isZero(0) && place.obstacle.isZero(0)) return;
  double rest = 0, last = 0;
  for (int k = 0; k < 3; ++k) {
    // x + agent - obstacle as three parts, each about a rounding of the one before.
    const DoubleDouble s = DoubleDouble::two_sum(x(k), place.agent(k)),
                       t = DoubleDouble::two_sum(s.hi, -place.obstacle(k)),
                       low = DoubleDouble::two_sum(t.lo, s.lo), high = DoubleDouble::two_sum(t.hi, low.hi),
                       tail = DoubleDouble::two_sum(high.lo, low.lo);
    origin_(k) = high.hi;
    rest_(k) = tail.hi;
    rest += std::abs(tail.hi) + std::abs(tail.lo);
    last += std::abs(tail.lo);
  }
  beyond_range_ = norm_ * last * (1 + 8 * kUlp);
  off_origin_ = norm_ * rest * (1 + 8 * kUlp);
}

Frame Frame::in_space(const Ellipsoid& agent, const Place& place) {
  const Frame round(agent);
  Frame frame(HullBody({agent.center()}), place);
  frame.points_.clear();
  frame.factor_ = agent.factor();
  frame.reach_ = round.reach_;
  // A ball is a point with a radius: no search has to find its curved surface.
  const Eigen::Vector3d axes = agent.semi_axes();
  if (axes(0) - axes(2) <= 1e-13 * axes(0)) {
    frame.round_ = true;
    frame.outer_ = frame.ball_ = axes(0) * round.outer_ * (1 + 64 * kUlp);
    frame.inner_ = axes(2) * round.inner_ * (1 - 64 * kUlp);
    return frame;
  }
  frame.ball_ = agent.factor().norm() * round.outer_ * (1 + 8 * kUlp);
  frame.support_error_ = (round.outer_ - 1 + 16 * kUlp) * agent.factor().norm();
  return frame;
}

void Frame::check_range(double largest) {
  constexpr double kLeast = 1e-100, kMost = 1e100;
  const double size = largest + ball_;
  const bool within =
      size > kLeast && size < kMost && norm_ > kLeast && norm_ < kMost && norm_ * size < kMost;
  if (!within) beyond_range_ = std::numeric_limits<double>::infinity();
}

Eigen::Vector3d Frame::support(const Eigen::Vector3d& n) const {
  if (convex_) return convex_->point(convex_->farthest(n));
  if (points_.empty()) {
    const Eigen::Vector3d back = factor_.transpose() * n;
    const double length = back.norm();
    return length > 0 ? Eigen::Vector3d(factor_ * (back / length)) : Eigen::Vector3d::Zero();
  }
  if (!hierarchy_.nodes().empty()) return farthest_of_many(n);
  std::size_t best = 0;
  double most = n.dot(points_[0]);
  for (std::size_t i = 1; i < points_.size(); ++i)
    if (const double value = n.dot(points_[i]); value > most) {
      most = value;
      best = i;
    }
  return points_[best];
}

Eigen::Vector3d Frame::farthest_of_many(const Eigen::Vector3d& n) const {
  const auto nodes = hierarchy_.nodes();
  const Eigen::Vector3d size = n.cwiseAbs();
  const auto most_in = [&](const Hierarchy::Node& node) {
    const Box box = node.box();
    return n.dot(box.center()) + size.dot(box.half_widths());
  };
  struct Item {
    std::uint32_t node;
    double most;
  };
  std::array<Item, 128> stack;
  std::size_t count = 0;
  std::uint32_t best = 0;
  double most = n.dot(points_[0]);
  stack[count++] = {0, most_in(nodes[0])};
  while (count > 0) {
    const Item item = stack[--count];
    if (item.most <= most) continue;
    const Hierarchy::Node& node = nodes[item.node];
    if (node.is_leaf()) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        if (const double value = n.dot(points_[i]); value > most) {
          most = value;
          best = i;
        }
      continue;
    }
    const Item first{node.first, most_in(nodes[node.first])},
        second{node.first + 1, most_in(nodes[node.first + 1])};
    stack[count++] = first.most < second.most ? first : second;
    stack[count++] = first.most < second.most ? second : first;
  }
  return points_[best];
}

Frame::Frame(const HullBody& agent, const Place& place) {
  Eigen::Vector3d low = agent.points().front(), high = low;
  for (const Eigen::Vector3d& a : agent.points()) {
    low = low.cwiseMin(a);
    high = high.cwiseMax(a);
  }
  const Eigen::Vector3d middle = 0.5 * low + 0.5 * high;
  points_.reserve(agent.size());
  for (const Eigen::Vector3d& a : agent.points()) {
    points_.push_back(a - middle);
    reach_ = reach_.cwiseMax(points_.back().cwiseAbs());
    ball_ = std::max(ball_, points_.back().norm());
  }
  reach_ *= 1 + 4 * kUlp;
  ball_ *= 1 + 8 * kUlp;
  if (points_.size() > kFew) {
    std::vector<Box> boxes;
    boxes.reserve(points_.size());
    for (const Eigen::Vector3d& a : points_) boxes.push_back({a, a});
    hierarchy_ = Hierarchy(boxes);
    std::vector<Eigen::Vector3d> by_slot;
    by_slot.reserve(points_.size());
    for (const std::uint32_t i : hierarchy_.order()) by_slot.push_back(points_[i]);
    points_ = std::move(by_slot);
  }
  norm_ = std::sqrt(3.0) * (1 + 4 * kUlp);
  set_origin(middle, place);
}

Frame::Frame(const Convex& agent, const Place& place) {
  const bool points = std::all_of(agent.pieces().begin(), agent.pieces().end(),
                                  [](const Convex::Piece& piece) { return piece.rank == 0; });
  if (points) {
    std::vector<Eigen::Vector3d> centers;
    for (const Convex::Piece& piece : agent.pieces()) centers.push_back(piece.center);
    *this = Frame(HullBody(std::move(centers)), place);
  } else {
    const Box bounds = agent.bounds();
    const Eigen::Vector3d middle = 0.5 * bounds.low + 0.5 * bounds.high;
    convex_ = std::make_shared<RoundBody>(round_body(agent, Eigen::Vector3d::Zero(), middle));
    ball_ = convex_->reach + convex_->off;
    support_error_ = (32 * kUlp * ball_ + 2 * convex_->off) * (1 + 8 * kUlp);
    for (int k = 0; k < 3; ++k)
      for (const double side : {-1.0, 1.0}) {
        const Eigen::Vector3d n = side * Eigen::Vector3d::Unit(k);
        reach_(k) = std::max(reach_(k), convex_->farthest(n).value + support_error_);
      }
    norm_ = std::sqrt(3.0) * (1 + 4 * kUlp);
    set_origin(middle, place);
  }
  // A margin is what it is rounded by.
  inner_ = outer_ = agent.margin();
  ball_ = (ball_ + outer_) * (1 + 8 * kUlp);
  reach_ = (reach_.array() + outer_) * (1 + 8 * kUlp);
}

Directions::Directions(const Frame& frame, std::initializer_list<Eigen::Vector3d> rays_in_space) {
  for (const Eigen::Vector3d& d : rays_in_space) {
    // Scaled first: velocities of any size are directions.
    const double largest = d.cwiseAbs().maxCoeff();
    const Eigen::Vector3d scaled = d / largest;
    const Eigen::Vector3d mapped = frame.to_frame() * scaled;
    const double norm = mapped.norm();
    length[count] = norm * largest;
    error = std::max(error, frame.error(scaled.norm()) / norm + 8 * kUlp);
    ray[count] = mapped / norm;
    middle += ray[count];
    ++count;
  }
  if (count == 0) return;
  middle.normalize();
  for (int i = 0; i < count; ++i) least_cosine = std::min(least_cosine, middle.dot(ray[i]) - error);
}

}  // namespace vericone::assembly
