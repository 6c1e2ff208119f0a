// SPDX-License-Identifier: BSD-3-Clause
//
// Polynomials of time that a body's track keeps near to, with a proved bound of how near.
#pragma once

#include <vericone/simulation/track.h>
#include <optional>
#include <vector>

#include "certificate/stated.h"

namespace vericone::simulation::certified {

/// What a tube is to hold.
struct TubeQuestion {
  double from, to;    // s, within the track's life
  double tolerance;   // m: segments are halved until polynomials are as near as this
  double reach;       // m, of the body's points from its position
  bool turns_matter;  // false of a ball: its orientation is left out
  double padding;     // m, of position, and of the body's farthest point by orientation, at the end
};

/// Every point of the body is, at each time of the question, within the radius of where the stated
/// polynomials put it: so of the track and of all motions within the padding of it. None where the track's
/// bounds do not tell how it turns (a level body that flies vertically, a turning body that comes to rest).
/// Method: docs/explanation/proof-of-runs.md.
[[nodiscard]] std::optional<StatedTrack> tube(const Track& track, const TubeQuestion& question);

/// The place and the rotation that polynomials say, in doubles.
struct Placement {
  Eigen::Vector3d position;
  Eigen::Matrix3d rotation;
};
[[nodiscard]] Placement placement(const StatedTrack& track, std::size_t segment, double t);
/// Bernstein coefficients of the position on [from, to], within one segment, rounded.
[[nodiscard]] std::vector<Eigen::Vector3d> control_points(const StatedTrack& track, double from, double to);
/// Between two segments as the later one says.
[[nodiscard]] Placement placement_at(const StatedTrack& track, double t);

}  // namespace vericone::simulation::certified
