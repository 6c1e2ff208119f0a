// SPDX-License-Identifier: BSD-3-Clause
//
// Whether some error collides: the distance of zero from
//   D = c + P - { t (w + v) : 0 <= t <= T, v in W } - K,
// a convex set of which supports are known, by Gilbert, Johnson and Keerthi's search.
#pragma once

#include <array>

#include "uncertain/engagement.h"

namespace vericone::robust {

enum class Nearness : std::uint8_t { apart, meet, close };

struct Nearest {
  /// `apart`: normal separates, proved. `meet`: zero is in the simplex. `close`: neither, for doubles.
  Nearness nearness = Nearness::close;
  Vector3d normal = Vector3d::Zero();

  /// The simplex: the points of D with these normals, and their weights.
  struct Corner {
    Vector3d n, x;
    bool late = false;  // at the end of `span`; otherwise at t = 0
    double weight = 0;
  };
  std::array<Corner, 4> corners;
  int count = 0;
  double span = 0;  // s, the horizon that was used
};

/// `start`: a first guess of the normal, not zero.
Nearest nearest(const Engagement& e, const Vector3d& start);

}  // namespace vericone::robust
