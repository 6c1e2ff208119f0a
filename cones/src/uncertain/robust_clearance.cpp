// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/uncertain/robust.h>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone {
namespace {

using Eigen::Vector3d;

/// The normals with n.w + h_W(n) = 0, by their azimuth about w, and what the clearance is there.
class Rim {
 public:
  Rim(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w, const ErrorSet& position,
      const ErrorSet& velocity)
      : a_(a), b_(b), c_(b.center() - a.center()), w_(w), position_(position), velocity_(velocity) {
    speed_ = w.norm();
    along_ = w / speed_;
    e1_ = along_.unitOrthogonal();
    e2_ = along_.cross(e1_);
  }

  struct At {
    Vector3d n;
    double value, slope, time;
  };

  /// The largest, by the slope's change of sign beside the best of some starts. A maximum that is positive,
  /// of a passage ahead, is the only one, as the condition is concave; elsewhere three times as many starts
  /// are looked at.
  At largest() const {
    static const std::array<Eigen::Vector2d, kMost> starts = [] {
      std::array<Eigen::Vector2d, kMost> all;
      for (int i = 0; i < kMost; ++i) all[std::size_t(i)] = {std::cos(kStep * i), std::sin(kStep * i)};
      return all;
    }();
    int best = 0, apart = kMost / kFew;
    double most = -std::numeric_limits<double>::infinity();
    const auto look = [&](int i) {
      const Eigen::Vector2d& start = starts[std::size_t(i)];
      const double found = value(normal(start.x(), start.y()));
      if (found > most) most = found, best = i;
    };
    for (int i = 0; i < kMost; i += apart) look(i);
    if (!(most > 0)) {
      for (int i = 0; i < kMost; ++i)
        if (i % apart != 0) look(i);
      apart = 1;
    }
    At top = at(kStep * best);
    double from = kStep * best, to = kStep * (best + (top.slope > 0 ? apart : -apart));
    double at_from = top.slope, at_to = at(to).slope;
    if (!(at_from * at_to < 0)) return top;
    for (int i = 0; i < 60; ++i) {
      const double middle = from - at_from * (to - from) / (at_to - at_from);
      const At now = at(middle);
      if (now.value >= top.value) top = now;
      if (now.slope == 0 || std::min(std::abs(middle - from), std::abs(middle - to)) < 1e-10) break;
      // The end that stays counts for half, so that both move (Illinois).
      if ((now.slope > 0) == (at_to > 0)) {
        to = middle, at_to = now.slope;
        at_from *= 0.5;
      } else {
        from = middle, at_from = now.slope;
        at_to *= 0.5;
      }
    }
    return top;
  }

 private:
  static constexpr int kFew = 8, kMost = 16;
  static constexpr double kStep = 2 * std::numbers::pi / kMost;

  Vector3d normal(double cosine, double sine) const {
    const Vector3d e = cosine * e1_ + sine * e2_;
    return velocity_.none() ? e : turned(e);
  }

  double value(const Vector3d& n) const {
    return n.dot(c_) - a_.radius(n) - b_.radius(n) - position_.support(n);
  }

  At at(double azimuth) const {
    At r;
    r.n = normal(std::cos(azimuth), std::sin(azimuth));
    const Vector3d fastest = velocity_.none() ? w_ : Vector3d(w_ + velocity_.support_point(r.n));
    Vector3d apart = c_ - reach(a_, r.n) - reach(b_, r.n);
    if (!position_.none()) apart -= position_.support_point(r.n);
    r.value = r.n.dot(apart);
    // Along the rim n moves across itself and across the gradient of the constraint.
    r.slope = apart.dot(fastest.cross(r.n));
    r.time = apart.dot(fastest) / fastest.squaredNorm();
    return r;
  }

  static Vector3d reach(const Ellipsoid& body, const Vector3d& n) {
    const Vector3d u = body.factor().transpose() * n;
    return body.factor() * (u / u.norm());
  }

  /// cos b e - sin b along with n.w + h_W(n) = 0: Newton, whose iterates stay between 0 and a quarter turn.
  Vector3d turned(const Vector3d& e) const {
    double s = velocity_.support(e) / speed_;
    Vector3d n = e;
    for (int i = 0; i < 30; ++i) {
      s = std::min(s, 1 - 1e-9);
      const double c = std::sqrt(1 - s * s);
      n = c * e - s * along_;
      if (velocity_.factors().empty() && velocity_.segments().empty()) return n;
      const Vector3d v = velocity_.support_point(n);
      const double off = v.dot(n) - s * speed_;
      // d/ds of h_W(n) - s |w|, with dn/ds = -s/c e - along.
      const double rate = -(s / c) * v.dot(e) - v.dot(along_) - speed_;
      const double next = s - off / rate;
      if (!(rate < 0) || std::abs(next - s) <= 1e-14) break;
      s = std::max(next, 0.0);
    }
    return n;
  }

  const Ellipsoid &a_, &b_;
  Vector3d c_, w_, along_, e1_, e2_;
  double speed_;
  const ErrorSet &position_, &velocity_;
};

}  // namespace

std::optional<RobustClearance> robust_clearance(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w,
                                                const ErrorSet& position, const ErrorSet& velocity) {
  const double speed = w.norm();
  if (!(speed > 0 && std::isfinite(speed)) || !(velocity.support(w / speed) < speed * (1 - 1e-9)))
    return std::nullopt;
  const Rim::At top = Rim(a, b, w, position, velocity).largest();
  return RobustClearance{top.value, top.n, top.time};
}

}  // namespace vericone
