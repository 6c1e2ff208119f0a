// SPDX-License-Identifier: BSD-3-Clause
//
// Videos and folders of pictures, read and written.
#pragma once

#include <vericone/vision/tracker.h>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace vericone::vision {

/// A video, or a folder of pictures (PNG, JPEG, BMP, TIFF) in the order of their names, numbers in them as
/// numbers. Not for two threads at a time.
class Reader {
 public:
  virtual ~Reader() = default;
  /// The next picture, of the channels asked for; false at the end. A video that is cut off or spoilt ends
  /// where no picture comes any more; broken() then says so. Throws InputError naming the file of a folder's
  /// picture that cannot be read or has not the size of those before.
  virtual bool next(Image& image) = 0;
  [[nodiscard]] virtual double rate() const = 0;                        // pictures a second; 0: not known
  [[nodiscard]] virtual std::optional<std::size_t> frames() const = 0;  // as the file says
  /// After the end: what is missing, in words; none where all pictures came.
  [[nodiscard]] virtual std::optional<std::string> broken() const = 0;
};
/// `channels`: 1 for grey, 3 for blue, green, red. Throws InputError naming `field` for what is no video and
/// no folder with pictures.
[[nodiscard]] std::unique_ptr<Reader> open_footage(const std::filesystem::path& path, int channels,
                                                   const std::string& field);

/// A video file (MP4 with H.264 where the system can encode it, which browsers play; MPEG-4 otherwise). An
/// odd width or height loses its last column or row: neither codec has them. Throws InputError naming
/// "size" or "rate"; std::system_error where it cannot be written.
class VideoWriter {
 public:
  /// `rate`: pictures a second, above 0.
  VideoWriter(const std::filesystem::path& file, int width, int height, double rate);
  ~VideoWriter();
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;
  /// A picture of the size said, of 1 or 3 channels. Throws InputError naming "image" for another one.
  void add(const Image& image);
  /// Returns once the file is whole.
  void close();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// PNG. Throws InputError naming "image"; std::system_error naming the file where it cannot be written.
void write_picture(const std::filesystem::path& file, const Image& image);
/// Throws InputError naming `field`.
[[nodiscard]] Image read_picture(const std::filesystem::path& file, int channels, const std::string& field);

// What is drawn into pictures for people to look at.

/// A box into a picture of 3 channels, coloured by what the tracker says of it: green seen, yellow partly
/// hidden, red hidden, violet lost; where it is only expected, dashed. Its name and confidence stand above
/// it. Throws InputError naming "image".
void draw_sighting(Image& image, const Sighting& sighting, const std::string& name);

/// A copy in grey, as trackers want it. Throws InputError naming "image".
[[nodiscard]] Image grey_of(const Image& image);

}  // namespace vericone::vision
