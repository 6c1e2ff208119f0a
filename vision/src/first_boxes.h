// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/vision/tracker.h>
#include <opencv2/core.hpp>
#include <string>

namespace vericone::vision {

/// Throws InputError naming "image" where there is no picture or its numbers contradict each other, or where
/// it has not the size of `before`, unless that is empty.
void check_picture(const Image& image, const cv::Mat& before);

/// Throws InputError naming `field` for a box that cannot be followed: outside of the picture, too small,
/// without texture.
void check_first_box(const cv::Mat& grey, const Box& box, const std::string& field);

}  // namespace vericone::vision
