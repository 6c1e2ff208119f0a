// SPDX-License-Identifier: BSD-3-Clause
//
// What bodies in the way are made of, down to convex parts, found by balls about them: only where a ball may
// be met is anything prepared.
#pragma once

#include <vericone/cones/pair.h>
#include <vericone/guidance/bands.h>
#include <deque>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "bands/parts.h"

namespace vericone::guidance::banding {

/// A convex part of the agent and one of an intruder. `inner`: the agent's with less than the margin around
/// it; what meets that comes nearer than the margin. Of a body with delimiters `pair` is of its ellipsoid;
/// `truth` is of the bodies as they are, and `core` of ellipsoids within them, with the same around the
/// agent's.
struct Part {
  Pair pair;
  std::optional<Pair> inner, truth, core;
  Eigen::Vector3d velocity;
  std::size_t intruder;
  Eigen::Vector3d apart;  // m, between balls about them
  double reach;           // m, of both balls and the margin

  bool exact() const { return !truth; }  // they are what the bodies are, not more
  const Pair& swollen() const { return inner ? *inner : pair; }
  /// What single flights are asked of.
  const Pair& as_it_is() const { return truth ? *truth : pair; }
};

class Threats {
 public:
  Threats(const Placed& agent, std::span<const Intruder> intruders, double margin);

  /// Of an agent that flies at a velocity over ground, up to `beside` metres beside that way, use(i) of every
  /// part [i] that may come nearer than the margin before `until`, s.
  template <typename Use>
  void near(const Eigen::Vector3d& ground, double until, double beside, const Use& use) {
    for (std::size_t k = 0; k < own_.size(); ++k)
      for (std::size_t j = 0; j < intruders_.size(); ++j) {
        const Eigen::Vector3d w = ground - intruders_[j].velocity;
        const auto may_meet = [&](const Ball& ball) {
          const Eigen::Vector3d c = ball.center - own_[k].ball.center;
          const double square = w.squaredNorm(),
                       t = square > 0 ? std::clamp(c.dot(w) / square, 0.0, until) : 0;
          const double reach = ball.radius + own_[k].ball.radius + margin_ + beside,
                       rounded = 0x1p-40 * (reach + c.norm() + t * std::sqrt(square));
          return !((c - t * w).norm() > reach + rounded);
        };
        const Kept& kept = kept_[j];
        for (std::size_t i = 0; i < kept.flat.size(); ++i)
          if (may_meet(kept.flat[i].ball)) use(part(k, j, i));
        if (!kept.tree) continue;
        open_.assign(1, 0);
        while (!open_.empty()) {
          const Hierarchy::Node& node = kept.tree->hierarchy().nodes()[open_.back()];
          open_.pop_back();
          if (!may_meet(ball_about(node, intruders_[j].body.pose))) continue;
          if (!node.is_leaf()) {
            open_.push_back(node.first);
            open_.push_back(node.first + 1);
          }
          for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot) use(part(k, j, slot));
        }
      }
  }

  /// From everything down: of a ball about many parts and the margin `ball(part, what)`, where part is one of
  /// the agent and the ball, says what there is still to ask of those within it; `of_part(part, what)`: of
  /// one.
  template <typename What, typename OfBall, typename OfPart>
  void descend(const What& all, const OfBall& ball, const OfPart& of_part) {
    for (std::size_t k = 0; k < own_.size(); ++k)
      for (std::size_t j = 0; j < intruders_.size(); ++j) {
        for (std::size_t i = 0; i < kept_[j].flat.size(); ++i) of_part(parts_[part(k, j, i)], all);
        if (kept_[j].tree) descend(k, j, 0, all, ball, of_part);
      }
  }

  const Part& operator[](std::size_t i) const { return parts_[i]; }
  /// m/s, of the intruders.
  double fastest() const;

 private:
  struct Ball {
    Eigen::Vector3d center;  // m, in the world
    double radius;
  };
  struct Convex {
    Placed body;
    std::optional<Placed> delimited;  // that the convex body contains
    Ball ball;
  };
  /// Of one intruder: its parts, or a tree of them.
  struct Kept {
    std::vector<Convex> flat;
    const Assembly* tree = nullptr;
  };

  template <typename What, typename OfBall, typename OfPart>
  void descend(std::size_t own, std::size_t intruder, std::uint32_t at, const What& all, const OfBall& ball,
               const OfPart& of_part) {
    const auto nodes = kept_[intruder].tree->hierarchy().nodes();
    const Hierarchy::Node& node = nodes[at];
    const Ball about = ball_about(node, intruders_[intruder].body.pose);
    const double radius = (about.radius + margin_) * (1 + 0x1p-48);
    const Placed placed(Ellipsoid::from_axes(about.center, Eigen::Vector3d::Constant(radius)));
    const What rest = ball(part_of(own, placed, intruder, about), all);
    if (rest.empty()) return;
    if (!node.is_leaf())
      for (const std::uint32_t child : {node.first, node.first + 1})
        descend(own, intruder, child, rest, ball, of_part);
    for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot)
      of_part(parts_[part(own, intruder, slot)], rest);
  }

  Part part_of(std::size_t own, const Placed& other, std::size_t intruder, const Ball& about) const {
    const Convex& agent = own_[own];
    return {Pair(agent.body, other),
            {},
            {},
            {},
            intruders_[intruder].velocity,
            intruder,
            about.center - agent.ball.center,
            (about.radius + agent.ball.radius + margin_) * (1 + 0x1p-48)};
  }
  static Ball ball_about(const Placed& part);
  static std::vector<Convex> convex_parts(const Placed& body);
  static Ball ball_about(const Hierarchy::Node& node, const Pose& pose);
  /// Prepared when it is asked for first.
  std::size_t part(std::size_t own, std::size_t intruder, std::size_t i);

  std::span<const Intruder> intruders_;
  double margin_;
  std::vector<Convex> own_;
  std::vector<Kept> kept_;
  std::deque<Part> parts_;
  std::unordered_map<std::uint64_t, std::size_t> known_;
  std::vector<std::uint32_t> open_;
};

}  // namespace vericone::guidance::banding
