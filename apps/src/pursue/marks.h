// SPDX-License-Identifier: BSD-3-Clause
//
// Boxes drawn into pictures.
#pragma once

#include <vericone/vision/tracker.h>

namespace vericone::pursuit {

vision::Image in_colour(const vision::Image& image);
/// Green where it is seen, yellow in part, red where it is hidden, grey where it is lost.
void mark(vision::Image& image, const vision::Sighting& sighting);

}  // namespace vericone::pursuit
