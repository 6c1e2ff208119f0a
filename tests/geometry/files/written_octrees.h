// SPDX-License-Identifier: BSD-3-Clause
//
// Octree maps written by OctoMap itself, and points asked of it, for the tests of the reader.
#pragma once

#include <octomap/OcTree.h>

#include <Eigen/Core>
#include <sstream>
#include <string>

#include "support/random.h"

namespace vericone::testing {

/// A tree with leaves of several sizes, probabilities and gaps around the origin.
template <typename Tree>
void fill(Tree& tree, Random& random, int leaves = 400) {
  for (int i = 0; i < leaves; ++i) {
    const float log_odds = 0.5F * float(random.integer(-4, 7));
    ::octomap::OcTreeKey key;
    for (unsigned axis = 0; axis < 3; ++axis)
      key[axis] = ::octomap::key_type(32768 + random.integer(-12, 11));
    tree.setNodeValue(key, log_odds, true);
  }
  // Blocks of equal cells, which pruning makes one leaf; and of unequal ones, which it does not.
  for (const int block : {0, 1})
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 4; ++k) {
          const auto at = [](int x) { return ::octomap::key_type(32768 + x); };
          tree.setNodeValue(::octomap::OcTreeKey(at(8 * block + i), at(4 + j), at(k - 4)),
                            block == 0 ? 3.F : 1.F + 0.25F * float(i + j + k), true);
        }
  tree.updateInnerOccupancy();
  tree.prune();
}

template <typename Tree>
std::string to_ot(const Tree& tree) {
  std::ostringstream out;
  tree.write(out);
  return out.str();
}

template <typename Tree>
std::string to_bt(Tree& tree) {
  std::ostringstream out;
  tree.writeBinary(out);
  return out.str();
}

}  // namespace vericone::testing
