// SPDX-License-Identifier: BSD-3-Clause
//
// What an oracle of convex bodies reads: their pieces as they were given, and centred and scaled for the
// rungs in floating point.
#pragma once

#include <vericone/geometry/convex.h>
#include <vericone/geometry/interval.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "answers/elementary.h"
#include "round/upright.h"

namespace vericone {

/// One body's pieces relative to a reference point, in units of the scene's scale, without its margin. Those
/// of one factor stand side by side: a cylinder asks for |F^T n| once.
struct RoundBody {
  struct Group {
    Eigen::Matrix3d factor;
    int rank;
    std::uint32_t first, end;  // of `center`
  };
  std::vector<Eigen::Vector3d> center;
  std::vector<Group> groups;
  double reach = 0;  // |x|_1 of each point of the body is at most this
  double off = 0;    // what ellipsoids that are given by a shape matrix differ from their factors

  /// Where n.x is largest.
  struct Farthest {
    double value;
    std::uint32_t at, group;
    Eigen::Vector3d back;  // F^T n
    double radius;         // its length
  };
  [[nodiscard]] Farthest farthest(const Eigen::Vector3d& n) const noexcept {
    Farthest best{-std::numeric_limits<double>::infinity(), 0, 0, Eigen::Vector3d::Zero(), 0};
    for (std::uint32_t g = 0; g < groups.size(); ++g) {
      const Group& group = groups[g];
      double most = -std::numeric_limits<double>::infinity();
      std::uint32_t at = group.first;
      for (std::uint32_t i = group.first; i < group.end; ++i)
        if (const double value = n.dot(center[i]); value > most) {
          most = value;
          at = i;
        }
      Eigen::Vector3d back = Eigen::Vector3d::Zero();
      double radius = 0;
      if (group.rank > 0) {
        back.x() = group.factor.col(0).dot(n);
        back.y() = group.factor.col(1).dot(n);
        if (group.rank > 2) back.z() = group.factor.col(2).dot(n);
        radius = std::sqrt(back.x() * back.x() + back.y() * back.y() + back.z() * back.z());
      }
      if (most + radius > best.value) best = {most + radius, at, g, back, radius};
    }
    return best;
  }
  /// The vector of the unit ball whose image it is, in length at most 1.
  [[nodiscard]] static Eigen::Vector3d direction(const Farthest& farthest) noexcept {
    return farthest.radius > 0 ? Eigen::Vector3d(farthest.back * ((1 - 0x1p-50) / farthest.radius))
                               : Eigen::Vector3d::Zero();
  }
  [[nodiscard]] Eigen::Vector3d point(const Farthest& farthest) const noexcept {
    const Eigen::Vector3d& at = center[farthest.at];
    const Group& group = groups[farthest.group];
    return group.rank > 0 ? Eigen::Vector3d(at + group.factor * direction(farthest)) : at;
  }
};

/// A body that stands at `at`, about a reference point; metres.
[[nodiscard]] RoundBody round_body(const Convex& body, const Eigen::Vector3d& at,
                                   const Eigen::Vector3d& reference);

/// The least n.x over K, and where: rounded, off by at most RoundScene::slack times the largest |n_k|.
struct RoundSupport {
  RoundBody::Farthest agent, obstacle;
  double value;
};

/// K = { b - a + r u }: the obstacle's points less the agent's, and the ball of both margins.
struct RoundScene {
  RoundScene(Convex agent, const Eigen::Vector3d& agent_at, Convex obstacle,
             const Eigen::Vector3d& obstacle_at);

  Convex given_agent, given_obstacle;
  Eigen::Vector3d agent_at, obstacle_at;

  bool usable = false;  // whether the following is within the range of doubles
  int exponent = 0;     // of the scale: lengths are in units of 2^exponent metres
  RoundBody agent, obstacle;
  double margin = 0;                                 // r, rounded up or down: see slack
  double obstacle_margin = 0;                        // its part
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // amid K
  Eigen::Vector3d middle_obstacle = Eigen::Vector3d::Zero();
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();  // where the centred coordinates are 0; metres

  double size = 0;   // |x|_1 of each point of K is at most this
  double slack = 0;  // of values of supports and of computed points, each of their coordinates
  std::optional<UprightDifference> upright;  // where K is that

  [[nodiscard]] RoundSupport least(const Eigen::Vector3d& n) const noexcept {
    RoundSupport support{agent.farthest(n), obstacle.farthest(-n), 0};
    support.value = -(support.obstacle.value + support.agent.value);
    if (margin > 0) support.value -= margin * n.norm();
    return support;
  }
  /// The point of K that has the least n.x.
  [[nodiscard]] Eigen::Vector3d point(const Eigen::Vector3d& n, const RoundSupport& support) const noexcept {
    Eigen::Vector3d x = obstacle.point(support.obstacle) - agent.point(support.agent);
    if (margin > 0) x -= n * (margin * (1 - 0x1p-50) / n.norm());
    return x;
  }

  /// The same in intervals, for a normal as it stands: at most the least n.x.
  [[nodiscard]] double enclosed_least(const std::array<Interval, 3>& n) const noexcept;
  /// A point of K that has about the least n.x.
  [[nodiscard]] std::array<Interval, 3> enclosed_point(const Eigen::Vector3d& n) const noexcept;
  [[nodiscard]] std::array<Interval, 3> enclosed_middle() const noexcept;
};

/// K and where it is while the agent goes from one displacement to another: { x - d }, x in K, d between the
/// two, which are rounded from w t by at most two roundings. Read as a RoundScene.
struct SweptScene {
  SweptScene(const RoundScene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& until) noexcept
      : still(scene), first(from), last(until) {
    const double way = std::max(first.cwiseAbs().sum(), last.cwiseAbs().sum());
    size = (still.size + way) * (1 + 0x1p-40);
    slack = still.slack + 8 * kUnitRoundoff * size;
  }

  const RoundScene& still;
  Eigen::Vector3d first, last;
  double size = 0, slack = 0;                        // as of RoundScene
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // a point of it, off by at most `slack`

  [[nodiscard]] RoundSupport least(const Eigen::Vector3d& n) const noexcept {
    RoundSupport support = still.least(n);
    support.value -= std::max(n.dot(first), n.dot(last));
    return support;
  }
  [[nodiscard]] Eigen::Vector3d point(const Eigen::Vector3d& n, const RoundSupport& support) const noexcept {
    return still.point(n, support) - (n.dot(first) > n.dot(last) ? first : last);
  }
};

}  // namespace vericone
