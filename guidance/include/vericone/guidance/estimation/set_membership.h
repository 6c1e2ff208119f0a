// SPDX-License-Identifier: BSD-3-Clause
//
// What bounded errors leave possible: along each axis a polygon of position and velocity that contains the
// true pair, proved. Nothing is assumed of the errors but their bounds.
#pragma once

#include <vericone/internal/geometry/requires.h>
#include <vericone/internal/guidance/estimation/possible_motion.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

namespace vericone::guidance {

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
