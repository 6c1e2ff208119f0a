// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/vision/whole.h>
#include <vericone/vision/tracker.h>
#include <algorithm>
#include <string>

namespace vericone::vision {

void require_whole(const Image& image) {
  if (image.width <= 0 || image.height <= 0 || (image.channels != 1 && image.channels != 3) ||
      image.data.size() != std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels))
    throw InputError("image",
                     std::to_string(image.width) + " x " + std::to_string(image.height) + " px, " +
                         std::to_string(image.data.size()) + " bytes of " + std::to_string(image.channels) +
                         " channels",
                     "a picture of 1 or 3 channels, 8 bits each");
}

double overlap(const Box& a, const Box& b) {
  const double w = std::min(a.x + a.w, b.x + b.w) - std::max(a.x, b.x),
               h = std::min(a.y + a.h, b.y + b.h) - std::max(a.y, b.y);
  if (!(w > 0 && h > 0)) return 0;
  return w * h / (a.w * a.h + b.w * b.h - w * h);
}

}  // namespace vericone::vision
