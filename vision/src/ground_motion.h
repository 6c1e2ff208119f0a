// SPDX-License-Identifier: BSD-3-Clause
//
// How the ground moves through the pictures of a moving camera.
#pragma once

#include <vericone/vision/tracker.h>
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

namespace vericone::vision {

/// Follows corners of the ground from picture to picture, at half resolution: a plane fitted to a hundred of
/// them needs no finer, and a quarter of the pixels is a quarter of the time.
class GroundMotion {
 public:
  void start(const cv::Mat& grey);
  /// (u, v, 1) of the picture before to this one, of points on the ground. `targets` and their surroundings
  /// are no ground. The last motion goes on where too little can be followed.
  Eigen::Matrix3d step(const cv::Mat& grey, std::span<const Box> targets);

 private:
  void find_corners(std::span<const Box> targets);

  std::vector<cv::Mat> before_, now_;  // pyramids with derivatives
  std::vector<cv::Point2f> corners_;   // in before_
  cv::Mat half_;
  Eigen::Matrix3d last_ = Eigen::Matrix3d::Identity();  // at half resolution
  int since_ = 0;
};

}  // namespace vericone::vision
