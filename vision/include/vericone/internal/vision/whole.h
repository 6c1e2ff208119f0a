// SPDX-License-Identifier: BSD-3-Clause
//
// Whether a picture is one.
#pragma once

#include <vericone/vision/tracker.h>

namespace vericone::vision {

/// Throws InputError naming "image" unless it has 1 or 3 channels, and as many bytes as its pixels times
/// them.
void require_whole(const Image& image);

}  // namespace vericone::vision
