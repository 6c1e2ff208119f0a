// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/track.h>

#include "certificate/stated.h"

namespace vericone::simulation::certified {

/// Of more, neighbours stand side by side, and boxes that hold some of them each are tried in their place.
constexpr std::size_t kManyPieces = 256;

/// A body as a certificate states it, about its reference point, in its own axes.
struct OwnFrame {
  Solid solid;
  bool dents = false;   // it, or a piece, has some
  double rounding = 0;  // m, by how much a point of the body may be off in it
};

/// All that it is during [from, to].
[[nodiscard]] OwnFrame in_own_frame(const ShapeInTime& shape, double from, double to);

}  // namespace vericone::simulation::certified
