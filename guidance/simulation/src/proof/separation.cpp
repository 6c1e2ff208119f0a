// SPDX-License-Identifier: BSD-3-Clause
#include "proof/separation.h"

#include <vericone/cones/ellipsoids/clearance.h>
#include <algorithm>
#include <cmath>

#include "proof/least_point.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

/// With e a direction that turns against the body, h(e) has d2/dt2 >= -|h'| |e''| as h is convex, and dh/dt
/// jumps down by at most |h'| times the jump of e': what h can rise above its chord, for |h'| = 1.
double bend(const Track::Bounds& bounds, double dt) {
  if (bounds.turn_rate == 0 || dt == 0) return 0;
  return bounds.turn_acceleration * dt * dt / 8 + bounds.turn_jumps * dt / 4;
}

/// The bodies over a piece, and the best certificate so far.
class Separator {
 public:
  Separator(const MovingPair& pair, const Piece& piece)
      : planar_(pair.planar()),
        from_(piece.from.between()),
        middle_(piece.middle.between()),
        to_(piece.to.between()),
        bounds_a_(pair.a().bounds(piece.from.t, piece.to.t)),
        bounds_b_(pair.b().bounds(piece.from.t, piece.to.t)),
        a_(pair.swept_a(piece.from.t, piece.to.t, piece.middle.a.rotation, half_turn(bounds_a_, piece))),
        b_(pair.swept_b(piece.from.t, piece.to.t, piece.middle.b.rotation, half_turn(bounds_b_, piece))) {
    const double dt = piece.duration();
    // Positions are within |a| dt^2 / 8 of the chord, however the acceleration turns.
    deviation_ = chord_deviation(bounds_a_, bounds_b_, dt) * (1 + 1e-12);
    rounding_ = 1e-14 * (from_.norm() + to_.norm()) + 2 * pair.rounding();
    // The support of a turning body is within this of the chord, on its upper side.
    bend_ = (a_.extent() * bend(bounds_a_, dt) + b_.extent() * bend(bounds_b_, dt)) * (1 + 1e-12);
    if (std::max(a_.angle(), b_.angle()) > 0 && std::isfinite(bend_)) {
      const double from = piece.from.t, to = piece.to.t;
      ends_.emplace(Ends{
          pair.swept_a(from, to, piece.from.a.rotation, 0), pair.swept_b(from, to, piece.from.b.rotation, 0),
          pair.swept_a(from, to, piece.to.a.rotation, 0), pair.swept_b(from, to, piece.to.b.rotation, 0)});
    }
  }

  const Certificate& best() const { return best_; }

  /// Tries a direction, and the one perpendicular to the relative motion next to it.
  void attempt(Vector3d n) {
    if (planar_) n.z() = 0;
    const double length = n.norm();
    if (!(length > 0)) return;
    n /= length;
    double bound =
        std::min(n.dot(from_), n.dot(to_)) - deviation_ - a_.support(n) - b_.support(-n) - rounding_;
    if (ends_) {
      const double first = n.dot(from_) - ends_->from_a.support(n) - ends_->from_b.support(-n);
      const double last = n.dot(to_) - ends_->to_a.support(n) - ends_->to_b.support(-n);
      bound = std::max(bound, std::min(first, last) - deviation_ - bend_ - rounding_);
    }
    if (best_.normal.isZero(0) || bound > best_.bound) {
      best_.bound = bound;
      best_.normal = n;
    }
  }

  void attempt_both(const Vector3d& n) {
    attempt(n);
    const Vector3d w = from_ - to_;
    if (w.squaredNorm() > 0) attempt(n - n.dot(w) / w.squaredNorm() * w);
  }

  /// Ellipsoids around the bodies, and their own answers about distance and passing.
  void by_ellipsoids(const Ellipsoid& a, const Ellipsoid& about_origin) {
    const Ellipsoid b = about_origin.translated(middle_);
    const Separation apart = separation(a, b);
    if (apart.distance > 0) {
      best_.gap = std::max(best_.gap, apart.distance);
      attempt(apart.normal);
    }
    const Vector3d w = from_ - to_;
    if (w.norm() > 1e-6 * (a_.reach() + b_.reach())) attempt(clearance(a, b, w).normal);
    latest_ = apart.normal;
  }

