// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/testing/random_bodies.h>
#include <utility>
#include <vector>

namespace vericone::guidance {

/// A union of three bodies of flat, round and straight parts.
inline Body round_pieces(testing::RandomBodies& random) {
  std::vector<Convex> pieces;
  for (int i = 0; i < 3; ++i) {
    const Body body = testing::any_body(random, BodyKind::convex);
    pieces.push_back(in_world(*body.convex(), {random.in_box(1.5), random.rotation()}));
  }
  return Assembly::convexes(std::move(pieces));
}

}  // namespace vericone::guidance
