// SPDX-License-Identifier: BSD-3-Clause
//
// How an agent sees an engagement on a plane: errors of what is measured, the source's filters of y, psi and
// theta_b, and the outer loop of its chapter 7.
#pragma once

#include <vericone/guidance/estimation/constant_rate.h>
#include <vericone/guidance/noise.h>
#include <vericone/guidance/robust_law.h>

namespace vericone::guidance {

/// One number for each quantity that a sensor of the engagement measures, (7.2): parts of the true value, or
/// radians.
struct EngagementParts {
  double r = 0, v_r = 0, v_theta = 0;      // parts
  double theta = 0, theta_b = 0, psi = 0;  // rad
};

/// One measurement: errors on the plane that are made now, and how large they usually are. Sensors of
/// position and velocity have made theirs in the bodies already; of them only the size is known here.
struct Sight {
  bool measured = false;  // otherwise all is known, and the rest is 0
  EngagementParts errors, deviations;
  double position_deviation = 0;  // m, of the relative position, along any direction
  double velocity_deviation = 0;  // m/s
};

/// Standard deviations of what is measured on the plane at a (measured) state: those of (7.2), and, to first
/// order, those of position and velocity; of psi as for a ball.
[[nodiscard]] Measured deviations_on_plane(const Sight& sight, const PlanarState& state,
                                           const PlaneCone& cone);

/// What is filtered, by constant_rate.h. The source filters y for its outer loop and the rates psi', theta_b'
/// (7.4); its models and intensities are not printed.
struct PlaneFilterOptions {
  bool y = false, rates = false;
  double intensity_y = 0.01;     // 1/s^3
  double intensity_angle = 0.1;  // rad^2/s^3
  double gate = 16;              // standard deviations, squared

  [[nodiscard]] bool any() const { return y || rates; }
};

/// The filters of one engagement.
class PlaneFilters {
 public:
  explicit PlaneFilters(const PlaneFilterOptions& options);

  /// A measured state and cone, the turning of the line of sight since the last, rad, and the standard
  /// deviations. Rates of `cone` are replaced where they are filtered. Returns y as it is to be used.
  /// Of the rates it writes the deviations too, those of the filters.
  double step(const PlanarState& state, PlaneCone& cone, double turned, Measured& deviations, double time);

 private:
  PlaneFilterOptions options_;
  ConstantRateFilter y_, psi_, theta_b_;
  double turned_ = 0, last_theta_b_ = 0;
};

/// The outer loop of (7.14)-(7.24) beside the inversion: z = y - w of the y used, limits as the actuator
/// leaves them.
struct OuterLoopOptions {
  RobustModel model;  // its gain and sign_b are those of the law
  RobustOptions options;
  /// a and |b| from the noise of the moment (noise_range) in place of those of `model`.
  bool from_noise = false;
};

/// u to be added to the inner loop's lateral acceleration `inner`, both within `most`. `by_lateral_a`: dy'/da
/// of the measured state, whose sign is that of b.
[[nodiscard]] RobustCorrection outer_loop(const OuterLoopOptions& outer, double z, double inner, double most,
                                          double gain, double by_lateral_a, const PlanarState& state,
                                          const PlaneCone& cone, const Measured& deviations);

}  // namespace vericone::guidance
