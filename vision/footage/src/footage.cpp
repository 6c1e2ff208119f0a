// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/vision/footage/footage.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <opencv2/videoio.hpp>
#include <vector>

#include "codecs.h"

namespace vericone::vision {
namespace {

namespace fs = std::filesystem;

/// Numbers within names count as numbers: 9.png comes before 10.png.
bool earlier(const fs::path& a, const fs::path& b) {
  const std::string x = a.filename().string(), y = b.filename().string();
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0, j = 0;
  while (i < x.size() && j < y.size()) {
    if (digit(x[i]) && digit(y[j])) {
      while (i < x.size() && x[i] == '0') ++i;
      while (j < y.size() && y[j] == '0') ++j;
      std::size_t m = i, n = j;
      while (m < x.size() && digit(x[m])) ++m;
      while (n < y.size() && digit(y[n])) ++n;
      if (m - i != n - j) return m - i < n - j;
      const int order = x.compare(i, m - i, y, j, n - j);
      if (order != 0) return order < 0;
      i = m;
      j = n;
    } else {
      if (x[i] != y[j]) return x[i] < y[j];
      ++i;
      ++j;
    }
  }
  return x.size() - i != y.size() - j ? x.size() - i < y.size() - j : x < y;
}

bool is_picture(const fs::path& file) {
  std::string end = file.extension().string();
  std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return end == ".png" || end == ".jpg" || end == ".jpeg" || end == ".bmp" || end == ".tif" || end == ".tiff";
}

class Folder : public Reader {
 public:
  Folder(const fs::path& folder, int channels, const std::string& field) : channels_(channels) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      if (entry.is_regular_file() && is_picture(entry.path())) files_.push_back(entry.path());
    if (files_.empty())
      throw InputError(field, folder.string(), "a video, or a folder with pictures (PNG, JPEG, BMP, TIFF)");
    std::sort(files_.begin(), files_.end(), earlier);
  }
  bool next(Image& image) override {
    if (at_ == files_.size()) return false;
    const fs::path& file = files_[at_];
    image = read_picture(file, channels_, "picture");
    if (at_ == 0) {
      width_ = image.width;
      height_ = image.height;
    } else if (image.width != width_ || image.height != height_) {
      throw InputError(
          "picture",
          file.string() + " of " + std::to_string(image.width) + " x " + std::to_string(image.height) + " px",
          "as large as those before, " + std::to_string(width_) + " x " + std::to_string(height_) + " px");
    }
    ++at_;
    return true;
  }
  double rate() const override { return 0; }
  std::optional<std::size_t> frames() const override { return files_.size(); }
  std::optional<std::string> broken() const override { return std::nullopt; }

 private:
  int channels_;
  std::vector<fs::path> files_;
  std::size_t at_ = 0;
  int width_ = 0, height_ = 0;
};

class Video : public Reader {
 public:
  Video(const fs::path& file, int channels, const std::string& field) : channels_(channels) {
    silence_codecs();
    // FFmpeg alone: other readers of OpenCV take a file's name for a pattern of names.
    if (!fs::is_regular_file(file) || !capture_.open(file.string(), cv::CAP_FFMPEG) ||
        !capture_.read(ahead_) || ahead_.empty())
      throw InputError(field, file.string(), "a video that can be read, or a folder with pictures");
    const double rate = capture_.get(cv::CAP_PROP_FPS), frames = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    if (std::isfinite(rate) && rate > 0 && rate < 10'000) rate_ = rate;
    if (std::isfinite(frames) && frames >= 1 && frames < 1e9) frames_ = std::size_t(std::lround(frames));
  }
  bool next(Image& image) override {
    if (ahead_.empty()) return false;
    image = to_image(ahead_, channels_);
    ++given_;
    try {
      if (!capture_.read(ahead_)) ahead_.release();
    } catch (const cv::Exception&) {
      ahead_.release();
    }
    return true;
  }
  double rate() const override { return rate_; }
  std::optional<std::size_t> frames() const override { return frames_; }
  std::optional<std::string> broken() const override {
    // Some files do not count their pictures, and their length by their rate is off by some.
    if (!ahead_.empty() || !frames_ || given_ + std::max<std::size_t>(2, *frames_ / 100) >= *frames_)
      return std::nullopt;
    return std::to_string(given_) + " of " + std::to_string(*frames_) + " pictures could be read";
  }

 private:
  int channels_;
  cv::VideoCapture capture_;
  cv::Mat ahead_;
  double rate_ = 0;
  std::optional<std::size_t> frames_;
  std::size_t given_ = 0;
};

}  // namespace

std::unique_ptr<Reader> open_footage(const fs::path& path, int channels, const std::string& field) {
  std::error_code error;
  if (fs::is_directory(path, error)) return std::make_unique<Folder>(path, channels, field);
  return std::make_unique<Video>(path, channels, field);
}

}  // namespace vericone::vision
