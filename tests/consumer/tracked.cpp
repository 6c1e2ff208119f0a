// SPDX-License-Identifier: BSD-3-Clause
//
// A tracker of the installed library, linked with OpenCV by the package alone.
#include <vericone/vision/tracker.h>
#include <array>

/// A bright square that moves two pixels to the right.
bool tracked() {
  using namespace vericone::vision;
  const auto picture = [](int at) {
    Image image(160, 120, 1);
    for (int v = 0; v < 120; ++v)
      for (int u = 0; u < 160; ++u) {
        const bool on = u >= at && u < at + 24 && v >= 50 && v < 70;
        image.data[std::size_t(160 * v + u)] =
            std::uint8_t(on ? 150 + 60 * ((u - at) / 6 % 2) + 20 * (v / 5 % 2) : 40 + (7 * u + 13 * v) % 23);
      }
    return image;
  };
  const auto tracker = vericone::vision::tracker();
  const std::array<Box, 1> boxes{Box{60, 50, 24, 20}};
  tracker->start(picture(60), boxes);
  const Sighting& said = tracker->step(picture(62), std::nullopt, {})[0];
  return overlap(said.box, {62, 50, 24, 20}) > 0.5;
}
