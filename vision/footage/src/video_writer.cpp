// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/vision/footage/footage.h>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>

#include "codecs.h"

namespace vericone::vision {

struct VideoWriter::Parts {
  std::filesystem::path file;
  int width, height;
  cv::VideoWriter writer;
  cv::Mat colours;
};

VideoWriter::VideoWriter(const std::filesystem::path& file, int width, int height, double rate)
    : parts_(new Parts{file, width, height, {}, {}}) {
  silence_codecs();
  const cv::Size even(width & ~1, height & ~1);
  for (const int codec :
       {cv::VideoWriter::fourcc('a', 'v', 'c', '1'), cv::VideoWriter::fourcc('m', 'p', '4', 'v')})
    if (even.width > 0 && even.height > 0 && rate > 0 &&
        parts_->writer.open(file.string(), cv::CAP_FFMPEG, codec, rate, even, true))
      return;
  throw std::runtime_error(file.string() + ": a video of " + std::to_string(width) + " x " +
                           std::to_string(height) + " px cannot be written");
}
VideoWriter::~VideoWriter() = default;
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;

void VideoWriter::add(const Image& image) {
  if (image.width != parts_->width || image.height != parts_->height)
    throw std::runtime_error(parts_->file.string() + ": a picture of another size");
  const cv::Mat seen(image.height, image.width, CV_8UC(image.channels),
                     const_cast<std::uint8_t*>(image.data.data()));
  const cv::Rect even(0, 0, image.width & ~1, image.height & ~1);
  if (image.channels == 1)
    cv::cvtColor(seen(even), parts_->colours, cv::COLOR_GRAY2BGR);
  else
    seen(even).copyTo(parts_->colours);
  parts_->writer.write(parts_->colours);
}

void VideoWriter::close() {
  parts_->writer.release();
  std::error_code error;
  if (std::filesystem::file_size(parts_->file, error) == 0 || error)
    throw std::runtime_error(parts_->file.string() + ": cannot be written");
}

}  // namespace vericone::vision
