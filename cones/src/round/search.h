// SPDX-License-Identifier: BSD-3-Clause
//
// The search of the lower rungs in the shadow of K along w: from a point amid K towards the origin (after
// G. Snethen, "XenoCollide", Game Programming Gems 7, 2008, in the plane). It proposes a plane that misses K
// or a polygon of points of K around the origin, and the rung that asks proves it.
#pragma once

#include <vericone/cones/answers.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "round/scene.h"

namespace vericone {

/// The coordinates in the order i, j, k, where k is that of the largest entry of w.
struct ShadowAxes {
  int i, j, k;
  explicit ShadowAxes(const Eigen::Vector3d& w) {
    const Eigen::Vector3d a = w.cwiseAbs();
    k = a.z() > std::max(a.x(), a.y()) ? 2 : static_cast<int>(a.y() > a.x());
    i = (k + 1) % 3;
    j = (k + 2) % 3;
  }
};

/// A point of K and its shadow (x_i - w_i/w_k x_k, x_j - w_j/w_k x_k): that with the least n.x, the one amid
/// K where n is zero; `halfway`: halfway between the two.
struct ShadowPoint {
  Eigen::Vector2d y;
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  bool halfway = false;
};

/// What a rung has to prove: outside(n, largest |n_k|, support): n.w <= 0 and n.x > 0 on all of K;
/// around(corners): the polygon of 3 or 4 corners winds once around the origin. `Scene`: RoundScene, or
/// SweptScene.
template <class Rung, class Scene>
class ShadowSearch {
 public:
  ShadowSearch(const Scene& scene, const Eigen::Vector3d& w, const Rung& rung) noexcept
      : scene_(scene),
        rung_(rung),
        w_(w),
        axes_(w),
        u_(w(axes_.i) / w(axes_.k)),
        v_(w(axes_.j) / w(axes_.k)) {}

  /// Whether the line of w meets the interior of K's shadow; nothing where the rung does not tell.
  std::optional<bool> run() noexcept {
    // Nearly all that miss are told by the plane along w that faces the middle.
    const Eigen::Vector3d c = scene_.middle;
    ShadowPoint middle{shadow(c)};
    Eigen::Vector3d n = c - (c.dot(w_) / w_.squaredNorm()) * w_;
    if (!(middle.y.squaredNorm() > 1e-12 * scene_.size * scene_.size)) {
      n = normal({1, 0});
      if (!ask(n)) return out_;
      middle = {0.5 * (middle.y + last_.y), last_.n, true};
      n = normal(middle.y);
    }
    if (!ask(n)) return out_;
    return from(middle, last_);
  }

 private:
  static double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  }
  Eigen::Vector2d shadow(const Eigen::Vector3d& x) const {
    return {x(axes_.i) - u_ * x(axes_.k), x(axes_.j) - v_ * x(axes_.k)};
  }
  /// In space, across w.
  Eigen::Vector3d normal(const Eigen::Vector2d& p) const {
    Eigen::Vector3d n;
    n(axes_.i) = p.x();
    n(axes_.j) = p.y();
    n(axes_.k) = -u_ * p.x() - v_ * p.y();
    return n;
  }

  /// The farthest point against n becomes last_; false where the search ends there.
  bool ask(const Eigen::Vector3d& n) noexcept {
    const double largest = n.cwiseAbs().maxCoeff();
    if (!(largest > 1e-100 && largest < 1e100)) return false;
    const RoundSupport support = scene_.least(n);
    if (support.value > 0 && rung_.outside(n, largest, support)) {
      out_ = false;
      return false;
    }
    last_ = {shadow(scene_.point(n, support)), n};
    return true;
  }

  std::optional<bool> from(const ShadowPoint& middle, ShadowPoint a) noexcept {
    const Eigen::Vector2d o = -middle.y;
    const double turn = cross(a.y - middle.y, o) >= 0 ? 1 : -1;
    const auto left = [turn](const Eigen::Vector2d& x) {
      return Eigen::Vector2d(-turn * x.y(), turn * x.x());
    };
    // Until the way to the origin is between a and b, seen from the middle.
    ShadowPoint b = a;
    for (int step = 0;; ++step) {
      if (step == kMostSteps || !ask(normal(-left(b.y - middle.y)))) return out_;
      b = last_;
      if (turn * cross(o, b.y - middle.y) >= 0) break;
      a = b;
    }
    double outermost = std::numeric_limits<double>::infinity();
    for (int step = 0; step < kMostSteps; ++step) {
      const Eigen::Vector2d edge = b.y - a.y;
      if (turn * cross(edge, Eigen::Vector2d(-a.y)) > 0) {
        if (rung_.around(std::array{middle, a, b})) return true;
        if (const auto answer = beside(middle, a, b, left)) return answer;
        if (step > 8) return std::nullopt;
      }
      if (!ask(normal(left(edge)))) return out_;
      // No farther than the edge: there is nothing more to be found.
      const double beyond = -left(edge).dot(last_.y - a.y);
      if (!(beyond > 1e-15 * edge.norm() * scene_.size) && !(beyond < outermost && step < 4))
        return std::nullopt;
      outermost = beyond;
      (turn * cross(last_.y - middle.y, o) >= 0 ? a : b) = last_;
    }
    return std::nullopt;
  }

  /// Where the origin is on a side of the triangle, or nearly: with the farthest point beyond that side.
  template <class Left>
  std::optional<bool> beside(const ShadowPoint& middle, const ShadowPoint& a, const ShadowPoint& b,
                             const Left& left) noexcept {
    const double at_a = std::abs(cross(middle.y, a.y)), at_b = std::abs(cross(b.y, middle.y));
    const bool by_a = at_a < at_b;
    const Eigen::Vector2d side =
        left(by_a ? Eigen::Vector2d(a.y - middle.y) : Eigen::Vector2d(middle.y - b.y));
    if (!ask(normal(side))) return out_;
    const bool around =
        by_a ? rung_.around(std::array{middle, last_, a, b}) : rung_.around(std::array{middle, a, b, last_});
    return around ? std::optional(true) : std::nullopt;
  }

  static constexpr int kMostSteps = 40;

  const Scene& scene_;
  const Rung& rung_;
  Eigen::Vector3d w_;
  ShadowAxes axes_;
  double u_, v_;
  ShadowPoint last_;
  std::optional<bool> out_;
};

}  // namespace vericone
