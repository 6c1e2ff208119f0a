// SPDX-License-Identifier: BSD-3-Clause
//
// What a body is and where it goes, in plain words.
#pragma once

#include <vericone/scenes/scene.h>
#include <string>

namespace vericone::scenes {

/// "ellipsoid, half-lengths 1, 0.6, 0.5 m, centre (0, 0, 0) m". Lengths with four digits.
[[nodiscard]] std::string body_words(const Placed& body);
[[nodiscard]] std::string body_words(const CombinedEllipse& body);

/// "at rest", or "moves at 3.03 m/s, azimuth 7.6, elevation 0 degrees"; `planar`: without the elevation.
[[nodiscard]] std::string motion_words(const Eigen::Vector3d& velocity, bool planar);

/// Four digits: what is shown to be read.
[[nodiscard]] std::string brief(double x);

}  // namespace vericone::scenes
