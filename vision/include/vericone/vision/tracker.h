// SPDX-License-Identifier: BSD-3-Clause
//
// A picture in memory, 8 bits a channel, and a box in it. Pixels: u to the right, v down, (0, 0) the middle
// of the first one.
#pragma once

#include <vericone/internal/geometry/requires.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace vericone::vision {

struct Image {
  int width = 0, height = 0, channels = 1;  // 1: grey; 3: blue, green, red
  std::vector<std::uint8_t> data;           // row by row, no gaps

  Image() = default;
  Image(int w, int h, int c) : width(w), height(h), channels(c), data(std::size_t(w) * h * c) {
    VERICONE_REQUIRES(w > 0 && h > 0 && (c == 1 || c == 3) && double(w) * h < 1e9, "size",
                      "no size of a picture", "w x h pixels of 1 or 3 channels");
  }
  [[nodiscard]] bool empty() const { return data.empty(); }
};

/// Upright, in pixels: left and top edge, width and height.
struct Box {
  double x = 0, y = 0, w = 0, h = 0;
  [[nodiscard]] Eigen::Vector2d centre() const { return {x + 0.5 * w, y + 0.5 * h}; }
};
/// Intersection over union, 0 to 1.
[[nodiscard]] double overlap(const Box& a, const Box& b);

// Several targets followed through the pictures of a moving camera.

/// How much of a target is hidden, as the tracker says (source 3.3.4).
enum class Sight : std::uint8_t {
  no_occlusion,
  partial,
  total,  // no measurement
  lost,   // given up: hidden for longer than the tracker searches; it may still be regained
};
[[nodiscard]] const char* to_string(Sight sight);

/// What one picture says of one target.
struct Sighting {
  Sight sight = Sight::total;
  Box box;                                                   // where it is, or is expected while it is hidden
  bool measured = false;                                     // the box's centre is a measurement
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  // of the measured centre, px^2
  double confidence = 0;                                     // 0 to 1, that the box holds the target
};

/// Where a filter expects a target, from estimates only: recovery searches there.
struct Expectation {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();          // px
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  // px^2
  double scale = 1;                                          // of the target's picture, against the first one
  double turn = 0;                                           // of it, rad, u to v, against the first one
};

class Tracker {
 public:
  virtual ~Tracker() = default;
  /// The first picture, with a box around every target. Throws InputError naming "boxes[i]": outside of the
  /// picture, too small, without texture.
  virtual void start(const Image& image, std::span<const Box> boxes) = 0;
  /// One target more, in the newest picture. Throws as start().
  virtual void add(const Box& box) = 0;
  /// The next one. `ground`: (u, v, 1) of the picture before to this one, of points on the ground, from the
  /// camera's own motion; left out: estimated from the pictures. `expected`: one a target, or none at all,
  /// and then the tracker's own. Pictures of another size throw InputError naming "image".
  virtual const std::vector<Sighting>& step(const Image& image, const std::optional<Eigen::Matrix3d>& ground,
                                            std::span<const Expectation> expected) = 0;
};

/// The source's (3.3.4, errata 4.3): 4 Shi-Tomasi points a target, pyramidal Lucas-Kanade, centroid
/// adjustment, recovery by patches and SIFT within the expected box. It never says `lost`, and its boxes keep
/// their size.
struct SourceTrackerOptions {
  int corners = 4;
  double quality = 0.3, distance = 7;
  int window = 15, levels = 2;
  double most_error = 15, template_score = 0.9849, descriptor_distance = 250;
  double patch = 0.25;  // side of a point's patch, of the box's longer one: 1.5 m of a vehicle of 6 m
};
/// Throws InputError naming the option: positive and at most 1e6; "window" odd, from 3 up; "levels" 0 or
/// more.
[[nodiscard]] std::unique_ptr<Tracker> source_tracker(const SourceTrackerOptions& options = {});

struct TrackerOptions {
  double frame_seconds = 1.0 / 30;  // s
  double give_up = 5;               // s hidden, until `lost` is said
};
[[nodiscard]] std::unique_ptr<Tracker> tracker(const TrackerOptions& options = {});

}  // namespace vericone::vision
