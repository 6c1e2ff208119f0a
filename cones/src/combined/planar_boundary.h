// SPDX-License-Identifier: BSD-3-Clause
//
// What a planar combined quadric can be touched at: its elliptic arcs and its corners.
#pragma once

#include <vericone/geometry/combined.h>
#include <limits>

#include "answers/small_list.h"

namespace vericone {

/// Points are offsets from the body's centre throughout, so nothing is lost far from the origin. Conic 0 is
/// the ellipse, i + 1 the delimiter i.
class PlanarBoundary {
 public:
  struct CornerPoint {
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
    int first = 0, second = 0;  // equal where the body is its centre alone
  };
  /// A conic that is an ellipse, { F u : |u| <= 1 }.
  struct Round {
    int conic = 0;
    Eigen::Matrix2d factor = Eigen::Matrix2d::Identity(), inverse = Eigen::Matrix2d::Identity();
  };

  explicit PlanarBoundary(const CombinedEllipse& body);

  const CombinedEllipse& body() const { return *body_; }
  int conics() const { return static_cast<int>(body_->delimiters().size()) + 1; }

  /// The ellipse first.
  const SmallList<Round, 4>& rounds() const { return rounds_; }

  /// Whether a point of the conic `of` is on the body, the others decide.
  bool on_body(const Eigen::Vector2d& offset, int of) const;
  bool contains(const Eigen::Vector2d& offset) const { return on_body(offset, -1); }

  /// All corners, found anew at each call. A body that is its centre alone (level 0 with nothing around it)
  /// has that one.
  SmallList<CornerPoint, 16> corners() const;

  /// Where the ellipse is the unit disc: conic i is u^T matrix(i) u = level(i).
  Eigen::Matrix2d matrix(int conic) const;
  double level(int conic) const { return conic == 0 ? 1 : body_->delimiters()[conic - 1].level; }

 private:
  const CombinedEllipse* body_;
  SmallList<Round, 4> rounds_;
};

/// The round conic as an ellipse at the body's centre.
Ellipse round_ellipse(const PlanarBoundary& boundary, const PlanarBoundary::Round& round);

/// Where u -> u^T h u changes its sign: directions (unit, up to sign) of the roots of a binary quadratic
/// form. Returns their number, 0 or 2.
int root_directions(const Eigen::Matrix2d& h, Eigen::Vector2d roots[2]);

}  // namespace vericone
