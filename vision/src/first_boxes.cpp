// SPDX-License-Identifier: BSD-3-Clause
#include "first_boxes.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/vision/whole.h>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "opencv_image.h"

namespace vericone::vision {
namespace {

constexpr double kLeastSide = 2, kLeastLength = 5;  // px: less has no form that could be told from others'
// Of the slope across and along a corner, grey levels a pixel: sensor noise of one grey level stays below it.
constexpr double kLeastSlope = 1.5;

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

}  // namespace

void check_picture(const Image& image, const cv::Mat& before) {
  require_whole(image);
  if (!before.empty() && (before.cols != image.width || before.rows != image.height))
    throw InputError("image", size_text(image.width, image.height),
                     "as large as the first one, " + size_text(before.cols, before.rows));
}

void check_first_box(const cv::Mat& grey, const Box& box, const std::string& field) {
  const std::string text =
      to_text(box.x) + "," + to_text(box.y) + "," + to_text(box.w) + "," + to_text(box.h);
  if (!std::isfinite(box.x + box.y + box.w + box.h) || !(box.w > 0) || !(box.h > 0))
    throw InputError(field, text, "X,Y,W,H of a box in pixels, with W and H above 0");
  if (std::min(box.w, box.h) < kLeastSide || std::max(box.w, box.h) < kLeastLength)
    throw InputError(
        field, text,
        "at least " + to_text(kLeastLength) + " px long and " + to_text(kLeastSide) + " px wide");
  if (box.x < -0.5 || box.y < -0.5 || box.x + box.w > grey.cols + 0.5 || box.y + box.h > grey.rows + 0.5)
    throw InputError(field, text, "within the picture of " + size_text(grey.cols, grey.rows));
  // With its edges: something plain on other ground has corners.
  const cv::Rect inside =
      cv::Rect(cv::Point(int(std::floor(box.x)) - 2, int(std::floor(box.y)) - 2),
               cv::Point(int(std::ceil(box.x + box.w)) + 2, int(std::ceil(box.y + box.h)) + 2)) &
      cv::Rect(0, 0, grey.cols, grey.rows);
  cv::Mat floats, corners;
  grey(inside).convertTo(floats, CV_32F);
  cv::cornerMinEigenVal(floats, corners, 3, 3);
  double most = 0;
  cv::minMaxLoc(corners, nullptr, &most);
  // The sum over 3 x 3 pixels of squared Sobel derivatives, 8 slopes each, that OpenCV divides by 4 x 3.
  if (!(most > 9 * std::pow(8 * kLeastSlope / 12, 2)))
    throw InputError(field, text, "around something with texture: nothing there can be followed");
}

}  // namespace vericone::vision
