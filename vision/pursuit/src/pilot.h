// SPDX-License-Identifier: BSD-3-Clause
//
// From what is believed of the vehicles to the UAS's acceleration.
#pragma once

#include <vericone/vision/pursuit/pursuit.h>

namespace vericone::vision {

/// A followed vehicle as the pilot is told of it, now.
struct Known {
  Eigen::Vector2d position = Eigen::Vector2d::Zero(), velocity = Eigen::Vector2d::Zero(),
                  acceleration = Eigen::Vector2d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  // of position and velocity
  bool left_out = false;                                 // hidden for too long
};

class Pilot {
 public:
  explicit Pilot(const Pursuit& pursuit);

  /// The command at a time that does not go back, and what was thought on the way, into `sample`; `focal`: of
  /// the camera, px.
  simulation::VehicleCommand step(const simulation::Motion& own, std::span<const Known> known, double focal,
                                  double t, PursuitSample& sample);
  [[nodiscard]] double layer_share() const { return steps_ ? double(in_layer_) / double(steps_) : 0; }

 private:
  void rendezvous(const simulation::Motion& own, const Known& target, PursuitSample& sample);
  void focal_law(const simulation::Motion& own, double t, PursuitSample& sample);
  void ours(const simulation::Motion& own, std::span<const Known> known, PursuitSample& sample);
  double climb(const simulation::Motion& own, std::span<const Known> known, double focal,
               PursuitSample& sample);

  const Pursuit& pursuit_;
  guidance::EllipseFollower follower_;
  guidance::FocalLaw law_;
  std::optional<guidance::VerticalLaw> vertical_;
  std::array<guidance::SingerFilter, 2> foci_;
  std::vector<Eigen::Vector2d> centres_, velocities_;
  std::size_t steps_ = 0, in_layer_ = 0;
};

/// What the laws' functions say of a truth, for the logs: y_1 and y_2 as the source has them.
void evaluate(const Pursuit& pursuit, const simulation::Motion& own,
              std::span<const simulation::RoadPoint> truth, guidance::EllipseFollower& follower,
              PursuitSample& sample);

}  // namespace vericone::vision
