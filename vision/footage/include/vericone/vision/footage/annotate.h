// SPDX-License-Identifier: BSD-3-Clause
//
// What is drawn into pictures for people to look at.
#pragma once

#include <vericone/vision/image.h>
#include <vericone/vision/tracker.h>
#include <string>

namespace vericone::vision {

/// A copy in grey, as trackers want it. Throws InputError naming "image".
[[nodiscard]] Image grey_of(const Image& image);

/// A box into a picture of 3 channels, coloured by what the tracker says of it: green seen, yellow partly
/// hidden, red hidden, violet lost; where it is only expected, dashed. Its name and confidence stand above
/// it. Throws InputError naming "image".
void draw_sighting(Image& image, const Sighting& sighting, const std::string& name);

}  // namespace vericone::vision
