// SPDX-License-Identifier: BSD-3-Clause
//
// Certificates that two moving bodies stay apart during a piece of time (docs/explanation/proof-of-runs.md).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "proof/swept_body.h"

namespace vericone::simulation {

/// Both bodies at one time.
struct Moment {
  double t = 0;
  Motion a, b;
  Eigen::Vector3d between() const { return b.position - a.position; }
};

/// m: what rounding may take from a place on a track in [from, to]. Places are sums of where a leg began and
/// what was flown since, so a body that comes from far off has it near the origin too. Of curves: with |p''|
/// <= a over h seconds the terms of p'', of degree 3, add up to 99 a at most, those of p to half as many h^2.
double rounding_of(const Track& track, double from, double to);

/// Two tracks and what is known of them over [from, to].
class MovingPair {
 public:
  MovingPair(const Track& a, const Track& b, double from, double to);

  const Track& a() const { return *a_; }
  const Track& b() const { return *b_; }
  bool planar() const { return planar_; }
  /// No point of the body is ever farther from its reference point.
  double reach_a() const { return reach_a_; }
  double reach_b() const { return reach_b_; }
  /// Of where one is from the other, by the places of both.
  double rounding() const { return rounding_; }
  Moment at(double t) const { return {t, a_->motion(t), b_->motion(t)}; }
  /// All shapes of [from, to] at a rotation, and turned from it by at most `angle`.
  SweptBody swept_a(double from, double to, const Eigen::Matrix3d& rotation, double angle) const;
  SweptBody swept_b(double from, double to, const Eigen::Matrix3d& rotation, double angle) const;

 private:
  const Track *a_, *b_;
  double reach_a_, reach_b_, rounding_;
  bool planar_;
};

/// A piece of time with its ends and a time between.
struct Piece {
  Moment from, middle, to;
  double duration() const { return to.t - from.t; }
};

struct Certificate {
  /// A lower bound of the distance all over the piece, proved, metres; not above 0: none.
  double bound = -1;
  /// The same at the middle alone, there nearly the distance of the bodies' convex hulls. Not proved.
  double gap = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, from A towards B
};

/// Half of what a body turns during a piece; nothing in no time, whatever the bound says.
double half_turn(const Track::Bounds& bounds, const Piece& piece);

/// How far the way from A's position to B's may be from its chord over `dt` seconds: accelerations bend it,
/// and jumps of the velocities.
double chord_deviation(const Track::Bounds& a, const Track::Bounds& b, double dt);

/// By planes: one normal n with n.x smaller on A than on B by the bound at all times of the piece. Deviations
/// from the chord, turning and changes of shape are allowed for. `previous`: a normal worth trying, or zero.
Certificate separate(const MovingPair& pair, const Piece& piece, const Eigen::Vector3d& previous);

}  // namespace vericone::simulation
