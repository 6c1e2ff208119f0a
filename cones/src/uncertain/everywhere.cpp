// SPDX-License-Identifier: BSD-3-Clause
#include "uncertain/everywhere.h"

#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/Geometry>
#include <array>

#include "uncertain/inward.h"

namespace vericone::robust {
namespace {

constexpr int kMostCells = 10'000, kDeepest = 44;
constexpr double kRounding = 0x1p-46;  // of every term: each is made by fewer than 40 roundings

/// A normal, and what does not depend on the point of K: at time t the farthest error reaches
/// reach + t late along it.
struct Normal {
  Vector3d n;
  double reach, late;     // n.c + h_P(n), h_W(n) - n.w
  double about, about_w;  // their sizes, for rounding
};

struct Cell {
  std::array<Normal, 3> corner;
  int depth;
};

class Search {
 public:
  Search(const Engagement& inner, const Engagement& outer, bool prove)
      : inner_(inner), outer_(outer), prove_(prove) {}

  Everywhere run() {
    seed();
    climb();
    if (found_.passes || !prove_) return found_;
    found_.all_collide = cover();
    return found_;
  }

 private:
  Normal normal(const Vector3d& n) const {
    const double length = n.norm();
    return {n, n.dot(inner_.c) + inner_.position.support(n), inner_.velocity.support(n) - n.dot(inner_.w),
            length * (inner_.c.norm() + inner_.position.reach()),
            length * (inner_.w.norm() + inner_.velocity.reach())};
  }

  /// An octahedron about w, in coordinates in which K is nearly round.
  void seed() {
    const auto shape = [](const Side& side) {
      return side.ellipsoid() ? side.ellipsoid()->shape()
                              : Matrix3d(Matrix3d::Identity() * (side.reach() * side.reach()));
    };
    const Cholesky<3> root = cholesky<3>(shape(inner_.a) + shape(inner_.b));
    Matrix3d l = Matrix3d::Identity();
    if (root.positive && root.lower.allFinite()) l = root.lower;
    Vector3d axis = l.triangularView<Eigen::Lower>().solve(inner_.w);
    if (!(axis.norm() > 0 && axis.allFinite())) axis = Vector3d::UnitZ();
    axis.normalize();
    const Vector3d e = axis.unitOrthogonal(), f = axis.cross(e);
    const auto lower = l.transpose().triangularView<Eigen::Upper>();
    const double size = l.diagonal().maxCoeff();
    const auto place = [&](const Vector3d& m) { return normal(size * Vector3d(lower.solve(m))); };
    const Normal top = place(axis), bottom = place(-axis);
    const Normal ring[4] = {place(e), place(f), place(-e), place(-f)};
    for (int i = 0; i < 4; ++i) {
      stack_[count_++] = {{bottom, ring[(i + 1) % 4], ring[i]}, 0};
      stack_[count_++] = {{top, ring[i], ring[(i + 1) % 4]}, 0};
    }
  }

  /// G(n) = min over t in [0, T] of n.(c - t w) + h_P(n) + t h_W(n) - h_K(n), over |n|; of T = infinity
  /// negative where the gap closes in the end. And the direction in which it grows.
  double passing(const Vector3d& n, Vector3d* uphill = nullptr) const {
    const Vector3d k = outer_.farthest(n), p = outer_.position.support_point(n);
    const double now = n.dot(outer_.c + p - k);
    const Vector3d slowest = outer_.w - outer_.velocity.support_point(n);
    const double closing = n.dot(slowest);
    if (uphill) *uphill = outer_.c + p - k;
    if (closing <= 0) return now;
    if (std::isfinite(outer_.horizon)) {
      if (uphill) *uphill -= outer_.horizon * slowest;
      return now - outer_.horizon * closing;
    }
    // The gap closes in the end: back to where it does not.
    if (uphill) *uphill = -slowest;
    return -std::numeric_limits<double>::infinity();
  }

  bool offer(const Vector3d& n) {
    found_.passes = passing_error(outer_, n);
    return found_.passes.has_value();
  }

  /// Uphill from the best of some normals across w, where the widest gap most often is.
  void climb() {
    Vector3d best = Vector3d::Zero(), uphill = best;
    double most = -std::numeric_limits<double>::infinity();
    // As it is, and turned so that the gap along it does not close at all.
    const auto look = [&](const Vector3d& m) {
      bool better = false;
      for (const bool turned : {false, true}) {
        Vector3d n = m;
        if (turned ? !open_for_ever(n) : !std::isfinite(outer_.horizon)) continue;
        n.normalize();
        Vector3d growing;
        const double value = passing(n, &growing);
        if (value > most) most = value, best = n, uphill = growing, better = true;
      }
      return better;
    };
    const int seeds = count_;
    for (int i = 0; i < seeds; i += 2) look(stack_[i].corner[1].n);
    look(outer_.c);
    if (best.isZero(0)) return;
    double step = 0.5;
    for (int i = 0; i < 24 && step > 0.01; ++i) {
      if (most > 0 && offer(best)) return;
      const Vector3d across = uphill - uphill.dot(best) * best;
      const double slope = across.norm();
      // Half a radian as steep would not do: no error passes near here, most likely.
      if (!(most + 0.5 * slope > 0)) break;
      if (!look(best + across * (step / slope))) step *= 0.4;
    }
    if (most > 0) offer(best);
  }

