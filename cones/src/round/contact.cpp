// SPDX-License-Identifier: BSD-3-Clause
#include "round/contact.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "round/triage.h"

namespace vericone {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A point of K, how far it is along w, and the obstacle's point and the part of the way that it comes from.
struct Vertex {
  Vector2d y;
  double z;
  Vector3d on_obstacle;
  double part;
};

const RoundScene& still(const RoundScene& scene) { return scene; }
const RoundScene& still(const SweptScene& scene) { return scene.still; }
double part_of_way(const RoundScene&, const Vector3d&) { return 0; }
double part_of_way(const SweptScene& scene, const Vector3d& n) {
  return n.dot(scene.first) > n.dot(scene.last) ? 0 : 1;
}

template <class Scene>
class FirstContact {
 public:
  FirstContact(const Scene& scene, const Vector3d& w)
      : scene_(scene), w_(w), axes_(w), u_(w(axes_.i) / w(axes_.k)), v_(w(axes_.j) / w(axes_.k)) {}

  std::optional<RoundContact> run(const std::array<Vector3d, 3>& normals) {
    earliest_ = 0;
    approach(normals, [this] { return !(latest_ - earliest_ > kEnough * latest_); });
    if (!(earliest_ > 0 && latest_ - earliest_ <= kKnown * latest_)) return std::nullopt;
    RoundContact found;
    found.earliest = earliest_;
    found.latest = latest_;
    found.normal = normal_.normalized();
    found.point = point_;
    return found;
  }

  /// Whether the origin is inside: after the contact, where w is a point of K, off by at most the slack.
  /// Nothing where that is not certain. From that point through the origin to the triangle the line may turn
  /// by 3 slack. Where the triangle is passed -T w before the origin, T <= 2, and its plane is off by a tenth
  /// of w at most, the line meets it before another 1 + 3 T times w, and turns change by as many times what
  /// they may be off.
  /// `plane`: goes on to where one beside the origin touches K, if that is near.
  RoundMeeting meeting(const std::array<Vector3d, 3>& normals, bool plane) {
    constexpr double kTouching = 1e-3, kNear = 0.1;
    const auto past = [this] { return latest_ < 0 && inside_; };
    approach(normals, [&] {
      if (!(earliest_ > 0)) return past();
      return !plane || earliest_ > kNear || latest_ - earliest_ <= kTouching * earliest_;
    });
    if (earliest_ > 0)
      return {false, normal_, part_, earliest_ <= kNear && latest_ - earliest_ <= kTouching * earliest_};
    return {past() ? std::optional(true) : std::nullopt};
  }

 private:
  /// Until enough() is known of earliest_ and latest_, or nothing more.
  template <typename Enough>
  void approach(const std::array<Vector3d, 3>& normals, const Enough& enough) {
    std::array<Vertex, 3> corner;
    for (int i = 0; i < 3; ++i) {
      corner[std::size_t(i)] =
          normals[std::size_t(i)].isZero(0) ? middle() : farthest(normals[std::size_t(i)]);
      if (!normals[std::size_t(i)].isZero(0)) below(normals[std::size_t(i)]);
    }
    if (!weigh(corner)) return;
    take(corner);
    // On an edge of K, as along the side of a cylinder, Newton's steps go back and forth.
    constexpr int kMostNewtonSteps = 4;
    bool newton = false;
    int newton_steps = 0;
    for (int step = 0; step < kMostSteps && !enough(); ++step) {
      const bool curved = newton && newton_steps < kMostNewtonSteps && curve();
      newton_steps += curved;
      const auto n = curved ? std::optional(across_w(solve(last_.y), n_)) : plane();
      if (!n) break;
      const double before = earliest_;
      static_cast<void>(farthest(*n));
      below(*n);
      newton = earliest_ > before;
      const bool near = curved && newton && last_.y.cwiseAbs().maxCoeff() < 1e-3 * scene_.size;
      if (near && triangle(corner)) continue;
      if (!replace(corner) && !curved && !(curve() && triangle(corner))) break;
    }
  }

  static double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

  Vertex vertex(const Vector3d& x, const Vector3d& on_obstacle, double part) const {
    return {{x(axes_.i) - u_ * x(axes_.k), x(axes_.j) - v_ * x(axes_.k)},
            x(axes_.k) / w_(axes_.k),
            on_obstacle,
            part};
  }
  Vertex middle() const { return vertex(scene_.middle, still(scene_).middle_obstacle, 0.5); }
  /// And what its plane says.
  const Vertex& farthest(const Vector3d& n) {
    support_ = scene_.least(n);
    const RoundScene& k = still(scene_);
    n_ = n;
    last_ = vertex(scene_.point(n, support_),
                   k.obstacle.point(support_.obstacle) - n * (k.obstacle_margin / n.norm()),
                   part_of_way(scene_, n));
    return last_;
  }
  /// Before a plane is reached there is no contact.
  void below(const Vector3d& n) {
    const double along = n.dot(w_), rounding = 8 * kUnitRoundoff * n.cwiseAbs().dot(w_.cwiseAbs());
    if (!(along > 2 * rounding)) return;
    const double room = support_.value - scene_.slack * n.cwiseAbs().maxCoeff();
    double time = room / (along + (room > 0 ? rounding : -rounding));
    time -= 4 * kUnitRoundoff * std::abs(time);
    if (!(time > earliest_)) return;
    earliest_ = time;
    normal_ = n;
  }

