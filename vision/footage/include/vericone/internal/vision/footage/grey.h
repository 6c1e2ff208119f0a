// SPDX-License-Identifier: BSD-3-Clause
//
// A picture without its colours.
#pragma once

#include <vericone/vision/footage/footage.h>

namespace vericone::vision {

/// A copy in grey, as trackers want it. Throws InputError naming "image".
[[nodiscard]] Image grey_of(const Image& image);

}  // namespace vericone::vision
