// SPDX-License-Identifier: BSD-3-Clause
//
// From pictures and the UAS's own states to where vehicles are on the ground: tracker, camera and filters in
// one. What a pursuit flies by, and what `vericone track --own` repeats from recorded pictures.
#pragma once

#include <vericone/geometry/camera.h>
#include <vericone/guidance/estimation/filters.h>
#include <vericone/vision/tracker.h>
#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace vericone::vision {

struct PerceptionOptions {
  Camera camera;
  /// m, of the middle of a vehicle above the ground. What a tracker follows of it is
  /// higher, so that from aside it is not where the middle of a box is: the perception puts that right.
  double height = 0;
  guidance::SingerOptions filter;
  double start_speed = 20;        // m/s, deviation of each component of a velocity that nobody has seen yet
  double start_acceleration = 1;  // m/s^2, the same
  /// As the source does (3.4.1): a measurement has `noise`, a hidden vehicle is "measured" where it was
  /// expected, with `hidden_noise`. Otherwise a hidden vehicle gives no measurement, and a seen one has the
  /// tracker's covariance on the ground and `own_noise` in every direction.
  bool source = false;
  double noise = 1, hidden_noise = 10;  // m^2
  double own_noise = 0.1;               // m, deviation: of the own position, of the ground's height
};

/// A vehicle as it is believed to be.
struct Followed {
  Sighting sighting;                                // of the last picture
  std::optional<Eigen::Vector2d> measured;          // m, on the ground
  Eigen::Matrix2d noise = Eigen::Matrix2d::Zero();  // of it, m^2
  guidance::SingerFilter filter;
  double hidden_since = -1;  // s; negative: it is seen
};

class Perception {
 public:
  Perception(const PerceptionOptions& options, std::unique_ptr<Tracker> tracker);

  /// The first picture, taken at time t, s, from a camera that stands there, with a box around every vehicle.
  /// Throws InputError naming "boxes[i]", also for one that does not stand on the ground.
  void start(const Image& image, const Pose& camera, double t, std::span<const Box> boxes);
  /// The next one.
  void step(const Image& image, const Pose& camera, double t);

  [[nodiscard]] const std::vector<Followed>& vehicles() const { return vehicles_; }
  [[nodiscard]] const PerceptionOptions& options() const { return options_; }
  /// Seconds that the tracker and the filters took for the last picture.
  [[nodiscard]] double tracker_seconds() const { return tracker_seconds_; }
  [[nodiscard]] double filter_seconds() const { return filter_seconds_; }

 private:
  /// From what is followed of a vehicle to its middle, m.
  [[nodiscard]] Eigen::Vector2d aside(std::size_t i) const;
  [[nodiscard]] Expectation expected(std::size_t i, const Pose& camera, double t);
  void take(std::size_t i, const Sighting& sighting, const Pose& camera, double t);

  struct Reference {
    double scale = 0;                                 // px a metre in the first picture
    std::optional<double> heading;                    // in the picture, rad, the first one known
    double course = 0;                                // on the ground then, rad, x to y
    double turn = 0;                                  // since, on the ground, rad, x to y
    Eigen::Vector2d aside = Eigen::Vector2d::Zero();  // m, from what is followed to the middle, then
  };

  PerceptionOptions options_;
  std::unique_ptr<Tracker> tracker_;
  std::vector<Followed> vehicles_;
  std::vector<Reference> references_;
  std::vector<Expectation> expectations_;
  std::optional<Eigen::Matrix3d> ground_;  // of the picture before: plane_homography
  double tracker_seconds_ = 0, filter_seconds_ = 0;
};

}  // namespace vericone::vision
