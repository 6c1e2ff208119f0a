// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/uncertain/robust.h>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
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

  At at(double azimuth) const {
    const Vector3d e = std::cos(azimuth) * e1_ + std::sin(azimuth) * e2_;
    At r;
    r.n = velocity_.none() ? e : turned(e);
    const Vector3d fastest = velocity_.none() ? w_ : Vector3d(w_ + velocity_.support_point(r.n));
    Vector3d apart = c_ - reach(a_, r.n) - reach(b_, r.n);
    if (!position_.none()) apart -= position_.support_point(r.n);
    r.value = r.n.dot(apart);
    // Along the rim n moves across itself and across the gradient of the constraint.
    r.slope = apart.dot(fastest.cross(r.n));
    r.time = apart.dot(fastest) / fastest.squaredNorm();
    return r;
  }

 private:
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
      if (!(rate < 0) || std::abs(next - s) <= 1e-15) break;
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
  const Rim rim(a, b, w, position, velocity);
  constexpr int kStart = 16;
  constexpr double kStep = 2 * std::numbers::pi / kStart;
  int best = 0;
  std::array<Rim::At, kStart> around;
  for (int i = 0; i < kStart; ++i) {
    around[std::size_t(i)] = rim.at(kStep * i);
    if (around[std::size_t(i)].value > around[std::size_t(best)].value) best = i;
  }
  // The slope changes its sign beside the best.
  Rim::At top = around[std::size_t(best)];
  const int other = top.slope > 0 ? best + 1 : best - 1;
  double from = kStep * best, to = kStep * other;
  double at_from = top.slope, at_to = around[std::size_t((other + kStart) % kStart)].slope;
  if (at_from * at_to < 0) {
    for (int i = 0; i < 60 && std::abs(to - from) > 1e-15; ++i) {
      double middle = from - at_from * (to - from) / (at_to - at_from);
      if (!(std::abs(middle - from) < std::abs(to - from))) middle = 0.5 * (from + to);
      const Rim::At now = rim.at(middle);
      if (now.value >= top.value) top = now;
      if (now.slope == 0 || std::abs(middle - from) < 1e-14 || std::abs(middle - to) < 1e-14) break;
      // The end that stays counts for half, so that both move (Illinois).
      if ((now.slope > 0) == (at_to > 0)) {
        to = middle, at_to = now.slope;
        at_from *= 0.5;
      } else {
        from = middle, at_from = now.slope;
        at_to *= 0.5;
      }
    }
  }
  return RobustClearance{top.value, top.n, top.time};
}

}  // namespace vericone
