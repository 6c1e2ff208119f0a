// SPDX-License-Identifier: BSD-3-Clause
#include "pursue/marks.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vericone::pursuit {

vision::Image in_colour(const vision::Image& image) {
  if (image.channels == 3) return image;
  vision::Image result(image.width, image.height, 3);
  for (std::size_t i = 0; i < image.data.size(); ++i)
    std::fill_n(result.data.begin() + std::ptrdiff_t(3 * i), 3, image.data[i]);
  return result;
}

void mark(vision::Image& image, const vision::Sighting& sighting) {
  constexpr std::array<std::array<std::uint8_t, 3>, 4> kColours{
      {{60, 200, 60}, {30, 220, 240}, {40, 40, 230}, {150, 150, 150}}};
  const auto& colour = kColours[std::size_t(sighting.sight)];
  const auto dot = [&](int u, int v) {
    if (u < 0 || v < 0 || u >= image.width || v >= image.height) return;
    std::copy(colour.begin(), colour.end(), image.data.begin() + 3 * (std::ptrdiff_t(v) * image.width + u));
  };
  if (!std::isfinite(sighting.box.x + sighting.box.y + sighting.box.w + sighting.box.h)) return;
  constexpr double kFar = 1e5;
  const auto whole = [&](double x) { return int(std::lround(std::clamp(x, -kFar, kFar))); };
  // A frame two pixels wide, two pixels outside of the box.
  for (const int out : {2, 3}) {
    const int left = whole(sighting.box.x) - out, right = whole(sighting.box.x + sighting.box.w) + out,
              top = whole(sighting.box.y) - out, bottom = whole(sighting.box.y + sighting.box.h) + out;
    for (int u = std::max(left, 0); u <= std::min(right, image.width - 1); ++u) dot(u, top), dot(u, bottom);
    for (int v = std::max(top, 0); v <= std::min(bottom, image.height - 1); ++v) dot(left, v), dot(right, v);
  }
}

}  // namespace vericone::pursuit
