// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "certificate/planes.h"

namespace vericone::simulation::certified {

/// Points of two bodies at one time, found in doubles.
struct NearPoints {
  double room;        // m: they are nearer than is to be shown by so much, whatever the motions in the tubes
  std::string proof;  // JSON
};

/// The nearest of the two at t, which is not between two segments of a track. Bodies that overlap have a
/// point in common, and of round ones the ball about it that lies within counts. Nothing of bodies with
/// dents.
[[nodiscard]] std::optional<NearPoints> near_points(const PairQuestion& question, double t);

}  // namespace vericone::simulation::certified
