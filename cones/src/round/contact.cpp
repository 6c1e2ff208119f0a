// SPDX-License-Identifier: BSD-3-Clause
#include "round/contact.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "round/triage.h"

namespace vericone {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A point of K, how far it is along w, and the obstacle's point that it comes from.
struct Vertex {
  Vector2d y;
  double z;
  Vector3d on_obstacle;
};

class FirstContact {
 public:
  FirstContact(const RoundScene& scene, const Vector3d& w)
      : scene_(scene), w_(w), axes_(w), u_(w(axes_.i) / w(axes_.k)), v_(w(axes_.j) / w(axes_.k)) {}

  std::optional<RoundContact> run(const std::array<Vector3d, 3>& normals) {
    std::array<Vertex, 3> corner;
    for (int i = 0; i < 3; ++i) {
      corner[std::size_t(i)] =
          normals[std::size_t(i)].isZero(0) ? middle() : farthest(normals[std::size_t(i)]);
      if (!normals[std::size_t(i)].isZero(0)) below(normals[std::size_t(i)]);
    }
    if (!weigh(corner)) return std::nullopt;
    take(corner);
    // On an edge of K, as along the side of a cylinder, Newton's steps go back and forth.
    constexpr int kMostNewtonSteps = 4;
    bool newton = false;
    int newton_steps = 0;
    for (int step = 0; step < kMostSteps && latest_ - earliest_ > kEnough * latest_; ++step) {
      const bool curved = newton && newton_steps < kMostNewtonSteps && curve();
      newton_steps += curved;
      const auto n = curved ? std::optional(across_w(solve(last_.y), n_)) : plane(corner);
      if (!n) break;
      const double before = earliest_;
      static_cast<void>(farthest(*n));
      below(*n);
      newton = earliest_ > before;
      const bool near = curved && newton && last_.y.cwiseAbs().maxCoeff() < 1e-3 * scene_.size;
      if (near && triangle()) continue;
      if (!replace(corner) && !curved && !(curve() && triangle())) break;
    }
    if (!(earliest_ > 0 && latest_ - earliest_ <= kKnown * latest_)) return std::nullopt;
    RoundContact found;
    found.earliest = earliest_;
    found.latest = latest_;
    found.normal = normal_.normalized();
    found.point = point_;
    return found;
  }

 private:
  static double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

  Vertex vertex(const Vector3d& x, const Vector3d& on_obstacle) const {
    return {
        {x(axes_.i) - u_ * x(axes_.k), x(axes_.j) - v_ * x(axes_.k)}, x(axes_.k) / w_(axes_.k), on_obstacle};
  }
  Vertex middle() const { return vertex(scene_.middle, scene_.middle_obstacle); }
  /// And what its plane says.
  const Vertex& farthest(const Vector3d& n) {
    support_ = scene_.least(n);
    const Vector3d b = scene_.obstacle.point(support_.obstacle);
    const Vector3d ball = n * (1 / n.norm());
    const Vector3d x = b - scene_.agent.point(support_.agent) - ball * (scene_.margin * (1 - 0x1p-50));
    n_ = n;
    last_ = vertex(x, b - ball * scene_.obstacle_margin);
    return last_;
  }
  /// Before a plane is reached there is no contact.
  void below(const Vector3d& n) {
    const double along = n.dot(w_), rounding = 8 * kUnitRoundoff * n.cwiseAbs().dot(w_.cwiseAbs());
    if (!(along > 2 * rounding)) return;
    const double room = support_.value - scene_.slack * n.cwiseAbs().maxCoeff();
    const double time = room / (along + (room > 0 ? rounding : -rounding)) * (1 - 4 * kUnitRoundoff);
    if (!(time > earliest_)) return;
    earliest_ = time;
    normal_ = n;
  }

  /// The weights of the origin, unless it is not surely inside, by eight times what turns are off. Shadows
  /// are off by 3 slack.
  bool weigh(std::array<Vertex, 3>& corner) {
    for (std::size_t i = 0; i < 3; ++i) turn_[i] = cross(corner[(i + 1) % 3].y, corner[(i + 2) % 3].y);
    if (turn_[0] + turn_[1] + turn_[2] < 0) {
      std::swap(corner[0], corner[1]);
      std::swap(turn_[0], turn_[1]);
      for (double& turn : turn_) turn = -turn;
    }
    double largest = 0;
    for (const Vertex& x : corner) largest = std::max(largest, x.y.cwiseAbs().maxCoeff());
    off_ = 4 * largest * 3 * scene_.slack + 2 * (3 * scene_.slack) * (3 * scene_.slack) +
           8 * kUnitRoundoff * largest * largest;
    return std::min({turn_[0], turn_[1], turn_[2]}) > 8 * off_;
  }

  /// When the line passes the triangle, at most.
  double above(const std::array<Vertex, 3>& corner) const {
    const double sum = turn_[0] + turn_[1] + turn_[2];
    double time = corner[0].z, spread = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      time += turn_[i] / sum * (corner[i].z - corner[0].z);
      spread += std::abs(corner[i].z - corner[0].z);
    }
    // Each weight is off by 4 off_ / sum, each z by slack / w_k.
    const double slack = 2 * scene_.slack / std::abs(w_(axes_.k));
    return time + (spread + 2 * slack) * 5 * off_ / sum + slack +
           16 * kUnitRoundoff * (std::abs(time) + spread);
  }
  /// The triangle that was weighed.
  void take(const std::array<Vertex, 3>& corner) {
    const double late = above(corner);
    if (!(late < latest_)) return;
    latest_ = late;
    const double sum = turn_[0] + turn_[1] + turn_[2];
    point_.setZero();
    for (std::size_t i = 0; i < 3; ++i) point_ += turn_[i] / sum * corner[i].on_obstacle;
  }

