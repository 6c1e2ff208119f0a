// SPDX-License-Identifier: BSD-3-Clause
//
// What bounded errors leave possible of one axis of a motion.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace vericone::guidance {

/// Closed, with low <= high.
struct Bounds {
  double low = 0, high = 0;                                           // in the unit bounded
  [[nodiscard]] double middle() const { return 0.5 * (low + high); }  // in the unit bounded
};

/// One axis. The possible pairs (position, velocity) are the polygon's points, each moved by at most `slack`
/// in position and in velocity: that is where rounding goes, outwards.
class PossibleMotion {
 public:
  using Point = Eigen::Vector2d;  // m, m/s

  /// Nothing is known but these bounds.
  PossibleMotion(const Bounds& position, const Bounds& velocity);

  /// `dt` seconds later, with an acceleration of at most `most` (m/s^2) either way, of any form. The motion
  /// under it lies in a parallelogram: |dp - dt dv / 2| <= most dt^2 / 4, |dv| <= most dt.
  void advance(double dt, double most);

  /// A measurement: the pair lies within these as well. False where that leaves nothing: then an error was
  /// larger than its bound, and all is as it was.
  bool meet(const Bounds& position, const Bounds& velocity);

  [[nodiscard]] Bounds position() const;
  [[nodiscard]] Bounds velocity() const;
  /// Of position + t velocity, t >= 0 in s.
  [[nodiscard]] Bounds position_after(double t) const;
  [[nodiscard]] bool contains(double position, double velocity) const;
  [[nodiscard]] std::size_t corners() const { return corners_.size(); }

 private:
  void simplify();
  void keep_below(std::vector<Point>& polygon, int axis, double sign, double bound);

  std::vector<Point> corners_;  // counter-clockwise; one or two for a degenerate set
  Eigen::Vector2d slack_ = Eigen::Vector2d::Zero();
};

}  // namespace vericone::guidance
