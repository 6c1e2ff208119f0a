// SPDX-License-Identifier: BSD-3-Clause
//
// Two moving bodies at an instant: how far apart they are, and for how long that keeps them apart.
#pragma once

#include <Eigen/Core>

#include "motion/path.h"

namespace vericone::motion {

class Look {
 public:
  /// `before`: one at a time nearby, whose normal may be as good here, or null.
  Look(const Path& a, const Path& b, double t, const Look* before = nullptr);

  [[nodiscard]] double t() const { return t_; }
  /// The distance of the bodies as placed in doubles lies between, m.
  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double most() const { return most_; }
  /// By how much the true distance may be another at that time or before, m.
  [[nodiscard]] double rounding(double t) const;
  /// They come nearer by at most that, m/s, but for accelerations.
  [[nodiscard]] double closing() const;
  /// From the agent towards the obstacle, unit, that of the widest gap known; zero where there is none.
  [[nodiscard]] const Eigen::Vector3d& normal() const { return normal_; }

  /// The true bodies are farther apart than this all over [t - back, t + ahead], proved, where no body that
  /// brakes comes to stand in between; m. Not above 0: nothing is proved.
  [[nodiscard]] double bound(double back, double ahead) const;

 private:
  [[nodiscard]] double by_plane(const Eigen::Vector3d& n, double back, double ahead) const;

  const Path &path_a_, &path_b_;
  double t_, least_ = 0, most_ = 0;
  Eigen::Vector3d between_, velocity_, acceleration_;  // of the obstacle's center less the agent's
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero(), other_ = Eigen::Vector3d::Zero();
  Placed a_, b_;  // about their centers
};

}  // namespace vericone::motion
