// SPDX-License-Identifier: BSD-3-Clause
//
// A picture in memory, 8 bits a channel, and a box in it. Pixels: u to the right, v down, (0, 0) the middle
// of the first one.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vericone::vision {

struct Image {
  int width = 0, height = 0, channels = 1;  // 1: grey; 3: blue, green, red
  std::vector<std::uint8_t> data;           // row by row, no gaps

  Image() = default;
  Image(int w, int h, int c) : width(w), height(h), channels(c), data(std::size_t(w) * h * c) {}
  [[nodiscard]] bool empty() const { return data.empty(); }
};

/// Throws InputError naming "image" unless it has 1 or 3 channels, and as many bytes as its pixels times
/// them.
void require_whole(const Image& image);

/// Upright, in pixels: left and top edge, width and height.
struct Box {
  double x = 0, y = 0, w = 0, h = 0;
  [[nodiscard]] Eigen::Vector2d centre() const { return {x + 0.5 * w, y + 0.5 * h}; }
};
/// Intersection over union, 0 to 1.
[[nodiscard]] double overlap(const Box& a, const Box& b);

}  // namespace vericone::vision
