// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/vision/tracker.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace vericone::vision {

/// The same pixels, seen as OpenCV's; `image` must live as long. OpenCV writes only to what it is told to.
[[nodiscard]] inline cv::Mat as_mat(const Image& image) {
  return cv::Mat(image.height, image.width, CV_8UC(image.channels),
                 const_cast<std::uint8_t*>(image.data.data()));
}

/// Grey, and a copy: trackers keep the picture before.
inline void to_grey(const Image& image, cv::Mat& grey) {
  const cv::Mat seen = as_mat(image);
  if (image.channels == 1)
    seen.copyTo(grey);
  else
    cv::cvtColor(seen, grey, cv::COLOR_BGR2GRAY);
}

[[nodiscard]] inline cv::Rect2d as_rect(const Box& box) { return {box.x, box.y, box.w, box.h}; }
[[nodiscard]] inline cv::Point2d as_point(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }
[[nodiscard]] inline Eigen::Vector2d as_vector(const cv::Point2d& p) { return {p.x, p.y}; }

}  // namespace vericone::vision
