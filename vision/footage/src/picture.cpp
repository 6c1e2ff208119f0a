// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/vision/whole.h>
#include <vericone/vision/footage/footage.h>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <mutex>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>
#include <vector>

#include "codecs.h"

namespace vericone::vision {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A JPEG that is cut off is filled up with grey by its decoder, and of a PNG its decoder complains by
/// itself. A whole JPEG has the mark of its end after the last mark of a scan, a whole PNG its last chunk.
bool cut_off(const Bytes& bytes) {
  constexpr std::uint8_t jpeg[] = {0xff, 0xd8, 0xff}, scan[] = {0xff, 0xda}, end[] = {0xff, 0xd9};
  constexpr std::uint8_t png[] = {0x89, 'P', 'N', 'G'}, last[] = {'I', 'E', 'N', 'D'};
  const auto starts = [&](const auto& mark) {
    return bytes.size() > std::size(mark) && std::equal(std::begin(mark), std::end(mark), bytes.begin());
  };
  const auto lacks = [&](auto from, const auto& mark) {
    return std::search(from, bytes.end(), std::begin(mark), std::end(mark)) == bytes.end();
  };
  if (starts(jpeg))
    return lacks(std::find_end(bytes.begin(), bytes.end(), std::begin(scan), std::end(scan)), end);
  return starts(png) &&
         lacks(bytes.end() - std::min<std::ptrdiff_t>(1000, std::ptrdiff_t(bytes.size())), last);
}

}  // namespace

void silence_codecs() {
  static std::once_flag once;
  std::call_once(once, [] {
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // AV_LOG_QUIET
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  });
}

Image to_image(const cv::Mat& picture, int channels) {
  cv::Mat wanted = picture;
  if (channels == 1 && picture.channels() == 3) cv::cvtColor(picture, wanted, cv::COLOR_BGR2GRAY);
  Image image(wanted.cols, wanted.rows, wanted.channels());
  const std::size_t row = std::size_t(image.width) * image.channels;
  for (int v = 0; v < image.height; ++v) std::memcpy(image.data.data() + v * row, wanted.ptr(v), row);
  return image;
}

cv::Mat decode(const std::filesystem::path& file) {
  silence_codecs();
  std::ifstream in(file, std::ios::binary);
  const Bytes bytes((std::istreambuf_iterator<char>(in)), {});
  if (bytes.empty() || cut_off(bytes)) return {};
  try {
    return cv::imdecode(bytes, cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    return {};
  }
}

Image read_picture(const std::filesystem::path& file, int channels, const std::string& field) {
  const cv::Mat picture = decode(file);
  if (picture.empty()) throw InputError(field, file.string(), "a whole picture (PNG, JPEG, BMP, TIFF)");
  return to_image(picture, channels);
}

void write_picture(const std::filesystem::path& file, const Image& image) {
  require_whole(image);
  silence_codecs();
  const cv::Mat seen(image.height, image.width, CV_8UC(image.channels),
                     const_cast<std::uint8_t*>(image.data.data()));
  Bytes bytes;
  if (!cv::imencode(".png", seen, bytes)) throw InputError("image", "nothing to write", "a picture");
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  if (!out.flush())
    throw std::system_error(errno ? errno : EIO, std::generic_category(), "could not write " + file.string());
}

}  // namespace vericone::vision
