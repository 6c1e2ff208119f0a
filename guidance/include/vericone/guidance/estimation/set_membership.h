// SPDX-License-Identifier: BSD-3-Clause
//
// What bounded errors leave possible: along each axis a polygon of position and velocity that contains the
// true pair, proved. Nothing is assumed of the errors but their bounds.
#pragma once

#include <vericone/internal/geometry/requires.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
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

/// Three axes. A polygon has at most 24 corners before it is replaced by one around it. Cost: some 4 us a
/// step.
class SetMembershipFilter {
 public:
  /// `most`: bound of the body's acceleration along each axis, m/s^2.
  explicit SetMembershipFilter(double most = 0) : most_(most) {}

  /// Errors of at most `position_error` (m) and `velocity_error` (m/s) along each axis. Times, s, do not go
  /// back. False where an error broke its bound: the belief then starts again from this measurement.
  bool step(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
            const Eigen::Vector3d& position_error, const Eigen::Vector3d& velocity_error, double time);

  [[nodiscard]] bool started() const { return axes_.has_value(); }
  [[nodiscard]] const PossibleMotion& axis(int i) const {
    VERICONE_REQUIRES(started() && i >= 0 && i < 3, "i", "no such axis, or no measurement",
                      "0, 1 or 2, of a filter that has met a measurement");
    return (*axes_)[std::size_t(i)];
  }
  /// The middle of the bounds, and half their width rounded up.
  [[nodiscard]] Eigen::Vector3d position() const;
  [[nodiscard]] Eigen::Vector3d velocity() const;
  [[nodiscard]] Eigen::Vector3d position_radius() const;
  [[nodiscard]] Eigen::Vector3d velocity_radius() const;

 private:
  double most_;
  double time_ = 0;
  std::optional<std::array<PossibleMotion, 3>> axes_;
};

}  // namespace vericone::guidance
