// SPDX-License-Identifier: BSD-3-Clause
#include "bands/threats.h"

#include <vericone/internal/geometry/rotation.h>
#include <algorithm>

namespace vericone::guidance::banding {

using Eigen::Vector3d;

namespace {

/// An ellipsoid within a part.
std::optional<Placed> core_of(const Placed& convex, const std::optional<Placed>& delimited) {
  if (!delimited) return convex;
  const auto inside = delimited->body.quadric()->inscribed_ellipsoid();
  return inside ? std::optional(Placed(*inside, delimited->pose)) : std::nullopt;
}

/// A body that a convex one and a ball of that radius around each of its points contain.
Placed swollen(const Placed& body, double radius) {
  if (const auto* quadric = body.body.quadric()) {
    const Ellipsoid& e = quadric->ellipsoid();
    Eigen::Matrix3d axes = e.axis_directions();
    if (axes.determinant() < 0) axes.col(0) *= -1;
    const Vector3d longer = e.semi_axes() + Vector3d::Constant(radius * (1 - 1e-12));
    return {Ellipsoid::from_axes(e.center(), longer, axes), body.pose};
  }
  if (const auto* convex = body.body.convex()) return {convex->swollen(radius * (1 - 1e-12)), body.pose};
  std::vector<Vector3d> points;
  for (const Vector3d& x : body.body.hull()->points())
    for (int k = 0; k < 3; ++k)
      for (const double side : {-1.0, 1.0})
        points.push_back(x + side * radius * (1 - 1e-12) * Vector3d::Unit(k));
  return {HullBody(std::move(points)), body.pose};
}

}  // namespace

Threats::Threats(const Placed& agent, std::span<const Intruder> intruders, double margin)
    : intruders_(intruders), margin_(margin) {
  // Of those that are out of reach nobody asks later: is_upright() throws where a pose is none.
  static_cast<void>(is_upright(agent.pose));
  for (const Intruder& intruder : intruders) static_cast<void>(is_upright(intruder.body.pose));
  own_ = convex_parts(agent);
  for (const Intruder& intruder : intruders) {
    Kept& kept = kept_.emplace_back();
    kept.tree = intruder.body.body.assembly();
    if (!kept.tree) kept.flat = convex_parts(intruder.body);
  }
}

double Threats::fastest() const {
  double most = 0;
  for (const Intruder& intruder : intruders_) most = std::max(most, intruder.velocity.norm());
  return most;
}

Threats::Ball Threats::ball_about(const Placed& part) {
  Vector3d center;
  double square = 0;
  if (const auto* quadric = part.body.quadric()) {
    center = quadric->ellipsoid().center();
    square = quadric->ellipsoid().factor().squaredNorm();  // the sum of its semi-axes' squares
  } else if (const auto* convex = part.body.convex()) {
    const Box bounds = part.body.bounds();
    center = bounds.center();
    double radius = 0;
    for (const auto& piece : convex->pieces())
      radius = std::max(radius, (piece.center - center).norm() + piece.factor.norm());
    radius = std::min(radius + convex->margin(), bounds.half_widths().norm());
    square = radius * radius;
  } else {
    center = part.body.bounds().center();
    for (const Vector3d& x : part.body.hull()->points())
      square = std::max(square, (x - center).squaredNorm());
  }
  const double rounded = 0x1p-48 * (center.norm() + part.pose.position.norm());
  return {part.pose.to_world(center), std::sqrt(square) * (1 + 0x1p-48) + rounded};
}

std::vector<Threats::Convex> Threats::convex_parts(const Placed& body) {
  std::vector<Convex> parts;
  for_each_part(body, [&](const Placed& part, const std::optional<Placed>& delimited) {
    parts.push_back({part, delimited, ball_about(part)});
  });
  return parts;
}

Threats::Ball Threats::ball_about(const Hierarchy::Node& node, const Pose& pose) {
  const Box box = node.box();
  const Vector3d center = box.center();
  const double rounded = 0x1p-48 * (center.norm() + pose.position.norm());
  return {pose.to_world(center), box.half_widths().norm() * (1 + 0x1p-48) + rounded};
}

std::vector<Threats::Piece> Threats::all() const {
  std::vector<Piece> pieces;
  for (std::uint32_t k = 0; k < own_.size(); ++k)
    for (std::uint32_t j = 0; j < kept_.size(); ++j) {
      for (std::uint32_t i = 0; i < kept_[j].flat.size(); ++i) pieces.push_back({k, j, i, false});
      if (kept_[j].tree) pieces.push_back({k, j, 0, true});
    }
  return pieces;
}

Threats::Apart Threats::apart(const Piece& piece) const {
  const Kept& kept = kept_[piece.intruder];
  const Placed& body = intruders_[piece.intruder].body;
  const Ball ball = [&] {
    if (piece.is_node) return ball_about(kept.tree->hierarchy().nodes()[piece.index], body.pose);
    return kept.tree ? ball_about(piece_of(body, kept.tree->hierarchy().order()[piece.index]))
                     : kept.flat[piece.index].ball;
  }();
  const Ball& own = own_[piece.own].ball;
  return {ball.center - own.center, (ball.radius + own.radius + margin_) * (1 + 0x1p-48)};
}

std::size_t Threats::part(std::size_t own, std::size_t intruder, std::size_t i) {
  const auto [found, is_new] =
      known_.try_emplace((own * intruders_.size() + intruder) << 32 | i, parts_.size());
  if (!is_new) return found->second;
  const Kept& kept = kept_[intruder];
  const Placed& body = intruders_[intruder].body;
  const auto add = [&](const Placed& other, const std::optional<Placed>& delimited, const Ball& ball) {
    const Convex& agent = own_[own];
    Part& part = parts_.emplace_back(part_of(own, other, intruder, ball));
    // Of the two that which is swollen exactly.
    const bool exactly = other.body.convex() && !agent.body.body.convex();
    if (margin_ > 0 && exactly) part.inner.emplace(agent.body, swollen(other, margin_));
    if (margin_ > 0 && !exactly) part.inner.emplace(swollen(agent.body, margin_), other);
    if (!agent.delimited && !delimited) return;
    part.truth.emplace(agent.delimited.value_or(agent.body), delimited.value_or(other));
    const auto core = core_of(agent.body, agent.delimited), other_core = core_of(other, delimited);
    if (core && other_core) part.core.emplace(margin_ > 0 ? swollen(*core, margin_) : *core, *other_core);
  };
  if (kept.tree) {
    const Placed piece = piece_of(body, kept.tree->hierarchy().order()[i]);
    add(piece, std::nullopt, ball_about(piece));
  } else {
    const Convex& one = kept.flat[i];
    add(one.body, one.delimited, one.ball);
  }
  return found->second;
}

}  // namespace vericone::guidance::banding
