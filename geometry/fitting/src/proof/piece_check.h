// SPDX-License-Identifier: BSD-3-Clause
//
// One piece of a hull, given by its quadrics, against points, triangles and balls.
#pragma once

#include <vector>
#include "proof/ball_bound.h"
#include "proof/quadratic_form.h"
#include "proof/triangle_form.h"

namespace vericone::fitting {

class PieceCheck {
 public:
  using Corners = std::array<Eigen::Vector3d, 3>;

  PieceCheck(const std::vector<Quadric>& quadrics, const Eigen::Vector3d& near);

  /// Whether the point is in the piece, by intervals; and exactly.
  Known contains(const Eigen::Vector3d& x) const;
  bool contains_exactly(const Eigen::Vector3d& x) const;

  /// The same for triangles whose corners are in the piece.
  Known contains(const Corners& corners) const;
  bool contains_exactly(const Corners& corners) const;
  /// Then no triangle needs to be asked.
  bool convex() const { return convex_; }

  /// Where intervals prove it of the ball.
  bool contains_ball(const Eigen::Vector3d& x, double radius) const;

  /// The largest of the quadrics' values, each scaled to -1 at its centre (those without depth are left out);
  /// rounded.
  double value(const Eigen::Vector3d& x) const;

 private:
  std::vector<QuadraticForm> forms_;
  std::vector<BallBound> balls_;
  bool convex_ = true;
};

}  // namespace vericone::fitting
