// SPDX-License-Identifier: BSD-3-Clause
//
// What bodies in the way are made of, down to convex parts, found by balls about them: only where a ball may
// be met is anything prepared.
#pragma once

#include <vericone/cones/pair.h>
#include <vericone/guidance/bands.h>
#include <algorithm>
#include <deque>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "bands/parts.h"

namespace vericone::guidance::banding {

/// A convex part of the agent and one of an intruder. `inner`: one of them with less than the margin around
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
  /// Some of the planes that were found between them, less the margin: what one quantity asked for often
  /// frees all of another.
  mutable std::vector<SafeHalfSpace> planes = {};

  bool exact() const { return !truth; }  // they are what the bodies are, not more
  const Pair& swollen() const { return inner ? *inner : pair; }
  /// What single flights are asked of.
  const Pair& as_it_is() const { return truth ? *truth : pair; }
};

/// Whether what is within a reach of a point may be met at a velocity relative to it before `until`, s.
inline bool may_meet(const Eigen::Vector3d& apart, double reach, const Eigen::Vector3d& w, double until) {
  const double square = w.squaredNorm(), t = square > 0 ? std::clamp(apart.dot(w) / square, 0.0, until) : 0;
  const double rounded = 0x1p-40 * (reach + apart.norm() + t * std::sqrt(square));
  return !((apart - t * w).norm() > reach + rounded);
}

class Threats {
 public:
  Threats(const Placed& agent, std::span<const Intruder> intruders, double margin);

  /// Of an agent that flies at a velocity over ground, up to `beside` metres beside that way, use(i) of every
  /// part [i] that may come nearer than the margin before `until`, s.
  template <typename Use>
  void near(const Eigen::Vector3d& ground, double until, double beside, const Use& use) {
    near_until(ground, until, beside, [&](std::size_t i) {
      use(i);
      return false;
    });
  }

  /// Until use(i) is true; of many parts the nearer ones first, as a rule.
  template <typename Use>
  void near_until(const Eigen::Vector3d& ground, double until, double beside, const Use& use) {
    for (std::size_t k = 0; k < own_.size(); ++k)
      for (std::size_t j = 0; j < intruders_.size(); ++j) {
        const Eigen::Vector3d w = ground - intruders_[j].velocity;
        const auto meet = [&](const Ball& ball) {
          return may_meet(ball.center - own_[k].ball.center,
                          ball.radius + own_[k].ball.radius + margin_ + beside, w, until);
        };
        const Kept& kept = kept_[j];
        for (std::size_t i = 0; i < kept.flat.size(); ++i)
          if (meet(kept.flat[i].ball) && use(part(k, j, i))) return;
        if (!kept.tree) continue;
        const auto nodes = kept.tree->hierarchy().nodes();
        open_.assign(1, 0);
        while (!open_.empty()) {
          const Hierarchy::Node& node = nodes[open_.back()];
          open_.pop_back();
          if (!meet(ball_about(node, intruders_[j].body.pose))) continue;
          if (!node.is_leaf()) {
            const Eigen::Vector3d from_first =
                nodes[node.first + 1].box().center() - nodes[node.first].box().center();
            const bool in_order = intruders_[j].body.pose.to_world(from_first).dot(w) >=
                                  intruders_[j].body.pose.position.dot(w);
            open_.push_back(node.first + (in_order ? 1 : 0));
            open_.push_back(node.first + (in_order ? 0 : 1));
          }
          for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot)
            if (use(part(k, j, slot))) return;
        }
      }
  }

  /// From everything down: of a ball about many parts and the margin `ball(part, what)`, where part is one of
  /// the agent and the ball, says what there is still to ask of those within it; `of_part(part, what)`: of
  /// one. Without what is out of reach: reaches(center, radius, velocity of the intruder) of a ball that is
  /// met where it is, seen from the agent.
  template <typename What, typename Reaches, typename OfBall, typename OfPart>
  void descend(const What& all, const Reaches& reaches, const OfBall& ball, const OfPart& of_part) {
    for (std::uint32_t k = 0; k < own_.size(); ++k)
      for (std::uint32_t j = 0; j < intruders_.size(); ++j) {
        for (std::uint32_t i = 0; i < kept_[j].flat.size(); ++i)
          if (is_reached({k, j, i, false}, reaches)) of_part(parts_[part(k, j, i)], all);
        if (kept_[j].tree) descend(k, j, 0, all, reaches, ball, of_part);
      }
  }

  /// A convex part of the agent and a part of an intruder, or all below a node of a tree of those.
  struct Piece {
    std::uint32_t own, intruder, index;
    bool is_node;
  };
  /// A ball that is met wherever a piece is, seen from the agent, with the margin.
  struct Apart {
    Eigen::Vector3d center;  // m
    double radius;
  };
  [[nodiscard]] std::vector<Piece> all() const;
  [[nodiscard]] Apart apart(const Piece& piece) const;
  /// What a node is made of: use(piece).
  template <typename Use>
  void open(const Piece& node, const Use& use) const {
    const Hierarchy::Node& at = kept_[node.intruder].tree->hierarchy().nodes()[node.index];
    if (!at.is_leaf())
      for (const std::uint32_t child : {at.first, at.first + 1})
        use(Piece{node.own, node.intruder, child, true});
    for (std::uint32_t slot = at.first; slot < at.first + at.count; ++slot)
      use(Piece{node.own, node.intruder, slot, false});
  }
  const Part& part_of(const Piece& piece) { return parts_[part(piece.own, piece.intruder, piece.index)]; }
  const Eigen::Vector3d& velocity_of(const Piece& piece) const { return intruders_[piece.intruder].velocity; }

  const Part& operator[](std::size_t i) const { return parts_[i]; }
  /// m/s, of the intruders.
  double fastest() const;
  /// Whether some intruder is made of many parts.
  bool any_trees() const {
    return std::any_of(kept_.begin(), kept_.end(), [](const Kept& kept) { return kept.tree != nullptr; });
  }

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

  template <typename Reaches>
  bool is_reached(const Piece& piece, const Reaches& reaches) const {
    const Apart ball = apart(piece);
    return reaches(ball.center, ball.radius, velocity_of(piece));
  }

  template <typename What, typename Reaches, typename OfBall, typename OfPart>
  void descend(std::uint32_t own, std::uint32_t intruder, std::uint32_t at, const What& all,
               const Reaches& reaches, const OfBall& ball, const OfPart& of_part) {
    if (!is_reached({own, intruder, at, true}, reaches)) return;
    const auto nodes = kept_[intruder].tree->hierarchy().nodes();
    const Hierarchy::Node& node = nodes[at];
    const Ball about = ball_about(node, intruders_[intruder].body.pose);
    const double radius = (about.radius + margin_) * (1 + 0x1p-48);
    const Placed placed(Ellipsoid::from_axes(about.center, Eigen::Vector3d::Constant(radius)));
    const What rest = ball(part_of(own, placed, intruder, about), all);
    if (rest.empty()) return;
    if (!node.is_leaf())
      for (const std::uint32_t child : {node.first, node.first + 1})
        descend(own, intruder, child, rest, reaches, ball, of_part);
    for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot)
      if (is_reached({own, intruder, slot, false}, reaches)) of_part(parts_[part(own, intruder, slot)], rest);
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
