// SPDX-License-Identifier: BSD-3-Clause
//
// What a target looks like, and where a picture shows the same.
#pragma once

#include <vericone/vision/tracker.h>
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace vericone::vision {

/// Where a target is in a picture, how large and turned against its first picture: a point q of the first
/// picture, from the target's centre there, is at centre + scale * R(turn) q.
struct View {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // px
  double scale = 1;
  double turn = 0;  // rad, u to v
};

/// What is known of a view's turn and scale before a picture is looked at: standard deviations about `view`.
struct Form {
  View view;
  double turn = 0, scale = 0;  // rad, of 1
};

/// How well a picture agrees with an appearance at a View.
struct Agreement {
  double correlation = -1;  // weighted, of all pixels, -1 to 1
  // The same, or that of the pixels that agree closely times their share, where it is more: a twig or a line
  // of the ground is a few pixels that are far off, and lets all look different.
  double alike = -1;
  double visible = 0;  // weighted share of the pixels that agree one by one, 0 to 1
  double inside = 0;   // weighted share of the pixels that lie in the picture
  double gain = 1, bias = 0;
};

/// A grid of grey levels over a target and a margin around it, with what each is worth: pixels that stay the
/// same while the target moves are the target's.
class Appearance {
 public:
  Appearance() = default;
  /// `size`: of the target in its first picture, px.
  Appearance(const cv::Mat& grey, const View& view, const Eigen::Vector2d& size);

  [[nodiscard]] bool empty() const { return mean_.empty(); }
  /// Moves `view` to where the picture agrees best, by Gauss-Newton steps from where it is; pixels that do
  /// not agree lose their weight. `form`: scale and turn too, which are left alone where it is null.
  Agreement align(const cv::Mat& grey, View& view, const Form* form) const;
  [[nodiscard]] Agreement compare(const cv::Mat& grey, const View& view) const;
  /// Takes in what the picture shows at `view`, at a rate from 0 to 1.
  void learn(const cv::Mat& grey, const View& view, double rate);
  /// The grid upright, as a picture of one sample a pixel, for a search.
  [[nodiscard]] cv::Mat picture() const;
  /// First-picture pixels from one sample to the next.
  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] const Eigen::Vector2d& size() const { return size_; }

 private:
  void sample(const cv::Mat& grey, const View& view, std::vector<float>& values) const;
  void weigh();
  Agreement judge(const std::vector<float>& values, double gain, double bias) const;

  int across_ = 0, down_ = 0;
  double step_ = 1;
  Eigen::Vector2d size_ = Eigen::Vector2d::Zero();
  std::vector<float> x_, y_;              // of each sample, first-picture px from the centre
  std::vector<float> mean_, variance_;    // grey levels
  std::vector<float> taper_, weight_;     // weight_ = taper_ by what variance_ says
  std::vector<float> slope_x_, slope_y_;  // of mean_, grey levels a first-picture px
  double level_ = 0, contrast_ = 0;       // weighted mean and standard deviation of mean_
};

}  // namespace vericone::vision
