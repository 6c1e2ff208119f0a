// SPDX-License-Identifier: BSD-3-Clause
//
// What a body is and where it goes, in plain words.
#pragma once

#include <vericone/scenes/scene.h>
#include <string>
#include <vector>

namespace vericone::scenes {

/// "ellipsoid, half-lengths 1, 0.6, 0.5 m, centre (0, 0, 0) m". Lengths with four digits.
[[nodiscard]] std::string body_words(const Placed& body);
[[nodiscard]] std::string body_words(const CombinedEllipse& body);

/// "at rest", or "moves at 3.03 m/s, azimuth 7.6, elevation 0 degrees"; `planar`: without the elevation.
[[nodiscard]] std::string motion_words(const Eigen::Vector3d& velocity, bool planar);

/// What of its file a body does not show, and what it takes for granted: a line each.
[[nodiscard]] std::vector<std::string> reading_words(const Reading& reading);

/// Four digits: what is shown to be read.
[[nodiscard]] std::string brief(double x);

}  // namespace vericone::scenes