  /// The weights of the origin, unless it is not surely inside, by twice what turns are off. Shadows are off
  /// by 3 slack.
  bool weigh(std::array<Vertex, 3>& corner) {
    for (std::size_t i = 0; i < 3; ++i) turn_[i] = cross(corner[(i + 1) % 3].y, corner[(i + 2) % 3].y);
    if (turn_[0] + turn_[1] + turn_[2] < 0) {
      std::swap(corner[0], corner[1]);
      std::swap(turn_[0], turn_[1]);
      for (double& turn : turn_) turn = -turn;
    }
    sure_ = std::numeric_limits<double>::infinity();
    const double slack = 3 * scene_.slack;
    for (std::size_t i = 0; i < 3; ++i) {
      const double p = corner[(i + 1) % 3].y.cwiseAbs().maxCoeff(),
                   q = corner[(i + 2) % 3].y.cwiseAbs().maxCoeff();
      const double off = 4 * std::max(p, q) * slack + 2 * slack * slack + 8 * kUnitRoundoff * p * q;
      sure_ = std::min(sure_, turn_[i] / off);
    }
    return sure_ > 2;
  }

  /// The triangle that was weighed, and its plane z + slope.y = z(0). Whatever the slope: the place of the
  /// line, with weights for which the y of the true corners cancel, is at most the most of z + slope.y of a
  /// corner, and what |slope| times their 3 slack may add.
  void take(const std::array<Vertex, 3>& corner) {
    const Vector2d a = corner[1].y - corner[0].y, b = corner[2].y - corner[0].y;
    const double za = corner[1].z - corner[0].z, zb = corner[2].z - corner[0].z, det = cross(a, b);
    slope_ = Vector2d(zb * a.y() - za * b.y(), za * b.x() - zb * a.x()) / det;
    double most = -std::numeric_limits<double>::infinity(), least = -most, largest = 0;
    for (const Vertex& x : corner) {
      const double at = x.z + slope_.dot(x.y);
      most = std::max(most, at);
      least = std::min(least, at);
      largest = std::max(largest, std::abs(x.z) + slope_.cwiseAbs().dot(x.y.cwiseAbs()));
    }
    const double off = 3 * scene_.slack * slope_.cwiseAbs().sum() + 2 * scene_.slack / std::abs(w_(axes_.k)) +
                       16 * kUnitRoundoff * largest;
    if (!(most + off < latest_)) return;
    latest_ = most + off;
    inside_ = off < 0.1 && least > -2 && sure_ > 2 + 3 * std::abs(least);
    const double sum = turn_[0] + turn_[1] + turn_[2];
    point_.setZero();
    part_ = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      point_ += turn_[i] / sum * corner[i].on_obstacle;
      part_ += turn_[i] / sum * corner[i].part;
    }
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
    const RoundScene& k = still(scene_);
    add(k.agent, support_.agent);
    add(k.obstacle, support_.obstacle);
    if (k.margin > 0) {
      const double length = n_.norm(), part = k.margin / length;
      for (int i = 0; i < 3; ++i) {
        const Vector2d g = across(Vector3d::Unit(i));
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
  bool triangle(std::array<Vertex, 3>& corner) {
    const Vector3d n = across_w(solve(last_.y), n_);
    // Of what is past the contact, so far as is known, it may be off by half of that.
    const double may_be_off = earliest_ < 0 ? -earliest_ : kEnough * std::abs(last_.z);
    const double off = std::sqrt(0.1 * may_be_off / curve_.trace());
    constexpr double kX[] = {1, -0.5, -0.5}, kY[] = {0, 0.866, -0.866};
    std::array<Vertex, 3> near;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d beside = across_w(Vector2d(off * kX[i], off * kY[i]), n);
      near[i] = farthest(beside);
      below(beside);
    }
    if (!weigh(near)) return false;
    corner = near;
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

  /// Of the plane through the corners taken last, ahead along w.
  std::optional<Vector3d> plane() const {
    if (!slope_.allFinite()) return std::nullopt;
    return across_w(slope_, Vector3d::Unit(axes_.k) / w_(axes_.k));
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

  static constexpr int kMostSteps = 64;
  static constexpr double kEnough = 1e-8, kKnown = 1e-6;

  const Scene& scene_;
  Vector3d w_;
  ShadowAxes axes_;
  double u_, v_;
  RoundSupport support_{};  // of n_, and its point
  Vector3d n_ = Vector3d::Zero();
  Vertex last_{};
  double earliest_ = -std::numeric_limits<double>::infinity(),
         latest_ = std::numeric_limits<double>::infinity();
  double turn_[3] = {}, sure_ = 0;  // turns, and the least of them over what it may be off
  Vector2d slope_ = Vector2d::Zero();
  bool inside_ = false;  // see meeting
  double part_ = 0;      // of the way, at the contact
  Eigen::Matrix2d curve_ = Eigen::Matrix2d::Zero();
  Vector3d normal_ = Vector3d::UnitX(), point_ = Vector3d::Zero();
};

/// The first rung, which remembers what it found around the line, or beside it.
template <class Scene>
struct Around : TriageShadow<Scene> {
  mutable std::array<Vector3d, 3> normals{};
  mutable bool found = false;
  mutable Vector3d beside = Vector3d::Zero();

  bool outside(const Vector3d& n, double largest, const RoundSupport& support) const noexcept {
    if (!TriageShadow<Scene>::outside(n, largest, support)) return false;
    beside = n;
    return true;
  }

  template <std::size_t kCount>
  bool around(const std::array<ShadowPoint, kCount>& corner) const noexcept {
    if (!TriageShadow<Scene>::around(corner)) return false;
    found = kCount == 3 && !corner[0].halfway;
    if (found)
      for (std::size_t i = 0; i < 3; ++i) normals[i] = corner[i].n;
    return true;
  }
};

}  // namespace

std::optional<RoundContact> round_contact(const RoundScene& scene, const Vector3d& w) noexcept {
  const Around<RoundScene> around{{scene, w}};
  if (ShadowSearch(scene, w, around).run() != true || !around.found) return std::nullopt;
  auto found = FirstContact(scene, w).run(around.normals);
  if (!found) return std::nullopt;
  const double scale = std::ldexp(1.0, scene.exponent);
  found->earliest *= scale;
  found->latest *= scale;
  found->point = scene.reference + scale * found->point;
  return found;
}

RoundMeeting round_meeting(const RoundScene& scene, const Vector3d& first, const Vector3d& last,
                           bool plane) noexcept {
  const double unit = std::ldexp(1.0, -scene.exponent);
  SweptScene swept(scene, unit * first, unit * last);
  if (!scene.usable || !(swept.size < 0x1p400)) return {};

  // A point amid it, on the way's side of the origin; where that is nearly there, one farther out.
  const Vector3d way = swept.last - swept.first;
  const double square = way.squaredNorm();
  const double at = square > 0 ? std::clamp((scene.middle - swept.first).dot(way) / square, 0.0, 1.0) : 0;
  Vector3d inside = scene.middle - ((1 - at) * swept.first + at * swept.last);
  const double near = inside.norm();
  const Vector3d ahead = near > 1e-9 * swept.size ? Vector3d(inside / near) : Vector3d::UnitX();
  const auto farthest = [&](const Vector3d& n) { return swept.point(n, swept.least(n)); };
  if (const Vector3d far = farthest(-ahead); near < 0.25 * far.dot(ahead))
    inside = 0.25 * inside + 0.75 * far;
  if (!(inside.cwiseAbs().maxCoeff() > 1e-9 * swept.size)) return {};
  swept.middle = 0.5 * (inside + farthest(inside.unitOrthogonal()));

  const Around<SweptScene> around{{swept, inside}};
  const auto met = ShadowSearch(swept, inside, around).run();
  if (met == false) return {false, around.beside, at};
  if (!met || !around.found) return {};
  return FirstContact(swept, inside).meeting(around.normals, plane);
}

std::optional<bool> round_within(const RoundScene& scene, const Vector3d& w, double from,
                                 double until) noexcept {
  const double largest = w.cwiseAbs().maxCoeff();
  if (!(largest > 1e-100 && largest < 1e100) || !(from >= 0 && until >= from)) return std::nullopt;
  if (!scene.usable) return std::nullopt;
  // All of K along w lies between; and half as much on each side, so that nothing ends at a touch.
  const Vector3d n = w / largest;
  const double unit = std::ldexp(1 / n.dot(w), scene.exponent), slack = 2 * scene.slack;
  const double low = (scene.least(n).value - slack) * unit, high = (slack - scene.least(-n).value) * unit;
  const double room = 0.5 * (high - low) + 0x1p-10 * std::max(std::abs(low), std::abs(high));
  if (!(std::abs(low) < 1e200 && std::abs(high) < 1e200)) return std::nullopt;
  if (from > high + room || until < low - room) return false;
  return round_meeting(scene, std::max(from, low - room) * w, std::min(until, high + room) * w, false).inside;
}

}  // namespace vericone
