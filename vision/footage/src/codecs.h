// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/vision/tracker.h>
#include <filesystem>
#include <opencv2/core.hpp>

namespace vericone::vision {

/// Whoever calls says in one line what is wrong; the libraries below say nothing.
void silence_codecs();

/// A copy of `channels` channels.
[[nodiscard]] Image to_image(const cv::Mat& picture, int channels);

/// Blue, green, red; empty where the file is no whole picture.
[[nodiscard]] cv::Mat decode(const std::filesystem::path& file);

}  // namespace vericone::vision
