// SPDX-License-Identifier: BSD-3-Clause
//
// What a body is and where it goes, in plain words.
#pragma once

#include <string>

#include "input/body.h"

namespace vericone {

/// "ellipsoid, half-lengths 1, 0.6, 0.5 m, centre (0, 0, 0) m".
std::string body_words(const Placed& body);
std::string body_words(const CombinedEllipse& body);

/// Agent and obstacle of a scene, and whether they are planar.
struct SceneWords {
  std::string agent, obstacle;
  bool planar = false;
};
SceneWords words_of(const input::AnyEngagement& engagement);

/// "at rest", or "moves at 3.03 m/s, azimuth 7.6, elevation 0 degrees"; `planar`: without the elevation.
std::string motion_words(const Eigen::Vector3d& velocity, bool planar);

/// Four digits: what is shown to be read.
std::string brief(double x);

}  // namespace vericone
