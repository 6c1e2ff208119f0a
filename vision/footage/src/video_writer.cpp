// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/vision/whole.h>
#include <vericone/vision/footage/footage.h>
#include <cerrno>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <system_error>

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
  if (!(even.width > 0 && even.height > 0))
    throw InputError("size", std::to_string(width) + " x " + std::to_string(height) + " px",
                     "of 2 x 2 px at least");
  if (!(rate > 0)) throw InputError("rate", to_text(rate), "positive (pictures a second)");
  for (const int codec :
       {cv::VideoWriter::fourcc('a', 'v', 'c', '1'), cv::VideoWriter::fourcc('m', 'p', '4', 'v')})
    if (parts_->writer.open(file.string(), cv::CAP_FFMPEG, codec, rate, even, true)) return;
  throw std::system_error(EIO, std::generic_category(),
                          "could not write " + file.string() + ", a video of " + std::to_string(width) +
                              " x " + std::to_string(height) + " px");
}
VideoWriter::~VideoWriter() = default;
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;

void VideoWriter::add(const Image& image) {
  require_whole(image);
  if (image.width != parts_->width || image.height != parts_->height)
    throw InputError(
        "image", std::to_string(image.width) + " x " + std::to_string(image.height) + " px",
        std::to_string(parts_->width) + " x " + std::to_string(parts_->height) + " px, as the video");
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
    throw std::system_error(error ? error.value() : EIO, std::generic_category(),
                            "could not write " + parts_->file.string());
}

}  // namespace vericone::vision