  /// Turns n against w until the slowest error does not close the gap.
  bool open_for_ever(Vector3d& n) const {
    const double speed = outer_.w.norm();
    if (!(speed > 0)) return true;
    const Vector3d along = outer_.w / speed;
    for (int i = 0; i < 3; ++i) {
      const double slowest = outer_.velocity.support(n), closing = n.dot(outer_.w) - slowest;
      if (closing <= -1e-12 * slowest && closing < 0) return true;
      // A little more, as errors are rounded inwards.
      n -= along * ((closing + 1e-11 * (slowest + n.norm() * speed)) / speed);
    }
    return n.dot(outer_.w) - outer_.velocity.support(n) < 0;
  }

  /// One point of K and one time for all normals of the cell.
  bool collides(const Cell& cell, const Vector3d& middle) const {
    const Vector3d k = inside(middle);
    double from = 0, to = inner_.horizon;
    const auto fixed = [&](const Normal& v) {
      return v.reach - v.n.dot(k) + kRounding * (v.about + v.n.norm() * inner_.reach());
    };
    double now[3];
    for (int i = 0; i < 3; ++i) {
      const Normal& v = cell.corner[i];
      now[i] = fixed(v);
      const double late = v.late + kRounding * v.about_w;
      if (late < 0)
        from = std::max(from, now[i] / -late);
      else if (late > 0)
        to = std::min(to, -now[i] / late);
      else if (now[i] > 0)
        return false;
    }
    if (!(from <= to)) return false;
    const double t = std::min(0.5 * (from + to), 2 * from);
    for (int i = 0; i < 3; ++i) {
      const Normal& v = cell.corner[i];
      const double late = v.late + kRounding * v.about_w;
      if (!(now[i] + t * late + kRounding * t * (std::abs(v.late) + v.about_w) < 0)) return false;
    }
    return true;
  }

  /// A point surely in K, or so near to it that kRounding covers the rest, far along n.
  Vector3d inside(const Vector3d& n) const {
    const auto of_side = [&](const Side& side, const Vector3d& m) {
      Vector3d x = side.farthest(m);
      const Ellipsoid* body = side.ellipsoid();
      // The factor is the body, or a rounded root of it.
      if (!body || body->defined_by_factor()) return x;
      for (double less = 0x1p-40; less < 1; less *= 16)
        if (side.surely_contains(exactly((1 - less) * x))) return Vector3d((1 - less) * x);
      return Vector3d(Vector3d::Zero());
    };
    return of_side(inner_.a, n) - of_side(inner_.b, -n);
  }

  /// Halves cells along their longest edge until each is decided.
  bool cover() {
    bool all = true;
    while (count_ > 0) {
      if (++found_.cells > kMostCells) return false;
      const Cell cell = stack_[--count_];
      const Vector3d middle = cell.corner[0].n + cell.corner[1].n + cell.corner[2].n;
      if (collides(cell, middle)) continue;
      Vector3d open = middle;
      if (passing(middle) > 0 && offer(middle)) return false;
      if (open_for_ever(open) && passing(open) > 0 && offer(open)) return false;
      if (cell.depth == kDeepest) {
        // A graze; an error that passes may still be found elsewhere.
        all = false;
        continue;
      }
      int longest = 0;
      double most = 0;
      for (int i = 0; i < 3; ++i) {
        const double length = (cell.corner[i].n - cell.corner[(i + 1) % 3].n).squaredNorm();
        if (length > most) most = length, longest = i;
      }
      const Normal &p = cell.corner[longest], &q = cell.corner[(longest + 1) % 3],
                   &r = cell.corner[(longest + 2) % 3];
      const Normal half = normal(0.5 * (p.n + q.n));
      stack_[count_++] = {{p, half, r}, cell.depth + 1};
      stack_[count_++] = {{half, q, r}, cell.depth + 1};
    }
    return all;
  }

  const Engagement &inner_, &outer_;
  bool prove_;
  Everywhere found_;
  std::array<Cell, 8 + kDeepest + 2> stack_;
  int count_ = 0;
};

}  // namespace

std::optional<RelativeError> passing_error(const Engagement& e, const Vector3d& n) {
  const Vector3d against = -n;
  const double one = 1;
  RelativeError error;
  error.position = inward(e.position.set, {&n, 1}, {&one, 1});
  error.velocity = inward(e.velocity.set, {&against, 1}, {&one, 1});
  if (e.separates(n, error)) return error;
  return std::nullopt;
}

Everywhere everywhere(const Engagement& inner, const Engagement& outer, bool prove) {
  return Search(inner, outer, prove).run();
}

}  // namespace vericone::robust
