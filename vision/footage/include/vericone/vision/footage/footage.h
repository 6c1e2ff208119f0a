// SPDX-License-Identifier: BSD-3-Clause
//
// Videos and folders of pictures, read and written.
#pragma once

#include <vericone/vision/image.h>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace vericone::vision {

/// A video, or a folder of pictures in the order of their names.
class Reader {
 public:
  virtual ~Reader() = default;
  /// The next picture, of `channels` channels; false at the end. Throws InputError naming the file for one
  /// that cannot be read; a video that is cut off ends there, and broken() says so.
  virtual bool next(Image& image) = 0;
  [[nodiscard]] virtual double rate() const = 0;                        // pictures a second; 0: not known
  [[nodiscard]] virtual std::optional<std::size_t> frames() const = 0;  // as the file says
  [[nodiscard]] virtual std::optional<std::string> broken() const = 0;
};
/// Throws InputError naming `field`.
[[nodiscard]] std::unique_ptr<Reader> open_footage(const std::filesystem::path& path, int channels,
                                                   const std::string& field);

/// A video file (MP4). Throws std::runtime_error where it cannot be written.
class VideoWriter {
 public:
  VideoWriter(const std::filesystem::path& file, int width, int height, double rate);
  ~VideoWriter();
  void add(const Image& image);
  void close();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

void write_picture(const std::filesystem::path& file, const Image& image);  // PNG
[[nodiscard]] Image read_picture(const std::filesystem::path& file, int channels, const std::string& field);

}  // namespace vericone::vision