  /// Delimited bodies: ellipsoids around them that fit at the normal of the last ones, until nothing
  /// improves.
  void by_fitting_ellipsoids(const Vector3d& previous) {
    by_ellipsoids(a_.body().ellipsoid(), b_.body().ellipsoid());
    // Ellipsoids apart: what is missing is a shorter piece of time.
    if (best_.bound > 0 || best_.gap > 0) return;
    if (!previous.isZero(0)) {
      attempt(previous);
      if (best_.bound > 0) {
        best_.gap = std::max(
            best_.bound, best_.normal.dot(middle_) - a_.support(best_.normal) - b_.support(-best_.normal));
        return;
      }
    }
    Vector3d n = !latest_.isZero(0) ? latest_ : !previous.isZero(0) ? previous : middle_;
    constexpr int kMostRounds = 4;
    for (int round = 0; round < kMostRounds; ++round) {
      n.normalize();
      const double before = best_.gap;
      by_ellipsoids(a_.around(n), b_.around(-n));
      if (best_.bound > 0 || latest_.isZero(0) || !(best_.gap > before * 1.001)) return;
      n = latest_;
    }
  }

  /// Hulls: the nearest points of the two.
  void by_nearest_points() {
    const auto farthest = [this](const Vector3d& d) -> Vector3d {
      return middle_ + b_.support_point(d) - a_.support_point(-d);
    };
    const Vector3d nearest = least_point(farthest, middle_);
    if (nearest.isZero(0)) return;
    const Vector3d n = nearest.normalized();
    const double gap = n.dot(farthest(-n));
    best_.gap = std::max(best_.gap, gap);
    attempt_both(n);
  }

  void search(const Vector3d& previous) {
    if (a_.is_ellipsoid() && b_.is_ellipsoid()) {
      by_ellipsoids(a_.body().ellipsoid(), b_.body().ellipsoid());
    } else if (a_.hull() || b_.hull()) {
      by_nearest_points();
    } else {
      by_fitting_ellipsoids(previous);
    }
    if (best_.bound <= 0 && !previous.isZero(0)) attempt(previous);
  }

 private:
  bool planar_;
  Vector3d from_, middle_, to_;  // from A's centre to B's
  Track::Bounds bounds_a_, bounds_b_;
  SweptBody a_, b_;
  struct Ends {
    SweptBody from_a, from_b, to_a, to_b;
  };
  std::optional<Ends> ends_;  // where turning can be followed
  double deviation_, rounding_, bend_;
  Vector3d latest_ = Vector3d::Zero();
  Certificate best_;
};

}  // namespace

double rounding_of(const Track& track, double from, double to) {
  double most = track.legs().empty() ? track.motion(track.appears()).position.norm() : 0;
  for (const auto& leg : track.legs()) {
    if (leg->to() < from || (leg->from() >= to && leg->from() > from)) continue;
    const double h = std::min(to, leg->to()) - leg->from();
    most = std::max(most, leg->start().position.norm() +
                              h * (leg->start().velocity.norm() + 50 * h * leg->most_acceleration()));
  }
  return 0x1p-50 * most;
}

MovingPair::MovingPair(const Track& a, const Track& b, double from, double to)
    : a_(&a),
      b_(&b),
      reach_a_(reach(a.shape())),
      reach_b_(reach(b.shape())),
      rounding_(rounding_of(a, from, to) + rounding_of(b, from, to)),
      planar_(simulation::planar(a.shape())) {}

SweptBody MovingPair::swept_a(double from, double to, const Eigen::Matrix3d& rotation, double angle) const {
  return {a_->shape(), reach_a_, from, to, rotation, angle};
}

SweptBody MovingPair::swept_b(double from, double to, const Eigen::Matrix3d& rotation, double angle) const {
  return {b_->shape(), reach_b_, from, to, rotation, angle};
}

double half_turn(const Track::Bounds& bounds, const Piece& piece) {
  const double dt = piece.duration();
  return bounds.turn_rate == 0 || dt == 0 ? 0 : 0.5 * bounds.turn_rate * dt * (1 + 1e-12);
}

double chord_deviation(const Track::Bounds& a, const Track::Bounds& b, double dt) {
  return (a.acceleration + b.acceleration) * dt * dt / 8 + (a.velocity_jumps + b.velocity_jumps) * dt / 4;
}

Certificate separate(const MovingPair& pair, const Piece& piece, const Vector3d& previous) {
  Separator separator(pair, piece);
  separator.search(previous);
  return separator.best();
}

}  // namespace vericone::simulation