  /// How fast the point of K turns with the normal, at the last one; false where K has an edge or corner.
  bool curve() {
    Eigen::Matrix2d& q = curve_;
    q.setZero();
    const auto across = [this](const Vector3d& x) {
      return Vector2d(x(axes_.i) - u_ * x(axes_.k), x(axes_.j) - v_ * x(axes_.k));
    };
    const auto add = [&](const RoundBody& body, const RoundBody::Farthest& farthest) {
      if (!(farthest.radius > 0)) return;
      const RoundBody::Group& group = body.groups[farthest.group];
      Vector2d along = Vector2d::Zero();
      for (int j = 0; j < group.rank; ++j) {
        const Vector2d g = across(group.factor.col(j)) / std::sqrt(farthest.radius);
        q += g * g.transpose();
        along += farthest.back(j) / farthest.radius * g;
      }
      q -= along * along.transpose();
    };
    add(scene_.agent, support_.agent);
    add(scene_.obstacle, support_.obstacle);
    if (scene_.margin > 0) {
      const double length = n_.norm(), part = scene_.margin / length;
      for (int k = 0; k < 3; ++k) {
        const Vector2d g = across(Vector3d::Unit(k));
        q += part * g * g.transpose();
      }
      const Vector2d g = across(n_) / length;
      q -= part * g * g.transpose();
    }
    const double trace = q.trace();
    return q.determinant() > 1e-9 * trace * trace;
  }
  Vector2d solve(const Vector2d& y) const {
    const Eigen::Matrix2d& q = curve_;
    const double det = q.determinant();
    return {(q(1, 1) * y.x() - q(0, 1) * y.y()) / det, (q(0, 0) * y.y() - q(1, 0) * y.x()) / det};
  }

  /// Three points near the contact, as far from it as the time may be off; whether they are around it.
  bool triangle() {
    const Vector3d n = across_w(solve(last_.y), n_);
    const double off = std::sqrt(0.1 * kEnough * std::abs(last_.z) / curve_.trace());
    constexpr double kX[] = {1, -0.5, -0.5}, kY[] = {0, 0.866, -0.866};
    std::array<Vertex, 3> near;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d beside = across_w(Vector2d(off * kX[i], off * kY[i]), n);
      near[i] = farthest(beside);
      below(beside);
    }
    if (!weigh(near)) return false;
    take(near);
    return true;
  }

  /// n and what p adds to it across w.
  Vector3d across_w(const Vector2d& p, Vector3d n) const {
    n(axes_.i) += p.x();
    n(axes_.j) += p.y();
    n(axes_.k) -= u_ * p.x() + v_ * p.y();
    return n;
  }

  /// A normal of the plane through the corners, ahead along w: z + p.y is the same of all three.
  std::optional<Vector3d> plane(const std::array<Vertex, 3>& corner) const {
    const Vector2d a = corner[1].y - corner[0].y, b = corner[2].y - corner[0].y;
    const double za = corner[1].z - corner[0].z, zb = corner[2].z - corner[0].z, det = cross(a, b);
    const Vector2d p((zb * a.y() - za * b.y()) / det, (za * b.x() - zb * a.x()) / det);
    if (!p.allFinite()) return std::nullopt;
    return across_w(p, Vector3d::Unit(axes_.k) / w_(axes_.k));
  }

  /// The last point instead of the corner without which the origin is still surely inside.
  bool replace(std::array<Vertex, 3>& corner) {
    std::size_t best = 0;
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector2d &p = corner[(i + 1) % 3].y, &q = corner[(i + 2) % 3].y;
      const double least = std::min(cross(q, last_.y), cross(last_.y, p));
      if (least > most) {
        best = i;
        most = least;
      }
    }
    if (!(most > 0)) return false;
    std::array<Vertex, 3> next = corner;
    next[best] = last_;
    if (!weigh(next)) return false;
    corner = next;
    take(corner);
    return true;
  }

  static constexpr int kMostSteps = 48;
  static constexpr double kEnough = 1e-8, kKnown = 1e-6;

  const RoundScene& scene_;
  Vector3d w_;
  ShadowAxes axes_;
  double u_, v_;
  RoundSupport support_{};  // of n_, and its point
  Vector3d n_ = Vector3d::Zero();
  Vertex last_{};
  double earliest_ = 0, latest_ = std::numeric_limits<double>::infinity();
  double turn_[3] = {}, off_ = 0;
  Eigen::Matrix2d curve_ = Eigen::Matrix2d::Zero();
  Vector3d normal_ = Vector3d::UnitX(), point_ = Vector3d::Zero();
};

/// The first rung, which remembers what it found around the line.
struct Around : TriageShadow {
  mutable std::array<Vector3d, 3> normals{};
  mutable bool found = false;

  template <std::size_t kCount>
  bool around(const std::array<ShadowPoint, kCount>& corner) const noexcept {
    if (!TriageShadow::around(corner)) return false;
    found = kCount == 3 && !corner[0].halfway;
    if (found)
      for (std::size_t i = 0; i < 3; ++i) normals[i] = corner[i].n;
    return true;
  }
};

}  // namespace

std::optional<RoundContact> round_contact(const RoundScene& scene, const Vector3d& w) noexcept {
  const Around around{{scene, w}};
  if (ShadowSearch(scene, w, around).run() != true || !around.found) return std::nullopt;
  auto found = FirstContact(scene, w).run(around.normals);
  if (!found) return std::nullopt;
  const double scale = std::ldexp(1.0, scene.exponent);
  found->earliest *= scale;
  found->latest *= scale;
  found->point = scene.reference + scale * found->point;
  return found;
}

}  // namespace vericone
